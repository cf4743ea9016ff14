/// `vantage schema`: what editors need to know of the files that users write.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_schema(CLI::App& app);

}  // namespace vantage
