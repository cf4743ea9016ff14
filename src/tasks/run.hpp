/// `vantage run`: an episode from its file to its run folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/runtime/metrics.hpp"
#include "vantage/runtime/spectator.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

struct RunOptions {
  std::filesystem::path directory;  ///< empty: out/<episode>-<seed>
  bool overwrite = false;
  bool video = false;
  std::vector<std::string> command;  ///< as typed, for the manifest
  bool lean = false;  ///< metrics, steps, trajectories, configuration, manifest and nothing else
  Spectator spectator = {};
};

struct RunOutcome {
  std::filesystem::path directory;
  ExitCode code = ExitCode::done;  ///< failed, diverged and interrupted runs have results too
  std::string metrics;             ///< the JSON text
};

/// A failure, a divergence and an interruption are outcomes, not exceptions.
/// @throws OutputError, InputError, RendererError
RunOutcome run(const ResolvedEpisode& resolved, const RunOptions& options);

}  // namespace vantage
