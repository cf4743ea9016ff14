#pragma once

#include <cstddef>
#include <string_view>

#include "vantage/information/discrete.hpp"
#include "vantage/planners/visibility/cell_tables.hpp"
#include "vantage/planners/visibility/ray_visibility.hpp"

namespace vantage {

/// The chain forgets the free space in front of it within some ten unobserved cells, so it values
/// little more than the rim of the unknown.  [Potthast2016, (3.11)-(3.15)]
struct PosteriorChainGain {
  static constexpr std::string_view name = "posterior_chain";
  static constexpr StrategyText text{
      .summary =
          "Expected loss of entropy of every cell in view, known ones included, by the "
          "dissertation's chain to the letter. For the record: it values little more than the rim "
          "of the unknown; `visibility_weighted` predicts better.",
      .formula = "sum of H(o) - H(o') over cells in view, o' the posterior of the chain",
      .source = "Potthast2016, (3.11)-(3.15)"};
  static constexpr bool unobserved_only = false;
  static constexpr bool predicts_cells = true;
  PosteriorModel model;
  void fields(auto&& f) { model.fields(f); }
  [[nodiscard]] double transmission_unobserved() const { return model.visibility.a; }

  class Ray {
   public:
    Ray(const PosteriorModel& model, const CellTables& tables)
        : model_(model),
          p_occupied_(tables.p_occupied.data()),
          entropy_bits_(tables.entropy_bits.data()),
          chain_(model) {}
    void start() { chain_ = PosteriorChain(model_); }
    bool pass(std::size_t cell) {
      chain_.enter(static_cast<double>(p_occupied_[cell]));
      return true;
    }
    double utility(std::size_t cell) {
      chain_.enter(static_cast<double>(p_occupied_[cell]));
      return static_cast<double>(entropy_bits_[cell]) - binary_entropy_bits(chain_.p_occupied());
    }

   private:
    PosteriorModel model_;
    const float* p_occupied_;
    const float* entropy_bits_;
    PosteriorChain chain_;
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.p_occupied = cell_probabilities(context.grid);
    tables.entropy_bits = cell_entropies_bits(context.grid);
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return {model, tables}; }
};

}  // namespace vantage
