// Which objects a flight looks at, one after the other or all at once, and where they stand.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/flight/two_objects.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/object_flight/object_flight_recorder.hpp"
#include "vantage/tasks/object_flight/object_on_table.hpp"
#include "vantage/tasks/object_flight/target_tour.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Recogniser kRecogniser = support::recogniser_of_two();

/// It is over at once.
ObjectInquiry inquiry_without_views() {
  RecognitionOptions options;
  options.max_views = 0;
  return {kRecogniser, options};
}

/// Of three objects, over once they were looked at.
TargetTour tour_of_three(bool all_at_once) {
  return {{.p_world_m = {{1.0, 0.0, 0.7}, {2.0, 0.0, 0.7}, {3.0, 0.0, 0.7}},
           .among_others = {},
           .all_at_once = all_at_once},
          inquiry_without_views()};
}

TEST(TargetTour, LooksAtOneObjectUntilItIsOver) {
  TargetTour tour = tour_of_three(false);
  EXPECT_EQ(tour.current_id(), 0U);
  EXPECT_THAT(tour.open(), ElementsAre(0U));
  tour.go_to(1);
  EXPECT_THAT(tour.open(), ElementsAre(1U));
  EXPECT_EQ(tour.current().p_world_m.x(), 2.0);
  tour.give_up(1, "no way");
  EXPECT_THAT(tour.open(), ElementsAre(0U, 2U)) << "any of the others";
  tour.give_up(0, "no way");
  tour.give_up(2, "no way");
  EXPECT_THAT(tour.open(), IsEmpty());
}

TEST(TargetTour, LooksAtAllThatAreNotOverAtOnce) {
  TargetTour tour = tour_of_three(true);
  EXPECT_THAT(tour.open(), ElementsAre(0U, 1U, 2U));
  tour.give_up(1, "no way");
  EXPECT_THAT(tour.open(), ElementsAre(0U, 2U));
}

/// Also where those of the object that is looked at were all taken.
TEST(TargetTour, NoViewIsTakenAgainWhileAnotherIsLeft) {
  const TargetTour tour = tour_of_three(true);
  const auto option = [](std::size_t target, bool visited) {
    return BearingOption{.id = 0,
                         .bearing_rad = 0.0,
                         .action = {.yaw_rad = std::numbers::pi, .visited = visited},
                         .target = target};
  };
  const auto chosen_of = [&](std::vector<BearingOption> options) {
    options[0].action.visible = 1.0;
    options.back().action.visible = 0.5;  // it is expected to tell less
    Rng rng(1);
    const NextView next = next_view(tour, kRecogniser, {}, options, rng);
    EXPECT_EQ(next.decision.scores.size(), options.size());
    return next.decision.action;
  };
  EXPECT_EQ(chosen_of({option(0, true), option(1, false)}), 1U);
  EXPECT_EQ(chosen_of({option(0, false), option(1, true)}), 0U);
  EXPECT_EQ(chosen_of({option(0, false), option(1, false)}), 0U);
  EXPECT_EQ(chosen_of({option(0, true), option(1, true)}), 0U);
}

TEST(TargetTour, SaysHowItHasEnded) {
  TargetTour tour = tour_of_three(false);
  tour.go_to(2);
  tour.current().bearing_ids = {4};
  tour.give_up(1, "no way");
  EXPECT_EQ(tour.reason(), "3 targets: not over; no way; limit of 0 views, not sure");
  tour.give_up(2, "no way");
  EXPECT_EQ(tour.targets()[2].over(), "limit of 0 views, not sure") << "what is known comes first";
  TargetTour one({.p_world_m = std::vector{Eigen::Vector3d(1.0, 0.0, 0.7)}, .among_others = {}},
                 inquiry_without_views());
  EXPECT_EQ(one.reason(), "");
  one.give_up(0, "no way");
  EXPECT_EQ(one.reason(), "no way");
}

TEST(TourTarget, IsTakenForAMiddlingThingUntilItIsSeen) {
  TourTarget target{.p_world_m = {1.0, 2.0, 0.7},
                    .inquiry = ObjectInquiry(kRecogniser, RecognitionOptions{})};
  EXPECT_FALSE(target.looked_at());
  EXPECT_EQ(target.expected_shape().p_foot_m, target.p_world_m);
  EXPECT_EQ(target.expected_shape().radius_m, 0.05);
  EXPECT_EQ(target.expected_shape().height_m, 0.14);
  target.shape = UprightCylinder{{1.0, 2.0, 0.7}, 0.08, 0.3};
  EXPECT_EQ(target.expected_shape().height_m, 0.3);
  target.bearing_ids = {3, 5};
  EXPECT_TRUE(target.looked_at());
  EXPECT_TRUE(target.visited(5));
  EXPECT_FALSE(target.visited(4));
}

