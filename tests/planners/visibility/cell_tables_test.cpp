#include "vantage/planners/visibility/cell_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/gains/ascii_ray.hpp"
#include "vantage/information/discrete.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"
#include "vantage/planners/visibility/entropy_beam.hpp"

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

/// A free cell, two unobserved ones, of which little is known of the second, and an occupied one.
TEST(Attenuation, IsOfUnobservedCellsAloneByTheirEntropyIfAskedFor) {
  OccupancyGrid row = row_of_cells(".??#");
  row.log_odds[2] = static_cast<float>(log_odds_of(0.41));
  Attenuation attenuation{.transmission = uniform_field(row.frame.cells, 0.75), .utility = 3.0};
  const auto h_little_evidence = static_cast<float>(3.0 * binary_entropy_bits(0.41));
  const CellTables tables = attenuation_tables(row, attenuation);
  EXPECT_THAT(tables.utility, ElementsAre(0.0F, 3.0F, FloatNear(h_little_evidence, 1e-5F), 0.0F));
  EXPECT_THAT(tables.transmission, ElementsAre(1.0F, 0.75F, 0.75F, 0.0F));
  EXPECT_EQ(tables.state, cell_states(row));
  attenuation.by_entropy = false;
  EXPECT_THAT(attenuation_tables(row, attenuation).utility, ElementsAre(0.0F, 3.0F, 3.0F, 0.0F));
}

/// Each twice, the second time as if it were the first.
TEST(Rays, AreWeakenedByTheCellsTheyPassAndEndInAnOpaqueOne) {
  CellTables tables;
  tables.transmission = {0.5F, 0.25F, 0.0F, 1.0F};
  tables.utility = {1.0F, 3.0F, 8.0F, 5.0F};
  tables.entropy_bits = {0.5F, 1.0F, 0.75F, 0.25F};
  AttenuatedRay ray(tables);
  EntropyBeam beam(tables);
  for (int turn = 0; turn < 2; ++turn) {
    ray.start();
    EXPECT_EQ(ray.utility(0), 1.0);
    EXPECT_TRUE(ray.pass(0));
    EXPECT_EQ(ray.utility(1), 0.5 * 3.0);
    EXPECT_TRUE(ray.pass(1));
    EXPECT_EQ(ray.utility(2), 0.125 * 8.0);
    EXPECT_FALSE(ray.pass(2));
    EXPECT_EQ(ray.utility(3), 0.0);
    beam.start();
    EXPECT_EQ(beam.total(), 0.0);
    EXPECT_TRUE(beam.enter(0));
    EXPECT_EQ(beam.total(), 0.5);
    EXPECT_TRUE(beam.enter(1));
    EXPECT_EQ(beam.total(), 0.5 + 0.5 * 1.0);
    EXPECT_FALSE(beam.enter(2));
    EXPECT_EQ(beam.total(), 0.5 + 0.5 * 1.0 + 0.125 * 0.75);
  }
}

}  // namespace
}  // namespace vantage
