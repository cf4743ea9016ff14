#include "vantage/planners/navigation/path_lengths.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planners/navigation/ascii_floor.hpp"
#include "vantage/core/cancellation/stop_poll.hpp"
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

/// After each place that is reached, and once in 32 768 cells of the search from there.
TEST(PathLengths, AskNowAndThenWhetherToGoOn) {
  FloorMap map(Eigen::Vector2d::Zero(), 1.0, 200, 200);
  for (float& log_odds : map.log_odds) log_odds = -3.0F;
  const PathField field = make_path_field(map, {0.5, 0.5, 0.0}, point_robot());
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
}

}  // namespace
}  // namespace vantage