TEST(ObjectFlight, LooksDownOnAPointAboveTheTable) {
  ObjectFlight task;
  task.table_m = {1.0, 2.0, 0.75};
  task.aim_height_m = 0.25;
  task.distance_m = 2.0;
  task.elevation_rad = 0.5;
  const Orbit orbit = task.orbit();
  EXPECT_NEAR((orbit.centre_m - Eigen::Vector3d(1.0, 2.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(orbit.radius_m, 2.0 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(orbit.height_m, 2.0 * std::sin(0.5), 1e-12);
  task.decision.max_views = 6;
  const TaskExtent extent = task.extent({});
  EXPECT_EQ(extent.key, "max_views");
  EXPECT_EQ(extent.text, "views at most");
  EXPECT_EQ(extent.count, 6U);
}

TEST(WrapTurn, GoesFromNothingToAFullTurn) {
  constexpr double kFull_rad = 2.0 * std::numbers::pi;
  EXPECT_EQ(wrap_turn(0.0), 0.0);
  EXPECT_NEAR(wrap_turn(-0.1), kFull_rad - 0.1, 1e-12);
  EXPECT_NEAR(wrap_turn(0.3 + 3.0 * kFull_rad), 0.3, 1e-12);
  EXPECT_NEAR(wrap_turn(0.3 - 2.0 * kFull_rad), 0.3, 1e-12);
  EXPECT_EQ(wrap_turn(4.0), 4.0);
}

TEST(ObjectOnTable, IsNamedOrAnyOfThem) {
  const std::vector<ObjectName> names{{"mug", "mug_1"}, {"mug", "mug_2"}, {"bowl", "bowl_1"}};
  EXPECT_EQ(named_or_drawn(names, "mug_2", "object", Rng(1)).object, "mug_2");
  std::set<std::string> drawn;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    drawn.insert(named_or_drawn(names, "", "object", Rng(seed)).object);
  }
  EXPECT_EQ(drawn.size(), 3U);
  try {
    named_or_drawn(names, "lamp_1", "expected_object", Rng(1));
    FAIL() << "there is none";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("expected_object: 'lamp_1' is none of the 3 objects from "
                                        "mug_1 to bowl_1"));
  }
}

/// As likely on any part of the disc: half of the draws are within sqrt(1/2) of its radius.
TEST(ObjectOnTable, StandsAnywhereOnTheDisc) {
  constexpr int kDraws = 2000;
  int inner = 0;
  int right = 0;
  for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
    const Eigen::Vector2d off_m = drawn_offset_m(seed, 0.02);
    EXPECT_LE(off_m.norm(), 0.02);
    inner += off_m.norm() < 0.02 * std::sqrt(0.5) ? 1 : 0;
    right += off_m.x() > 0.0 ? 1 : 0;
    const double yaw_rad = drawn_yaw_rad(seed, "object yaw");
    EXPECT_GE(yaw_rad, 0.0);
    EXPECT_LT(yaw_rad, 2.0 * std::numbers::pi);
  }
  EXPECT_NEAR(inner, 0.5 * kDraws, 150);
  EXPECT_NEAR(right, 0.5 * kDraws, 150);
}

TEST(ObjectFlightRecorder, KeepsNoImagesEventsOrSceneIfLean) {
  const support::TemporaryDirectory folder;
  write_file(folder / "scene.xml",
             "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  const ModelSource source{folder / "scene.xml", {}};
  World world(source);
  const EpisodeSetup setup{};
  RunOptions options;
  options.directory = folder / "run";
  options.lean = true;
  const RunRequest request{setup, "recognition", "star", "a: 1\n", {}, options};
  const EpisodeRun run(request);
  const auto at_origin = [] { return make_pose({0.0, 0.0, 1.0}, 0.0); };
  ObjectFlightRecorder recorder(
      run, {.world = world, .T_world_body = at_origin, .T_world_estimated = at_origin}, 8, false);
  recorder.observation({}, 1, {}, std::nullopt);
  recorder.commit();
  EXPECT_TRUE(std::filesystem::exists(options.directory / "steps.csv"));
  for (const char* name : {"views", "story.bin", "scene.bin", "candidates.csv", "states.bin"}) {
    EXPECT_FALSE(std::filesystem::exists(options.directory / name)) << name;
  }
  release_run_directory(options.directory);
}

/// As flights that were recorded have it: heading, then distance.
TEST(ObjectOnTable, StandsWhereItsSeedPutsIt) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng place = Rng::stream(seed, "object place");
    const double heading_rad = place.uniform(0.0, 2.0 * std::numbers::pi);
    const double distance_m = 0.02 * std::sqrt(place.uniform());
    const Eigen::Vector2d expected_m(distance_m * std::cos(heading_rad),
                                     distance_m * std::sin(heading_rad));
    EXPECT_NEAR((drawn_offset_m(seed, 0.02) - expected_m).norm(), 0.0, 1e-12) << seed;
  }
}

}  // namespace
}  // namespace vantage
