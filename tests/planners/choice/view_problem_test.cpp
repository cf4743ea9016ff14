#include "vantage/planners/choice/view_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/planners/choice/drawn_map.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/tours/joint_gain.hpp"

namespace vantage {
namespace {

/// An empty room of 4 x 4 x 1 m whose floor is known and whose air above y = 0 is not.
struct Room {
  OccupancyGrid grid{make_grid_frame({0.0, 0.0, 0.5}, {4.0, 4.0, 1.0}, {40, 40, 10})};
  BlockField transmission = uniform_field(grid.frame.cells, 0.98);
  FloorMap floor{Eigen::Vector2d(-2.0, -2.0), 0.1, 40, 40};
  PathField paths;
  std::vector<Candidate> views;
  std::vector<Eigen::Vector2d> places_m;
  FieldOfView field{.range_max_m = 2.5, .panorama = true};

  Room() {
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      grid.log_odds[cell] = grid.frame.cell(cell).y() < 20 ? -3.0F : 0.0F;
    }
    for (float& log_odds : floor.log_odds) log_odds = -3.0F;
    NavigationOptions navigation;
    navigation.footprint_radius_m = 0.2;
    navigation.clearance_weight = 0.0;
    paths = make_path_field(floor, {-1.0, -1.0, 0.0}, navigation);
    for (const auto& [x, y] : {std::pair{-1.0, 0.5}, {1.0, 0.5}, {1.0, 0.6}}) {
      Candidate& view = views.emplace_back();
      view.id = static_cast<int>(views.size()) - 1;
      view.T_world_sensor = Pose(Eigen::Translation3d(x, y, 0.55));
      view.path_length_m = std::hypot(x + 1.0, y + 1.0);
      places_m.emplace_back(x, y);
    }
  }

  [[nodiscard]] ViewPlanningInput input(const Gain& gain) const {
    return {.map = {grid, &transmission},
            .gain = gain,
            .candidates = views,
            .places_m = places_m,
            .field_of_view = field,
            .paths = paths,
            .travel_time = TravelTime(0.5),
            .scan_s = 7.0,
            .threads = 2};
  }
};

/// What the three views of a room show together, and what is beyond each of them.
double shown_and_beyond(const PlanningProblem& problem) {
  const std::vector<std::size_t> all{0, 1, 2};
  double sum = joint_gain(problem, all);
  for (const std::size_t view : all) sum += problem.beyond_of(view);
  return sum;
}

TEST(ViewProblem, HasGainsAndTravelTimes) {
  const Room room;
  const auto input = room.input(AdaptiveGain{});
  const PlanningProblem problem = make_view_problem(input, {});
  problem.check();
  EXPECT_EQ(problem.scan_s, 7.0);
  const auto gains_bits =
      swept_gains_bits(AdaptiveGain{}, input.map, room.views, room.field, 1, kNoRays);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(gain_of(problem, i), gains_bits[i], 0.02 * gains_bits[i]);
    EXPECT_NEAR(problem.leg_s(problem.here(), i),
                input.travel_time.of_m(room.views[i].path_length_m), 1e-9);
  }
  EXPECT_NEAR(problem.leg_s(0, 1), input.travel_time.of_m(2.0), 1e-4);
}

TEST(ViewProblem, KnowsThatTwoViewsOfOnePlaceShareTheirCells) {
  const Room room;
  const PlanningProblem problem = make_view_problem(room.input(SimpleGain{}), {});
  const double one = gain_of(problem, 1);
  const std::vector<std::size_t> near{1, 2};
  const std::vector<std::size_t> apart{0, 1};
  EXPECT_LT(joint_gain(problem, near), 1.15 * one);
  EXPECT_GT(joint_gain(problem, apart), 1.25 * one);
}

