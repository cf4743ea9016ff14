/// A run that maps, as its folder tells it: for questions that are asked once it is over.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "vantage/tasks/episode.hpp"

namespace vantage {

struct RecordedScan {
  double time_s = 0.0;
  double path_length_m = 0.0;
  double scan_time_s = 0.0;
  std::size_t cells_left = 0;  ///< observable, and not observed yet
  int chosen_view = -1;
  int candidates = 0;  ///< that it was chosen from
};

struct RecordedRun {
  std::filesystem::path directory;
  ResolvedEpisode episode;
  std::string method;
  std::string state_hash;
  std::string status;
  std::size_t observable_cells = 0;
  std::vector<RecordedScan> scans;
  std::string version;  ///< of vantage, that recorded it
};

/// @throws InputError if the folder lacks what is needed, is of another version, or its task takes
/// no scans
RecordedRun read_recorded_run(const std::filesystem::path& directory);

}  // namespace vantage
