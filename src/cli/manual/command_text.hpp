/// A command as its own texts describe it: what pages of the manual and completion are made of.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vantage {

struct OptionText {
  std::vector<std::string> names = {};  ///< "-q", "--quiet"; of a positional its name
  std::string text = {};
  std::string default_value = {};  ///< empty: none said
  bool positional = false;
  bool takes_value = false;
  bool required = false;
  bool repeats = false;  ///< takes several values, or may be given several times
};

struct CommandText {
  std::string name = {};  ///< "sweep run"
  std::string text = {};
  std::string footer = {};
  std::vector<OptionText> options = {};
  std::vector<CommandText> parts = {};
};

/// @param name of the command; those below it follow
CommandText command_text(const std::string& name, CLI::App& app);

}  // namespace vantage
