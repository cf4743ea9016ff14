/// What of a run folder becomes which stream of messages.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "vantage/mcap/timeline.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/runtime/log/state_log.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {

/// A run folder read back, with the world that its states are of.
class RunToExport {
 public:
  /// @throws InputError
  explicit RunToExport(const std::filesystem::path& run_dir);

  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
  [[nodiscard]] double time_s(std::size_t state) const { return states_.state(state)[0]; }
  [[nodiscard]] double end_s() const { return time_s(states_.count() - 1); }
  /// The world in that state.
  const World& world_at(std::size_t state);
  [[nodiscard]] const World& world() const { return world_; }
  /// The first state of each of these moments: 0, period_s, 2 period_s ...
  [[nodiscard]] std::vector<std::size_t> states_every(double period_s) const;

  [[nodiscard]] const std::optional<GridFrame>& map() const { return map_; }
  [[nodiscard]] const std::vector<EpisodeEvent>& events() const { return events_; }
  /// When it happened.
  [[nodiscard]] double time_s(const EpisodeEvent& event) const;

 private:
  std::filesystem::path directory_;
  ResolvedEpisode resolved_;
  World world_;
  RecordedStates states_;
  std::optional<GridFrame> map_;
  std::vector<EpisodeEvent> events_;
  std::optional<std::size_t> shown_;
};

// Each adds its streams. What they add refers to `run`.
void add_transforms(RunToExport& run, Timeline& timeline);   ///< /tf: bodies of the robot
void add_poses(const RunToExport& run, Timeline& timeline);  ///< /pose, /pose_estimated
/// /views: what was weighed, what was chosen; /plan: the way there.
void add_decisions(const RunToExport& run, Timeline& timeline);
void add_map(const RunToExport& run, Timeline& timeline);    ///< /map/occupied: centres of cells
void add_cloud(const RunToExport& run, Timeline& timeline);  ///< /cloud: points of all scans
void add_steps(const RunToExport& run, Timeline& timeline);  ///< /steps: rows of steps.csv
/// /camera: what the robot's camera sees, with its calibration and frame; /overview.
void add_images(RunToExport& run, double period_s, int height_px, Timeline& timeline);

}  // namespace vantage
