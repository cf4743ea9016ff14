/// A robot's folder: an MJCF file, and robot.yaml, which says what the names in it are.
///
///   models/robots/NAME/robot.yaml      kind, names of joints, actuators and sensors, footprint
///   models/robots/NAME/<model>.xml     the MJCF; every name in it starts with robot/
///
/// docs/tutorials/own-robot.md is the recipe.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {

/// Two circles about the base's origin, on the floor, and what lies between them.
struct Footprint {
  double inscribed_radius_m = 0.0;
  double circumscribed_radius_m = 0.0;
  std::vector<std::array<double, 2>> outline_m;
  void fields(auto&& f) {
    f("inscribed_radius_m", inscribed_radius_m,
      "radius of the circle about the base's origin that the robot covers at any heading",
      Range{0.0, 5.0, true});
    f("circumscribed_radius_m", circumscribed_radius_m,
      "radius of the circle about the base's origin that covers the robot at any heading; higher "
      "keeps farther away from obstacles",
      Range{0.0, 5.0, true});
    f("outline_m", outline_m,
      "corners (x, y) of a convex outline of the robot in the base's frame, which it goes through "
      "narrow passages with; empty: that of all its geoms that can touch something",
      between(-5.0, 5.0));
  }
  void check() const;  ///< the inscribed circle within the other one, an outline with an area
};

struct OmnidirectionalDrive {
  static constexpr std::string_view name = "omnidirectional";
  static constexpr StrategyText text{
      .summary =
          "Moves in any direction at any heading: slide joints along x and y and a hinge about z, "
          "in this order, on the base."};
  std::string x;
  std::string y;
  std::string yaw;
  double speed_max_m_s = 1.0;
  void fields(auto&& f) {
    f("x", x, "name of the slide joint along x, with a velocity actuator");
    f("y", y, "name of the slide joint along y, with a velocity actuator");
    f("yaw", yaw, "name of the hinge joint about z, with a velocity actuator");
    f("speed_max_m_s", speed_max_m_s,
      "greatest speed, in any direction; turning is limited by its actuator",
      Range{0.0, 10.0, true});
  }
  void check() const;  ///< every joint is named
};

/// The base moves freely: friction between wheels and floor is what moves it.
struct DifferentialDrive {
  static constexpr std::string_view name = "differential";
  static constexpr StrategyText text{.summary =
                                         "Two driven wheels on one axle through the base's origin, "
                                         "moved by friction with the floor; cannot go sideways."};
  std::string free_joint;
  std::string left_wheel;
  std::string right_wheel;
  double wheel_radius_m = 0.0;
  double track_m = 0.0;
  double speed_max_m_s = 0.5;
  double turn_rate_max_rad_s = 1.5;
  std::vector<std::string> on_floor;
  void fields(auto&& f) {
    f("free_joint", free_joint, "name of the base's free joint");
    f("left_wheel", left_wheel,
      "name of the left wheel's hinge joint about y, with a velocity actuator");
    f("right_wheel", right_wheel,
      "name of the right wheel's hinge joint about y, with a velocity actuator");
    f("wheel_radius_m", wheel_radius_m, "rolling radius of the driven wheels",
      Range{0.0, 1.0, true});
    f("track_m", track_m, "distance between the points where the driven wheels touch the floor",
      Range{0.0, 5.0, true});
    f("speed_max_m_s", speed_max_m_s, "greatest speed; higher is faster and may slip",
      Range{0.0, 10.0, true});
    f("turn_rate_max_rad_s", turn_rate_max_rad_s, "greatest turn rate in place",
      Range{0.0, 10.0, true});
    f("on_floor", on_floor,
      "names of the geoms that roll or glide on the floor, whose contact with it is no collision");
  }
  void check() const;  ///< joints and geoms are named, radius and track are given
};

using BaseDrive = std::variant<OmnidirectionalDrive, DifferentialDrive>;
template <>
inline constexpr std::string_view strategy_family<BaseDrive> = "drive";

/// An RGB-D camera that pans and tilts.
struct HeadNames {
  std::string pan;
  std::string tilt;
  std::string camera;
  void fields(auto&& f) {
    f("pan", pan, "name of the hinge joint about z that pans the head, with a position actuator");
    f("tilt", tilt,
      "name of the hinge joint about y that tilts the head, with a position actuator; positive "
      "looks down");
    f("camera", camera, "name of the camera, on the tilting body");
  }
  void check() const;  ///< every name is given
};

/// A line scanner that a joint tilts.
struct TiltingLaserNames {
  std::string tilt;
  std::string site;
  void fields(auto&& f) {
    f("tilt", tilt,
      "name of the hinge joint about y that tilts the scanner, with a position actuator; positive "
      "looks down");
    f("site", site,
      "name of the scanner's site, on the tilting body: x along the middle beam, z up");
  }
  void check() const;  ///< every name is given
};

/// A task that needs what it does not name says so.
struct MobileBaseDescription {
  static constexpr std::string_view name = "mobile_base";
  static constexpr StrategyText text{
      .summary =
          "A base that drives on the floor, for the tasks `tabletop` and `exploration`. What it "
          "does not have it does not name."};
  std::string base;
  Footprint footprint;
  double idle_power_w = 0.0;
  BaseDrive drive = OmnidirectionalDrive{};
  std::string planar_scanner;
  std::string lift;
  std::optional<HeadNames> head;
  std::optional<TiltingLaserNames> tilting_laser;
  void fields(auto&& f) {
    f("base", base, "name of the base's body: x forward, y left, z up, its origin on the floor");
    f("footprint", footprint, "circles on the floor that lie within the robot and hold it");
    f("idle_power_w", idle_power_w,
      "power that the robot draws at rest, by computers and sensors, all the time", at_least(0.0));
    f("drive", drive, "how the base moves, with the names of its joints");
    f("planar_scanner", planar_scanner,
      "name of the planar scanner's site, near the floor and level: x along the middle beam, z up");
    f("lift", lift,
      "name of the slide joint along z that carries head and tilting laser; empty: none");
    f("head", head, "pan-tilt head with an RGB-D camera; null: none");
    f("tilting_laser", tilting_laser, "laser scanner on a tilt joint; null: none");
  }
  void check() const;  ///< what every mobile base needs is there
};

struct QuadrotorDescription {
  static constexpr std::string_view name = "quadrotor";
  static constexpr StrategyText text{
      .summary =
          "A vehicle with four rotors and a tilting camera, for the tasks `recognition`, "
          "`change_detection` and `trajectory`."};
  std::string base;
  std::string free_joint;
  std::vector<std::string> rotors;
  double rotor_radius_m = 0.0;
  std::string camera;
  std::string camera_tilt;
  void fields(auto&& f) {
    f("base", base,
      "name of the vehicle's body: x forward, y left, z up, its origin amid the rotors");
    f("free_joint", free_joint, "name of the vehicle's free joint");
    f("rotors", rotors,
      "names of the four rotors' actuators, each at a site that has its thrust along z");
    f("rotor_radius_m", rotor_radius_m,
      "radius of a rotor; higher needs less power for the same thrust", Range{0.0, 5.0, true});
    f("camera", camera, "name of the camera, on the tilting body, which looks along x at tilt 0");
    f("camera_tilt", camera_tilt,
      "name of the hinge joint about y that tilts the camera, with a position actuator that lags");
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
