#include "vantage/planners/travel/path_lengths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "tests/planners/navigation/ascii_floor.hpp"
#include "tests/planners/navigation/drawn_rooms.hpp"
#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/navigation/path_planning.hpp"

namespace vantage {
namespace {

const Drawing kRooms{
    "A.....#....B",  //
    "......#.....",  //
    "......#.....",  //
    "............",  //
    "S.....#.....",  //
    "......#....C",  //
    "#######.....",  //
    "D..........?",  //
};

Eigen::Vector2d at(char mark) {
  const Pose2 place = place_of(kRooms, mark);
  return {place.x_m, place.y_m};
}

TEST(PathLengths, AreThoseOfTheSearchFromThere) {
  const FloorMap map = floor_of(kRooms);
  const PathField field = make_path_field(map, place_of(kRooms, 'S'), point_robot());
  const std::vector<Eigen::Vector2d> places{at('A'), at('B'), at('C'), at('S')};
  const Eigen::MatrixXd lengths_m = path_lengths_m(field, places, 1);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const auto& from = places[static_cast<std::size_t>(i)];
    // Costs are lengths here: no clearance is paid for.
    const PathField search = make_path_field(map, {from.x(), from.y(), 0.0}, point_robot());
    for (Eigen::Index j = 0; j < 4; ++j) {
      const auto& to = places[static_cast<std::size_t>(j)];
      EXPECT_NEAR(lengths_m(i, j), search.cost[map.index(map.cell_at(to))], 1e-5);
    }
  }
}

TEST(PathLengths, OfRandomFloorsAreThoseOfTheSearchFromEachCell) {
  NavigationOptions options = point_robot();
  options.footprint_radius_m = 0.4;
  Rng rng(4);
  int reached = 0;
  for (int world = 0; world < 4; ++world) {
    FloorMap map(Eigen::Vector2d::Zero(), 0.5, 8, 6);
    for (float& log_odds : map.log_odds) log_odds = rng.uniform() < 0.2 ? 3.0F : -3.0F;
    map.log_odds.front() = -3.0F;
    const PathField field = make_path_field(map, {0.25, 0.25, 0.0}, options);
    std::vector<Eigen::Vector2d> places;
    for (std::size_t i = 0; i < map.size(); ++i) places.push_back(map.centre(map.cell(i)));
    const Eigen::MatrixXd lengths_m = path_lengths_m(field, places, 1);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const PathField from = make_path_field(map, {places[i].x(), places[i].y(), 0.0}, options);
      for (std::size_t j = 0; j < map.size(); ++j) {
        const double length_m =
            lengths_m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        const bool way = field.reachable(i) && field.reachable(j);
        ASSERT_EQ(std::isinf(length_m), !way && i != j) << world << " " << i << " " << j;
        if (!way) continue;
        ASSERT_NEAR(length_m, from.cost[j], 1e-5) << world << " " << i << " " << j;
        ++reached;
      }
    }
  }
  EXPECT_GT(reached, 1000);
}

TEST(PathLengths, GoRoundWallsAndAreTheSameBothWays) {
  const PathField field = make_path_field(floor_of(kRooms), place_of(kRooms, 'S'), point_robot());
  const std::vector<Eigen::Vector2d> places{at('A'), at('B')};
  const Eigen::MatrixXd lengths_m = path_lengths_m(field, places, 2);
  // Down to the door, through it, and up again: 3 diagonal steps a side and 5 across.
  EXPECT_NEAR(lengths_m(0, 1), 5.0 + 6.0 * std::sqrt(2.0), 1e-5);
  EXPECT_EQ(lengths_m(0, 1), lengths_m(1, 0));
  EXPECT_EQ(lengths_m(0, 0), 0.0);
}

TEST(PathLengths, AreNoShorterThanThePathPulledStraightAndLittleLonger) {
  const PathField field = make_path_field(floor_of(kRooms), place_of(kRooms, 'S'), point_robot());
  const std::vector<Eigen::Vector2d> places{at('S'), at('B'), at('C')};
  const Eigen::MatrixXd lengths_m = path_lengths_m(field, places, 1);
  for (Eigen::Index j = 1; j < 3; ++j) {
    const auto& to = places[static_cast<std::size_t>(j)];
    const double straight_m = path_length_m(field, {to.x(), to.y(), 0.0});
    EXPECT_GE(lengths_m(0, j), straight_m - 1e-5);
    EXPECT_LE(lengths_m(0, j), 1.09 * straight_m);
  }
}

TEST(PathLengths, AreInfiniteToWhatCannotBeReached) {
  const PathField field = make_path_field(floor_of(kRooms), place_of(kRooms, 'S'), point_robot());
  const std::vector<Eigen::Vector2d> places{at('A'), at('D'), {-5.0, 3.0}};
  const Eigen::MatrixXd lengths_m = path_lengths_m(field, places, 1);
  EXPECT_TRUE(std::isinf(lengths_m(0, 2)));
  EXPECT_TRUE(std::isinf(lengths_m(2, 1)));
  EXPECT_EQ(lengths_m(2, 2), 0.0);
}

