/// The program, but for its start: loading its libraries takes 0.15 s, longer than most commands
/// do.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/shell.hpp"

namespace vantage::support {

/// A command of the program in a fork of this process.
/// @param arguments as a shell reads them
/// @return nothing if a shell is needed for them, if the command starts the program again, or if
/// this process has other threads
std::optional<ShellResult> run_inside(const std::filesystem::path& folder,
                                      const std::string& arguments);

}  // namespace vantage::support
