#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/planners/visibility/beam_gain.hpp"

namespace vantage {

struct RearSideVoxelGain {
  static constexpr std::string_view name = "rear_side_voxel";
  static constexpr StrategyText text{
      .summary =
          "Number of beams that meet the unseen side of a known surface: an occupied cell directly "
          "behind an unobserved one. For completing objects that were seen from the front.",
      .formula =
          "number of beams whose first occupied cell comes directly behind an unobserved cell",
      .source = "Isler2016"};
  static constexpr std::string_view unit = "beams";
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  void fields(auto&& f) { fan.fields(f); }

  class Beam {
   public:
    explicit Beam(const CellTables& tables) : state_(tables.state.data()) {}
    void start() {
      before_ = CellState::free;
      rear_sides_ = 0.0;
    }
    bool enter(std::size_t cell) {
      const CellState here = state_[cell];
      if (here == CellState::occupied && before_ == CellState::unobserved) rear_sides_ = 1.0;
      before_ = here;
      return here != CellState::occupied;
    }
    [[nodiscard]] double total() const { return rear_sides_; }

   private:
    const CellState* state_;
    CellState before_ = CellState::free;
    double rear_sides_ = 0.0;
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    return tables;
  }
  [[nodiscard]] Beam beam(const CellTables& tables) const { return Beam(tables); }
};

}  // namespace vantage
