/// Writes the run folder of a trajectory flight while it runs.
#pragma once

#include <opencv2/core.hpp>

#include <functional>
#include <memory>
#include <vector>

#include "vantage/runtime/recorder.hpp"
#include "vantage/sim/sensors/camera_options.hpp"
#include "vantage/tasks/trajectory/flight_log.hpp"
#include "vantage/tasks/trajectory/trajectory_panel.hpp"
#include "vantage/tasks/trajectory/waypoint_record.hpp"

namespace vantage {

class Renderer;
class SimulatedQuadrotor;

class TrajectoryRecorder : public EpisodeRecorder {
 public:
  /// Lean: neither states nor images are kept.
  /// @throws OutputError, RendererError
  TrajectoryRecorder(const EpisodeRun& run, SimulatedQuadrotor& quadrotor,
                     const RgbdOptions& camera);
  ~TrajectoryRecorder() override;

  void set_panel(std::function<TrajectoryPanelInput()> panel);
  /// Adds a row to steps.csv.
  void waypoint(const WaypointRecord& record, int waypoints);
  /// The plans that were chosen among.
  void decision(const std::vector<CandidatePlan>& plans, std::size_t chosen);
  /// Adds a row to looks.csv, and the segmented object to views/.
  void observation(int object, const ObjectObservation& observation, int number,
                   const ObjectView& view);
  /// What is known and planned, for those who look on.
  [[nodiscard]] FlightLog& flight() { return flight_; }
  void commit() override;

 private:
  cv::Mat onboard_image();

  SimulatedQuadrotor& quadrotor_;
  FlightLog flight_;
  GrowingFile observations_;
  std::unique_ptr<Renderer> onboard_;  ///< for the video
  RgbdOptions camera_;
};

}  // namespace vantage