/// What all views show together and what is beyond them is all there is, where no wall is known.
TEST(ViewProblem, KnowsWhatLiesBeyondAllViews) {
  const Room room;
  ViewPlanningInput input = room.input(AdaptiveGain{});
  input.elapsed_s = 16.0;
  const PlanningProblem problem = make_view_problem(input, {.beyond_m = 8.0});
  EXPECT_NEAR(shown_and_beyond(problem), 8000.0, 80.0);
  EXPECT_GT(problem.beyond_of(0), 2.0 * problem.beyond_of(1));  // its neighbours share theirs
  EXPECT_EQ(problem.seen, 8000.0);
  EXPECT_NEAR(problem.pace_per_s, 500.0, 1e-9);
  EXPECT_NEAR(problem.dwell_s(0), problem.beyond_of(0) / 500.0, 1e-9);
  // Nothing counts where that is not wanted, or time has not passed.
  EXPECT_EQ(make_view_problem(input, {}).beyond_of(0), 0.0);
  EXPECT_EQ(make_view_problem(room.input(AdaptiveGain{}), {.beyond_m = 8.0}).beyond_of(0), 0.0);
}

/// The lowest layer is known everywhere and the highest one nowhere: where it is open, nine tenths
/// are seen.
TEST(ViewProblem, ExpectsAsMuchBeyondAsIsSeenElsewhere) {
  Room room;
  for (std::size_t cell = 0; cell < room.grid.size(); ++cell) {
    const int z = room.grid.frame.cell(cell).z();
    if (z == 0) room.grid.log_odds[cell] = -3.0F;
    if (z == 9) room.grid.log_odds[cell] = 0.0F;
  }
  ViewPlanningInput input = room.input(AdaptiveGain{});
  input.elapsed_s = 16.0;
  const PlanningProblem problem = make_view_problem(input, {.beyond_m = 8.0});
  ASSERT_EQ(problem.cells.size(), 300U);  // blocks of 4 cells, 10 x 10 x 3
  std::vector<double> unshown(problem.cells.begin(), problem.cells.end());
  double beyond = 0.0;
  for (std::size_t view = 0; view < 3; ++view) {
    beyond += problem.beyond_of(view);
    const ShownShares& shown = problem.shows[view];
    for (std::size_t i = 0; i < shown.block.size(); ++i) {
      unshown[shown.block[i]] *= 1.0 - static_cast<double>(shown.share[i]);
    }
  }
  double unknown = 0.0;
  for (std::size_t block = 0; block < unshown.size(); ++block) {
    if (block / 10 % 10 >= 5) unknown += unshown[block];
  }
  EXPECT_GT(unknown, 100.0);
  EXPECT_NEAR(beyond, 0.9 * unknown, 1e-3 * unknown);
}

/// A cell of 0.1 m is a litre.
TEST(ViewProblem, IsInTheUnitOfItsGain) {
  Room room;
  room.field.range_max_m = 1.0;
  const auto problem_of = [&](const Gain& gain) {
    ViewPlanningInput input = room.input(gain);
    input.elapsed_s = 16.0;
    return make_view_problem(input, {.drawn_cells = 2, .beyond_m = 8.0});
  };
  const PlanningProblem in_cells = problem_of(SimpleGain{});
  const PlanningProblem in_m3 = problem_of(UnmappedVolumeGain{});
  EXPECT_EQ(in_cells.seen, 8000.0);
  EXPECT_NEAR(in_m3.seen, 8.0, 1e-9);
  EXPECT_NEAR(in_m3.pace_per_s, 0.5, 1e-9);
  EXPECT_GT(in_cells.beyond_of(0), 100.0);
  for (std::size_t view = 0; view < 3; ++view) {
    EXPECT_NEAR(in_m3.beyond_of(view), 0.001 * in_cells.beyond_of(view), 1e-4);
  }
  const auto drawn = [](const PlanningProblem& problem) {
    Rng rng(1);
    const ShownBlocks shown = problem.draw(rng);
    double sum = 0.0;
    for (const float cells : shown.cells) sum += static_cast<double>(cells);
    return sum;
  };
  EXPECT_NEAR(drawn(in_cells), 8000.0, 0.1) << "whatever is drawn is seen or not";
  EXPECT_NEAR(drawn(in_m3), 8.0, 1e-4);
}

