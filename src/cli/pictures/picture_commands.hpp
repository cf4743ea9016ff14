/// `vantage dataset import` and `vantage dataset check`: a user's own pictures.
#pragma once

#include <functional>
#include <memory>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

/// Flags that all commands share, declared by whoever declares the command.
struct PictureFlags {
  bool json = false;
  bool overwrite = false;
};

std::function<ExitCode()> declare_import(CLI::App& app,
                                         const std::shared_ptr<const PictureFlags>& flags);
std::function<ExitCode()> declare_check(CLI::App& app,
                                        const std::shared_ptr<const PictureFlags>& flags);

}  // namespace vantage
