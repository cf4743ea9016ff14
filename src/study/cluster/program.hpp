/// Other programs, by name.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vantage {

struct ProgramEnd {
  int exit_code = 0;  ///< 128 + the signal that killed it
  std::string output;
  std::string errors;
};

/// Runs a program of PATH and waits for it; its stdin is empty. Nothing if there is no such
/// program.
/// @throws OutputError if the system refuses a process or a temporary file.
std::optional<ProgramEnd> run_program(const std::vector<std::string>& arguments);

}  // namespace vantage
