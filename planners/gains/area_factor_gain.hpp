#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/planners/visibility/beam_gain.hpp"

namespace vantage {

/// 0 at shares 0 and 1, 1 at `target`, smooth between:
/// -2 (x/a)^3 + 3 (x/a)^2 up to a, then (-2x^3 + 3(a+1)x^2 - 6ax + 3a - 1) / (a-1)^3.
/// [VasquezGomez2014]
constexpr double area_factor(double share, double target) {
  const double x = share;
  const double a = target;
  if (x <= a) return (3.0 - 2.0 * x / a) * x * x / (a * a);
  const double left = a - 1.0;
  return (((-2.0 * x + 3.0 * (a + 1.0)) * x - 6.0 * a) * x + 3.0 * a - 1.0) / (left * left * left);
}

/// The source calls unobserved cells behind a seen surface occluded, and their border to free space
/// the occlusion plane. The map does not tell them from cells that no view covered yet: here every
/// unobserved cell behind a free one is of that plane. Unobserved cells in front of the first known
/// one are passed: a sensor outside of the map looks through them.  [VasquezGomez2014]
struct AreaFactorGain {
  static constexpr std::string_view name = "area_factor";
  static constexpr StrategyText text{
      .summary =
          "Favours views of which a given share of the beams ends at known surfaces, for overlap "
          "with what was seen, and a given share where free space ends in the unknown.",
      .formula =
          "f(x_occupied; target_occupied) + f(x_occplane; target_occplane), x a share of the beams "
          "by the first cell that is not free, f(x; a) = -2x^3/a^3 + 3x^2/a^2 for x <= a, else "
          "(-2x^3 + 3(a+1)x^2 - 6ax + 3a - 1)/(a-1)^3",
      .source = "VasquezGomez2014"};
  static constexpr std::string_view unit = "of 2";
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  double target_occupied = 0.2;
  double target_occplane = 0.8;
  void fields(auto&& f) {
    fan.fields(f);
    f("target_occupied", target_occupied,
      "best share of beams that end at a known surface; higher wants more overlap",
      between(0.01, 0.99));
    f("target_occplane", target_occplane,
      "best share of beams that go from free space into the unknown; higher wants more that is new",
      between(0.01, 0.99));
  }

  class Beam {
   public:
    explicit Beam(const CellTables& tables) : state_(tables.state.data()) {}
    void start() {
      free_before_ = false;
      end_ = CellState::free;
    }
    bool enter(std::size_t cell) {
      const CellState here = state_[cell];
      if (here == CellState::free) free_before_ = true;
      if (here == CellState::free || (here == CellState::unobserved && !free_before_)) return true;
      end_ = here;
      return false;
    }
    [[nodiscard]] CellState end() const { return end_; }

   private:
    const CellState* state_;
    bool free_before_ = false;
    CellState end_ = CellState::free;
  };

  struct View {
    double target_occupied;
    double target_occplane;
    double beams = 0.0;
    double occupied = 0.0;
    double occplane = 0.0;
    void add(const Beam& beam) {
      beams += 1.0;
      if (beam.end() == CellState::occupied) occupied += 1.0;
      if (beam.end() == CellState::unobserved) occplane += 1.0;
    }
    [[nodiscard]] double total() const {
      return area_factor(occupied / beams, target_occupied) +
             area_factor(occplane / beams, target_occplane);
    }
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    return tables;
  }
  [[nodiscard]] Beam beam(const CellTables& tables) const { return Beam(tables); }
  [[nodiscard]] View view() const { return {target_occupied, target_occplane}; }
};

}  // namespace vantage
