/// `vantage explain`: what a key, strategy, column, file or exit code means.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_explain(CLI::App& app);

}  // namespace vantage
