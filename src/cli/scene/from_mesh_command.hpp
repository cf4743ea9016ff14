/// `vantage scene from-mesh`: scenes from what others drew.
#pragma once

#include <functional>
#include <memory>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

/// Flags that are the same for every command, which its caller adds.
struct SceneFlags {
  bool overwrite = false;
  bool json = false;
};

std::function<ExitCode()> declare_from_mesh(CLI::App& app,
                                            const std::shared_ptr<const SceneFlags>& flags);

}  // namespace vantage
