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

/// Letters that are left out, added, changed or swapped with their neighbour between two words:
/// optimal string alignment.
std::size_t letters_off(std::string_view a, std::string_view b);

/// The one of `known` that is nearest by letters_off(); empty if none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// Of the command line's words, the first that stands where a subcommand should and is none:
/// "unknown command 'rnu'; did you mean run?"
std::optional<std::string> unknown_command(const CLI::App& app,
                                           const std::vector<std::string>& words);

}  // namespace vantage
