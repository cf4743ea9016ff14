/// `vantage scene ...`.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_scene(CLI::App& app);

}  // namespace vantage
