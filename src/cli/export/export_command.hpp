/// `vantage export`: a run for other people's programs.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_export(CLI::App& app);

}  // namespace vantage
