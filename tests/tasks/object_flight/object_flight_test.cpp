// Which objects a flight looks at, one after the other or all at once, and where they stand.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/flight/two_objects.hpp"
#include "tests/tasks/object_flight/scripted_flight.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/flight/object_mjcf.hpp"
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

/// As if its colour were so likely of the bowl in its bin 2, and of anything else.
ExtractFeature colour_of_that_bowl(double p_that, double p_else) {
  Eigen::VectorXd log_p = Eigen::VectorXd::Constant(8, std::log(p_else));
  log_p[6] = std::log(p_that);
  return [log_p](std::size_t /*feature*/) {
    return ExtractedFeature{.result = {}, .time_s = 0.25, .log_likelihood = log_p};
  };
}

ExtractFeature no_colour() {
  return [](std::size_t /*feature*/) {
    return ExtractedFeature{.result = FeatureResult::skip("hidden")};
  };
}

RecognitionOptions all_of_it(int max_views, const EnoughViews& enough) {
  RecognitionOptions options;
  options.all_features = true;
  options.transition = RigidTransition{.slip = 0.0};
  options.max_views = max_views;
  options.enough = enough;
  return options;
}

TEST(ObjectInquiry, ReportsItsViewsAndTurnsWhatItBelieves) {
  const Recogniser recogniser = support::recogniser_by_colour();
  const RecognitionOptions options = all_of_it(8, {.object_probability = 1.0, .entropy_bits = 0.0});
  ChangeOptions of_change;
  of_change.recognition = options;
  for (ObjectInquiry inquiry : {ObjectInquiry(recogniser, options),
                                ObjectInquiry(recogniser, of_change, "bowl_2", std::numbers::pi)}) {
    Rng rng(1);
    inquiry.observe(colour_of_that_bowl(0.5, 0.01), 0.75, 0.125, rng);
    const ViewReport view = inquiry.recognition().views.back();
    EXPECT_EQ(view.view_rad, 0.75);
    EXPECT_EQ(view.view_time_s, 0.125);
    EXPECT_EQ(view.feature_time_s, 0.25);
    EXPECT_THAT(view.features, ElementsAre("colour"));
    EXPECT_EQ(most_probable_state(inquiry.recognition().belief), 6);
    inquiry.turned(0.5 * std::numbers::pi);
    EXPECT_EQ(most_probable_state(inquiry.recognition().belief), 5);
  }
}

/// Of eight states alike the first view leaves one with 4/11, the second with 16/23.
TEST(ObjectInquiry, SaysWhyItKnowsWhatItIs) {
  const Recogniser recogniser = support::recogniser_by_colour();
  const auto over_after = [&](int views, int max_views, const EnoughViews& enough) {
    ObjectInquiry inquiry(recogniser, all_of_it(max_views, enough));
    EXPECT_FALSE(inquiry.of_change());
    Rng rng(1);
    for (int i = 0; i < views; ++i) inquiry.observe(colour_of_that_bowl(0.8, 0.2), 0.0, 0.0, rng);
    return inquiry.over();
  };
  const EnoughViews never{.object_probability = 1.0, .entropy_bits = 0.0};
  EXPECT_EQ(over_after(1, 2, never), "");
  EXPECT_EQ(over_after(2, 2, never), "limit of 2 views, not sure");
  const EnoughViews probable{.object_probability = 0.7, .entropy_bits = 0.0};
  EXPECT_EQ(over_after(1, 8, probable), "") << "7/11";
  EXPECT_EQ(over_after(2, 8, probable),
            "sure: bowl_2 with probability 0.826, above enough.object_probability 0.7");
  const EnoughViews certain{.object_probability = 1.0, .entropy_bits = 2.8};
  const double entropy_bits = -4.0 / 11.0 * std::log2(4.0 / 11.0) + 7.0 / 11.0 * std::log2(11.0);
  EXPECT_EQ(over_after(1, 8, certain),
            fmt::format("sure: entropy {:.3g} bits, below enough.entropy_bits 2.8", entropy_bits));
  const EnoughViews surer{.object_probability = 1.0, .entropy_bits = 2.0};
  EXPECT_EQ(over_after(1, 8, surer), "");
  const double after_two_bits = std::log2(23.0) - 16.0 / 23.0 * 4.0;
  EXPECT_EQ(over_after(2, 8, surer),
            fmt::format("sure: entropy {:.3g} bits, below enough.entropy_bits 2", after_two_bits));
}

