/// What a mistyped word was likely meant to be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace vantage {

/// `words` with a --set before each further assignment that follows one: `--set a=1 b=2`. What
/// comes after -- is somebody else's.
std::vector<std::string> with_every_set(const std::vector<std::string>& words);

/// Of the command line's words, the first that stands where a subcommand should and is none:
/// "unknown command 'rnu'; did you mean run?"
std::optional<std::string> unknown_command(const CLI::App& app,
                                           const std::vector<std::string>& words);

}  // namespace vantage
