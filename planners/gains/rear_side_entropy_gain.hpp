#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/planners/visibility/beam_gain.hpp"
#include "vantage/planners/visibility/entropy_beam.hpp"

namespace vantage {

/// A beam without such a run is worth nothing.  [Isler2016]
struct RearSideEntropyGain {
  static constexpr std::string_view name = "rear_side_entropy";
  static constexpr StrategyText text{
      .summary =
          "Entropy of the unobserved cells directly in front of the unseen side of known surfaces, "
          "weighted as in `occlusion_aware`. For completing objects that were seen from the front.",
      .formula =
          "sum over beams of sum_i V_i H(o_i) over the unbroken run of unobserved cells that ends "
          "at the first occupied cell",
      .source = "Isler2016"};
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  double opacity_unobserved = kOpacityUnobserved;
  void fields(auto&& f) {
    fan.fields(f);
    f("opacity_unobserved", opacity_unobserved,
      "share of a beam that an unobserved cell stops; higher sees less deep", between(0.0, 0.5));
  }
  [[nodiscard]] double transmission_unobserved() const { return 1.0 - opacity_unobserved; }

  class Beam {
   public:
    explicit Beam(const CellTables& tables) : state_(tables.state.data()), entropy_(tables) {}
    void start() {
      entropy_.start();
      before_run_bits_ = 0.0;
      rear_side_bits_ = 0.0;
    }
    bool enter(std::size_t cell) {
      if (state_[cell] == CellState::occupied) {
        rear_side_bits_ = entropy_.total() - before_run_bits_;
        return false;
      }
      const bool visible = entropy_.enter(cell);
      if (state_[cell] == CellState::free) before_run_bits_ = entropy_.total();
      return visible;
    }
    [[nodiscard]] double total() const { return rear_side_bits_; }

   private:
    const CellState* state_;
    EntropyBeam entropy_;
    double before_run_bits_ = 0.0;
    double rear_side_bits_ = 0.0;
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    tables.entropy_bits = cell_entropies_bits(context.grid);
    tables.transmission = beam_transmissions(context.grid, opacity_unobserved);
    return tables;
  }
  [[nodiscard]] Beam beam(const CellTables& tables) const { return Beam(tables); }
};

}  // namespace vantage