TEST(ViewProblem, KnowsWhatLiesBeyondInTheFirstColumnOfAMap) {
  Room room;
  for (int z = 0; z < 10; ++z) room.grid.log_odds[room.grid.frame.index({0, 0, z})] = 0.0F;
  ViewPlanningInput input = room.input(AdaptiveGain{});
  input.elapsed_s = 16.0;
  const PlanningProblem problem = make_view_problem(input, {.beyond_m = 8.0});
  EXPECT_NEAR(shown_and_beyond(problem), 8010.0, 80.0);
  EXPECT_EQ(problem.seen, 7990.0);
}

TEST(ViewProblem, IsMadeByOneThreadAtAnUnknownPaceUnlessItIsSaid) {
  const Room room;
  const ViewPlanningInput input{.map = {room.grid, &room.transmission},
                                .gain = SimpleGain{},
                                .candidates = room.views,
                                .places_m = room.places_m,
                                .field_of_view = room.field,
                                .paths = room.paths,
                                .travel_time = TravelTime(0.5)};
  EXPECT_EQ(input.threads, 1);
  EXPECT_EQ(input.elapsed_s, 0.0);
  EXPECT_EQ(make_view_problem(input, {}).scan_s, 0.0);
}

TEST(ViewProblem, OfAViewOutOfReachIsInfinitelyFar) {
  Room room;
  room.views[0].reachable = false;
  const PlanningProblem problem = make_view_problem(room.input(AdaptiveGain{}), {});
  EXPECT_EQ(affordable_views(problem), (std::vector<std::size_t>{1, 2}));
}

TEST(ViewProblem, OfAGainThatCannotBeSweptCountsEachViewAlone) {
  const Room room;
  ViewPlanningInput input = room.input(FsmiGain{});
  input.elapsed_s = 16.0;
  const PlanningProblem problem = make_view_problem(input, {.beyond_m = 8.0});
  EXPECT_TRUE(problem.beyond.empty()) << "what they leave is not known";
  const std::vector<std::size_t> near{1, 2};
  EXPECT_NEAR(joint_gain(problem, near), gain_of(problem, 1) + gain_of(problem, 2), 1e-3);
}

/// The truth: view 0 shows the cells that `shows` says, the others nothing.
void let_view_0_show(Room& room, auto&& shows) {
  for (Candidate& view : room.views) {
    auto shown = std::make_shared<CellSet>((room.grid.size() + 63) / 64, 0U);
    for (std::size_t cell = 0; view.id == 0 && cell < room.grid.size(); ++cell) {
      if (shows(room.grid.frame.cell(cell))) (*shown)[cell / 64] |= 1ULL << (cell % 64);
    }
    view.true_new_cell_set = shown;
  }
}

TEST(TrueViewProblem, HasWhatTheViewsReallyShow) {
  Room room;
  let_view_0_show(room, [](const Eigen::Array3i& at) {  // a corner of 10 x 5 x 10 cells
    return at.x() < 10 && at.y() >= 20 && at.y() < 25;
  });
  const PlanningProblem problem = make_true_view_problem(room.input(SimpleGain{}), {});
  EXPECT_NEAR(gain_of(problem, 0), 500.0, 1e-2);
  EXPECT_EQ(gain_of(problem, 1), 0.0);
  double unobserved = 0.0;
  for (std::size_t cell = 0; cell < room.grid.size(); ++cell) {
    unobserved += room.grid.state(cell) == CellState::unobserved ? 1.0 : 0.0;
  }
  EXPECT_EQ(std::accumulate(problem.cells.begin(), problem.cells.end(), 0.0), unobserved);
}

