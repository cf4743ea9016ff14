#include "vantage/planners/navigation/narrow_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "vantage/planners/navigation/narrow_places.hpp"

namespace vantage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How far from its heading a base may go that cannot go sideways: what steps to the eight cells
/// about it leave between them.
constexpr double kAlong_rad = 0.48;
/// A quarter of a turn makes hardly a difference to a nearly square robot. It faces where it goes.
constexpr double kSquare_m = 0.02;
constexpr double kFacing_rad = 0.5;

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
        leeway_(std::move(leeway)),
        fixed_(field.map.size(), 0),
        row_of_(field.map.size(), kNone),
        facing_rad_(facing_limit_rad(space_.robot())) {
    const auto headings = static_cast<std::size_t>(space_.headings());
    std::uint32_t rows = 0;
    for (std::size_t cell = 0; cell < leeway_.size(); ++cell) {
      if (is_narrow(cell)) row_of_[cell] = rows++;
      fixed_[cell] = field.reachable(cell) ? 1 : 0;
    }
    node_at_.assign(rows * headings, kUnknown);
  }

  void from_open_places() {
    for (std::size_t cell = 0; cell < leeway_.size(); ++cell) {
      if (fixed_[cell] == 0 || !field_.traversable(cell) || !is_beside_passage(cell)) continue;
      queue_.emplace(field_.cost[cell], cell);
    }
    run();
  }

  /// The robot stands in a passage.
  void from_start() {
    const int heading = space_.nearest_heading(field_.start.yaw_rad);
    const Eigen::Array2i fine = middle(field_.start_cell);
    tight_ = !space_.fits(fine, heading);
    field_.narrow.push_back(
        {.pose = field_.start, .cell = field_.start_cell, .cost = 0.0, .parent = PathField::kNone});
    placed_.push_back({fine, heading});
    node_at_[slot(field_.start_cell, heading)] = 0;
    queue_.emplace(0.0, field_.map.size());
    run();
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kUnknown = kNone;
  static constexpr std::uint32_t kBlocked = kNone - 1;
  struct Place {
    Eigen::Array2i fine;  ///< cell of the finer map
    int heading;
  };
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

  [[nodiscard]] bool is_narrow(std::size_t cell) const {
    return leeway_[cell] == Leeway::passage || leeway_[cell] == Leeway::nook;
  }
  [[nodiscard]] bool is_node(std::size_t id) const { return id >= field_.map.size(); }
  [[nodiscard]] std::size_t slot(std::size_t cell, int heading) const {
    return row_of_[cell] * static_cast<std::size_t>(space_.headings()) +
           static_cast<std::size_t>(heading);
  }
  [[nodiscard]] Eigen::Array2i middle(std::size_t cell) const {
    return field_.map.cell(cell) * space_.parts() + space_.parts() / 2;
  }
  [[nodiscard]] bool is_beside_passage(std::size_t cell) const {
    const Eigen::Array2i at = field_.map.cell(cell);
    return std::ranges::any_of(kSteps, [&](const Step& step) {
      const Eigen::Array2i to = at + Eigen::Array2i(step.dx, step.dy);
      return field_.map.contains(to) && is_narrow(field_.map.index(to));
    });
  }
  [[nodiscard]] bool faces(const Step& step, int heading) const {
    return std::abs(wrap_angle(step.direction_rad - space_.heading_rad(heading))) <= facing_rad_;
  }

  /// The node of a cell at that heading, put where in the cell it fits, nearest to the middle; none
  /// if it fits nowhere.
  std::uint32_t node_at(std::size_t cell, int heading) {
    std::uint32_t& node = node_at_[slot(cell, heading)];
    if (node != kUnknown) return node;
    node = kBlocked;
    if (!space_.may_fit(middle(cell), heading, tight_)) return node;
    const int reach = space_.parts() / 2;
    double nearest = kInfinity;
    Eigen::Array2i best = Eigen::Array2i::Zero();
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const double off = std::hypot(dx, dy);
        const Eigen::Array2i fine = middle(cell) + Eigen::Array2i(dx, dy);
        if (off >= nearest || !space_.fits(fine, heading, tight_)) continue;
        nearest = off;
        best = fine;
      }
    }
    if (nearest == kInfinity) return node;
    node = static_cast<std::uint32_t>(field_.narrow.size());
    const Eigen::Vector2d p_m = space_.centre(best);
    field_.narrow.push_back({.pose = {p_m.x(), p_m.y(), space_.heading_rad(heading)},
                             .cell = cell,
                             .cost = kInfinity,
                             .parent = PathField::kNone});
    placed_.push_back({best, heading});
    return node;
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

  void relax_narrow(std::size_t from, std::size_t to, double more_m) {
    const double length_m = ((place_of(to) - place_of(from)).norm() + more_m) * space_.slowness();
    relax(from, to, length_m * (1.0 + field_.options.clearance_weight), length_m);
  }

  [[nodiscard]] bool fits_between(const Eigen::Array2i& a, const Eigen::Array2i& b, int heading) {
    return space_.fits((a + b) / 2, heading, tight_);
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
      if (is_narrow(neighbour)) {
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
      const std::uint32_t node = node_at(narrow_cell, heading);
      if (node == kBlocked || !fits_between(middle(cell), placed_[node].fine, heading)) continue;
      relax_narrow(cell, field_.map.size() + node, 0.0);
    }
  }

  void step_from_passage(std::size_t id) {
    const std::size_t index = id - field_.map.size();
    const std::size_t cell = field_.narrow[index].cell;
    const Place place = placed_[index];
    const Eigen::Array2i at = field_.map.cell(cell);
    for (const Step& step : kSteps) {
      const Eigen::Array2i to = at + Eigen::Array2i(step.dx, step.dy);
      if (!field_.map.contains(to) || !faces(step, place.heading)) continue;
      const std::size_t neighbour = field_.map.index(to);
      if (field_.traversable(neighbour)) {
        if (fits_between(place.fine, middle(neighbour), place.heading)) {
          relax_narrow(id, neighbour, 0.0);
        }
      } else if (is_narrow(neighbour)) {
        const std::uint32_t node = node_at(neighbour, place.heading);
        if (node != kBlocked && fits_between(place.fine, placed_[node].fine, place.heading)) {
          relax_narrow(id, field_.map.size() + node, 0.0);
        }
      }
    }
    turn_from(id, cell, place.heading);
  }

  void turn_from(std::size_t id, std::size_t cell, int heading) {
    const double turned_m = 2.0 * std::numbers::pi / space_.headings() * space_.circumscribed_m();
    for (const int way : {1, -1}) {
      const int turned = (heading + way + space_.headings()) % space_.headings();
      const std::uint32_t node = node_at(cell, turned);
      if (node != kBlocked) relax_narrow(id, field_.map.size() + node, turned_m);
    }
  }

  void run() {
    while (!queue_.empty()) {
      const auto [cost, id] = queue_.top();
      queue_.pop();
      if (cost > cost_of(id)) continue;
      if (is_node(id)) {
        step_from_passage(id);
      } else {
        step_from_open(id);
      }
    }
    reach_nooks();
  }

  /// A nook is a place to go to, at the heading that is cheapest there; but not for a robot that
  /// could neither turn there nor come out again as it went in.
  void reach_nooks() {
    if (!space_.robot().goes_sideways && !space_.turns_anywhere()) return;
    for (std::size_t i = 0; i < field_.narrow.size(); ++i) {
      const NarrowPose& node = field_.narrow[i];
      if (leeway_[node.cell] != Leeway::nook || node.cost >= field_.cost[node.cell]) continue;
      if (field_.traversable(node.cell)) continue;
      field_.cost[node.cell] = node.cost;
      field_.parent[node.cell] = field_.map.size() + i;
    }
  }

  static inline const std::array<Step, 8> kSteps = steps();

  PathField& field_;
  const FootprintSpace& space_;
  std::vector<Leeway> leeway_;
  std::vector<std::uint8_t> fixed_;     ///< reached before
  std::vector<std::uint32_t> row_of_;   ///< of narrow cells in node_at_
  std::vector<std::uint32_t> node_at_;  ///< per narrow cell and heading
  std::vector<Place> placed_;           ///< of each node
  double facing_rad_;
  bool tight_ = false;  ///< the robot stands nearer to something than a passage allows
  using Entry = std::pair<double, std::size_t>;  // ties by index: the same tree every time
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

void search_passages(PathField& field) {
  const FootprintSpace& space = *field.space;
  const std::size_t size = field.map.size();
  std::vector<std::uint8_t> open(size, 0);
  std::vector<std::uint8_t> may_stand(size, 0);
  bool any_reached = false;
  for (std::size_t cell = 0; cell < size; ++cell) {
    open[cell] = field.traversable(cell) ? 1 : 0;
    any_reached = any_reached || (field.reachable(cell) && open[cell] != 0);
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
