/// What the verbs of `vantage arena` do.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {

struct ArenaArguments {
  std::string study = "assets/studies/arena.yaml";  ///< file or arena's folder
  std::filesystem::path directory;
  std::vector<std::string> overrides;
  std::string split;  ///< empty: as the study says
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool overwrite = false;
  bool bounds = false;
  bool json = false;
  std::string name;  ///< of the planner that enters
  std::vector<std::string> command;
  double timeout_s = 10.0;
};

/// Runs the episodes that have no result yet and writes the page; exit 1 unless all are completed.
ExitCode run_arena(const ArenaArguments& arguments);
/// Enters a planner and runs its episodes.
ExitCode add_to_arena(const ArenaArguments& arguments);
/// The page anew, of what there is.
ExitCode write_arena(const ArenaArguments& arguments);

}  // namespace vantage