/// Each view makes a change four times as likely, or a fourth.
TEST(ObjectInquiry, SaysWhyItKnowsWhetherItHasChanged) {
  const Recogniser recogniser = support::recogniser_by_colour();
  ChangeOptions options;
  const auto after = [&](int views, int max_views, const ExtractFeature& extract) {
    options.recognition = all_of_it(max_views, {});
    ObjectInquiry inquiry(recogniser, options, "bowl_2", std::numbers::pi);
    EXPECT_TRUE(inquiry.of_change());
    Rng rng(1);
    for (int i = 0; i < views; ++i) inquiry.observe(extract, 0.0, 0.0, rng);
    return inquiry;
  };
  const ExtractFeature as_before = colour_of_that_bowl(0.8, 0.2);
  const ExtractFeature otherwise = colour_of_that_bowl(0.2, 0.8);
  EXPECT_EQ(after(2, 8, as_before).over(), "");
  EXPECT_NEAR(after(2, 8, as_before).p_changed(), 1.0 / 17.0, 1e-9);
  EXPECT_EQ(after(2, 8, as_before).verdict(), Change::none);
  EXPECT_EQ(after(2, 2, as_before).over(), "limit of 2 views, still in doubt");
  EXPECT_EQ(after(3, 8, as_before).over(),
            "sure of no change: probability 0.0154, below unchanged_below 0.05");
  EXPECT_NEAR(after(2, 8, otherwise).p_changed(), 16.0 / 17.0, 1e-9);
  EXPECT_EQ(after(2, 8, otherwise).verdict(), Change::pose);
  EXPECT_EQ(after(3, 8, otherwise).over(),
            "sure of a change: probability 0.985, above changed_above 0.95");
  const ObjectInquiry empty = after(2, 8, no_colour());
  EXPECT_EQ(empty.over(), "2 views in a row without the object (empty_views)");
  EXPECT_EQ(empty.p_changed(), 1.0);
  EXPECT_EQ(empty.verdict(), Change::removed);
}

/// By the turn that a view takes; of equal ones the first.
TEST(TargetTour, TheBestViewOfAllTargetsIsTaken) {
  const TargetTour tour = tour_of_three(true);
  RecognitionOptions by_turn;
  by_turn.views.choice = StarView{};
  const auto next_of = [&](const std::vector<std::pair<std::size_t, double>>& turns_rad) {
    std::vector<BearingOption> options;
    for (const auto& [target, yaw_rad] : turns_rad) {
      options.push_back(
          {.id = 0, .bearing_rad = 0.0, .action = {.yaw_rad = yaw_rad}, .target = target});
    }
    Rng rng(1);
    return next_view(tour, kRecogniser, by_turn, options, rng).decision;
  };
  const ObjectViewDecision decision =
      next_of({{0, 0.5}, {0, -2.0}, {1, 1.0}, {1, -3.0}, {1, 2.75}, {2, 2.5}});
  EXPECT_EQ(decision.action, 3U);
  std::vector<double> scores;
  for (const ObjectViewScore& score : decision.scores) scores.push_back(score.score);
  EXPECT_THAT(scores, ElementsAre(0.5, 2.0, 1.0, 3.0, 2.75, 2.5));
  EXPECT_EQ(next_of({{0, 0.5}, {0, 2.0}, {1, 2.0}, {2, 2.0}}).action, 1U);
  EXPECT_EQ(next_of({{1, 0.5}, {2, 0.25}, {2, 1.0}}).action, 2U);
}

TEST(ObjectFlight, FindsItsFilesBesideItsEpisode) {
  const support::TemporaryDirectory folder;
  write_file(folder / "my.model", "bytes");
  std::filesystem::create_directory(folder / "objects");
  ObjectFlight task;
  task.model = "my.model";
  task.database.models = "objects";
  task.find_files(folder.path());
  EXPECT_EQ(task.model, (folder / "my.model").string());
  EXPECT_EQ(task.database.models, (folder / "objects").string());
  ASSERT_EQ(task.inputs().size(), 1U);
  EXPECT_EQ(task.inputs()[0].path, folder / "my.model");
}

TEST(ObjectOnTable, IsPutIntoTheSceneWhereItStands) {
  ObjectFlight task;
  task.table_m = {1.0, 2.0, 0.75};
  const std::vector<MemoryFile> nothing = object_files(task, ObjectOnTable{});
  ASSERT_EQ(nothing.size(), 1U);
  EXPECT_EQ(nothing[0].name, "object.xml");
  EXPECT_THAT(nothing[0].content, HasSubstr("<body name=\"object\"/>"));
  const ObjectOnTable mug{.object = "mug_1",
                          .category = "mug",
                          .yaw_rad = std::numbers::pi,
                          .offset_m = {0.25, -0.5},
                          .told_m = {0.125, 0.0}};
  const std::vector<MemoryFile> files = object_files(task, mug);
  const TurntableObject made = make_turntable_object(dataset_of(task.database), {"mug", "mug_1"});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_THAT(files[0].content, HasSubstr(R"(<body name="object" pos="1.25 1.5 0.75")"));
  EXPECT_EQ(files[1].name, "object.obj");
  EXPECT_EQ(files[1].content, made.obj);
  EXPECT_EQ(files[2].name, "object.png");
  EXPECT_EQ(files[2].content, made.png);
  EXPECT_EQ(body_of_target(0), "object");
  EXPECT_EQ(body_of_target(2), "object_2");
  EXPECT_EQ(drawn_yaw_rad(3, "object yaw"),
            Rng::stream(3, "object yaw").uniform(0.0, 2.0 * std::numbers::pi));
}

}  // namespace
}  // namespace vantage
