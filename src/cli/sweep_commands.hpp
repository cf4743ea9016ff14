/// `vantage sweep ...` and `vantage compare`.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_sweep(CLI::App& app);
std::function<ExitCode()> declare_compare(CLI::App& app);

}  // namespace vantage
