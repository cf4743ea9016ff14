#include "vantage/tasks/mapping/external/planner_files.hpp"

#include <fmt/format.h>

#include "vantage/runtime/process/command_files.hpp"

namespace vantage {

void find_planner(ViewChoice& choice, const std::filesystem::path& base) {
  auto* external = std::get_if<ExternalChoice>(&choice);
  if (external != nullptr) external->command = settled_command(external->command, base);
}

std::vector<InputFile> planner_files(const ViewChoice& choice) {
  std::vector<InputFile> files;
  const auto* external = std::get_if<ExternalChoice>(&choice);
  if (external == nullptr) return files;
  for (const auto& [i, file] : files_of_command(external->command)) {
    files.push_back({fmt::format("choice.command[{}]", i), file});
  }
  return files;
}

void require_planner(const ViewChoice& choice) {
  const auto* external = std::get_if<ExternalChoice>(&choice);
  if (external == nullptr) return;
  try {
    external->check();
  } catch (const ConfigError& error) {
    throw ConfigError(std::string("choice.") + error.what());
  }
  runnable_command(external->command);
}

}  // namespace vantage