TEST(DrawnMap, IsOpaqueAsOftenAsBeamsAreStopped) {
  const Room room;
  const DrawableMap belief({room.grid, &room.transmission}, 2);
  Rng rng(3);
  double opaque = 0.0;
  double unobserved = 0.0;
  for (int k = 0; k < 20; ++k) {
    const Attenuation drawn = belief.draw(rng);
    for (std::size_t cell = 0; cell < belief.grid().size(); ++cell) {
      const bool known = belief.grid().state(cell) != CellState::unobserved;
      if (known) {
        EXPECT_EQ(drawn.transmission.per_block[cell], 1.0);
      }
      unobserved += known ? 0.0 : 1.0;
      opaque += drawn.transmission.per_block[cell] == 0.0 ? 1.0 : 0.0;
    }
  }
  EXPECT_NEAR(unobserved / 20.0, 20.0 * 10.0 * 5.0, 1e-9);
  // 1 - 0.98^2, within four standard deviations
  const double p = 1.0 - 0.98 * 0.98;
  EXPECT_NEAR(opaque / unobserved, p, 4.0 * std::sqrt(p / unobserved));
}

/// On average over drawn maps a view shows what `adaptive` expects.
TEST(DrawnMap, ShowsOnAverageWhatIsExpected) {
  const Room room;
  const PlanningProblem problem =
      make_view_problem(room.input(AdaptiveGain{}), {.block_m = 0.4, .drawn_cells = 1});
  Rng rng(4);
  double sum = 0.0;
  constexpr int kDraws = 30;
  for (int k = 0; k < kDraws; ++k) {
    PlanningProblem drawn = problem;
    ShownBlocks shown = problem.draw(rng);
    drawn.cells = shown.cells;
    drawn.shows = shown.shows;
    sum += gain_of(drawn, 1);
  }
  EXPECT_NEAR(sum / kDraws, gain_of(problem, 1), 0.05 * gain_of(problem, 1));
}

TEST(ViewProblem, HasBlocksAsLargeAsTheyAreSaidToBe) {
  const Room room;  // of 40 x 40 x 10 cells of 0.1 m
  const auto blocks = [&](double block_m) {
    return make_view_problem(room.input(SimpleGain{}), {.block_m = block_m}).cells.size();
  };
  EXPECT_EQ(blocks(0.4), 10U * 10U * 3U);
  EXPECT_EQ(blocks(0.22), 20U * 20U * 5U);
  EXPECT_EQ(blocks(0.01), 16000U) << "a cell at least";
}

/// Four images all round, each a little more than a quarter.
PartialScans quarters(const GazeOptions& gaze) {
  std::vector<Gaze> gazes;
  for (int i = 0; i < 4; ++i) gazes.push_back({1.5707963267948966 * i, 0.0});
  return {{std::move(gazes), 1.0, 2.0}, gaze};
}

TEST(ViewProblem, OfPartialScansHasTheImagesThatAreWorthTheirTime) {
  const Room room;
  ViewPlanningInput input = room.input(SimpleGain{});
  const PlanningProblem whole = make_view_problem(input, {});
  const PartialScans scans = quarters({.worth = 1.0});
  input.partial_scans = &scans;
  const PlanningProblem partial = make_view_problem(input, {});
  ASSERT_EQ(partial.scan_share.size(), 3U);
  EXPECT_EQ(partial.scan_s, 7.0);
  for (std::size_t view = 0; view < 3; ++view) {
    const double share = partial.scan_share[view];
    EXPECT_GE(share, 0.25);
    EXPECT_LT(share, 1.0);
    EXPECT_EQ(partial.scan_s_of(view), 7.0 * share);
    EXPECT_GT(gain_of(partial, view), share * gain_of(whole, view)) << "the best images";
    EXPECT_LT(gain_of(partial, view), gain_of(whole, view));
    for (const std::uint32_t block : partial.shows[view].block) {
      EXPECT_TRUE(std::ranges::binary_search(whole.shows[view].block, block));
    }
  }
  EXPECT_TRUE(whole.scan_share.empty());
  EXPECT_EQ(whole.scan_s_of(1), 7.0);
}

