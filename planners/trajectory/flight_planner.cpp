#include "vantage/planners/trajectory/flight_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "vantage/planners/trajectory/flight_hazards.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"
#include "vantage/planners/trajectory/replanning.hpp"

namespace vantage {
namespace {

Eigen::Matrix4Xd columns(const std::vector<Eigen::Vector4d>& path, int first, int count) {
  Eigen::Matrix4Xd points(4, count);
  const auto from = static_cast<std::size_t>(first);
  for (int i = 0; i < count; ++i) points.col(i) = path[from + static_cast<std::size_t>(i)];
  return points;
}

/// Farther surfaces cost nothing.
constexpr double kReach_m = 1.5;
/// Beyond the path, where its detours may lead.
constexpr double kAside_m = 2.5;

/// With fewer waypoints left no view is sought: whoever turns back at the last one swings past it.
constexpr int kLastAsGiven = 6;

/// How much smaller the path-deviation tolerance is upwards and down: a fixed camera has an object
/// in its middle from high above as well, but sees less of it there.
constexpr double kUpright = 4.0;

ViewTarget view_target(int id, const ObservedObject& object, int direction) {
  return {.object = id,
          .direction = direction,
          .p_world_object_m = object.ring.p_world_object_m,
          .p_world_view_m = object.ring.view_m(direction),
          .entropy_nats = object.entropy_nats};
}

/// Round the paths, by so much.
Eigen::AlignedBox3d box_round(const std::vector<Eigen::Matrix4Xd>& paths, double by_m) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Matrix4Xd& path : paths) {
    for (const auto& q : path.colwise()) box.extend(Eigen::Vector3d(q.head<3>()));
  }
  const Eigen::Vector3d more_m = Eigen::Vector3d::Constant(by_m);
  return {box.min() - more_m, box.max() + more_m};
}

}  // namespace

FlightPlanner::FlightPlanner(const FlightPlanning& planning, const FlightCamera& camera, Rng rng)
    : planning_(planning), camera_(camera), rng_(rng) {
  planning_.options.cost.tau_nats = planning.known_below_nats;
}

Horizon FlightPlanner::horizon(const PlanState& state,
                               const std::vector<Eigen::Vector4d>& path) const {
  const int first = state.at + 1;
  const auto size = static_cast<int>(state.nominal.size());
  const int count = std::min(planning_.horizon, size - first);
  Horizon horizon;
  horizon.before = state.plan[static_cast<std::size_t>(state.at)];
  horizon.points = columns(path, first, count);
  horizon.points.col(0) = state.plan[static_cast<std::size_t>(first)];
  if (count > 1)
    horizon.points.col(count - 1) = state.nominal[static_cast<std::size_t>(first + count - 1)];
  horizon.after = state.nominal.at(static_cast<std::size_t>(std::min(first + count, size - 1)));
  return unwrapped(std::move(horizon));
}

std::vector<ObservedObject> FlightPlanner::observed(const std::vector<PlannableObject>& objects,
                                                    double height_m) const {
  const Eigen::Vector3d in_body_m =
      camera_.T_body_camera * Eigen::Vector3d(0.0, 0.0, planning_.options.observation_distance_m);
  std::vector<ObservedObject> observed;
  for (const PlannableObject& object : objects) {
    ObservedObject& ring = observed.emplace_back();
    ring = {.ring = {.p_world_object_m = object.p_world_m,
                     .radius_m = in_body_m.head<2>().norm(),
                     .height_m = std::min(height_m, object.p_world_m.z() - in_body_m.z())},
            .used = object.used,
            .entropy_nats = object.entropy_nats,
            .gain_nats = object.gain_nats};
    leave_out_blocked(ring, *surface_, planning_.options.clearance_m);
  }
  return observed;
}

void FlightPlanner::choose_target(const PlanState& state,
                                  const std::vector<PlannableObject>& objects,
                                  const std::vector<ObservedObject>& rings,
                                  const OccupancyGrid& grid) {
  if (const auto* on_the_way = std::get_if<ViewsOnTheWay>(&planning_.options.views)) {
    return choose_views(*on_the_way, state, objects, rings, grid);
  }
  const Eigen::Vector3d p_m = state.plan[static_cast<std::size_t>(state.at)].head<3>();
  const auto active =
      active_object(rings, p_m, planning_.known_below_nats, planning_.options.range_m);
  if (!active) return;
  const auto direction = active_direction(rings[*active], horizon(state, state.nominal).points);
  if (!direction) return;
  target_ = view_target(objects[*active].id, rings[*active], *direction);
}

