#include "vantage/planners/views/frontiers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/planners/navigation/ascii_floor.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// A single layer of 1 m cells, drawn as in ascii_floor.hpp; z in [0, 1].
OccupancyGrid layer_of(const Drawing& rows) {
  const FloorMap floor = floor_of(rows);
  GridFrame frame;
  frame.cells = {floor.nx, floor.ny, 1};
  OccupancyGrid grid(frame);
  grid.log_odds = floor.log_odds;
  return grid;
}

/// Nothing is dropped and nothing split, and the candidates lie in the layer.
FrontierOptions whole() { return {.min_cells = 1, .max_extent_m = 1e6, .height_m = 0.5}; }

std::vector<std::size_t> sizes(const std::vector<Frontier>& frontiers) {
  std::vector<std::size_t> counts(frontiers.size());
  std::ranges::transform(frontiers, counts.begin(),
                         [](const Frontier& frontier) { return frontier.cells.size(); });
  return counts;
}

TEST(FrontierCells, AreFreeCellsBesideUnobservedOnes) {
  EXPECT_THAT(frontier_cells(layer_of({"...??",  //
                                       "...#?"}),
                             whole()),
              ElementsAre(5U + 2U));
  EXPECT_THAT(frontier_cells(layer_of({"#?",  //
                                       ".#"}),
                             whole()),
              IsEmpty());
}

TEST(FindFrontiers, FindsNoneWhereAllIsKnownOrNothingIs) {
  EXPECT_THAT(find_frontiers(layer_of({"...#", "....", "##.."}), whole()), IsEmpty());
  EXPECT_THAT(find_frontiers(layer_of({"????", "????"}), whole()), IsEmpty());
}

TEST(FindFrontiers, ProposesTheCentroidOfEachDoorwayTheWidestFirst) {
  const auto frontiers = find_frontiers(layer_of({"??.......",  //
                                                  "##.......",  //
                                                  "#.......?",  //
                                                  "#.......?",  //
                                                  "#.......?",  //
                                                  "########?"}),
                                        whole());
  ASSERT_THAT(frontiers, SizeIs(2));
  // The right opening, three cells and the one above it that looks down into the unknown.
  EXPECT_THAT(sizes(frontiers), ElementsAre(4U, 1U));
  EXPECT_TRUE(frontiers[0].p_m.isApprox(Eigen::Vector3d(7.75, 3.0, 0.5)));
  EXPECT_TRUE(frontiers[1].p_m.isApprox(Eigen::Vector3d(2.5, 5.5, 0.5)));
}

TEST(FindFrontiers, JoinsCellsThatTouchByACorner) {
  EXPECT_THAT(sizes(find_frontiers(layer_of({"..#?",  //
                                             "...?",  //
                                             "##.#",  //
                                             "##?#"}),
                                   whole())),
              ElementsAre(2U));
}

TEST(FindFrontiers, KeepsApartWhatOneCellParts) {
  EXPECT_THAT(sizes(find_frontiers(layer_of({"#?.#.?",  //
                                             "####.?",  //
                                             "####.?"}),
                                   whole())),
              ElementsAre(3U, 1U));
  EXPECT_THAT(sizes(find_frontiers(layer_of({"?.#.?#",  //
                                             "?.####",  //
                                             "?.####"}),
                                   whole())),
              ElementsAre(3U, 1U));
}

// The frontier runs round an unknown block, its centroid lies inside.
TEST(FindFrontiers, MovesACandidateOutOfTheUnknown) {
  const OccupancyGrid grid = layer_of({".....",  //
                                       ".???.",  //
                                       ".???.",  //
                                       ".....",  //
                                       "....."});
  const auto frontiers = find_frontiers(grid, whole());
  ASSERT_THAT(frontiers, SizeIs(1));
  EXPECT_THAT(frontiers[0].cells, SizeIs(10));
  // Centroid (2.5, 3.0): the cells above and below it are nearest, the lower comes first.
  EXPECT_TRUE(frontiers[0].p_m.isApprox(Eigen::Vector3d(2.5, 1.5, 0.5)))
      << frontiers[0].p_m.transpose();
}

TEST(FindFrontiers, HalvesALongFrontierUntilEachPartIsShort) {
  FrontierOptions options = whole();
  options.max_extent_m = 4.0;
  const auto frontiers = find_frontiers(layer_of({"????????????",  //
                                                  "............",  //
                                                  "............"}),
                                        options);
  EXPECT_THAT(sizes(frontiers), ElementsAre(3U, 3U, 3U, 3U));
  for (std::size_t i = 0; i < frontiers.size(); ++i) {
    const double x_m = 1.5 + 3.0 * static_cast<double>(i);
    EXPECT_TRUE(frontiers[i].p_m.isApprox(Eigen::Vector3d(x_m, 1.5, 0.5), 1e-9));
  }
}

