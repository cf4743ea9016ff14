/// A robot interface whose driving is that of a simulated mobile base.
#pragma once

#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"
#include "vantage/tasks/mapping/simulated/simulated_mobile_base.hpp"

namespace vantage {

/// @tparam Interface of a task, derived from MobileRobotInterface; the rest is for the class that
/// derives from this.
template <class Interface>
class DrivenByBase : public Interface {
 public:
  [[nodiscard]] double time_s() const override { return base_.world().time_s(); }
  [[nodiscard]] double energy_used_j() const override { return base_.energy_used_j(); }
  PlanarScan read_base_scanner() override { return base_.read_base_scanner(); }
  DriveResult drive_along(std::span<const Pose2> path, double max_speed_m_s,
                          const std::function<bool()>& go_on) override {
    return base_.drive_along(path, max_speed_m_s, go_on);
  }
  void correct_pose(const Pose2& T_world_base) override { base_.correct_pose(T_world_base); }
  [[nodiscard]] Pose2 dead_reckoned_base() const override { return base_.dead_reckoned_base(); }
  void restart_dead_reckoning() override { base_.restart_dead_reckoning(); }
  [[nodiscard]] Pose2 estimated_base() const override { return base_.estimated_base(); }
  [[nodiscard]] double base_scan_height_m() const override { return base_.base_scan_height_m(); }
  [[nodiscard]] double inscribed_radius_m() const override { return base_.inscribed_radius_m(); }
  [[nodiscard]] RobotOutline outline() const override { return base_.outline(); }

  [[nodiscard]] MobileGroundTruth ground_truth() const { return base_.ground_truth(); }
  World& world() { return base_.world(); }
  [[nodiscard]] const RobotFaults& faults() const { return base_.faults(); }

 protected:
  template <class... Arguments>
  explicit DrivenByBase(Arguments&&... arguments) : base_(std::forward<Arguments>(arguments)...) {}

  SimulatedMobileBase base_;
};

}  // namespace vantage
