/// A robot's folder: an MJCF file, and robot.yaml, which says what the names in it are.
///
///   models/robots/NAME/robot.yaml      kind, names of joints, actuators and sensors, footprint
///   models/robots/NAME/<model>.xml     the MJCF; every name in it starts with robot/
///
/// docs/tutorials/own-robot.md is the recipe.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {

/// Two circles about the base's origin, on the floor.
struct Footprint {
  double inscribed_radius_m = 0.0;      ///< the robot covers it at any heading
  double circumscribed_radius_m = 0.0;  ///< it covers the robot at any heading; higher keeps away
  void fields(auto&& f) {
    f("inscribed_radius_m", inscribed_radius_m, Range{0.0, 5.0, true});
    f("circumscribed_radius_m", circumscribed_radius_m, Range{0.0, 5.0, true});
  }
  void check() const;  ///< the inscribed circle within the circumscribed one
};

/// Slides along the world's x and y and a hinge about z, in this order, on the base. Moves in any
/// direction at any heading.
struct OmnidirectionalDrive {
  static constexpr std::string_view name = "omnidirectional";
  std::string x;               ///< joint, with a velocity actuator
  std::string y;               ///< joint, with a velocity actuator
  std::string yaw;             ///< joint, with a velocity actuator
  double speed_max_m_s = 1.0;  ///< along the direction asked for; the actuators cap the turning
  void fields(auto&& f) {
    f("x", x);
    f("y", y);
    f("yaw", yaw);
    f("speed_max_m_s", speed_max_m_s, Range{0.0, 10.0, true});
  }
  void check() const;  ///< every joint is named
};

/// Two driven wheels on one axle through the base's origin, on a base that moves freely: friction
/// between wheels and floor is what moves it. It cannot go sideways.
struct DifferentialDrive {
  static constexpr std::string_view name = "differential";
  std::string free_joint;             ///< of the base
  std::string left_wheel;             ///< hinge about y, with a velocity actuator
  std::string right_wheel;            ///< hinge about y, with a velocity actuator
  double wheel_radius_m = 0.0;        ///< of the rolling circle
  double track_m = 0.0;               ///< between the points where the wheels touch the floor
  double speed_max_m_s = 0.5;         ///< higher is faster, and may slip
  double turn_rate_max_rad_s = 1.5;   ///< in place
  std::vector<std::string> on_floor;  ///< geoms that roll or glide on the floor: no collision
  void fields(auto&& f) {
    f("free_joint", free_joint);
    f("left_wheel", left_wheel);
    f("right_wheel", right_wheel);
    f("wheel_radius_m", wheel_radius_m, Range{0.0, 1.0, true});
    f("track_m", track_m, Range{0.0, 5.0, true});
    f("speed_max_m_s", speed_max_m_s, Range{0.0, 10.0, true});
    f("turn_rate_max_rad_s", turn_rate_max_rad_s, Range{0.0, 10.0, true});
    f("on_floor", on_floor);
  }
  void check() const;  ///< joints and geoms are named, radius and track are given
};

using BaseDrive = std::variant<OmnidirectionalDrive, DifferentialDrive>;
template <>
inline constexpr std::string_view strategy_family<BaseDrive> = "drive";

/// An RGB-D camera that pans and tilts.
struct HeadNames {
  std::string pan;     ///< hinge about z, with a position actuator
  std::string tilt;    ///< hinge about y, with a position actuator; positive looks down
  std::string camera;  ///< on the tilting body
  void fields(auto&& f) {
    f("pan", pan);
    f("tilt", tilt);
    f("camera", camera);
  }
  void check() const;  ///< every name is given
};

/// A line scanner that a joint tilts.
struct TiltingLaserNames {
  std::string tilt;  ///< hinge about y, with a position actuator; positive looks down
  std::string site;  ///< of the scanner on the tilting body: x along the middle beam, z up
  void fields(auto&& f) {
    f("tilt", tilt);
    f("site", site);
  }
  void check() const;  ///< every name is given
};

/// kind: mobile_base. What it has not, it does not name; a task that needs it says so.
struct MobileBaseDescription {
  static constexpr std::string_view name = "mobile_base";
  std::string base;  ///< body: x forward, y left, z up, its origin on the floor
  Footprint footprint;
  BaseDrive drive = OmnidirectionalDrive{};
  std::string planar_scanner;  ///< site near the floor, level: x along the middle beam, z up
  std::string lift;            ///< slide along z that carries head and tilting laser; empty: none
  std::optional<HeadNames> head;
  std::optional<TiltingLaserNames> tilting_laser;
  void fields(auto&& f) {
    f("base", base);
    f("footprint", footprint);
    f("drive", drive);
    f("planar_scanner", planar_scanner);
    f("lift", lift);
    f("head", head);
    f("tilting_laser", tilting_laser);
  }
  void check() const;  ///< what every mobile base needs is there
};

/// kind: quadrotor.
struct QuadrotorDescription {
  static constexpr std::string_view name = "quadrotor";
  std::string base;                 ///< body: x forward, y left, z up, amid the rotors
  std::string free_joint;           ///< of the base
  std::vector<std::string> rotors;  ///< four actuators, each at a site; thrust along the site's z
  double rotor_radius_m = 0.0;      ///< higher needs less power for the same thrust
  std::string camera;               ///< on the tilting body, looking along x at tilt 0
  std::string camera_tilt;          ///< hinge about y, with a position actuator with a lag
  void fields(auto&& f) {
    f("base", base);
    f("free_joint", free_joint);
    f("rotors", rotors);
    f("rotor_radius_m", rotor_radius_m, Range{0.0, 5.0, true});
    f("camera", camera);
    f("camera_tilt", camera_tilt);
  }
  void check() const;  ///< every name is given, four rotors
};

/// A new kind of robot is a struct of this form, added here.
using RobotKind = std::variant<MobileBaseDescription, QuadrotorDescription>;
template <>
inline constexpr std::string_view strategy_family<RobotKind> = "kind of robot";

/// A robot that is found on disk, its MJCF not compiled yet.
struct RobotFolder {
  std::filesystem::path description;  ///< robot.yaml
  std::filesystem::path mjcf;
  RobotKind kind;
  /// Per task, what an episode's keys are for this robot unless the episode sets them: heights of
  /// its sensors, its speeds. Null if it says nothing.
  ConfigNode episode_defaults;
};

/// @param folder_or_mjcf the folder, its robot.yaml, or an MJCF file in it to be used in place of
/// its own
/// @throws InputError if there is no robot.yaml or MJCF, ConfigError naming file, line and key.
RobotFolder read_robot(const std::filesystem::path& folder_or_mjcf);

/// @throws ConfigError naming `key`, the robot, its kind and the kind that is needed.
void require_kind(const RobotFolder& robot, std::string_view kind, const std::string& key);
/// The robot as the kind that a task needs. @throws ConfigError as require_kind()
const MobileBaseDescription& mobile_base_of(const RobotFolder& robot, const std::string& key);
const QuadrotorDescription& quadrotor_of(const RobotFolder& robot, const std::string& key);

}  // namespace vantage
