#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "vantage/planners/visibility/beam_gain.hpp"

namespace vantage {

/// What an update of a cell's odds from r to d r teaches, KL(updated || before) in bits:
/// f(d, r) = log2((r + 1) / (r + 1 / d)) - log2(d) / (r d + 1); r may be infinite.  [Zhang2020]
double odds_update_bits(double d, double odds);

/// The sum is over the cells j that a beam may be the first to hit; one that hits nothing teaches
/// nothing.  [Zhang2020]
///
/// The defaults of d_occ and d_emp are those of InverseSensorModel and FreeSpaceUpdate. With
/// opacity_unobserved at 0.5 the gain is that of the source.
struct FsmiGain {
  static constexpr std::string_view name = "fsmi";
  static constexpr StrategyText text{
      .summary =
          "Shannon mutual information between the map and the ranges of a fan of noise-free beams. "
          "Ranks views, predicts no number of cells.",
      .formula =
          "sum over beams of sum_j P(e_j) C_j, P(e_j) = o_j prod_{l<j} (1 - o_l), C_j = f(d_occ, "
          "r_j) + sum_{i<j} f(d_emp, r_i), r = o / (1 - o), f(d, r) = log2((r + 1) / (r + 1/d)) - "
          "log2(d) / (r d + 1)",
      .source = "Zhang2020"};
  static constexpr bool predicts_cells = false;
  BeamFan fan = {};
  double opacity_unobserved = kOpacityUnobserved;
  double d_occ = 0.8 / 0.2;
  double d_emp = 0.3 / 0.7;
  void fields(auto&& f) {
    fan.fields(f);
    f("opacity_unobserved", opacity_unobserved,
      "share of a beam that an unobserved cell stops; higher sees less deep", between(0.0, 0.5));
    f("d_occ", d_occ,
      "factor by which a hit multiplies a cell's odds of being occupied; higher values surfaces "
      "more",
      at_least(1.0));
    f("d_emp", d_emp,
      "factor by which a pass multiplies a cell's odds of being occupied; lower values free space "
      "more",
      Range{0.0, 1.0, true});
  }
  [[nodiscard]] double transmission_unobserved() const { return 1.0 - opacity_unobserved; }

  struct Cell {
    float p_hit = 0.0F;      ///< o_j
    float hit_bits = 0.0F;   ///< f(d_occ, r_j)
    float pass_bits = 0.0F;  ///< f(d_emp, r_j)
  };
  using Tables = std::vector<Cell>;

  class Beam {
   public:
    explicit Beam(const Tables& tables) : cells_(tables.data()) {}
    void start() {
      p_visible_ = 1.0;
      passed_bits_ = 0.0;
      sum_bits_ = 0.0;
    }
    bool enter(std::size_t index) {
      constexpr double kNegligible = 1e-9;
      const Cell& cell = cells_[index];
      const auto p_hit = static_cast<double>(cell.p_hit);
      sum_bits_ += p_visible_ * p_hit * (static_cast<double>(cell.hit_bits) + passed_bits_);
      p_visible_ *= 1.0 - p_hit;
      passed_bits_ += static_cast<double>(cell.pass_bits);
      return p_visible_ > kNegligible;
    }
    [[nodiscard]] double total() const { return sum_bits_; }

   private:
    const Cell* cells_;
    double p_visible_ = 1.0;
    double passed_bits_ = 0.0;
    double sum_bits_ = 0.0;
  };

  [[nodiscard]] Tables prepare(const GainContext& context) const;
  [[nodiscard]] Beam beam(const Tables& tables) const { return Beam(tables); }
};

}  // namespace vantage
