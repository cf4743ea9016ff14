/// Completion of the command line by bash.
#pragma once

#include <string>
#include <vector>

#include "vantage/cli/manual/command_text.hpp"
#include "vantage/core/schema.hpp"

namespace vantage {

/// Words that complete the value of an option or of the first positional.
struct Completions {
  std::string command = {};  ///< empty: of every command
  std::string option = {};   ///< "--gain"; empty: the first positional
  std::vector<std::string> words = {};
};

/// A script that bash sources. Commands, flags and what `words` has complete as such, keys of
/// --set by `keys`, names of strategies after `key=`, anything else as a file.
std::string bash_completion(const std::vector<CommandText>& commands,
                            const std::vector<Completions>& words,
                            const std::vector<KeyDescription>& keys);

}  // namespace vantage
