#pragma once

#include <cstddef>
#include <string_view>

#include "planners/cell_tables.hpp"

namespace vantage {

/// Every unobserved cell that no known occupied cell hides counts one bit: unobserved space is
/// taken to be empty.
struct SimpleGain {
  static constexpr std::string_view name = "simple";
  static constexpr bool unobserved_only = true;
  static constexpr bool predicts_cells = true;
  void fields(auto&&) {}

  class Ray {
   public:
    explicit Ray(const CellTables& tables) : state_(tables.state.data()) {}
    void start() {}
    [[nodiscard]] bool pass(std::size_t cell) const { return state_[cell] != CellState::occupied; }
    [[nodiscard]] double worth(std::size_t /*cell*/) const { return 1.0; }

   private:
    const CellState* state_;
  };

  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.state = cell_states(context.grid);
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
};

}  // namespace vantage
