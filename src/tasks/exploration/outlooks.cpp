#include "vantage/tasks/exploration/outlooks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "vantage/planners/navigation/distance_field.hpp"
#include "vantage/planners/travel/cost_queue.hpp"

namespace vantage {
namespace {

constexpr float kNoWay = std::numeric_limits<float>::infinity();

/// Where the middle of the robot might be, for all that the planar scanner knows.
std::vector<std::uint8_t> might_pass(const PathField& paths) {
  FloorMap scanned = paths.map;
  std::ranges::fill(scanned.blocked, std::uint8_t{0});
  std::vector<std::uint8_t> met(scanned.size());
  for (std::size_t cell = 0; cell < met.size(); ++cell) {
    met[cell] = scanned.state(cell) == CellState::occupied ? 1 : 0;
  }
  const auto squared = squared_distances_cells(met, scanned.nx, scanned.ny);
  const double radius_m = paths.space == nullptr ? paths.options.inflation_m()
                                                 : inscribed_radius_m(paths.space->robot().outline);
  const double clear = std::max(radius_m / scanned.cell_m - std::numbers::sqrt2 / 2.0, 0.0);
  std::vector<std::uint8_t> passable(scanned.size());
  for (std::size_t cell = 0; cell < passable.size(); ++cell) {
    const bool open = scanned.state(cell) == CellState::free && squared[cell] > clear * clear;
    passable[cell] = open || paths.reachable(cell) ? 1 : 0;
  }
  return passable;
}

}  // namespace

Outlooks::Outlooks(const PathField& paths)
    : map_(paths.map), way_m_(paths.map.size(), kNoWay), from_(paths.map.size(), 0) {
  for (std::size_t cell = 0; cell < way_m_.size(); ++cell) {
    if (!paths.reachable(cell)) continue;
    way_m_[cell] = 0.0F;
    from_[cell] = static_cast<std::uint32_t>(cell);
  }
  find_ways(might_pass(paths));
}

void Outlooks::find_ways(const std::vector<std::uint8_t>& passable) {
  constexpr std::array<std::pair<int, int>, 8> kSteps{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  CostQueue queue(map_.cell_m);
  for (std::size_t cell = 0; cell < way_m_.size(); ++cell) {
    if (way_m_[cell] == 0.0F) queue.push(0.0F, static_cast<std::uint32_t>(cell));
  }
  while (const auto next = queue.pop()) {
    const auto [way_m, cell] = *next;
    if (way_m > way_m_[cell]) continue;
    const Eigen::Array2i at = map_.cell(cell);
    for (const auto& [dx, dy] : kSteps) {
      const Eigen::Array2i to = at + Eigen::Array2i(dx, dy);
      if (!map_.contains(to) || passable[map_.index(to)] == 0) continue;
      const auto next_cell = static_cast<std::uint32_t>(map_.index(to));
      const double cells = dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0;
      const float through_m = way_m + static_cast<float>(map_.cell_m * cells);
      if (through_m >= way_m_[next_cell]) continue;
      way_m_[next_cell] = through_m;
      from_[next_cell] = from_[cell];
      queue.push(through_m, next_cell);
    }
  }
}

std::optional<std::size_t> Outlooks::towards(const Eigen::Vector2d& p_m) const {
  std::optional<std::size_t> from;
  std::tuple<double, float, std::size_t> best(kInfinity, kNoWay, 0);  // squared distance, way, cell
  const auto look_in_row = [&](int y) {
    if (y < 0 || y >= map_.ny) return;
    for (int x = 0; x < map_.nx; ++x) {
      const std::size_t cell = map_.index({x, y});
      if (way_m_[cell] == kNoWay) continue;
      const std::tuple rank((map_.centre({x, y}) - p_m).squaredNorm(), way_m_[cell], cell);
      if (rank >= best) continue;
      best = rank;
      from = from_[cell];
    }
  };
  const int row = std::clamp(map_.cell_at(p_m).y(), 0, map_.ny - 1);
  for (int off = 0; off < map_.ny; ++off) {
    const double nearest_m = (off - 1) * map_.cell_m;  // no centre there is nearer
    if (off > 0 && nearest_m * nearest_m > std::get<0>(best)) break;
    look_in_row(row - off);
    if (off > 0) look_in_row(row + off);
  }
  return from;
}

}  // namespace vantage
