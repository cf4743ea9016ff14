/// Robot interface of a quadrotor that flies to bearings round the table's centre and takes images
/// there. Ground truth stays behind `truth()`, which metrics alone may call.
#pragma once

#include <memory>

#include "vantage/planners/objects/orbit.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

/// What the robot observes with one image.
struct FlightObservation {
  CameraImages images;       ///< colour and depth; without truth
  Pose T_world_camera;       ///< as estimated, OpenCV's axes
  double bearing_rad = 0.0;  ///< where it was meant to be taken from
};

/// A flight to a bearing before it is flown.
struct FlightPlan {
  std::vector<FlightWaypoint> waypoints;
  double duration_s = 0.0;
  double path_m = 0.0;
  double energy_j = 0.0;  ///< induced power of hovering, for that long
};

struct FlightTruth {
  int collisions = 0;
  double position_error_m = 0.0;  ///< camera, from where it was meant to be
  double angle_error_rad = 0.0;   ///< camera, from how it was meant to be turned
  double object_angle_rad = 0.0;  ///< yaw of the object as the camera sees it, [0, 2 pi)
};

class OrbitRobotInterface {
 public:
  /// Hovers at a bearing drawn by the seed.
  /// @throws ConfigError or InputError if the episode cannot begin, RendererError
  explicit OrbitRobotInterface(const ResolvedEpisode& resolved);
  OrbitRobotInterface(const OrbitRobotInterface&) = delete;
  OrbitRobotInterface& operator=(const OrbitRobotInterface&) = delete;

  /// Comes to rest and takes an image.
  /// @throws Interrupted, RendererError, EpisodeFailed if it touches anything
  FlightObservation observe();
  /// Along the circle, the short way. @throws Interrupted, EpisodeFailed if it touches anything
  FlightResult fly_to(double bearing_rad);
  [[nodiscard]] FlightPlan plan(double bearing_rad) const;

  [[nodiscard]] double start_bearing_rad() const { return start_bearing_rad_; }
  [[nodiscard]] double bearing_rad() const { return bearing_rad_; }  ///< flown to last
  [[nodiscard]] const Orbit& orbit() const { return orbit_; }        ///< of the camera
  [[nodiscard]] Eigen::Vector3d p_world_table_m() const;
  [[nodiscard]] Pose estimated_body() const { return tracking_.estimate().T_world_body; }

  [[nodiscard]] FlightTruth truth() const;
  [[nodiscard]] Pose true_body() const { return vehicle_.state(world_).T_world_body; }
  World& world() { return world_; }
  [[nodiscard]] const World& world() const { return world_; }

 private:
  void require_untouched(const FlightResult& flight) const;
  [[nodiscard]] FlightWaypoint waypoint(const Pose& T_world_place) const;

  Episode episode_;
  Orbit orbit_;
  double start_bearing_rad_;
  double bearing_rad_;
  World world_;
  Quadrotor vehicle_;
  TrajectoryTrackingController tracking_;
  double object_yaw_rad_;  ///< truth
  std::unique_ptr<Renderer> renderer_;
  Rng camera_noise_;
};

}  // namespace vantage
