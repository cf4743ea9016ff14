/// Writes the run folder of a trajectory flight while it runs.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "vantage/core/log.hpp"
#include "vantage/planners/trajectory/trajectory_record.hpp"
#include "vantage/runtime/run_log.hpp"
#include "vantage/tasks/trajectory/trajectory_panel.hpp"
#include "vantage/tasks/trajectory/trajectory_robot_interface.hpp"

namespace vantage {

class TrajectoryRecorder {
 public:
  /// Hooks itself to the world's ticks. Lean: neither states nor images are kept.
  /// @throws OutputError, RendererError
  TrajectoryRecorder(const ResolvedEpisode& resolved, TrajectoryRobotInterface& robot,
                     std::filesystem::path directory, bool with_video, bool lean,
                     Spectator spectator = {});

  void set_panel(std::function<TrajectoryPanelInput()> panel);
  /// Adds a row to steps.csv.
  void waypoint(const WaypointRecord& record, int waypoints);
  /// Adds a row to looks.csv, and the segmented object to views/.
  void observation(int object, const ObjectObservation& observation, int number,
                   const ObjectView& view);
  void commit();  ///< puts the growing files under their final names
  void finish_video() { log_.finish_video(); }

  [[nodiscard]] std::uint64_t state_hash() const { return log_.state_hash(); }
  [[nodiscard]] double path_length_m() const { return log_.path_length_m(); }

 private:
  cv::Mat onboard_image();

  std::filesystem::path directory_;
  TrajectoryRobotInterface& robot_;
  bool lean_;
  RunLog log_;
  GrowingFile steps_;
  GrowingFile observations_;
  Progress progress_;
  std::unique_ptr<Renderer> onboard_;  ///< for the video
  RgbdOptions camera_;
};

}  // namespace vantage
