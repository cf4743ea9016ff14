#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/planners/visibility/beam_gain.hpp"
#include "vantage/planners/visibility/entropy_beam.hpp"

namespace vantage {

/// Per beam sum of V_i H(o_i) in bits over the unbroken run of unobserved cells that ends at its
/// first occupied cell; 0 without such a run. V_i as in `occlusion_aware`.  [Isler2016]
struct RearSideEntropyGain {
  static constexpr std::string_view name = "rear_side_entropy";
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  double opacity_unobserved = kOpacityUnobserved;
  void fields(auto&& f) {
    fan.fields(f);
    f("opacity_unobserved", opacity_unobserved, "of a cell, [0, 0.5]; higher sees less deep",
      between(0.0, 0.5));
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
