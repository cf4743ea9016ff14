#include "vantage/planners/navigation/path_field.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <deque>
#include <numbers>

#include "tests/planners/navigation/ascii_floor.hpp"
#include "tests/planners/navigation/drawn_rooms.hpp"
#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/navigation/distance_field.hpp"

namespace vantage {
namespace {

NavigationOptions comfortable_point_robot() {
  NavigationOptions options = point_robot();
  options.comfort_m = 2.0;
  return options;
}

std::vector<bool> flood(const FloorMap& map, const PathField& field, std::size_t start) {
  std::vector<bool> seen(map.size(), false);
  std::deque<std::size_t> open{start};
  seen[start] = true;
  while (!open.empty()) {
    const Eigen::Array2i at = map.cell(open.front());
    open.pop_front();
    for (const Eigen::Array2i& step : {Eigen::Array2i(1, 0), Eigen::Array2i(-1, 0),
                                       Eigen::Array2i(0, 1), Eigen::Array2i(0, -1)}) {
      const Eigen::Array2i to = at + step;
      if (!map.contains(to) || seen[map.index(to)] || !field.traversable(map.index(to))) continue;
      seen[map.index(to)] = true;
      open.push_back(map.index(to));
    }
  }
  return seen;
}

RC_GTEST_PROP(PathField, ReachesWhatAFloodReaches, ()) {
  const int nx = *rc::gen::inRange(2, 16);
  const int ny = *rc::gen::inRange(2, 16);
  FloorMap map(Eigen::Vector2d(-3.0, 2.0), 0.5, nx, ny);
  const int one_in = *rc::gen::inRange(2, 9);
  for (float& cell : map.log_odds) cell = *rc::gen::inRange(0, one_in) == 0 ? 0.0F : -3.0F;
  const auto start = static_cast<std::size_t>(*rc::gen::inRange(0, nx * ny));
  map.log_odds[start] = -3.0F;
  NavigationOptions options = comfortable_point_robot();
  options.footprint_radius_m = *rc::gen::element(0.4, 0.6, 0.9);
  options.clearance_weight = *rc::gen::element(0.0, 2.0);

  const Eigen::Vector2d p_start = map.centre(map.cell(start));
  const PathField field = make_path_field(map, {p_start.x(), p_start.y(), 0.0}, options);
  RC_PRE(field.traversable(start));
  const auto reached = flood(map, field, start);
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    RC_ASSERT(field.reachable(cell) == reached[cell]);
  }
}

TEST(PathField, CostsTheOctileDistanceWhereClearanceDoesNotMatter) {
  const Drawing rows{
      "......",  //
      "......",  //
      "S.....",  //
  };
  const PathField field =
      make_path_field(floor_of(rows), place_of(rows, 'S'), comfortable_point_robot());
  EXPECT_NEAR(field.cost[field.map.index({5, 0})], 5.0, 1e-12);
  EXPECT_NEAR(field.cost[field.map.index({5, 2})], 3.0 + 2.0 * std::sqrt(2.0), 1e-12);
}

TEST(PathField, DoesNotCutCorners) {
  const Drawing rows{
      ".#.",  //
      "S.#",  //
      "...",  //
  };
  const FloorMap map = floor_of(rows);
  const PathField field = make_path_field(map, place_of(rows, 'S'), comfortable_point_robot());
  EXPECT_TRUE(field.reachable(map.index({1, 1})));
  EXPECT_FALSE(field.reachable(map.index({2, 2})));
}

TEST(PathField, KeepsTheFootprintOutOfNarrowPlaces) {
  const Drawing rows{
      "...#...",  //
      "...#...",  //
      "S.....G",  //
      "...#...",  //
      "...#...",  //
  };
  const FloorMap map = floor_of(rows);
  const Pose2 goal = place_of(rows, 'G');
  NavigationOptions options = comfortable_point_robot();
  const auto reaches = [&] {
    const PathField field = make_path_field(map, place_of(rows, 'S'), options);
    return field.reachable(Eigen::Vector2d(goal.x_m, goal.y_m));
  };
  EXPECT_TRUE(reaches());
  options.margin_m = 0.2;
  EXPECT_FALSE(reaches());
}

const Drawing kTightCorner{
    "#########",  //
    "#S......#",  //
    "#.......#",  //
    "#.......#",  //
    "#.......#",  //
    "#########",  //
};

/// Too large for the corner that it stands in.
NavigationOptions large_robot() {
  NavigationOptions options = comfortable_point_robot();
  options.footprint_radius_m = 2.0;
  return options;
}

TEST(PathField, LeavesAPlaceTooNearAnObstacle) {
  const Drawing& rows = kTightCorner;
  NavigationOptions options = large_robot();
  options.escape_radius_m = 1.5;
  const FloorMap map = floor_of(rows);
  const PathField field = make_path_field(map, place_of(rows, 'S'), options);
  EXPECT_FALSE(field.traversable(field.start_cell));
  EXPECT_TRUE(field.reachable(map.index({2, 3})));
  EXPECT_TRUE(field.reachable(map.index({6, 2})));
  EXPECT_FALSE(field.reachable(map.index({1, 4})));  // only traversable cells are goals

  options.escape_radius_m = 1.0;
  const PathField stuck = make_path_field(map, place_of(rows, 'S'), options);
  EXPECT_FALSE(nearest_reachable(stuck, {6.5, 2.5}).has_value());
}

/// The shortest way out leads past a post; the robot takes the one that keeps away from it.
TEST(PathField, EscapesAwayFromWhatItStandsBeside) {
  const Drawing rows{
      "...............",  //
      "...............",  //
      "...............",  //
      "......#........",  //
      ".....S.........",  //
      "...............",  //
      "...............",  //
  };
  NavigationOptions options = comfortable_point_robot();
  options.footprint_radius_m = 2.0;
  options.escape_radius_m = 3.0;
  const FloorMap map = floor_of(rows);
  const PathField field = make_path_field(map, place_of(rows, 'S'), options);
  for (std::size_t cell = map.index({5, 1}); field.parent[cell] != PathField::kNone;
       cell = field.parent[cell]) {
    EXPECT_GE(field.clearance_m[cell], field.clearance_m[field.start_cell]);
  }
  EXPECT_TRUE(field.reachable(map.index({5, 1})));
}

TEST(PathField, DoesNotEscapeThroughAWall) {
  const Drawing rows{
      "???#......",  //
      "?S?#......",  //
      "???#......",  //
  };
  NavigationOptions options = comfortable_point_robot();
  options.footprint_radius_m = 1.5;
  options.escape_radius_m = 9.0;
  const PathField field = make_path_field(floor_of(rows), place_of(rows, 'S'), options);
  EXPECT_FALSE(nearest_reachable(field, {8.5, 1.5}).has_value());
}

/// Five cells of 0.5 m to the first one that is wide enough; the door is the narrowest of them.
TEST(PathField, LeavesThroughWhatIsNarrowerIfItMust) {
  const Drawing rows{
      "#############",  //
      "#####.......#",  //
      "#####.......#",  //
      "#...#.......#",  //
      "#.S.........#",  //
      "#...#.......#",  //
      "#####.......#",  //
      "#####.......#",  //
      "#############",  //
  };
  FloorMap map = floor_of(rows);
  map.cell_m = 0.5;
  NavigationOptions options = comfortable_point_robot();
  options.footprint_radius_m = 1.4;
  options.escape_radius_m = 3.0;
  const PathField field = make_path_field(map, {1.25, 2.25, 0.0}, options);
  EXPECT_FLOAT_EQ(field.clearance_m[field.start_cell], 1.0F);
  EXPECT_FALSE(field.traversable(map.index({6, 4})));
  EXPECT_DOUBLE_EQ(field.cost[map.index({7, 4})], 2.5);
}

/// At the centre of a cell 1, 2 and 3 m from what is outside, where the inflation is 1 m.
TEST(PathField, AMetreCostsByTheClearanceItHas) {
  const FloorMap map = floor_of(Drawing(9, "........."));
  NavigationOptions options;
  options.footprint_radius_m = 0.5;
  options.margin_m = 0.5;
  options.clearance_weight = 3.0;
  options.comfort_m = 2.0;
  const PathField field = make_path_field(map, {2.5, 4.5, 0.0}, options);
  EXPECT_DOUBLE_EQ(field.cost_per_metre(map.index({0, 4})), 4.0);
  EXPECT_DOUBLE_EQ(field.cost_per_metre(map.index({1, 4})), 2.5);
  EXPECT_DOUBLE_EQ(field.cost_per_metre(map.index({2, 4})), 1.0);
  EXPECT_DOUBLE_EQ(field.cost_per_metre(map.index({4, 4})), 1.0);
  EXPECT_DOUBLE_EQ(field.cost[map.index({1, 4})], 1.75) << "half of either cell";
  EXPECT_DOUBLE_EQ(field.cost[map.index({0, 4})], 1.75 + 3.25) << "just traversable";
  EXPECT_DOUBLE_EQ(field.cost[field.start_cell], 0.0);
  EXPECT_EQ(field.parent[map.index({0, 4})], map.index({1, 4}));
}

/// It is dear all the way, and as long as the radius.
TEST(PathField, TheWayOutOfATightPlaceCostsToo) {
  const Drawing& rows = kTightCorner;
  NavigationOptions options = large_robot();
  options.clearance_weight = 2.0;
  options.escape_radius_m = std::numbers::sqrt2;
  const FloorMap map = floor_of(rows);
  const PathField field = make_path_field(map, place_of(rows, 'S'), options);
  ASSERT_TRUE(field.reachable(map.index({2, 3})));
  EXPECT_DOUBLE_EQ(field.cost[map.index({2, 3})], 3.0 * std::numbers::sqrt2);
  EXPECT_DOUBLE_EQ(field.cost[map.index({3, 3})], 3.0 * std::numbers::sqrt2 + 3.0);
  EXPECT_EQ(field.parent[map.index({2, 3})], field.start_cell);
  EXPECT_EQ(field.parent[field.start_cell], PathField::kNone);
  EXPECT_FALSE(field.reachable(field.start_cell));
  options.escape_radius_m = 1.41;
  EXPECT_FALSE(make_path_field(map, place_of(rows, 'S'), options).reachable(map.index({2, 3})));
}

TEST(NearestReachable, OfEquallyNearCellsIsTheCheapest) {
  const Drawing rows{
      ".....",  //
      "S.#..",  //
      ".....",  //
  };
  const FloorMap map = floor_of(rows);
  const PathField field = make_path_field(map, place_of(rows, 'S'), point_robot());
  EXPECT_EQ(nearest_reachable(field, {2.5, 1.5}), map.index({1, 1}));
  EXPECT_EQ(nearest_reachable(field, {2.5, 1.6}), map.index({2, 2}));
  EXPECT_TRUE(field.reachable(Eigen::Vector2d(4.9, 2.9)));
  EXPECT_FALSE(field.reachable(Eigen::Vector2d(5.1, 2.9))) << "off the map";
  EXPECT_FALSE(field.reachable(Eigen::Vector2d(2.5, 1.5)));
}

/// After each row and each column of the clearance, which has a ring of cells more, and once in
/// 32 768 cells of the search.
TEST(PathField, AsksNowAndThenWhetherToGoOn) {
  FloorMap map(Eigen::Vector2d::Zero(), 1.0, 200, 200);
  for (float& log_odds : map.log_odds) log_odds = -3.0F;
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  make_path_field(map, {100.5, 100.5, 0.0}, point_robot());
  EXPECT_EQ(asked, 202 + 202 + 1);
  FloorMap one_cell_less(Eigen::Vector2d::Zero(), 1.0, 217, 151);
  for (float& log_odds : one_cell_less.log_odds) log_odds = -3.0F;
  asked = 0;
  make_path_field(one_cell_less, {100.5, 100.5, 0.0}, point_robot());
  EXPECT_EQ(asked, 153 + 219) << "after 32 767 cells not yet";
}

TEST(PathField, OneCellIsAnOpenPlaceForADisc) {
  const FloorMap map = floor_of({".#."});
  EXPECT_TRUE(make_path_field(map, {0.5, 0.5, 0.0}, point_robot()).reaches_open_place());
  EXPECT_FALSE(make_path_field(map, {9.5, 0.5, 0.0}, point_robot()).reaches_open_place());
  const FloorMap row = floor_of({"..."});
  EXPECT_TRUE(make_path_field(row, {0.5, 0.5, 0.0}, point_robot()).reaches_open_place());
}

/// Of cells of 0.5 m.
TEST(PathField, AnOpenPlaceHasAsManyCellsAsItsAreaNeedsAndAtLeastOne) {
  FloorMap map = floor_of({"....."});
  map.cell_m = 0.5;
  NavigationOptions options = point_robot();
  options.footprint_radius_m = 0.4;
  PathField field = make_path_field(map, {0.25, 0.25, 0.0}, options);
  const auto opens = [&](double least_area_m2, std::size_t reached) {
    field.space = DrawnRooms(1.0, 1.0, {})
                      .space({.outline = rectangle(0.4, 0.2)}, {.least_area_m2 = least_area_m2});
    std::ranges::fill(field.cost, kInfinity);
    std::fill_n(field.cost.begin(), reached, 1.0);
    return field.reaches_open_place();
  };
  EXPECT_FALSE(opens(0.0, 0));
  EXPECT_TRUE(opens(0.0, 1));
  EXPECT_FALSE(opens(0.6, 2));
  EXPECT_TRUE(opens(0.6, 3));
}

TEST(PathField, OfARobotOutsideTheMapReachesNothing) {
  const FloorMap map = floor_of({"...", "...", "..."});
  const PathField field = make_path_field(map, {-5.0, 0.0, 0.0}, comfortable_point_robot());
  EXPECT_FALSE(nearest_reachable(field, {1.5, 1.5}).has_value());
}

/// It stands 2 m from the walls of a corridor, as it would all the way to the right. To the left it
/// is nearer, past a post.
TEST(PathField, EscapesByAWayThatComesNoNearerThanItIs) {
  const Drawing rows{
      "........#########........",  //
      "........#########........",  //
      "........#########........",  //
      ".........#...............",  //
      "...........S.............",  //
      ".........................",  //
      "........#########........",  //
      "........#########........",  //
      "........#########........",  //
  };
  NavigationOptions options = comfortable_point_robot();
  options.footprint_radius_m = 3.0;
  options.escape_radius_m = 9.0;
  const FloorMap map = floor_of(rows);
  const PathField field = make_path_field(map, place_of(rows, 'S'), options);
  EXPECT_EQ(field.clearance_m[field.start_cell], 2.0F);
  EXPECT_TRUE(field.reachable(map.index({20, 4})));
  EXPECT_FALSE(field.reachable(map.index({4, 4})));
}

/// By eight steps, which cut no corners; a metre costs the mean of both cells.
TEST(PathField, ACellCostsTheCheapestStepFromOneBesideIt) {
  Rng rng(8);
  FloorMap map(Eigen::Vector2d(-3.0, 2.0), 0.5, 24, 20);
  for (float& cell : map.log_odds) cell = rng.uniform() < 0.12 ? 3.0F : -3.0F;
  map.log_odds[map.index({12, 10})] = -3.0F;
  NavigationOptions options = comfortable_point_robot();
  options.footprint_radius_m = 0.4;
  options.clearance_weight = 2.0;
  const PathField field = make_path_field(map, {3.25, 7.25, 0.0}, options);
  const auto is_reached = [&](const Eigen::Array2i& at) {
    return map.contains(at) && field.reachable(map.index(at));
  };
  int reached = 0;
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    const Eigen::Array2i to = map.cell(cell);
    if (!is_reached(to)) continue;
    ++reached;
    double cheapest = cell == field.start_cell ? 0.0 : kInfinity;
    for (int k = 0; k < 9; ++k) {
      const Eigen::Array2i from = to + Eigen::Array2i(k % 3 - 1, k / 3 - 1);
      const bool open =
          is_reached(from) && is_reached({to.x(), from.y()}) && is_reached({from.x(), to.y()});
      if (k == 4 || !open) continue;
      const double length_m = 0.5 * (k % 2 == 0 ? std::numbers::sqrt2 : 1.0);
      const double per_metre =
          0.5 * (field.cost_per_metre(map.index(from)) + field.cost_per_metre(cell));
      cheapest = std::min(cheapest, field.cost[map.index(from)] + length_m * per_metre);
    }
    EXPECT_NEAR(field.cost[cell], cheapest, 1e-9) << to.transpose();
  }
  EXPECT_GT(reached, 200);
}

TEST(NearestReachable, OfCellsAsNearAndAsCheapIsTheFirstInTheMap) {
  const Drawing rows{
      "..#..",  //
      "..#..",  //
      "..S..",  //
  };
  const FloorMap map = floor_of(rows);
  const PathField field = make_path_field(map, place_of(rows, 'S'), point_robot());
  ASSERT_EQ(field.cost[map.index({1, 2})], field.cost[map.index({3, 2})]);
  EXPECT_EQ(nearest_reachable(field, {2.5, 2.5}), map.index({1, 2}));
}

TEST(PathField, RejectsOptionsOutOfRange) {
  const FloorMap map = floor_of({"...", "...", "..."});
  NavigationOptions options = point_robot();
  options.comfort_m = 0.0;
  EXPECT_THROW(static_cast<void>(make_path_field(map, {1.5, 1.5, 0.0}, options)), ConfigError);
}

}  // namespace
}  // namespace vantage
