/// What a waypoint costs: near obstacles, without its target in view, far from where to look at it.
/// [Potthast2016, 5.2]
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/trajectory/esdf.hpp"
#include "vantage/planners/trajectory/optimisers/horizon.hpp"

namespace vantage {

struct FlightCostOptions {
  double obstacle_weight = 5.0;
  double centre_weight = 1.0;
  double recognition_weight = 0.5;
  bool information = true;
  double tau_nats = 0.1;  ///< entropy below which a target is known; no key, see
                          ///< ObservationOptions::known_below_nats
  double epsilon_m = 0.5;
  double body_radius_m = 0.5;
  double speed_floor_m_s = 0.2;
  double segment_s = 1.0;
  double bearing_weight = 0.5;
  bool between_waypoints = true;
  double clearance_m = 0.6;
  double clearance_weight = 50.0;
  double delta_m = 2.0;
  bool literal = false;
  void fields(auto&& f) {
    f("obstacle_weight", obstacle_weight,
      "weight of the obstacle cost c_o, in s/m^2; higher keeps farther off obstacles",
      at_least(0.0));
    f("centre_weight", centre_weight,
      "weight of the centre cost c_v; higher keeps the target nearer the middle of the image",
      at_least(0.0));
    f("recognition_weight", recognition_weight,
      "weight of the recognition cost c_r c_i, in 1/m; higher leaves the path more for a view",
      at_least(0.0));
    f("information", information,
      "true: known objects cost nothing (c_i); false: each is sought as if it had never been "
      "observed");
    f("epsilon_m", epsilon_m,
      "margin beyond the body within which obstacles cost; higher keeps farther off",
      at_least(0.0));
    f("body_radius_m", body_radius_m,
      "radius of the sphere that holds the vehicle, for the obstacle cost; higher keeps farther "
      "off",
      at_least(0.0));
    f("speed_floor_m_s", speed_floor_m_s,
      "least speed in the obstacle cost, so that standing in an obstacle costs too; higher costs "
      "more",
      at_least(0.0));
    f("segment_s", segment_s,
      "time between waypoints that speeds are computed from; higher takes the flight to be slower, "
      "and obstacles cost less",
      above(0.0));
    f("bearing_weight", bearing_weight,
      "weight of the angle off the optical axis in c_v; higher turns sooner to a target behind the "
      "camera",
      at_least(0.0));
    f("between_waypoints", between_waypoints,
      "true: the obstacle cost looks half way to the neighbouring waypoints too");
    f("clearance_m", clearance_m,
      "distance from the vehicle's centre to surfaces below which what is missing costs; higher "
      "keeps farther off",
      at_least(0.0));
    f("clearance_weight", clearance_weight,
      "weight of missing clearance, in 1/m; higher makes it harder", at_least(0.0));
    f("delta_m", delta_m,
      "with `literal`, distance beyond which obstacles do not count; higher counts more",
      at_least(0.0));
    f("literal", literal,
      "true: the dissertation's costs as printed, for the record, by which the vehicle flies into "
      "obstacles");
  }
};

/// A camera on the body that looks `pitch_rad` below the horizon ahead of it.
Pose camera_ahead(double pitch_rad,
                  const Eigen::Vector3d& p_body_camera_m = Eigen::Vector3d::Zero());

/// The camera on the body; axes as in geometry/pose.hpp.
struct FlightCamera {
  Pose T_body_camera = camera_ahead(0.0);
  double horizontal_fov_rad = 0.9948376736367679;  ///< 57 deg
  double vertical_fov_rad = 0.7853981633974483;    ///< 45 deg
};

/// Of a pinhole camera with square pixels.
FlightCamera flight_camera(const Pose& T_body_camera, int width_px, int height_px,
                           double vertical_fov_rad);

/// What to recognise and from where.
struct ObservationTarget {
  Eigen::Vector3d p_world_object_m = Eigen::Vector3d::Zero();  ///< o_r
  Eigen::Vector3d p_world_view_m = Eigen::Vector3d::Zero();    ///< o_v
  double entropy_nats = 0.0;                                   ///< H of what it may be
  bool flown_to = true;  ///< false: it is only looked at, c_r does not count
};

/// c_o of a place so far from the surface, max(epsilon + r_b - d, 0) |x'|.  [Potthast2016, (5.8)]
double obstacle_cost(const FlightCostOptions& options, double distance_m, double speed_m_s);

/// The image plane: 1 where the frame ends. Nothing if it is not in front of the camera.
std::optional<Eigen::Vector2d> in_frame(const FlightCamera& camera, const Eigen::Vector4d& waypoint,
                                        const Eigen::Vector3d& p_world);

/// c_v of a waypoint that should see a place in the middle.  [Potthast2016, (5.9)]
double centre_cost(const FlightCostOptions& options, const FlightCamera& camera,
                   const Eigen::Vector4d& waypoint, const Eigen::Vector3d& p_world);

/// c_v of a waypoint without a target: that it heads for a place, whatever its height.
double heading_cost(const FlightCostOptions& options, const FlightCamera& camera,
                    const Eigen::Vector4d& waypoint, const Eigen::Vector3d& p_world);

/// c_r.  [Potthast2016, (5.10)], with o_v in place of o_r, which the vehicle would fly into, and
/// the ray from the object through o_v in place of the line, which has two sides.
double recognition_cost(const FlightCostOptions& options, const ObservationTarget& target,
                        const Eigen::Vector3d& p_world);

/// c_i.  [Potthast2016, (5.11)]
double information_cost(const FlightCostOptions& options, double entropy_nats);

/// What is known round the vehicle.
struct FlightSurroundings {
  const Esdf* surface = nullptr;              ///< null: nothing is in the way
  std::optional<ObservationTarget> target{};  ///< none: look where you go
  /// Of each of the K points, instead of `target`; empty: all have that.
  std::vector<std::optional<ObservationTarget>> target_of_point{};
  std::vector<Eigen::Vector3d> p_world_obstacles_m{};  ///< literal: centres o_c
};

/// c_o + c_v + c_r c_i of each point, weighed. `scene.surface` must outlive it.
/// [Potthast2016, (5.7)]
PathCost flight_cost(const FlightCostOptions& options, const FlightCamera& camera,
                     FlightSurroundings scene);

}  // namespace vantage
