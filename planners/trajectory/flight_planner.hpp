/// Candidate plans for the next waypoints: which object to observe next, from which viewpoint, and
/// the waypoints of each trajectory method.  [Potthast2016, 5.2]
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "vantage/belief/map/flight_map.hpp"
#include "vantage/control/minimum_jerk_trajectory.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/candidate_plan.hpp"
#include "vantage/planners/trajectory/esdf.hpp"
#include "vantage/planners/trajectory/flight_cost.hpp"
#include "vantage/planners/trajectory/observation_ring.hpp"
#include "vantage/planners/trajectory/trajectory_method.hpp"

namespace vantage {

/// An object that was found.
struct PlannableObject {
  int id = 0;
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  double entropy_nats = 0.0;
  std::array<bool, kObservationDirections> used{};  ///< or not worth an observation
  /// Expected information of an observation from each direction.
  std::array<double, kObservationDirections> gain_nats =
      every_direction(std::numeric_limits<double>::infinity());
};

/// Where the flight is.
struct PlanState {
  int at = 0;                                   ///< the waypoint reached last
  const std::vector<Eigen::Vector4d>& nominal;  ///< the path as given
  const std::vector<Eigen::Vector4d>& plan;     ///< as it is flown until now
};

/// What a planner is asked for.
struct FlightPlanning {
  TrajectoryMethod method = Stomp{};
  FlightPlannerOptions options = {};
  int horizon = 10;               ///< waypoints that are planned at once, K; at least 3
  double known_below_nats = 0.1;  ///< entropy of an object below which it is not looked at
};

class FlightPlanner {
 public:
  FlightPlanner(const FlightPlanning& planning, const FlightCamera& camera, Rng rng);

  /// Candidate plans for the next waypoints: the method's own first, then its fallbacks.
  std::vector<CandidatePlan> propose(const PlanState& state,
                                     const std::vector<PlannableObject>& objects,
                                     const FlightMap& map);
  /// Least distance from what is known to be in the way, and from what is not known of, until then.
  [[nodiscard]] double clearance_m(const MinimumJerkTrajectory& path, double until_s) const;
  [[nodiscard]] bool clear(double clearance_m) const {
    return clearance_m >= planning_.options.clearance_m;
  }

  /// What the last proposal of an optimiser looks at; nothing: where it goes.
  [[nodiscard]] const std::optional<ViewTarget>& target() const { return target_; }

 private:
  [[nodiscard]] Horizon horizon(const PlanState& state,
                                const std::vector<Eigen::Vector4d>& path) const;
  [[nodiscard]] std::vector<ObservedObject> observed(const std::vector<PlannableObject>& objects,
                                                     double height_m) const;
  void choose_target(const PlanState& state, const std::vector<PlannableObject>& objects,
                     const std::vector<ObservedObject>& rings, const OccupancyGrid& grid);
  void choose_views(const ViewsOnTheWay& options, const PlanState& state,
                    const std::vector<PlannableObject>& objects,
                    const std::vector<ObservedObject>& rings, const OccupancyGrid& grid);
  [[nodiscard]] Eigen::Matrix4Xd turned(const Eigen::Matrix4Xd& points,
                                        const std::vector<ObservedObject>& objects) const;
  [[nodiscard]] double clearance_m(const Eigen::Vector3d& p_world_m) const;
  [[nodiscard]] double lowest_view_m(double height_m) const;
  [[nodiscard]] PathCost cost(const Eigen::Matrix4Xd& given,
                              const std::vector<ObservedObject>& objects) const;
  [[nodiscard]] Eigen::Matrix4Xd method_path(const PlanState& state,
                                             const std::vector<ObservedObject>& objects,
                                             const PathCost& cost);

  FlightPlanning planning_;
  FlightCamera camera_;
  Rng rng_;
  Eigen::AlignedBox3d window_;  ///< round the way ahead; what is outside of it was not looked at
  std::optional<Esdf> surface_;
  std::optional<ViewTarget> target_;
  /// Of each point of the horizon; empty: all have `target_`.
  std::vector<std::optional<ObservationTarget>> target_of_point_;
};

/// The first that is clear; if none is, the one that keeps off farthest.
std::size_t safest_of_best(const std::vector<CandidatePlan>& candidates);

}  // namespace vantage
