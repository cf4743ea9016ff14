/// A robot on wheels, as its robot.yaml describes it: commands in, encoder readings and frames out.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vantage/geometry/floor_outline.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/twist.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/sim/robots/robot_names.hpp"
#include "vantage/sim/world/contacts.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

struct AngleRange {
  double min_rad = 0.0;
  double max_rad = 0.0;
};

/// Handles of the robot's joints, actuators and sites in one model. Commands hold until the next
/// one; those out of range are clipped to it, those not finite are a programmer error.
class MobileBase {
 public:
  /// @param where the robot's folder, for messages
  /// @throws InputError naming key and name if the model lacks what robot.yaml names.
  MobileBase(const mjModel& model, const MobileBaseDescription& description,
             const std::string& where);

  /// Where the robot stands when the episode begins. Only before the first tick.
  void place(World& world, const Pose2& T_world_base, double lift_m = 0.0) const;

  /// Caps of speed and turning are those of the drive. A differential drive ignores vy.
  void command_twist(World& world, const Twist2& twist) const;
  void command_lift(World& world, double height_m) const;  ///< nothing without a lift
  void command_head(World& world, double pan_rad, double tilt_rad) const;  ///< tilt > 0 looks down
  void command_laser_tilt(World& world, double tilt_rad) const;            ///< > 0 looks down

  /// Encoders; exact.
  [[nodiscard]] double lift_m(const World& world) const;  ///< 0 without a lift
  [[nodiscard]] double head_pan_rad(const World& world) const;
  [[nodiscard]] double head_tilt_rad(const World& world) const;
  [[nodiscard]] double head_rate_rad_s(const World& world) const;  ///< the faster of both joints
  [[nodiscard]] double laser_tilt_rad(const World& world) const;
  [[nodiscard]] AngleRange laser_tilt_range() const;
  [[nodiscard]] double lift_min_m() const { return lift_ ? lift_->min : 0.0; }
  [[nodiscard]] double lift_max_m() const { return lift_ ? lift_->max : 0.0; }

  /// Truth: for metrics and as the input of odometry.
  [[nodiscard]] Pose2 T_world_base(const World& world) const;
  [[nodiscard]] Twist2 twist(const World& world) const;        ///< of the base, in its frame
  [[nodiscard]] Pose T_world_laser(const World& world) const;  ///< turns with the tilt
  [[nodiscard]] Pose T_world_base_scan(const World& world) const;

  /// What it draws at rest and the mechanical power of its actuators, at the last step; braking
  /// gives nothing back.
  [[nodiscard]] double power_w(const World& world) const;

  [[nodiscard]] const Footprint& footprint() const { return footprint_; }
  /// In the base's frame: footprint.outline_m, or that of its geoms.
  [[nodiscard]] const FloorOutline& outline() const { return outline_; }
  /// Whether it moves in any direction at any heading.
  [[nodiscard]] bool is_holonomic() const { return std::holds_alternative<Slides>(drive_); }

  /// What is asked of a head or a tilting laser is an InputError for a robot that has none.
  [[nodiscard]] bool has_head() const { return head_.has_value(); }
  [[nodiscard]] bool has_tilting_laser() const { return laser_.has_value(); }

  /// The laser at tilt 0 (x forward, z up) for the lift's present height.
  [[nodiscard]] Pose T_base_laser_mount(const World& world) const;
  [[nodiscard]] Pose2 T_base_base_scan() const { return T_base_base_scan_; }
  [[nodiscard]] double base_scan_height_m() const { return base_scan_height_m_; }
  /// Where the base must stand for the laser to be at that place, looking along its x axis. The
  /// height of `T_world_sensor` is the lift's affair.
  [[nodiscard]] Pose2 base_for_laser(const Pose& T_world_sensor) const;

  [[nodiscard]] int camera_id() const { return head().camera; }
  [[nodiscard]] int head_body_id() const { return head().body; }  ///< that the head pans
  [[nodiscard]] int laser_site_id() const { return laser().site; }
  [[nodiscard]] int laser_body_id() const { return laser().body; }
  [[nodiscard]] int base_scan_site_id() const { return base_scan_site_; }
  [[nodiscard]] int base_scan_body_id() const { return base_scan_body_; }
  [[nodiscard]] int base_body_id() const { return base_body_; }

  /// Geoms of other things that the robot touches, ascending. Not its own, nor the floor that it
  /// rolls on.
  [[nodiscard]] std::vector<int> touched_geoms(const World& world) const;
  /// Those it would touch while it turns once where it stands, in steps of 15 degrees.
  [[nodiscard]] std::vector<int> touched_by_turning(const World& world) const;
  /// Contact points between the robot and anything else but that floor, as of the last step.
  [[nodiscard]] int contacts(const World& world) const;

 private:
  struct Slides {
    DrivenJoint x, y, yaw;
    double speed_max_m_s;
  };
  struct Wheels {
    std::string free_joint;
    int qpos;  ///< of the base: position, quaternion
    int dof;
    DrivenJoint left, right;
    DifferentialDrive options;
  };
  struct Head {
    DrivenJoint pan, tilt;
    int body;
    int camera;
  };
  struct Laser {
    DrivenJoint tilt;
    int body;
    int site;
    Pose T_base_low;  ///< lift down, tilt 0
  };

  static std::variant<Slides, Wheels> find_drive(const RobotNames& names, const mjModel& model,
                                                 const BaseDrive& drive, int base);
  void find_scanner(const RobotNames& names, const mjModel& model, const std::string& site);
  /// @return the body that carries head and laser
  int find_lift(const RobotNames& names, const mjModel& model, const std::string& joint);
  [[nodiscard]] Head find_head(const RobotNames& names, const mjModel& model, const HeadNames& head,
                               int carrier) const;
  [[nodiscard]] Laser find_laser(const RobotNames& names, const mjModel& model,
                                 const TiltingLaserNames& laser, int carrier) const;
  [[nodiscard]] const Head& head() const;    ///< @throws InputError if it has none
  [[nodiscard]] const Laser& laser() const;  ///< @throws InputError if it has none
  [[nodiscard]] Pose2 pose_of(const mjData& data) const;
  void turn(mjData& data, double angle_rad) const;

  std::string where_;
  Footprint footprint_;
  double idle_power_w_ = 0.0;
  std::vector<int> actuators_;
  int base_body_ = 0;
  FloorOutline outline_;
  std::variant<Slides, Wheels> drive_;
  std::vector<int> on_floor_;  ///< geoms
  std::optional<DrivenJoint> lift_;
  std::string lift_joint_;
  std::optional<Head> head_;
  std::optional<Laser> laser_;
  int base_scan_site_ = 0;
  int base_scan_body_ = 0;
  Pose2 T_base_base_scan_;
  double base_scan_height_m_ = 0.0;
};

}  // namespace vantage
