/// The PR2-like robot of models/robots/pr2: commands in, encoder readings and frames out.
#pragma once

#include <vector>

#include "vantage/geometry/twist.hpp"
#include "vantage/sim/world/contacts.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

struct AngleRange {
  double min_rad = 0.0;
  double max_rad = 0.0;
};

/// Handles of the robot's joints, actuators and sites in one model. Commands hold until the next
/// one; those out of range are clipped to it, those not finite are a programmer error.
class Pr2 {
 public:
  /// @throws InputError if the model has no such robot.
  explicit Pr2(const mjModel& model);

  /// Where the robot stands when the episode begins. Only before the first tick.
  void place(World& world, const Pose2& T_world_base, double torso_m = 0.0) const;

  /// Speed cap 1 m/s, along the direction asked for; turning cap 1.5 rad/s.
  void command_twist(World& world, const Twist2& twist) const;
  void command_torso(World& world, double height_m) const;  ///< 0 .. 0.33 m, moves at 0.013 m/s
  void command_head(World& world, double pan_rad, double tilt_rad) const;  ///< tilt > 0 looks down
  void command_laser_tilt(World& world, double tilt_rad) const;            ///< > 0 looks down

  /// Encoders; exact.
  [[nodiscard]] double torso_m(const World& world) const;
  [[nodiscard]] double head_pan_rad(const World& world) const;
  [[nodiscard]] double head_tilt_rad(const World& world) const;
  [[nodiscard]] double laser_tilt_rad(const World& world) const;
  [[nodiscard]] AngleRange laser_tilt_range() const;
  [[nodiscard]] double torso_max_m() const { return torso_.max; }  ///< from 0 up to there

  /// Truth: for metrics and as the input of odometry.
  [[nodiscard]] Pose2 T_world_base(const World& world) const;
  [[nodiscard]] Twist2 twist(const World& world) const;        ///< of the base, in its frame
  [[nodiscard]] Pose T_world_laser(const World& world) const;  ///< turns with the tilt
  [[nodiscard]] Pose T_world_base_scan(const World& world) const;

  /// The laser at tilt 0 (x forward, z up) for the torso's present height.
  [[nodiscard]] Pose T_base_laser_mount(const World& world) const;
  [[nodiscard]] Pose2 T_base_base_scan() const { return T_base_base_scan_; }
  [[nodiscard]] double base_scan_height_m() const { return base_scan_height_m_; }
  /// Where the base must stand for the laser to be at that place, looking along its x axis. The
  /// height of `T_world_sensor` is the torso's affair.
  [[nodiscard]] Pose2 base_for_laser(const Pose& T_world_sensor) const;

  [[nodiscard]] int camera_id() const { return camera_; }
  [[nodiscard]] int laser_site_id() const { return laser_site_; }
  [[nodiscard]] int base_scan_site_id() const { return base_scan_site_; }
  [[nodiscard]] int base_body_id() const { return base_body_; }
  [[nodiscard]] int laser_body_id() const { return laser_body_; }

  /// Geoms of other things that the robot touches, ascending. Not its own.
  [[nodiscard]] std::vector<int> touched_geoms(const World& world) const;
  /// Those it would touch while it turns once where it stands, in steps of 15 degrees.
  [[nodiscard]] std::vector<int> touched_by_turning(const World& world) const;
  /// Contact points between the robot and anything else, as of the last step.
  [[nodiscard]] int contacts(const World& world) const;

 private:
  struct Axis {
    int qpos = 0;
    int dof = 0;
    int actuator = 0;
    double min = 0.0;  ///< of the command
    double max = 0.0;
  };
  static Axis find_axis(const mjModel& model, const std::string& name);
  static double position(const World& world, const Axis& axis);
  static void command(World& world, const Axis& axis, double target);

  Axis x_, y_, yaw_, torso_, head_pan_, head_tilt_, laser_tilt_;
  int base_body_ = 0;
  int laser_body_ = 0;
  int camera_ = 0;
  int laser_site_ = 0;
  int base_scan_site_ = 0;
  Pose T_base_laser_low_ = Pose::Identity();  ///< torso down, tilt 0
  Pose2 T_base_base_scan_;
  double base_scan_height_m_ = 0.0;
};

}  // namespace vantage
