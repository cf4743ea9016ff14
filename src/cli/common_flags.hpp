/// The flags that are the same for every command.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vantage {

/// -q and -v for the command and its subcommands. No flag of theirs takes a value, and no option
/// of theirs a number that is not finite.
void add_common_flags(CLI::App& app);

/// --json, for a command that prints a result.
void add_json(CLI::App& app, bool& json);

/// --overwrite, for a command that writes a result: see require_absent().
void add_overwrite(CLI::App& app, bool& overwrite);

}  // namespace vantage
