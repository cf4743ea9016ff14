/// `vantage arena run|add|page`: planners side by side, and a planner of anybody's among them.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_arena(CLI::App& app);

}  // namespace vantage