/// 200 x 200 m, more cells than a search settles between two polls.
PathField field_of_open_floor(int nx = 200, int ny = 200) {
  FloorMap map(Eigen::Vector2d::Zero(), 1.0, nx, ny);
  for (float& log_odds : map.log_odds) log_odds = -3.0F;
  return make_path_field(map, {0.5, 0.5, 0.0}, point_robot());
}

/// From those that are new alone it searches, which asks once more here.
TEST(PathLengths, OfPlacesThatComeAgainAreRemembered) {
  const PathField field = field_of_open_floor();
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  PathLengths ways(field);
  const std::vector<Eigen::Vector2d> first{{0.5, 0.5}, {199.5, 199.5}, {-5.0, 3.0}};
  EXPECT_TRUE(ways.between_m(first, 1) == path_lengths_m(field, first, 1));
  EXPECT_EQ(asked, 3 + 3);
  const std::vector<Eigen::Vector2d> more{{199.5, 199.5}, {-5.0, 3.0}, {0.5, 0.5}, {150.5, 150.5}};
  asked = 0;
  const Eigen::MatrixXd lengths_m = ways.between_m(more, 1);
  EXPECT_EQ(asked, 3 + 1);
  const double step_m = std::sqrt(2.0);
  EXPECT_NEAR(lengths_m(0, 2), 199.0 * step_m, 0.01);
  EXPECT_NEAR(lengths_m(0, 3), 49.0 * step_m, 0.01);
  EXPECT_NEAR(lengths_m(3, 2), 150.0 * step_m, 0.01);
  EXPECT_TRUE(std::isinf(lengths_m(1, 3)));
  asked = 0;
  EXPECT_TRUE(ways.between_m(more, 1) == lengths_m);
  EXPECT_EQ(asked, 3);
}

/// After each place that is reached, and once in 32 768 cells of the search from there.
TEST(PathLengths, AskNowAndThenWhetherToGoOn) {
  const PathField field = field_of_open_floor();
  const std::vector<Eigen::Vector2d> places{{0.5, 0.5}, {199.5, 199.5}, {-5.0, 3.0}};
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  const Eigen::MatrixXd lengths_m = path_lengths_m(field, places, 1);
  EXPECT_EQ(asked, 1 + 2);
  EXPECT_NEAR(lengths_m(0, 1), 199.0 * std::sqrt(2.0), 0.01);
  asked = 0;
  const std::vector<Eigen::Vector2d> near{{0.5, 0.5}, {1.5, 0.5}, {1.6, 0.6}};
  EXPECT_NEAR(path_lengths_m(field, near, 1)(0, 2), 1.0, 1e-5);
  EXPECT_EQ(asked, 3) << "a search ends with the last place, two of one cell too";
  const PathField one_cell_less = field_of_open_floor(217, 151);
  asked = 0;
  const std::vector<Eigen::Vector2d> corners{{0.5, 0.5}, {216.5, 150.5}};
  EXPECT_NEAR(path_lengths_m(one_cell_less, corners, 1)(0, 1), 66.0 + 150.0 * std::sqrt(2.0), 0.01);
  EXPECT_EQ(asked, 2) << "after 32 767 cells not yet";
}

TEST(PathLengths, PayForClearanceAsPathsDo) {
  // Straight on past the wall is shorter; with a price on closeness the way keeps off.
  const Drawing rows{
      "...........",  //
      "...........",  //
      "...........",  //
      "A.........B",  //
      "###########",  //
  };
  NavigationOptions options = point_robot();
  options.clearance_weight = 5.0;
  options.comfort_m = 2.0;
  const Pose2 a = place_of(rows, 'A');
  const Pose2 b = place_of(rows, 'B');
  const PathField field = make_path_field(floor_of(rows), a, options);
  const std::vector<Eigen::Vector2d> places{{a.x_m, a.y_m}, {b.x_m, b.y_m}};
  EXPECT_GT(path_lengths_m(field, places, 1)(0, 1), 10.5);
}

/// With more room the cheapest way goes two rows up and down again.
TEST(PathLengths, AreThoseOfTheCheapestWayNotOfTheShortest) {
  const Drawing rows{
      "...........",  //
      "...........",  //
      "...........",  //
      "...........",  //
      "...........",  //
      "A.........B",  //
      "###########",  //
  };
  NavigationOptions options = point_robot();
  options.comfort_m = 2.0;
  const Pose2 a = place_of(rows, 'A');
  const Pose2 b = place_of(rows, 'B');
  const std::vector<Eigen::Vector2d> places{{b.x_m, b.y_m}, {a.x_m, a.y_m}};
  for (const double weight : {2.0, 5.0, 8.0}) {
    options.clearance_weight = weight;
    const PathField field = make_path_field(floor_of(rows), a, options);
    EXPECT_NEAR(path_lengths_m(field, places, 2)(1, 0), 6.0 + 4.0 * std::sqrt(2.0), 1e-5);
  }
}

