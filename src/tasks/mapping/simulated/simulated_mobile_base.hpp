/// The simulation of a mobile robot, as far as driving goes: its world, its wheels, its planar
/// scanner. Truth is handed out by ground_truth(), for evaluators and recorders.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/runtime/episode_setup.hpp"
#include "vantage/sim/faults/robot_faults.hpp"
#include "vantage/sim/robots/drive.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/sensors/laser.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"
#include "vantage/tasks/mapping/mobile_ground_truth.hpp"

namespace vantage {

/// The robot of an episode in its world.
/// @throws ConfigError if it is of another kind or larger than its paths allow for, InputError if
/// its model lacks what it names.
MobileBase mobile_base(const World& world, const EpisodeSetup& setup,
                       const NavigationOptions& navigation);

class SimulatedMobileBase {
 public:
  /// @param place puts the robot where the episode begins
  SimulatedMobileBase(const EpisodeOptions& episode, const MappingOptions& options,
                      const ModelSource& source, const std::function<MobileBase(World&)>& place);
  SimulatedMobileBase(const SimulatedMobileBase&) = delete;
  SimulatedMobileBase& operator=(const SimulatedMobileBase&) = delete;

  /// One scan of the planar scanner, from the present pose.
  PlanarScan read_base_scanner();
  /// No faster than `max_speed_m_s`; `go_on` is asked every tick; truth is not passed on.
  /// @throws Interrupted
  DriveResult drive_along(std::span<const Pose2> path, double max_speed_m_s,
                          const std::function<bool()>& go_on);
  /// Adds a note if the planar scanner shows nothing here that fixes the pose. Draws from no stream
  /// of the run.
  void note_localisation(const RegistrationOptions& registration, std::uint64_t seed,
                         std::vector<std::string>& notes);
  void correct_pose(const Pose2& T_world_base);
  /// What the wheels alone say, without the corrections since restart_dead_reckoning().
  [[nodiscard]] Pose2 dead_reckoned_base() const;
  void restart_dead_reckoning();
  /// Of its actuators and of what it draws at rest; exact.
  [[nodiscard]] double energy_used_j() const { return energy_used_j_; }
  [[nodiscard]] double base_scan_height_m() const { return robot_.base_scan_height_m(); }
  /// The disc that the robot covers at any heading: what it stands on is free.
  [[nodiscard]] double inscribed_radius_m() const { return robot_.footprint().inscribed_radius_m; }
  [[nodiscard]] RobotOutline outline() const {
    return {robot_.outline(), robot_.is_holonomic(), drive_.controller.speed_m_s};
  }
  [[nodiscard]] Pose2 estimated_base() const { return odometry_.estimate(); }

  void tick();  ///< @throws Interrupted
  /// Moves the geometry that sensors see to where it is now.
  const RayScene& seen_geometry();

  [[nodiscard]] MobileGroundTruth ground_truth() const {
    return {world_, robot_, geometry_without_robot_, collisions_};
  }
  World& world() { return world_; }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const MobileBase& robot() const { return robot_; }
  [[nodiscard]] RobotFaults& faults() { return faults_; }
  [[nodiscard]] const RobotFaults& faults() const { return faults_; }

 private:
  void report_touch() const;

  DriveOptions drive_;
  PlanarScannerOptions scanner_;
  World world_;
  MobileBase robot_;
  RayScene geometry_;
  RayScene geometry_without_robot_;
  Odometry odometry_;
  Pose2 T_world_dead_reckoned_;  ///< at the last correction
  Pose2 T_world_corrected_;      ///< the pose that correction set
  CollisionCounter collisions_;
  Rng scanner_noise_;
  RobotFaults faults_;
  double energy_used_j_ = 0.0;
};

/// @throws ConfigError if the robot would touch something while it turns once where it is;
/// `place` says which keys put it there.
void check_turning_room(const World& world, const MobileBase& robot, const std::string& place);

}  // namespace vantage