/// The views that the next waypoints take, and the first of them as what is looked at.
void FlightPlanner::choose_views(const ViewsOnTheWay& options, const PlanState& state,
                                 const std::vector<PlannableObject>& objects,
                                 const std::vector<ObservedObject>& rings,
                                 const OccupancyGrid& grid) {
  const Eigen::Matrix4Xd given = horizon(state, state.nominal).points;
  if (static_cast<int>(state.nominal.size()) - 1 - state.at < kLastAsGiven) {
    target_of_point_.resize(static_cast<std::size_t>(given.cols()));
    return;
  }
  const std::vector<ScheduledView> views =
      schedule_views(options, rings, given, planning_.known_below_nats);
  for (const auto& view : views_of_points(options, views, given)) {
    const auto point = static_cast<Eigen::Index>(target_of_point_.size());
    auto& target = target_of_point_.emplace_back();
    if (!view) {
      target = search_target(planning_.options.search, grid, camera_, given, point,
                             planning_.options.observation_distance_m);
      continue;
    }
    const ObservedObject& object = rings[views[*view].object];
    target = ObservationTarget{.p_world_object_m = object.ring.p_world_object_m,
                               .p_world_view_m = object.ring.view_m(views[*view].direction),
                               .entropy_nats = object.entropy_nats};
  }
  if (views.empty()) return;
  const ScheduledView& first = views.front();
  target_ = view_target(objects[first.object].id, rings[first.object], first.direction);
}

/// The same places, headed for what each is to look at.
Eigen::Matrix4Xd FlightPlanner::turned(const Eigen::Matrix4Xd& points,
                                       const std::vector<ObservedObject>& objects) const {
  if (target_of_point_.empty()) {
    return initial_yaw(
        points, objects,
        {.tau_nats = planning_.known_below_nats, .range_m = planning_.options.range_m});
  }
  Eigen::Matrix4Xd headed = points;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto& target = target_of_point_[static_cast<std::size_t>(i)];
    if (!target) continue;
    const Eigen::Vector3d to_m = target->p_world_object_m - points.col(i).head<3>();
    headed(3, i) = std::atan2(to_m.y(), to_m.x());
  }
  return headed;
}

/// Of what is looked at, no higher than the path.
double FlightPlanner::lowest_view_m(double height_m) const {
  double lowest_m = height_m;
  if (target_) lowest_m = std::min(lowest_m, target_->p_world_view_m.z());
  for (const auto& target : target_of_point_) {
    if (target) lowest_m = std::min(lowest_m, target->p_world_view_m.z());
  }
  return lowest_m;
}

Eigen::Matrix4Xd FlightPlanner::method_path(const PlanState& state,
                                            const std::vector<ObservedObject>& objects,
                                            const PathCost& cost) {
  const Horizon given = horizon(state, state.nominal);
  if (given.free_points() == 0) return given.points;
  const Eigen::Vector4d next = given.points.col(0);  // flown to already
  Eigen::Matrix4Xd points = std::visit(
      [&](auto method) -> Eigen::Matrix4Xd {
        using Method = decltype(method);
        if constexpr (std::is_same_v<Method, GivenPath>) {
          return given.points;
        } else if constexpr (std::is_same_v<Method, GivenPathYaw>) {
          method.yaw.tau_nats = planning_.known_below_nats;
          return initial_yaw(given.points, objects, method.yaw);
        } else if constexpr (std::is_same_v<Method, DetourPath>) {
          method.detour.tau_nats = planning_.known_below_nats;
          return greedy_detour(given, objects, method.detour);
        } else {
          const auto turned = [&](const Eigen::Matrix4Xd& points) {
            return this->turned(points, objects);
          };
          return replan(method, horizon(state, state.plan), given.points, turned, cost, rng_)
              .points;
        }
      },
      planning_.method);
  points.col(0) = next;
  return points;
}

