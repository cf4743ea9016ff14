/// Tracks trajectories with the quadrotor: flies to a place, along a trajectory, or hovers.
#pragma once

#include <functional>
#include <span>

#include "vantage/control/tracking_options.hpp"
#include "vantage/sim/robots/quadrotor.hpp"

namespace vantage {

class TrajectoryTrackingController;
/// Asked every period; false stops the flight, which then has to be held or led on.
using KeepFlying = std::function<bool(const TrajectoryTrackingController&)>;

/// Gusts push that body from now on.
void add_gusts(World& world, int body_id, const std::vector<Gust>& gusts);

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
