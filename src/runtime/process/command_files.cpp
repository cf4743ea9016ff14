#include "vantage/runtime/process/command_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <sstream>

#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// None of an option, or where there is no such file.
std::optional<fs::path> file_named(const std::string& argument, const fs::path& base) {
  if (argument.empty() || argument.front() == '-') return std::nullopt;
  try {
    fs::path found = find_input(argument, base, "choice.command");
    if (is_file(found)) return found;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

bool is_path(const std::string& name) { return name.find('/') != std::string::npos; }

bool can_be_run(const fs::path& path) { return is_file(path) && ::access(path.c_str(), X_OK) == 0; }

std::optional<fs::path> program_in_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path found = fs::path(folder.empty() ? "." : folder) / name;
    if (can_be_run(found)) return fs::absolute(found);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> settled_command(std::vector<std::string> command, const fs::path& base) {
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (i == 0 && !is_path(command[i])) continue;
    if (const auto found = file_named(command[i], base)) command[i] = lasting_name(*found);
  }
  return command;
}

std::vector<std::pair<std::size_t, fs::path>> files_of_command(
    const std::vector<std::string>& command) {
  std::vector<std::pair<std::size_t, fs::path>> files;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (i == 0 && !is_path(command[i])) continue;
    if (const auto found = file_named(command[i], {})) files.emplace_back(i, fs::absolute(*found));
  }
  return files;
}

std::vector<std::string> runnable_command(const std::vector<std::string>& command) {
  expects(!command.empty(), "a program to run");
  std::vector<std::string> runnable = command;
  for (const auto& [i, file] : files_of_command(command)) runnable[i] = file.string();
  std::string& program = runnable.front();
  if (!is_path(program)) {
    const auto found = program_in_path(program);
    if (!found) {
      throw ConfigError(fmt::format("choice.command: there is no program '{}' in PATH", program));
    }
    program = found->string();
  }
  if (!can_be_run(program)) {
    throw ConfigError(fmt::format("choice.command: '{}' is no program that can be run", program));
  }
  return runnable;
}

}  // namespace vantage