/// @param given where the path as given has the points
PathCost FlightPlanner::cost(const Eigen::Matrix4Xd& given,
                             const std::vector<ObservedObject>& objects) const {
  FlightSurroundings scene{.surface = &*surface_, .target_of_point = target_of_point_};
  for (const ObservedObject& object : objects) {  // what the literal cost takes for obstacles
    scene.p_world_obstacles_m.push_back(object.ring.p_world_object_m);
  }
  if (target_) {
    scene.target = ObservationTarget{.p_world_object_m = target_->p_world_object_m,
                                     .p_world_view_m = target_->p_world_view_m,
                                     .entropy_nats = target_->entropy_nats};
  }
  return [of_flight = flight_cost(planning_.options.cost, camera_, std::move(scene)), given,
          path_deviation_tolerance_m = planning_.options.path_deviation_tolerance_m,
          weight = planning_.options.path_deviation_weight,
          lowest_m = lowest_view_m(given.row(2).minCoeff())](
             const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point) {
    of_flight(horizon, cost_of_point);
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      Eigen::Vector3d off_m = (horizon.points.col(i) - given.col(i)).head<3>();
      off_m.z() = kUpright * std::max({off_m.z(), lowest_m - horizon.points(2, i), 0.0});
      cost_of_point[i] += weight * std::max(0.0, off_m.norm() - path_deviation_tolerance_m);
    }
  };
}

std::vector<CandidatePlan> FlightPlanner::propose(const PlanState& state,
                                                  const std::vector<PlannableObject>& objects,
                                                  const FlightMap& map) {
  const Eigen::Matrix4Xd given = horizon(state, state.nominal).points;
  const Eigen::Matrix4Xd planned = horizon(state, state.plan).points;
  window_ = box_round({given, planned}, kAside_m);
  surface_ = make_esdf(
      map.grid().frame,
      flight_hazards(map, columns(state.nominal, 0, static_cast<int>(state.nominal.size()))),
      window_, kReach_m);
  const double height_m = state.nominal[static_cast<std::size_t>(state.at)].z();
  const std::vector<ObservedObject> rings = observed(objects, height_m);
  target_.reset();
  target_of_point_.clear();
  if (optimises(planning_.method)) choose_target(state, objects, rings, map.grid());
  std::vector<CandidatePlan> candidates;
  const PathCost cost = this->cost(given, rings);
  const auto add = [&](std::string planner, const Eigen::Matrix4Xd& points) {
    Horizon ahead = horizon(state, state.plan);
    ahead.points = points;
    candidates.push_back({.planner = std::move(planner),
                          .points = points,
                          .cost = ahead.count() < 2 ? 0.0 : path_cost(unwrapped(ahead), cost)});
  };
  add(std::string(strategy_name_of(planning_.method)), method_path(state, rings, cost));
  if (std::holds_alternative<GivenPath>(planning_.method) ||
      std::holds_alternative<GivenPathYaw>(planning_.method)) {
    return candidates;  // these go nowhere else, whatever is in the way
  }
  add("as before", planned);
  add("as given", given);
  add("as flown", planned);
  candidates.back().same_spline = true;
  return candidates;
}

/// To the surface or the end of the window, beyond which nothing is known of surfaces.
double FlightPlanner::clearance_m(const Eigen::Vector3d& p_world_m) const {
  const double inside_m =
      std::min((p_world_m - window_.min()).minCoeff(), (window_.max() - p_world_m).minCoeff());
  return std::min(surface_->distance_m(p_world_m), inside_m);
}

double FlightPlanner::clearance_m(const MinimumJerkTrajectory& path, double until_s) const {
  double min_m = clearance_m(path.at(until_s).p_world_m);
  for (double t_s = 0.0; t_s < until_s; t_s += planning_.options.sample_s) {
    min_m = std::min(min_m, clearance_m(path.at(t_s).p_world_m));
  }
  return min_m;
}

std::size_t safest_of_best(const std::vector<CandidatePlan>& candidates) {
  const auto clear = std::ranges::find(candidates, true, &CandidatePlan::clear);
  if (clear != candidates.end()) return static_cast<std::size_t>(clear - candidates.begin());
  return static_cast<std::size_t>(
      std::ranges::max_element(candidates, {}, &CandidatePlan::clearance_m) - candidates.begin());
}

}  // namespace vantage