TEST(FindFrontiers, MeasuresLengthInMetres) {
  OccupancyGrid grid = layer_of({"????????????", "............"});
  grid.frame.cell_size_m.x() = 0.25;
  FrontierOptions options = whole();
  options.max_extent_m = 4.0;
  EXPECT_THAT(sizes(find_frontiers(grid, options)), ElementsAre(12U));
}

TEST(FindFrontiers, DropsSmallClustersAndSplitsOffNoSmallOnes) {
  const OccupancyGrid grid = layer_of({"?????##??",  //
                                       ".....##.."});
  FrontierOptions options = whole();
  options.min_cells = 3;
  options.max_extent_m = 1.5;
  // Halves of the five would have three and two cells.
  EXPECT_THAT(sizes(find_frontiers(grid, options)), ElementsAre(5U));
  options.min_cells = 2;
  EXPECT_THAT(sizes(find_frontiers(grid, options)), ElementsAre(3U, 2U, 2U));
  options.min_cells = 6;
  EXPECT_THAT(find_frontiers(grid, options), IsEmpty());
}

/// A room of 5 x 5 x 4 free cells of 1 m; above it, everything is unknown.
OccupancyGrid room_without_ceiling() {
  GridFrame frame;
  frame.cells = {5, 5, 6};
  OccupancyGrid grid(frame);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (frame.cell(cell).z() < 4) grid.log_odds[cell] = -3.0F;
  }
  return grid;
}

TEST(FindFrontiers, LooksAtAHighFrontierFromTheHeightOfTheSensor) {
  FrontierOptions options = whole();
  options.height_m = 1.2;
  const auto frontiers = find_frontiers(room_without_ceiling(), options);
  ASSERT_THAT(frontiers, SizeIs(1));
  EXPECT_THAT(frontiers[0].cells, SizeIs(25));
  EXPECT_TRUE(frontiers[0].p_m.isApprox(Eigen::Vector3d(2.5, 2.5, 1.2)));
}

TEST(FindFrontiers, StandsBesideWhatFillsThePlaceBelowTheCentroid) {
  OccupancyGrid grid = room_without_ceiling();
  grid.log_odds[grid.frame.index({2, 2, 1})] = 3.0F;
  FrontierOptions options = whole();
  options.height_m = 1.2;
  const auto frontiers = find_frontiers(grid, options);
  ASSERT_THAT(frontiers, SizeIs(1));
  EXPECT_TRUE(frontiers[0].p_m.isApprox(Eigen::Vector3d(2.5, 1.5, 1.2)));
}

TEST(FindFrontiers, LeavesOutCellsAboveAndBelowTheBand) {
  FrontierOptions options = whole();
  options.height_band_m = {{0.0, 3.4}};  // the centres of the highest free cells are at 3.5
  EXPECT_THAT(find_frontiers(room_without_ceiling(), options), IsEmpty());
  options.height_band_m = {{3.5, 3.6}};
  EXPECT_THAT(find_frontiers(room_without_ceiling(), options), SizeIs(1));
  options.height_band_m = {{3.6, 9.0}};
  EXPECT_THAT(find_frontiers(room_without_ceiling(), options), IsEmpty());
}

TEST(FrontierOptions, ReadTheBandAndRejectAnEmptyOne) {
  FrontierOptions options;
  read_into(parse_yaml("height_band_m: [0.2, 1.5]", "test"), options);
  EXPECT_THAT(options.height_band_m, testing::Optional(ElementsAre(0.2, 1.5)));
  EXPECT_THROW(read_into(parse_yaml("height_band_m: [1.5, 0.2]", "test"), options), ConfigError);
  EXPECT_THROW(find_frontiers({}, {.min_cells = 0}), ConfigError);
}

OccupancyGrid any_grid() {
  GridFrame frame;
  frame.cells = {*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), *rc::gen::inRange(1, 5)};
  OccupancyGrid grid(frame);
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  for (float& cell : grid.log_odds) {
    const double draw = rng.uniform();
    cell = draw < 0.7 ? -3.0F : (draw < 0.85 ? 0.0F : 3.0F);
  }
  return grid;
}

