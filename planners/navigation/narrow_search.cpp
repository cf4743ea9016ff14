#include "vantage/planners/navigation/narrow_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/planners/navigation/distance_field.hpp"
#include "vantage/planners/navigation/narrow_poses.hpp"

namespace vantage {
namespace {

/// How far from its heading a base may go that cannot go sideways: what steps to the eight cells
/// about it leave between them.
constexpr double kAlong_rad = 0.48;
/// A quarter of a turn makes hardly a difference to a nearly square robot. It faces where it goes,
/// to an eighth: along a wall it gets from one row of cells to the next without turning.
constexpr double kSquare_m = 0.02;
constexpr double kFacing_rad = 0.8;

/// What a metre counts for that keeps less than the preferred margin.
constexpr double kPinched = 2.0;

double facing_limit_rad(const RobotOutline& robot) {
  if (!robot.goes_sideways) return kAlong_rad;
  const auto width_m = [&](const Eigen::Vector2d& along) {
    double least = kInfinity;
    double most = -kInfinity;
    for (const Eigen::Vector2d& p : robot.outline) {
      least = std::min(least, along.dot(p));
      most = std::max(most, along.dot(p));
    }
    return Eigen::Array2d(-least, most);
  };
  const Eigen::Array2d x = width_m(Eigen::Vector2d::UnitX());
  const Eigen::Array2d y = width_m(Eigen::Vector2d::UnitY());
  const double differs_m =
      std::max(x.maxCoeff(), y.maxCoeff()) - std::min(x.minCoeff(), y.minCoeff());
  return differs_m < kSquare_m ? kFacing_rad : std::numbers::pi;
}

class PassageSearch {
 public:
  PassageSearch(PathField& field, std::vector<Leeway> leeway)
      : field_(field),
        space_(*field.space),
        poses_(field, std::move(leeway)),
        fixed_(field.map.size(), 0),
        facing_rad_(facing_limit_rad(space_.robot())) {
    for (std::size_t cell = 0; cell < fixed_.size(); ++cell) {
      fixed_[cell] = field.reachable(cell) ? 1 : 0;
    }
  }

  void from_open_places() {
    for (std::size_t cell = 0; cell < fixed_.size(); ++cell) {
      if (fixed_[cell] == 0 || !field_.traversable(cell) || !is_beside_passage(cell)) continue;
      queue_.emplace(field_.cost[cell], cell);
    }
    run();
    reach_nooks();
  }

  /// The robot stands in a passage. Where it gets to no open place ahead, it leaves backwards or
  /// sideways.
  void from_start() {
    const std::uint32_t start = poses_.add_start();
    field_.narrow[start].cost = 0.0;
    queue_.emplace(0.0, field_.map.size() + start);
    run();
    if (!field_.reaches_open_place() && space_.robot().goes_sideways) {
      facing_rad_ = std::numbers::pi;
      field_.narrow_edges.clear();  // all are made again
      for (std::size_t i = 0; i < field_.narrow.size(); ++i) {
        const double cost = field_.narrow[i].cost;
        if (cost < kInfinity) queue_.emplace(cost, field_.map.size() + i);
      }
      run();
    }
    reach_nooks();
  }

 private:
  struct Step {
    int dx, dy;
    double cells, direction_rad;
  };

