#include "vantage/belief/map/block_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace vantage {
namespace {

using ::testing::ElementsAre;

TEST(BlockLayout, DividesCellsEvenly) {
  const BlockLayout layout{.cells = {10, 7, 2}, .blocks = {5, 3, 4}};
  EXPECT_EQ(layout.block_of(0, 0), 0);
  EXPECT_EQ(layout.block_of(0, 9), 4);
  EXPECT_EQ(layout.block_of(1, 2), 0);
  EXPECT_EQ(layout.block_of(1, 3), 1);
  EXPECT_EQ(layout.block_of(2, 1), 2) << "more blocks than cells: some are empty";
  const BlockLayout fine{.cells = {65536, 1, 1}, .blocks = {65536, 1, 1}};
  EXPECT_EQ(fine.block_of(0, 65535), 65535) << "whose product is beyond an int";
  std::set<std::size_t> seen;
  for (int z = 0; z < 4; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 5; ++x) seen.insert(layout.index(x, y, z));
    }
  }
  EXPECT_EQ(seen.size(), layout.size());
  EXPECT_EQ(*seen.rbegin(), layout.size() - 1);
}

TEST(BlockField, OfOneNumberIsThatEverywhere) {
  const BlockField field = uniform_field({3, 4, 5}, 0.7);
  EXPECT_EQ(field.at_cell({0, 0, 0}), 0.7);
  EXPECT_EQ(field.at_cell({2, 3, 4}), 0.7);
}

TEST(GatherNeighbours, SpreadsANumberOverItsLayer) {
  BlockField field{.layout = {.cells = {5, 3, 2}, .blocks = {5, 3, 2}}, .per_block = {}};
  field.per_block.assign(field.layout.size(), 0.0);
  field.per_block[field.layout.index(1, 1, 0)] = 2.0;
  const BlockField spread = gather_neighbours(field, {1.0, 0.5});
  const auto at = [&](int x, int y, int z) {
    return spread.per_block[field.layout.index(x, y, z)];
  };
  EXPECT_DOUBLE_EQ(at(1, 1, 0), 2.0);
  EXPECT_DOUBLE_EQ(at(2, 1, 0), 2.0 * std::exp(-0.5));
  EXPECT_DOUBLE_EQ(at(4, 1, 0), 2.0 * std::exp(-4.5));
  EXPECT_DOUBLE_EQ(at(1, 2, 0), 2.0 * std::exp(-2.0));
  EXPECT_DOUBLE_EQ(at(0, 0, 0), 2.0 * std::exp(-0.5) * std::exp(-2.0));
  EXPECT_EQ(at(1, 1, 1), 0.0);
}

TEST(GatherNeighbours, WithinNoReachIsTheFieldItself) {
  const BlockField field{.layout = {.cells = {4, 1, 1}, .blocks = {2, 1, 1}},
                         .per_block = {3.0, 5.0}};
  EXPECT_THAT(gather_neighbours(field, {0.0, 0.0}).per_block, ElementsAre(3.0, 5.0));
}

TEST(BlockField, GivesACellTheNumberOfItsBlock) {
  BlockField field{.layout = {.cells = {10, 7, 4}, .blocks = {5, 3, 2}}, .per_block = {}};
  for (int block = 0; block < 30; ++block) field.per_block.push_back(block);
  EXPECT_EQ(field.at_cell({9, 2, 1}), 4.0) << "block 4, 0, 0";
  EXPECT_EQ(field.at_cell({4, 5, 2}), 27.0) << "block 2, 2, 1";
  EXPECT_EQ(field.at_cell({5, 3, 3}), 22.0) << "block 2, 1, 1";
}

TEST(GatherNeighbours, ReachesThreeSigmaRoundedUp) {
  BlockField field{.layout = {.cells = {6, 4, 1}, .blocks = {6, 4, 1}}, .per_block = {}};
  field.per_block.assign(field.layout.size(), 0.0);
  field.per_block[0] = 1.0;
  const BlockField spread = gather_neighbours(field, {1.0, 0.5});
  EXPECT_DOUBLE_EQ(spread.per_block[3], std::exp(-4.5));
  EXPECT_EQ(spread.per_block[4], 0.0);
  EXPECT_DOUBLE_EQ(spread.per_block[2 * 6], std::exp(-8.0));
  EXPECT_EQ(spread.per_block[3 * 6], 0.0);
}

}  // namespace
}  // namespace vantage
