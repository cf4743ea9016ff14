#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "vantage/planners/visibility/beam_gain.hpp"

namespace vantage {

/// For each cell the least number of steps, over faces and through unobserved cells alone, from an
/// occupied cell to it; 0 in known cells and where it takes more than `max_steps`.
std::vector<int> steps_from_surface(const OccupancyGrid& grid, int max_steps);

/// The source keeps with each unobserved cell how many cells the beams of past scans would have
/// gone on from the surface that stopped them. Here d is taken from the map instead,
/// steps_from_surface(). A beam goes on over faces through unobserved cells as well, so d is at
/// most what past beams give, and the same where one went the shortest way. Two things differ:
/// cells beside a surface count like those behind it, and so do cells in front of it that no beam
/// passed. [Isler2016]
struct ProximityCountGain {
  static constexpr std::string_view name = "proximity_count";
  static constexpr StrategyText text{
      .summary =
          "Unobserved cells that the beams of a fan meet up to the first occupied one, each the "
          "more worth the nearer it lies behind a known surface. For completing objects; blind to "
          "space without surfaces.",
      .formula =
          "sum over beams of sum of (d_max - d) over unobserved cells with d < d_max, d the fewest "
          "steps through unobserved cells from an occupied one (of the source: along past beams)",
      .source = "Isler2016"};
  static constexpr std::string_view unit = "cells";
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  int d_max_cells = 10;
  void fields(auto&& f) {
    fan.fields(f);
    f("d_max_cells", d_max_cells,
      "distance behind a surface from which on unobserved cells are worth nothing; higher looks "
      "deeper into what surfaces hide",
      between(2, 1000));
  }
  /// Farther from a surface a cell is worth nothing.
  [[nodiscard]] int halo_cells() const { return d_max_cells - 1; }

  class Beam {
   public:
    explicit Beam(const CellTables& tables)
        : state_(tables.state.data()), utility_(tables.utility.data()) {}
    void start() { sum_ = 0.0; }
    bool enter(std::size_t cell) {
      sum_ += static_cast<double>(utility_[cell]);
      return state_[cell] != CellState::occupied;
    }
    [[nodiscard]] double total() const { return sum_; }

   private:
    const CellState* state_;
    const float* utility_;
    double sum_ = 0.0;
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const;
  [[nodiscard]] Beam beam(const CellTables& tables) const { return Beam(tables); }
};

}  // namespace vantage