TEST(PathLengths, AreInfiniteBetweenPlacesOfARoomThatIsNotReached) {
  const Drawing rows{"...#...",  //
                     "S..#A.B",  //
                     "...#..."};
  const PathField field = make_path_field(floor_of(rows), place_of(rows, 'S'), point_robot());
  const std::vector<Eigen::Vector2d> places{position(place_of(rows, 'A')),
                                            position(place_of(rows, 'B'))};
  EXPECT_TRUE(std::isinf(path_lengths_m(field, places, 1)(0, 1)));
  PathField two_starts = field;
  two_starts.cost[field.map.index(field.map.cell_at(places[0]))] = 0.0;
  const std::vector<Eigen::Vector2d> apart{position(place_of(rows, 'S')), places[0]};
  EXPECT_TRUE(std::isinf(path_lengths_m(two_starts, apart, 1)(0, 1)));
}

/// Of the ends of a row of 11 cells, which these passages lead past. Poses are from 11 on.
double length_past_m(const std::vector<NarrowEdge>& passages) {
  const Drawing row{"A.........B"};
  PathField field = make_path_field(floor_of(row), place_of(row, 'A'), point_robot());
  for (const NarrowEdge& edge : passages) {
    field.narrow.resize(std::max(field.narrow.size(), std::max(edge.from, edge.to) - 10));
  }
  field.narrow_edges = passages;
  const std::vector<Eigen::Vector2d> places{position(place_of(row, 'A')),
                                            position(place_of(row, 'B'))};
  return path_lengths_m(field, places, 1)(0, 1);
}

TEST(PathLengths, GoThroughPassagesThatCostLessThanTheFloor) {
  EXPECT_NEAR(length_past_m({{0, 11, 1.0, 2.0}, {12, 11, 7.5, 3.0}, {12, 10, 1.0, 4.0}}), 9.0, 1e-5)
      << "which cost 9.5, the floor 10";
  EXPECT_NEAR(length_past_m({{0, 11, 1.0, 2.0}, {12, 11, 8.5, 3.0}, {12, 10, 1.0, 4.0}}), 10.0,
              1e-5)
      << "these would cost 10.5";
}

TEST(PathLengths, OfTwoPassagesAreThatOfTheCheaperHoweverLittleItIsOrOfTheFirst) {
  EXPECT_NEAR(
      length_past_m(
          {{0, 11, 1e-8, 2.0}, {11, 10, 1e-8, 3.0}, {0, 12, 1e-8, 1.0}, {12, 10, 5e-9, 1.0}}),
      2.0, 1e-5);
  EXPECT_NEAR(
      length_past_m({{0, 11, 1.0, 2.0}, {11, 10, 1.0, 3.0}, {0, 12, 1.0, 1.0}, {12, 10, 1.0, 1.0}}),
      5.0, 1e-5);
}

/// A nearly square robot in a closed corridor, which looks for a way out ahead first and then on
/// all sides: that makes the edges anew. Each counts its length and turn, thrice for its time, and
/// what is pinched twice.
TEST(NarrowEdges, AreThereOnceAndNoWayOverThemIsCheaper) {
  const DrawnRooms rooms(4.0, 2.0, {wall(0.0, 0.0, 4.0, 0.67), wall(0.0, 1.38, 4.0, 2.0)});
  const FloorOutline outline = rectangle(0.6, 0.6);
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  options.clearance_weight = 1.5;
  const PathField field =
      make_path_field(rooms.floor, {2.025, 1.025, 0.0}, options,
                      rooms.space({.outline = outline, .speed_m_s = 0.6}, {.speed_m_s = 0.2}));
  const std::size_t cells = field.map.size();
  const double step_m = 2.0 * std::numbers::pi / 48.0 * std::hypot(0.3, 0.3);
  ASSERT_GT(field.narrow_edges.size(), 500U);
  std::set<std::pair<std::size_t, std::size_t>> made;
  std::vector<double> cheapest(field.narrow.size(), std::numeric_limits<double>::infinity());
  for (const NarrowEdge& edge : field.narrow_edges) {
    ASSERT_GE(std::min(edge.from, edge.to), cells) << "nothing is open";
    EXPECT_TRUE(made.emplace(edge.from, edge.to).second) << edge.from << " " << edge.to;
    const NarrowPose& from = field.narrow[edge.from - cells];
    const NarrowPose& to = field.narrow[edge.to - cells];
    const double way_m = (position(to.pose) - position(from.pose)).norm();
    EXPECT_NEAR(edge.length_m, 3.0 * (way_m + (from.cell == to.cell ? step_m : 0.0)), 1e-9);
    const double pinched = edge.cost / (2.5 * edge.length_m);
    EXPECT_TRUE(std::abs(pinched - 1.0) < 1e-9 || std::abs(pinched - 2.0) < 1e-9) << pinched;
    double& least = cheapest[edge.to - cells];
    least = std::min(least, from.cost + edge.cost);
  }
  int reached = 0;
  for (std::size_t i = 0; i < cheapest.size(); ++i) {
    const NarrowPose& node = field.narrow[i];
    if (node.cost == 0.0) continue;  // where it stands
    EXPECT_DOUBLE_EQ(node.cost, cheapest[i]) << i;
    reached += std::isinf(node.cost) ? 0 : 1;
  }
  EXPECT_GT(reached, 100);
}

}  // namespace
}  // namespace vantage
