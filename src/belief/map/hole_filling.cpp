#include "vantage/belief/map/hole_filling.hpp"

#include <cstdint>
#include <set>
#include <utility>

namespace vantage {
namespace {

/// What the energy is made of; whole numbers, so that keeping count of changes is exact.
struct EnergySums {
  std::int64_t pairs = 0;      ///< sum over s and z in N(s) of s z
  std::int64_t agreement = 0;  ///< sum of s o

  [[nodiscard]] double energy(const HoleFilling& options) const {
    return -options.smoothness_weight * static_cast<double>(pairs) -
           options.data_weight * static_cast<double>(agreement);
  }
};

/// Hidden and observed nodes with a border of empty ones, so that every node has six neighbours.
/// 0: no node (free, or outside the grid).
class Field {
 public:
  explicit Field(const OccupancyGrid& grid)
      : cells_(grid.frame.cells),
        stride_y_(cells_.x() + 2),
        stride_z_(static_cast<std::ptrdiff_t>(stride_y_) * (cells_.y() + 2)),
        observed_(static_cast<std::size_t>(stride_z_ * (cells_.z() + 2)), 0) {
    for_each_cell([&](std::size_t cell, std::size_t node) {
      const CellState state = grid.state(cell);
      if (state == CellState::free) return;
      observed_[node] = state == CellState::occupied ? 1 : -1;
    });
    hidden_ = observed_;
    for_each_cell([&](std::size_t, std::size_t node) {
      sums_.pairs += hidden_[node] * neighbour_sum(node);
      sums_.agreement += hidden_[node] * observed_[node];
    });
  }

  /// Calls visit(cell of the grid, node) in index order.
  void for_each_cell(auto&& visit) const {
    std::size_t cell = 0;
    for (int z = 0; z < cells_.z(); ++z) {
      for (int y = 0; y < cells_.y(); ++y) {
        auto node = static_cast<std::size_t>((z + 1) * stride_z_ + (y + 1) * stride_y_ + 1);
        for (int x = 0; x < cells_.x(); ++x) visit(cell++, node++);
      }
    }
  }

  [[nodiscard]] bool filled(std::size_t node) const {
    return hidden_[node] == 1 && observed_[node] == -1;
  }
  [[nodiscard]] double energy(const HoleFilling& options) const { return sums_.energy(options); }

  /// One pass of iterated conditional modes; false if nothing changed.
  bool pass(const HoleFilling& options) {
    next_.clear();
    if (is_first_) {
      for_each_cell([&](std::size_t, std::size_t node) { settle(node, options); });
    } else {
      settle_waiting(options);
    }
    is_first_ = false;
    std::swap(waiting_, next_);
    return !waiting_.empty();
  }

 private:
  [[nodiscard]] int neighbour_sum(std::size_t node) const {
    const std::int8_t* s = hidden_.data() + node;
    return s[-1] + s[1] + s[-stride_y_] + s[stride_y_] + s[-stride_z_] + s[stride_z_];
  }

  /// Later passes: a node none of whose neighbours changed since its turn would stay as it is, so
  /// that only neighbours of what changed get another, in index order.
  void settle_waiting(const HoleFilling& options) {
    std::set<std::size_t> turns(waiting_.begin(), waiting_.end());
    while (!turns.empty()) {
      const std::size_t node = *turns.begin();
      turns.erase(turns.begin());
      if (!settle(node, options)) continue;
      for_each_neighbour(node, [&](std::size_t other) {
        if (other > node) turns.insert(other);
      });
    }
  }

  void for_each_neighbour(std::size_t node, auto&& visit) const {
    for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, stride_y_, stride_z_}) {
      visit(node - static_cast<std::size_t>(step));
      visit(node + static_cast<std::size_t>(step));
    }
  }

  /// The node's turn; true if it flipped.
  bool settle(std::size_t node, const HoleFilling& options) {
    if (observed_[node] != -1) return false;
    // The terms of E that hold s are -s * pull: each neighbour appears as s z and as z s.
    const int sum = neighbour_sum(node);
    const double pull = 2.0 * options.smoothness_weight * sum + options.data_weight * -1.0;
    if (pull * hidden_[node] >= 0.0) return false;
    sums_.pairs -= 4 * hidden_[node] * sum;
    sums_.agreement += 2 * hidden_[node];
    hidden_[node] = static_cast<std::int8_t>(-hidden_[node]);
    for_each_neighbour(node, [&](std::size_t other) { next_.push_back(other); });
    return true;
  }

  Eigen::Array3i cells_;
  std::ptrdiff_t stride_y_;
  std::ptrdiff_t stride_z_;
  std::vector<std::int8_t> observed_;
  std::vector<std::int8_t> hidden_;
  EnergySums sums_;
  bool is_first_ = true;
  std::vector<std::size_t> waiting_;  ///< neighbours of what changed in the last pass
  std::vector<std::size_t> next_;
};

}  // namespace

FilledGrid fill_holes(const OccupancyGrid& grid, const HoleFilling& options) {
  check_options(options, "hole filling");
  Field field(grid);
  FilledGrid result{.grid = grid, .energy = {field.energy(options)}};
  while (!result.converged && result.passes < options.max_passes) {
    result.converged = !field.pass(options);
    ++result.passes;
    result.energy.push_back(field.energy(options));
  }
  const auto filled_log_odds = static_cast<float>(log_odds_of(options.p_occupied_filled));
  field.for_each_cell([&](std::size_t cell, std::size_t node) {
    if (!field.filled(node)) return;
    result.grid.log_odds[cell] = filled_log_odds;
    ++result.filled_cells;
  });
  return result;
}

}  // namespace vantage
