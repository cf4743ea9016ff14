/// The folder of a study: what there is of its episodes.
///
///   DIR/study.yaml                  the study, self-contained
///   DIR/episodes/<scene>/<...>/     a run folder for each episode, named by its levels
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "vantage/study/study.hpp"

namespace vantage {

enum class EpisodeState {
  missing,      ///< not run yet
  stale,        ///< run with another configuration, or with other files
  interrupted,  ///< ended by the user
  crashed,      ///< run, and no result came of it
  failed,       ///< a result: the task was not done
  diverged,     ///< a result: the simulation diverged
  completed,    ///< a result
};
std::string_view state_name(EpisodeState state);

/// Results are kept; anything else is run (again).
constexpr bool is_result(EpisodeState state) { return state >= EpisodeState::failed; }

std::filesystem::path episode_folder(const std::filesystem::path& study_dir,
                                     const PlannedEpisode& episode);

/// Whether a result fits what would run now: a whole metrics.json, the same configuration (but for
/// `threads`, which changes no result) and the same files of scene, robot and model.
class ResultCheck {
 public:
  EpisodeState operator()(const std::filesystem::path& study_dir, const PlannedEpisode& episode);
  /// Of a folder that the episode was run in.
  EpisodeState in_folder(const std::filesystem::path& folder, const PlannedEpisode& episode);

 private:
  using Hashes = std::map<std::string, std::string>;
  const Hashes& assets(const ResolvedEpisode& resolved);
  std::map<std::string, Hashes> assets_;  ///< by the names of scene, robot and inputs
};

/// metrics.json, manifest.json or failure.json; null if it is missing or not whole.
nlohmann::ordered_json read_json_or_null(const std::filesystem::path& file);

/// The state of every episode of `plan`, in its order.
std::vector<EpisodeState> episode_states(const std::filesystem::path& study_dir,
                                         const std::vector<PlannedEpisode>& plan);

/// What is known of an episode beyond its folder.
struct EpisodeActivity {
  std::string state;  ///< "running" or "queued"; empty: what its folder says
  std::string reason;
};

/// "310 completed, 10 missing of 320 episodes", then a line for each that is not completed, and
/// why. @param activities of each episode, or empty
std::string status_text(const std::filesystem::path& study_dir,
                        const std::vector<PlannedEpisode>& plan,
                        const std::vector<EpisodeState>& states,
                        const std::vector<EpisodeActivity>& activities = {});

/// The same as an object: how many of each state, and each that is not completed.
nlohmann::ordered_json status_json(const std::filesystem::path& study_dir,
                                   const std::vector<PlannedEpisode>& plan,
                                   const std::vector<EpisodeState>& states,
                                   const std::vector<EpisodeActivity>& activities = {});

}  // namespace vantage
