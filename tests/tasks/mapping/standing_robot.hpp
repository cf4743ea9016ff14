/// A robot for tests that has no wheels: it stands where it is put.
#pragma once

#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"

namespace vantage::support {

class StandingRobot : public MobileRobotInterface {
 public:
  double now_s = 0.0;
  double used_j = 0.0;
  Pose2 T_world_base;
  [[nodiscard]] double time_s() const override { return now_s; }
  [[nodiscard]] double energy_used_j() const override { return used_j; }
  PlanarScan read_base_scanner() override { return {}; }
  DriveResult drive_along(std::span<const Pose2> /*path*/, double /*max_speed_m_s*/,
                          const std::function<bool()>& /*go_on*/) override {
    return {};
  }
  void correct_pose(const Pose2& /*T_world_base*/) override {}
  [[nodiscard]] Pose2 dead_reckoned_base() const override { return {}; }
  void restart_dead_reckoning() override {}
  [[nodiscard]] Pose2 estimated_base() const override { return T_world_base; }
  [[nodiscard]] double base_scan_height_m() const override { return 0.3; }
  [[nodiscard]] double inscribed_radius_m() const override { return 0.2; }
  [[nodiscard]] RobotOutline outline() const override { return {}; }
  /// A quarter of a metre ahead of the base, a metre up.
  [[nodiscard]] Pose estimated_sensor() const override {
    return to_se3(T_world_base) * make_pose({0.25, 0.0, 1.0}, 0.0);
  }
  [[nodiscard]] Pose2 base_for_sensor(const Pose& T_world_sensor) const override {
    return project_to_se2(T_world_sensor);
  }
  [[nodiscard]] FieldOfView view_field() const override {
    return {.half_width_rad = 0.35, .tilt_min_rad = -0.2, .tilt_max_rad = 0.8};
  }
};

/// At once where it drives to, and where it is told to be.
class JumpingRobot : public StandingRobot {
 public:
  void correct_pose(const Pose2& pose) override { T_world_base = pose; }
  DriveResult drive_along(std::span<const Pose2> path, double /*max_speed_m_s*/,
                          const std::function<bool()>& go_on) override {
    for (const Pose2& waypoint : path) {
      T_world_base = waypoint;
      for (int tick = 0; tick < 10; ++tick) go_on();
    }
    return {};
  }
};

}  // namespace vantage::support
