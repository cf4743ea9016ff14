#include "src/belief/hole_filling.hpp"

#include <array>
#include <cstdint>

namespace vantage {
namespace {

/// Hidden and observed nodes with a border of empty ones, so that every node has six neighbours.
/// 0: no node (free, or outside the grid).
class Field {
 public:
  explicit Field(const OccupancyGrid& grid)
      : stride_y_(grid.frame.cells.x() + 2),
        stride_z_(static_cast<std::ptrdiff_t>(stride_y_) * (grid.frame.cells.y() + 2)),
        observed_(static_cast<std::size_t>(stride_z_ * (grid.frame.cells.z() + 2)), 0) {
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const CellState state = grid.state(cell);
      if (state == CellState::free) continue;
      observed_[node_of(grid.frame.cell(cell))] = state == CellState::occupied ? 1 : -1;
    }
    hidden_ = observed_;
    for (std::size_t node = 0; node < observed_.size(); ++node) {
      if (observed_[node] == -1) may_flip_.push_back(node);
    }
  }

  [[nodiscard]] std::size_t node_of(const Eigen::Array3i& cell) const {
    return static_cast<std::size_t>((cell.z() + 1) * stride_z_ + (cell.y() + 1) * stride_y_ +
                                    cell.x() + 1);
  }
  [[nodiscard]] bool filled(std::size_t node) const {
    return hidden_[node] == 1 && observed_[node] == -1;
  }

  [[nodiscard]] double energy(const HoleFilling& options) const {
    std::int64_t pairs = 0;
    std::int64_t agreement = 0;
    for (std::size_t node = 0; node < hidden_.size(); ++node) {
      if (hidden_[node] == 0) continue;
      pairs += hidden_[node] * neighbour_sum(node);
      agreement += hidden_[node] * observed_[node];
    }
    return -options.smoothness_weight * static_cast<double>(pairs) -
           options.data_weight * static_cast<double>(agreement);
  }

  /// One pass of iterated conditional modes; false if nothing changed.
  bool pass(const HoleFilling& options) {
    bool changed = false;
    for (const std::size_t node : may_flip_) {
      // The terms of E that hold s are -s * pull: each neighbour appears as s z and as z s.
      const double pull = 2.0 * options.smoothness_weight * neighbour_sum(node) +
                          options.data_weight * observed_[node];
      if (pull * hidden_[node] >= 0.0) continue;
      hidden_[node] = static_cast<std::int8_t>(-hidden_[node]);
      changed = true;
    }
    return changed;
  }

 private:
  [[nodiscard]] int neighbour_sum(std::size_t node) const {
    const std::int8_t* s = hidden_.data() + node;
    return s[-1] + s[1] + s[-stride_y_] + s[stride_y_] + s[-stride_z_] + s[stride_z_];
  }

  std::ptrdiff_t stride_y_;
  std::ptrdiff_t stride_z_;
  std::vector<std::int8_t> observed_;
  std::vector<std::int8_t> hidden_;
  std::vector<std::size_t> may_flip_;
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
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (!field.filled(field.node_of(grid.frame.cell(cell)))) continue;
    result.grid.log_odds[cell] = filled_log_odds;
    ++result.filled_cells;
  }
  return result;
}

}  // namespace vantage
