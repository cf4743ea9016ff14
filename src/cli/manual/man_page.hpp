/// Pages of section 1 of the manual.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "vantage/cli/manual/command_text.hpp"

namespace vantage {

/// What every page ends with.
struct ManualFrame {
  std::string version = {};
  std::string summary = {};                                           ///< of the program
  std::vector<std::pair<std::string, std::string>> exit_status = {};  ///< code and meaning
};

/// vantage(1): the commands, and what they have in common.
std::string program_page(const std::vector<CommandText>& commands, const ManualFrame& frame);
/// vantage-NAME(1), with the commands below it.
std::string command_page(const CommandText& command, const ManualFrame& frame);

/// vantage.1, and a page a command. @throws OutputError
void write_manual(const std::vector<CommandText>& commands, const ManualFrame& frame,
                  const std::filesystem::path& directory);

/// `text` as roff prints it letter for letter.
std::string roff_text(const std::string& text);

}  // namespace vantage
