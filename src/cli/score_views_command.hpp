/// `vantage score-views`.
#pragma once

#include <functional>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

std::function<ExitCode()> declare_score_views(CLI::App& app);

}  // namespace vantage
