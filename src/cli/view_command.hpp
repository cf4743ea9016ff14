/// `vantage view`.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_view(CLI::App& app);

}  // namespace vantage
