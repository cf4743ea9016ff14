#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/planners/visibility/beam_gain.hpp"

namespace vantage {

/// No beam is weighted by what it may not reach. A view without a beam that ends occupied is worth
/// nothing.  [Delmerico2018]
struct AverageEntropyGain {
  static constexpr std::string_view name = "average_entropy";
  static constexpr StrategyText text{
      .summary =
          "Mean entropy of the cells on the beams that end at a known surface: how uncertain a "
          "view's way to the object is, however much of it there is.",
      .formula =
          "sum of H(o) over number of cells, both over the beams that meet an occupied cell, each "
          "up to and with the first",
      .source = "Delmerico2018"};
  static constexpr std::string_view unit = "bits per cell";
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  void fields(auto&& f) { fan.fields(f); }

  class Beam {
   public:
    explicit Beam(const CellTables& tables)
        : state_(tables.state.data()), entropy_bits_(tables.entropy_bits.data()) {}
    void start() {
      bits_ = 0.0;
      cells_ = 0.0;
      ends_occupied_ = false;
    }
    bool enter(std::size_t cell) {
      bits_ += static_cast<double>(entropy_bits_[cell]);
      cells_ += 1.0;
      ends_occupied_ = state_[cell] == CellState::occupied;
      return !ends_occupied_;
    }

   private:
    friend struct AverageEntropyGain;
    const CellState* state_;
    const float* entropy_bits_;
    double bits_ = 0.0;
    double cells_ = 0.0;
    bool ends_occupied_ = false;
  };

  struct View {
    double bits = 0.0;
    double cells = 0.0;
    void add(const Beam& beam) {
      if (!beam.ends_occupied_) return;
      bits += beam.bits_;
      cells += beam.cells_;
    }
    [[nodiscard]] double total() const { return cells > 0.0 ? bits / cells : 0.0; }
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    tables.entropy_bits = cell_entropies_bits(context.grid);
    return tables;
  }
  [[nodiscard]] Beam beam(const CellTables& tables) const { return Beam(tables); }
  [[nodiscard]] View view() const { return {}; }
};

}  // namespace vantage
