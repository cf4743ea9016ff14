/// `vantage replay`, `bound` and `branch`: what a run was, and what it could have been.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_replay(CLI::App& app);
std::function<ExitCode()> declare_bound(CLI::App& app);
std::function<ExitCode()> declare_branch(CLI::App& app);

}  // namespace vantage
