/// The subcommands of `vantage`: each adds its options to a CLI11 app and returns what to run.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

struct Command {
  std::string_view name;
  std::string_view help;
  /// Declares the options on `app`, but for common_flags.hpp; the result runs the command once they
  /// are parsed.
  std::function<ExitCode()> (*declare)(CLI::App& app);
};

const std::vector<Command>& commands();

/// The command line as typed, for the manifest.
void remember_command_line(int argc, char** argv);
const std::vector<std::string>& command_line();

}  // namespace vantage
