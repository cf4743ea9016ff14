#include "vantage/planners/visibility/cell_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/gains/ascii_ray.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::FloatNear;

TEST(CellTables, HoldOneEntryPerCell) {
  const OccupancyGrid grid = row_of_cells(".?#");
  EXPECT_THAT(cell_states(grid),
              ElementsAre(CellState::free, CellState::unobserved, CellState::occupied));
  EXPECT_THAT(cell_probabilities(grid),
              ElementsAre(FloatNear(0.02F, 1e-6F), 0.5F, FloatNear(1.0F, 2e-6F)));
  const auto h_free = static_cast<float>(binary_entropy_bits(kFreeCell));
  EXPECT_THAT(cell_entropies_bits(grid),
              ElementsAre(FloatNear(h_free, 1e-5F), 1.0F, FloatNear(0.0F, 1e-4F)));
}

TEST(CellTables, EntropyOfUnobservedCellsLeavesKnownOnesOut) {
  OccupancyGrid row = row_of_cells(".?#?");
  row.log_odds[3] = static_cast<float>(log_odds_of(0.41));
  const auto h_little_evidence = static_cast<float>(binary_entropy_bits(0.41));
  EXPECT_THAT(unobserved_entropies_bits(row),
              ElementsAre(0.0F, 1.0F, 0.0F, FloatNear(h_little_evidence, 1e-5F)));
}

TEST(CellTables, TransmissionOfUnobservedCellsGoesByTheirBlock) {
  GridFrame frame;
  frame.cells = {2, 1, 2};
  OccupancyGrid grid(frame);
  grid.log_odds[1] = -3.0F;
  grid.log_odds[2] = 3.0F;
  const BlockField slices{.layout = {.cells = frame.cells, .blocks = {1, 1, 2}},
                          .per_block = {0.75, 0.5}};
  EXPECT_THAT(cell_transmissions(grid, slices), ElementsAre(0.75F, 1.0F, 0.0F, 0.5F));
}

// A free cell of odds 0.02 / 0.98 from even ones is one of odds 0.02 / 0.98 / 3 from 1 / 3.
TEST(CellOpacities, TakeTheEvidenceOfFreeCellsFromAnotherPrior) {
  const auto p_free_cell = static_cast<float>(0.02 / (0.02 + 3.0 * 0.98));
  EXPECT_THAT(cell_opacities(row_of_cells(".?#"), 0.25),
              ElementsAre(FloatNear(p_free_cell, 1e-6F), 0.25F, FloatNear(1.0F, 2e-6F)));
  EXPECT_THAT(cell_opacities(row_of_cells(".?#"), 0.5),
              ElementsAre(FloatNear(0.02F, 1e-6F), 0.5F, FloatNear(1.0F, 2e-6F)));
  EXPECT_THAT(cell_opacities(row_of_cells(".?"), 0.0), ElementsAre(0.0F, 0.0F));
}

TEST(BeamTransmissions, EndABeamInOccupiedCells) {
  EXPECT_THAT(beam_transmissions(row_of_cells("?#"), 0.25), ElementsAre(0.75F, 0.0F));
}

TEST(CellTablesDeathTest, WantsTransmissionsForTheGrid) {
  EXPECT_DEATH(cell_transmissions(row_of_cells("??"), uniform_field({3, 1, 1}, 1.0)),
               "transmissions for a grid of this size");
}

}  // namespace
}  // namespace vantage
