#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/planners/visibility/cell_tables.hpp"
#include "vantage/planners/visibility/ray_visibility.hpp"

namespace vantage {

struct VisibilityWeightedGain {
  static constexpr std::string_view name = "visibility_weighted";
  static constexpr StrategyText text{
      .summary =
          "Entropy of the unobserved cells in view, each weighted by the probability that it is "
          "visible: the dissertation's gain. Its `a` has to suit the clutter.",
      .formula =
          "sum of p(x) H(o) over unobserved cells in view, p(x) the probability of being visible",
      .source = "Potthast2016, 3.1.1"};
  static constexpr bool unobserved_only = true;
  static constexpr bool predicts_cells = true;
  VisibilityModel model;
  void fields(auto&& f) { model.fields(f); }
  [[nodiscard]] double transmission_unobserved() const { return model.a; }

  class Ray {
   public:
    Ray(const VisibilityModel& model, const CellTables& tables)
        : model_(model),
          p_occupied_(tables.p_occupied.data()),
          entropy_bits_(tables.entropy_bits.data()),
          chain_(model) {}
    void start() { chain_ = VisibilityChain(model_); }
    bool pass(std::size_t cell) {
      chain_.pass(static_cast<double>(p_occupied_[cell]));
      return true;
    }
    [[nodiscard]] double utility(std::size_t cell) const {
      return chain_.p_visible() * static_cast<double>(entropy_bits_[cell]);
    }

   private:
    VisibilityModel model_;
    const float* p_occupied_;
    const float* entropy_bits_;
    VisibilityChain chain_;
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    tables.p_occupied = cell_probabilities(context.grid);
    tables.entropy_bits = unobserved_entropies_bits(context.grid);
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return {model, tables}; }
};

}  // namespace vantage