  static std::array<Step, 8> steps() {
    std::array<Step, 8> made{};
    const std::array<std::pair<int, int>, 8> to{
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
    for (std::size_t i = 0; i < to.size(); ++i) {
      const auto [dx, dy] = to[i];
      made[i] = {dx, dy, std::hypot(dx, dy), std::atan2(dy, dx)};
    }
    return made;
  }

  [[nodiscard]] bool is_node(std::size_t id) const { return id >= field_.map.size(); }
  [[nodiscard]] bool is_beside_passage(std::size_t cell) const {
    const Eigen::Array2i at = field_.map.cell(cell);
    return std::ranges::any_of(kSteps, [&](const Step& step) {
      const Eigen::Array2i to = at + Eigen::Array2i(step.dx, step.dy);
      return field_.map.contains(to) && poses_.is_narrow(field_.map.index(to));
    });
  }
  [[nodiscard]] bool faces(const Step& step, int heading) const {
    return std::abs(wrap_angle(step.direction_rad - space_.heading_rad(heading))) <= facing_rad_;
  }

  [[nodiscard]] double cost_of(std::size_t id) const {
    return is_node(id) ? field_.narrow[id - field_.map.size()].cost : field_.cost[id];
  }
  [[nodiscard]] Eigen::Vector2d place_of(std::size_t id) const {
    if (!is_node(id)) return field_.map.centre(field_.map.cell(id));
    const Pose2& pose = field_.narrow[id - field_.map.size()].pose;
    return {pose.x_m, pose.y_m};
  }

  void relax(std::size_t from, std::size_t to, double cost, double length_m) {
    field_.narrow_edges.push_back({from, to, cost, length_m});
    const double through = cost_of(from) + cost;
    if (through >= cost_of(to)) return;
    if (is_node(to)) {
      NarrowPose& node = field_.narrow[to - field_.map.size()];
      node.cost = through;
      node.parent = from;
    } else {
      if (fixed_[to] != 0) return;
      field_.cost[to] = through;
      field_.parent[to] = from;
    }
    queue_.emplace(through, to);
  }

  void relax_narrow(std::size_t from, std::size_t to, double more_m, bool roomy) {
    const double length_m = ((place_of(to) - place_of(from)).norm() + more_m) * space_.slowness();
    const double per_metre = (1.0 + field_.options.clearance_weight) * (roomy ? 1.0 : kPinched);
    relax(from, to, length_m * per_metre, length_m);
  }

  void step_from_open(std::size_t cell) {
    const Eigen::Array2i at = field_.map.cell(cell);
    const auto is_open = [&](int dx, int dy) {
      const Eigen::Array2i to = at + Eigen::Array2i(dx, dy);
      return field_.map.contains(to) && field_.traversable(field_.map.index(to));
    };
    for (const Step& step : kSteps) {
      const Eigen::Array2i to = at + Eigen::Array2i(step.dx, step.dy);
      if (!field_.map.contains(to)) continue;
      const std::size_t neighbour = field_.map.index(to);
      if (poses_.is_narrow(neighbour)) {
        enter(cell, neighbour, step);
      } else if (fixed_[cell] == 0 && is_open(step.dx, step.dy)) {
        if (step.dx != 0 && step.dy != 0 && !(is_open(step.dx, 0) && is_open(0, step.dy))) continue;
        const double length_m = step.cells * field_.map.cell_m;
        const double through =
            field_.cost[cell] +
            length_m * 0.5 * (field_.cost_per_metre(cell) + field_.cost_per_metre(neighbour));
        if (fixed_[neighbour] != 0 || through >= field_.cost[neighbour]) continue;
        field_.cost[neighbour] = through;
        field_.parent[neighbour] = cell;
        queue_.emplace(through, neighbour);
      }
    }
  }

  void enter(std::size_t cell, std::size_t narrow_cell, const Step& step) {
    for (int heading = 0; heading < space_.headings(); ++heading) {
      if (!faces(step, heading)) continue;
      const std::uint32_t node = poses_.at(narrow_cell, heading);
      if (node == NarrowPoses::kNone) continue;
      const NarrowPoses::Place& place = poses_.place(node);
      if (!poses_.fits_between(poses_.middle(cell), place.fine, heading)) continue;
      relax_narrow(
          cell, field_.map.size() + node, 0.0,
          place.roomy && poses_.is_roomy_between(poses_.middle(cell), place.fine, heading));
    }
  }

  void step_from_passage(std::size_t id) {
    const std::size_t index = id - field_.map.size();
    const std::size_t cell = field_.narrow[index].cell;
    const NarrowPoses::Place place = poses_.place(index);
    const Eigen::Array2i at = field_.map.cell(cell);
    for (const Step& step : kSteps) {
      const Eigen::Array2i to = at + Eigen::Array2i(step.dx, step.dy);
      if (!field_.map.contains(to) || !faces(step, place.heading)) continue;
      const std::size_t neighbour = field_.map.index(to);
      if (field_.traversable(neighbour)) {
        go(id, place, neighbour, {poses_.middle(neighbour), place.heading, true});
      } else if (poses_.is_narrow(neighbour)) {
        const std::uint32_t node = poses_.at(neighbour, place.heading);
        if (node != NarrowPoses::kNone) go(id, place, field_.map.size() + node, poses_.place(node));
      }
    }
    turn_from(id, cell, place);
  }

  void go(std::size_t id, const NarrowPoses::Place& from, std::size_t to_id,
          const NarrowPoses::Place& to) {
    if (!poses_.fits_between(from.fine, to.fine, from.heading)) return;
    relax_narrow(
        id, to_id, 0.0,
        from.roomy && to.roomy && poses_.is_roomy_between(from.fine, to.fine, from.heading));
  }

  void turn_from(std::size_t id, std::size_t cell, const NarrowPoses::Place& place) {
    const double turned_m = 2.0 * std::numbers::pi / space_.headings() * space_.circumscribed_m();
    for (const int way : {1, -1}) {
      const int turned = (place.heading + way + space_.headings()) % space_.headings();
      const std::uint32_t node = poses_.at(cell, turned);
      if (node == NarrowPoses::kNone) continue;
      const NarrowPoses::Place& there = poses_.place(node);
      const auto& [from, to_next] = way > 0 ? std::tie(place, there) : std::tie(there, place);
      if (!poses_.fits_turning(from, to_next)) continue;
      relax_narrow(id, field_.map.size() + node, turned_m, poses_.is_roomy_turning(from, to_next));
    }
  }

  void run() {
    for (std::size_t settled = 1; !queue_.empty();) {
      const auto [cost, id] = queue_.top();
      queue_.pop();
      if (cost > cost_of(id)) continue;
      if (settled++ % kNodesBetweenPolls == 0) poll_stop();
      if (is_node(id)) {
        step_from_passage(id);
      } else {
        step_from_open(id);
      }
    }
  }

  /// A nook is a place to go to, at the heading that is cheapest there of those that keep the
  /// preferred margin; but not for a robot that could neither turn there nor come out again as it
  /// went in, and not where its own way out is.
  void reach_nooks() {
    if (!space_.robot().goes_sideways && !space_.turns_anywhere()) return;
    for (std::size_t i = 0; i < field_.narrow.size(); ++i) {
      const NarrowPose& node = field_.narrow[i];
      if (!poses_.is_nook(node.cell) || !poses_.place(i).roomy) continue;
      if (node.cost >= field_.cost[node.cell]) continue;
      const bool on_way_out =
          !field_.reachable(node.cell) && field_.parent[node.cell] != PathField::kNone;
      if (field_.traversable(node.cell) || on_way_out) continue;
      field_.cost[node.cell] = node.cost;
      field_.parent[node.cell] = field_.map.size() + i;
    }
  }

  static inline const std::array<Step, 8> kSteps = steps();

  PathField& field_;
  const FootprintSpace& space_;
  NarrowPoses poses_;
  std::vector<std::uint8_t> fixed_;  ///< reached before
  double facing_rad_;
  using Entry = std::pair<double, std::size_t>;  // ties by index: the same tree every time
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

void search_passages(PathField& field) {
  const FootprintSpace& space = *field.space;
  const std::size_t size = field.map.size();
  std::vector<std::uint8_t> open(size, 0);
  std::vector<std::uint8_t> may_stand(size, 0);
  const bool any_reached = field.reaches_open_place();
  for (std::size_t cell = 0; cell < size; ++cell) {
    const bool small = !any_reached && cell == field.start_cell;  // no open place
    open[cell] = field.traversable(cell) && !small ? 1 : 0;
    if (open[cell] != 0) continue;
    const Eigen::Array2i middle = field.map.cell(cell) * space.parts() + space.parts() / 2;
    may_stand[cell] = space.may_stand(middle) ? 1 : 0;
  }
  if (!any_reached) may_stand[field.start_cell] = 1;  // it does
  std::vector<Leeway> leeway =
      find_narrow_places(field.map, open, may_stand, space.options().least_area_m2,
                         any_reached ? std::nullopt : std::optional(field.start_cell));
  const bool any = std::ranges::any_of(
      leeway, [](Leeway l) { return l == Leeway::passage || l == Leeway::nook; });
  if (!any) return;
  PassageSearch search(field, std::move(leeway));
  if (any_reached) {
    search.from_open_places();
  } else {
    search.from_start();
  }
}

}  // namespace vantage