bool touches_unobserved(const OccupancyGrid& grid, std::size_t cell) {
  for (std::size_t other = 0; other < grid.size(); ++other) {
    const int steps = (grid.frame.cell(cell) - grid.frame.cell(other)).abs().sum();
    if (steps == 1 && grid.state(other) == CellState::unobserved) return true;
  }
  return false;
}

RC_GTEST_PROP(FrontierCells, AreJustTheFreeCellsWithAnUnobservedNeighbour, ()) {
  const OccupancyGrid grid = any_grid();
  std::vector<std::size_t> expected;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.state(cell) == CellState::free && touches_unobserved(grid, cell)) {
      expected.push_back(cell);
    }
  }
  RC_ASSERT(frontier_cells(grid, whole()) == expected);
}

RC_GTEST_PROP(FindFrontiers, PartitionTheFrontierCells, ()) {
  const OccupancyGrid grid = any_grid();
  FrontierOptions options = whole();
  options.max_extent_m = *rc::gen::inRange(1, 6);
  std::vector<std::size_t> united;
  std::size_t before = grid.size();
  for (const Frontier& frontier : find_frontiers(grid, options)) {
    RC_ASSERT(std::ranges::is_sorted(frontier.cells));
    RC_ASSERT(frontier.cells.size() <= before);
    before = frontier.cells.size();
    united.insert(united.end(), frontier.cells.begin(), frontier.cells.end());
  }
  std::ranges::sort(united);
  RC_ASSERT(united == frontier_cells(grid, options));
}

RC_GTEST_PROP(FindFrontiers, KeepNoClusterBelowTheMinimum, ()) {
  const OccupancyGrid grid = any_grid();
  FrontierOptions options = whole();
  options.max_extent_m = 1.5;
  options.min_cells = *rc::gen::inRange(1, 8);
  for (const Frontier& frontier : find_frontiers(grid, options)) {
    RC_ASSERT(frontier.cells.size() >= static_cast<std::size_t>(options.min_cells));
  }
}

RC_GTEST_PROP(FindFrontiers, StandInKnownFreeSpaceWhereAClusterReachesTheSensorsHeight, ()) {
  const OccupancyGrid grid = any_grid();
  for (const Frontier& frontier : find_frontiers(grid, whole())) {
    const bool reaches = std::ranges::any_of(
        frontier.cells, [&](std::size_t cell) { return grid.frame.cell(cell).z() == 0; });
    const auto here = grid.frame.cell_at(frontier.p_m);
    RC_ASSERT(grid.frame.contains(here));
    RC_ASSERT(!reaches || grid.state(grid.frame.index(here)) == CellState::free);
  }
}

TEST(FindFrontiers, TakeTheHighestOfTheBandAndRefuseABandOfNoHeight) {
  FrontierOptions options = whole();
  options.height_band_m = {{3.4, 3.5}};
  EXPECT_THAT(find_frontiers(room_without_ceiling(), options), SizeIs(1));
  options.height_band_m = {{1.5, 1.5}};
  EXPECT_THROW(find_frontiers(room_without_ceiling(), options), ConfigError);
}

RC_GTEST_PROP(FindFrontiers, JoinCellsThatTouchInAnyDirection, ()) {
  const OccupancyGrid grid = any_grid();
  const auto frontiers = find_frontiers(grid, whole());
  std::vector<std::size_t> frontier_of(grid.size(), frontiers.size());
  for (std::size_t i = 0; i < frontiers.size(); ++i) {
    for (const std::size_t cell : frontiers[i].cells) frontier_of[cell] = i;
  }
  const auto cells = frontier_cells(grid, whole());
  for (const std::size_t a : cells) {
    for (const std::size_t b : cells) {
      const int apart = (grid.frame.cell(a) - grid.frame.cell(b)).abs().maxCoeff();
      RC_ASSERT(apart > 1 || frontier_of[a] == frontier_of[b]);
    }
  }
}

/// From the middle of the first cell to that of the last one.
TEST(FindFrontiers, SplitAClusterOnlyIfItIsLongerThanTheGreatestExtent) {
  const OccupancyGrid grid = layer_of({"?????", "....."});
  FrontierOptions options = whole();
  options.max_extent_m = 4.0;
  EXPECT_THAT(sizes(find_frontiers(grid, options)), ElementsAre(5U));
  options.max_extent_m = 3.99;
  EXPECT_THAT(sizes(find_frontiers(grid, options)), ElementsAre(3U, 2U));
}

}  // namespace
}  // namespace vantage
