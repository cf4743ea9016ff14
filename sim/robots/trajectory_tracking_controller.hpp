/// Tracks trajectories with the quadrotor: flies to a place, along a trajectory, or hovers.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "vantage/control/flight_disturbance.hpp"
#include "vantage/control/minimum_jerk_trajectory.hpp"
#include "vantage/sim/robots/quadrotor.hpp"

namespace vantage {

struct TrajectoryTrackingOptions {
  FlightControllerOptions controller = {};
  FlightLimits limits = {};
  PoseNoiseOptions pose_noise = {};
  std::vector<Gust> gusts = {};
  double goal_tolerance_m = 0.05;    ///< of the estimate; higher arrives sooner, less exactly
  double goal_tolerance_rad = 0.05;  ///< of the heading
  double rest_speed_m_s = 0.05;      ///< slower than this is at rest
  double settle_time_s = 0.3;        ///< within tolerance and at rest that long is arrived
  double timeout_s = 8.0;            ///< after the path's end; higher is more patient
  void fields(auto&& f) {
    f("controller", controller);
    f("limits", limits);
    f("pose_noise", pose_noise);
    f("gusts", gusts);
    f("goal_tolerance_m", goal_tolerance_m, Range{0.001, 1.0});
    f("goal_tolerance_rad", goal_tolerance_rad, Range{0.001, 1.0});
    f("rest_speed_m_s", rest_speed_m_s, Range{0.001, 1.0});
    f("settle_time_s", settle_time_s, between(0.0, 10.0));
    f("timeout_s", timeout_s, above(0.0));
  }
};

enum class FlightStatus { arrived, contact, stopped, timeout };
std::string_view to_string(FlightStatus status);

struct FlightResult {
  FlightStatus status = FlightStatus::arrived;
  double duration_s = 0.0;     ///< simulated
  double path_length_m = 0.0;  ///< truly flown
  double rms_error_m = 0.0;    ///< of the true position from the reference, over time
  double greatest_error_m = 0.0;
  double energy_J = 0.0;  ///< induced power of the rotors, integrated
};

class TrajectoryTrackingController;
/// Asked every period; false stops the flight, which then has to be held or led on.
using KeepFlying = std::function<bool(const TrajectoryTrackingController&)>;

/// Steps the world while the vehicle follows references, from its estimated pose. Nothing but
/// rotor thrust (and the gusts) acts on it. A flight ends at the first contact with anything.
class TrajectoryTrackingController {
 public:
  /// Starts with the reference where the vehicle is, at rest.
  /// @throws ConfigError if options are out of range or the world commands less often than it
  /// steps (see kFlightWorld).
  TrajectoryTrackingController(World& world, const Quadrotor& vehicle,
                               const TrajectoryTrackingOptions& options, Rng rng);

  /// Through the waypoints (world frame as the vehicle believes it) and to rest at the last.
  FlightResult fly_to(std::span<const FlightWaypoint> waypoints, const KeepFlying& keep = {});
  /// Along a path that begins at `reference()`, and to rest at its end.
  FlightResult follow(const MinimumJerkTrajectory& path, const KeepFlying& keep = {});
  /// Stays where the reference is; at rest.
  FlightResult hold(double duration_s);

  /// One period towards `reference`; for planners that lead it themselves.
  void tick(const FlightReference& reference);

  /// Where the reference is now: where the next path begins.
  [[nodiscard]] const FlightReference& reference() const { return reference_; }
  [[nodiscard]] FlightState estimate() const;
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const Quadrotor& vehicle() const { return vehicle_; }
  [[nodiscard]] int collisions() const { return collisions_.count(); }  ///< truth, for metrics

 private:
  /// What has been flown since some moment.
  struct Log {
    double start_s = 0.0;
    double path_length_m = 0.0;
    double squared_error_m2_s = 0.0;
    double greatest_error_m = 0.0;
    double energy_J = 0.0;
    int collisions = 0;
  };
  [[nodiscard]] FlightStatus fly(const MinimumJerkTrajectory& path, const KeepFlying& keep);
  [[nodiscard]] FlightResult result_since(FlightStatus status) const;
  [[nodiscard]] bool is_at(const FlightWaypoint& goal) const;
  void begin();
  void apply_gusts();
  void log_tick(const FlightState& before, const FlightState& after);

  World& world_;
  const Quadrotor& vehicle_;
  TrajectoryTrackingOptions options_;
  PoseEstimate estimate_;
  FlightMemory memory_;
  FlightReference reference_;
  CollisionCounter collisions_;
  Log log_;
};

}  // namespace vantage
