/// Interface of a mobile robot: drive commands in, readings and estimates out. Ground truth is no
/// part of it.
#pragma once

#include <functional>
#include <span>

#include "vantage/control/drive_options.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/planners/navigation/footprint_space.hpp"

namespace vantage {

class MobileRobotInterface {
 public:
  MobileRobotInterface() = default;
  MobileRobotInterface(const MobileRobotInterface&) = delete;
  MobileRobotInterface& operator=(const MobileRobotInterface&) = delete;
  virtual ~MobileRobotInterface() = default;

  /// Of the robot's clock, simulated.
  [[nodiscard]] virtual double time_s() const = 0;

  /// Used so far, by its battery's gauge.
  [[nodiscard]] virtual double energy_used_j() const = 0;

  /// One scan of the planar scanner, from the present pose.
  virtual PlanarScan read_base_scanner() = 0;
  /// No faster than `max_speed_m_s`; `go_on` is asked every tick. @throws Interrupted
  virtual DriveResult drive_along(std::span<const Pose2> path, double max_speed_m_s,
                                  const std::function<bool()>& go_on) = 0;
  virtual void correct_pose(const Pose2& T_world_base) = 0;
  /// What the wheels alone say, without the corrections since restart_dead_reckoning().
  [[nodiscard]] virtual Pose2 dead_reckoned_base() const = 0;
  virtual void restart_dead_reckoning() = 0;
  [[nodiscard]] virtual Pose2 estimated_base() const = 0;
  [[nodiscard]] virtual double base_scan_height_m() const = 0;
  /// Radius of the largest disc round the base's origin that the footprint covers.
  [[nodiscard]] virtual double inscribed_radius_m() const = 0;
  /// What it takes through narrow passages.
  [[nodiscard]] virtual RobotOutline outline() const = 0;

  /// Where the mapping sensor is, as the robot believes: x forward, z up.
  [[nodiscard]] virtual Pose estimated_sensor() const = 0;
  /// Where the base must stand for the mapping sensor to be there.
  [[nodiscard]] virtual Pose2 base_for_sensor(const Pose& T_world_sensor) const = 0;
  /// What one scan of the mapping sensor covers.
  [[nodiscard]] virtual FieldOfView view_field() const = 0;
};

}  // namespace vantage