TEST(ViewProblem, DrawsWhatPartialScansShow) {
  const Room room;
  ViewPlanningInput input = room.input(SimpleGain{});
  const PartialScans scans = quarters({.worth = 1.0});
  const auto drawn_gain = [&](const PartialScans* partial) {
    input.partial_scans = partial;
    PlanningProblem problem = make_view_problem(input, {.drawn_cells = 1});
    Rng rng(4);
    ShownBlocks shown = problem.draw(rng);
    problem.cells = shown.cells;
    problem.shows = shown.shows;
    return gain_of(problem, 1);
  };
  EXPECT_LT(drawn_gain(&scans), 0.95 * drawn_gain(nullptr));
  EXPECT_GT(drawn_gain(&scans), 0.25 * drawn_gain(nullptr));
}

TEST(ViewProblem, OfTruthHasPartialScansToo) {
  Room room;
  // The first view shows what is above y = 1 and x = -1 to its left, nothing else.
  for (Candidate& view : room.views) {
    auto shown = std::make_shared<CellSet>((room.grid.size() + 63) / 64, 0U);
    for (std::size_t cell = 0; view.id == 0 && cell < room.grid.size(); ++cell) {
      const Eigen::Array3i at = room.grid.frame.cell(cell);
      if (at.y() >= 32 && at.x() >= 8 && at.x() < 12) (*shown)[cell / 64] |= 1ULL << (cell % 64);
    }
    view.true_new_cell_set = shown;
  }
  ViewPlanningInput input = room.input(SimpleGain{});
  const PartialScans scans = quarters({.worth = 1.0});
  input.partial_scans = &scans;
  const PlanningProblem problem = make_true_view_problem(input, {});
  EXPECT_EQ(problem.scan_share[0], 0.25) << "one image shows all of it";
  EXPECT_NEAR(gain_of(problem, 0), 4.0 * 8.0 * 10.0, 1e-2);
}

TEST(ViewProblem, ScansStayWholeWhereNothingIsKnownOfDirections) {
  const Room room;
  ViewPlanningInput input = room.input(FsmiGain{});
  const PartialScans scans = quarters({.worth = 1.0});
  input.partial_scans = &scans;
  EXPECT_TRUE(make_view_problem(input, {}).scan_share.empty());
}

/// A view that nothing leads to yet might be come to from anywhere.
TEST(ViewProblem, AScanOutOfReachStaysWhole) {
  Room room;
  for (Candidate& view : room.views) view.reachable = false;
  room.places_m = {{-1.0, 0.5}, {9.0, 0.5}, {1.0, 0.6}};
  ViewPlanningInput input = room.input(SimpleGain{});
  const PartialScans scans = quarters({.worth = 1.0});
  input.partial_scans = &scans;
  const PlanningProblem problem = make_view_problem(input, {});
  EXPECT_EQ(problem.scan_share[1], 1.0);
  EXPECT_LT(problem.scan_share[0], 1.0) << "one can come from the third";
}

/// Of 8000 known cells. The first view shows 320 cells to its left and 160 ahead.
TEST(ViewProblem, AnImageIsTakenFromAShareOfTheKnownCellsOn) {
  Room room;
  for (Candidate& view : room.views) {
    auto shown = std::make_shared<CellSet>((room.grid.size() + 63) / 64, 0U);
    const auto show = [&](int x_begin, int y_begin) {
      for (int x = x_begin; x < x_begin + 4; ++x) {
        for (int y = y_begin; y < y_begin + 4; ++y) {
          for (int z = 0; z < 10; ++z) {
            const std::size_t cell = room.grid.frame.index({x, y, z});
            (*shown)[cell / 64] |= 1ULL << (cell % 64);
          }
        }
      }
    };
    if (view.id == 0) {  // stands at cell (10, 25)
      show(8, 36);
      show(12, 36);
      show(28, 24);
    }
    view.true_new_cell_set = shown;
  }
  ViewPlanningInput input = room.input(SimpleGain{});
  const auto expect = [&](double share, double images, double cells) {
    const PartialScans scans = quarters({.share = share});
    input.partial_scans = &scans;
    const PlanningProblem problem = make_true_view_problem(input, {});
    EXPECT_EQ(problem.scan_share[0], 0.25 * images) << share;
    EXPECT_NEAR(gain_of(problem, 0), cells, 1e-2) << share;
  };
  expect(0.019, 2.0, 480.0);  // 152
  expect(0.021, 1.0, 320.0);  // 168
  expect(0.05, 1.0, 320.0);   // 400: the best one all the same
}

