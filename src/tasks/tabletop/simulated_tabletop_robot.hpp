/// The simulated robot of the table-top task.
#pragma once

#include <string>
#include <vector>

#include "vantage/runtime/episode_setup.hpp"
#include "vantage/tasks/mapping/simulated/driven_by_base.hpp"
#include "vantage/tasks/tabletop/tabletop.hpp"
#include "vantage/tasks/tabletop/tabletop_robot_interface.hpp"

namespace vantage {

class SimulatedTabletopRobot : public DrivenByBase<TabletopRobotInterface> {
 public:
  /// @throws ConfigError, InputError if the episode cannot begin, see start_check.hpp
  SimulatedTabletopRobot(const EpisodeSetup& setup, const Tabletop& task);

  TabletopObservation observe() override;
  /// Where the laser (at tilt 0) is, as the robot believes.
  [[nodiscard]] Pose estimated_sensor() const override;
  [[nodiscard]] Pose2 base_for_sensor(const Pose& T_world_laser) const override;
  [[nodiscard]] FieldOfView view_field() const override { return field_of_view(laser_); }

  /// What is worth a warning before it starts.
  [[nodiscard]] const std::vector<std::string>& start_notes() const { return start_notes_; }

 private:
  void move_laser_to(double tilt_rad);

  LaserOptions laser_;
  Rng laser_noise_;
  std::vector<std::string> start_notes_;
};

}  // namespace vantage
