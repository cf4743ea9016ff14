/// The command line of a program of a user's, as an episode's file has it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vantage {

/// Arguments that name a file in `base`, the working directory or the data root, named so that they
/// are found again; the others as they are. The program itself is such a file if its name has a
/// slash. Nothing need be there: a recorded run is read without the program.
std::vector<std::string> settled_command(std::vector<std::string> command,
                                         const std::filesystem::path& base);

/// Those of the arguments that name a file, by their place in the command.
std::vector<std::pair<std::size_t, std::filesystem::path>> files_of_command(
    const std::vector<std::string>& command);

/// The command with the program found in PATH and files by their absolute path.
/// @throws ConfigError naming a program that is not there or cannot be run
std::vector<std::string> runnable_command(const std::vector<std::string>& command);

}  // namespace vantage