/// A lookout is weighed as the view of a problem from there, with what is known in the gain's unit.
TEST(ImagesOfALookout, AreWeighedAsThoseOfAView) {
  const Room room;
  const SweepImages images = quarters({}).images;
  const CellBlocks blocks = blocks_of(room.grid.frame, 0.4);
  const Pose T_world_sweep = room.views[0].T_world_sensor;
  for (const bool in_cells : {true, false}) {
    const Gain gain = in_cells ? Gain(SimpleGain{}) : Gain(UnmappedVolumeGain{});
    const PlanningProblem whole = make_view_problem(room.input(gain), {});
    const Lookout lookout{.grid = room.grid,
                          .attenuation = attenuation_of(gain, {room.grid}),
                          .field_of_view = room.field,
                          .T_world_sweep = T_world_sweep,
                          .block_m = 0.4};
    const SeenBlocks seen{room.grid.frame, blocks, whole.cells, whole.shows[0], T_world_sweep};
    const std::vector<double> gains = gains_of_images(images, lookout);
    EXPECT_EQ(gains, gains_of_images(images, seen));
    const double known = in_cells ? 8000.0 : 8.0;
    std::vector<GazeOptions> all{{.worth = 0.5}, {.worth = 1.0}, {.worth = 2.0}};
    for (const double share : {0.01, 0.02, 0.05, 0.1}) all.push_back({.share = share});
    for (const GazeOptions& gaze : all) {
      EXPECT_EQ(worthwhile_images(PartialScans{images, gaze}, ScanToCome{lookout, 8.0, 3.0}),
                worthwhile_images(StopOffer{gains, 2.0, 3.0, known}, gaze))
          << gaze.worth << ' ' << gaze.share;
    }
  }
}

TEST(ViewProblem, OfAGainThatCannotBeSweptKnowsWhatIsSeen) {
  const Room room;
  EXPECT_EQ(make_view_problem(room.input(FsmiGain{}), {}).seen, 8000.0);
  const PlanningProblem of_areas = make_view_problem(room.input(AreaFactorGain{}), {});
  EXPECT_EQ(of_areas.seen, 0.0) << "of 2, no cells";
  Rng rng(1);
  EXPECT_GT(std::ranges::max(of_areas.draw(rng).cells), 0.0F) << "by cells draws are compared";
}

TEST(TrueViewProblem, HasNothingBeyondAllViews) {
  Room room;
  let_view_0_show(room, [](const Eigen::Array3i&) { return false; });
  ViewPlanningInput input = room.input(SimpleGain{});
  input.elapsed_s = 16.0;
  const PlanningProblem problem = make_true_view_problem(input, {.beyond_m = 8.0});
  EXPECT_TRUE(problem.beyond.empty());
  EXPECT_EQ(problem.pace_per_s, 0.0);
}

TEST(ViewProblem, AnImageIsWeighedByItsTimeAndTheWayFromHere) {
  Room room;
  let_view_0_show(room, [](const Eigen::Array3i& at) {
    const bool left = at.y() >= 36 && at.x() >= 8 && at.x() < 16;
    const bool ahead = at.y() >= 24 && at.y() < 28 && at.x() >= 28 && at.x() < 32;
    return left || ahead;
  });
  ViewPlanningInput input = room.input(SimpleGain{});
  const auto share_taken = [&](double worth) {
    const PartialScans scans = quarters({.worth = worth});
    input.partial_scans = &scans;
    return make_true_view_problem(input, {}).scan_share[0];
  };
  EXPECT_EQ(share_taken(2.1), 0.5);
  EXPECT_EQ(share_taken(2.2), 0.25);
}

}  // namespace
}  // namespace vantage
