// What a view problem is made of: the pace of short ways, the map that is drawn, units of gains.
#include <gtest/gtest.h>

#include <vector>

#include "vantage/planners/choice/view_problem.hpp"

namespace vantage {
namespace {

/// An empty hall of 2 x 2 x 1 m whose floor is known, and the air of one half of it.
struct Hall {
  OccupancyGrid grid{make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {10, 10, 5})};
  BlockField transmission = uniform_field(grid.frame.cells, 0.98);
  FloorMap floor{Eigen::Vector2d(-1.0, -1.0), 0.1, 20, 20};
  PathField paths;
  std::vector<Candidate> views;
  std::vector<Eigen::Vector2d> places_m;

  Hall() {
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      grid.log_odds[cell] = grid.frame.cell(cell).y() < 5 ? -3.0F : 0.0F;
    }
    for (float& log_odds : floor.log_odds) log_odds = -3.0F;
    NavigationOptions navigation;
    navigation.footprint_radius_m = 0.2;
    navigation.clearance_weight = 0.0;
    paths = make_path_field(floor, {-0.5, -0.5, 0.0}, navigation);
    Candidate& view = views.emplace_back();
    view.T_world_sensor = Pose(Eigen::Translation3d(0.5, -0.5, 0.55));
    view.path_length_m = 1.0;
    places_m.emplace_back(0.5, -0.5);
  }

  [[nodiscard]] ViewPlanningInput input(const BlockField* known_transmission) const {
    return {.map = {grid, known_transmission},
            .gain = SimpleGain{},
            .candidates = views,
            .places_m = places_m,
            .field_of_view = {.range_max_m = 2.5, .panorama = true},
            .paths = paths,
            .travel_time = TravelTime(0.5),
            .scan_s = 7.0};
  }
};

/// Half of 500 cells in half a second.
TEST(ViewProblemParts, ThePaceIsThatOfWhatTimeAndWayThereAreHoweverShort) {
  const Hall hall;
  ViewPlanningInput input = hall.input(&hall.transmission);
  input.elapsed_s = 0.5;
  const PlanningProblem problem = make_view_problem(input, {.beyond_m = 0.5});
  EXPECT_EQ(problem.seen, 250.0);
  EXPECT_NEAR(problem.pace_per_s, 500.0, 1e-9);
  EXPECT_EQ(problem.beyond.size(), 1U);
}

TEST(ViewProblemParts, MapsAreDrawnWhereTransmissionIsKnownAlone) {
  const Hall hall;
  EXPECT_TRUE(static_cast<bool>(make_view_problem(hall.input(&hall.transmission), {}).draw));
  EXPECT_FALSE(static_cast<bool>(make_view_problem(hall.input(nullptr), {}).draw));
}

TEST(ViewProblemParts, OfAGainOfCellsThatCannotBeSweptKnowsWhatIsSeen) {
  const Hall hall;
  for (const Gain& gain : {Gain(FrontierCellsGain{}), Gain(ProximityCountGain{})}) {
    ViewPlanningInput input = hall.input(nullptr);
    input.gain = gain;
    EXPECT_EQ(make_view_problem(input, {}).seen, 250.0) << strategy_name_of(gain);
  }
  ViewPlanningInput input = hall.input(nullptr);
  input.gain = RearSideVoxelGain{};
  EXPECT_EQ(make_view_problem(input, {}).seen, 0.0) << "of beams";
}

}  // namespace
}  // namespace vantage
