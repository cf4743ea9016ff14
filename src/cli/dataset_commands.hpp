/// `vantage dataset ...`.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

/// The command of this program that renders for another process of it.
inline constexpr std::string_view kRenderWorker = "render-worker";
/// Program and arguments of such a process, as DatasetRun takes them.
std::vector<std::string> own_render_worker();

std::function<ExitCode()> declare_dataset(CLI::App& app);

}  // namespace vantage
