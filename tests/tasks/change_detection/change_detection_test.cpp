// Is the object on the table as the map says? Whole short episodes, and what each scenario makes.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/small_recognition.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/tasks/change_detection/change_ground_truth.hpp"
#include "vantage/tasks/recognition/recognition_ground_truth.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/validate.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kChange = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/change_detection.yaml";

class ChangeEpisode : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::quiet);
    folder_.emplace();
    support::make_small_model(folder_->path());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::vector<std::string> overrides(const std::string& scenario,
                                            const std::vector<std::string>& more) {
    std::vector<std::string> all = support::small_flight(folder_->path());
    all.emplace_back("expected_object=cereal_box_1");
    all.push_back("scenario=" + scenario);
    all = support::overridden(std::move(all), more);
    return all;
  }
  static json metrics_of(const std::string& scenario, const std::vector<std::string>& more = {}) {
    RunOptions options;
    options.directory = *folder_ / scenario;
    options.overwrite = true;
    const RunOutcome outcome = run(load_episode(kChange, overrides(scenario, more)), options);
    EXPECT_EQ(outcome.code, ExitCode::done);
    return json::parse(outcome.metrics);
  }

  static inline std::optional<support::TemporaryDirectory> folder_;
};

TEST_F(ChangeEpisode, NothingHasChanged) {
  const json metrics = metrics_of("none");
  EXPECT_EQ(metrics["task"], "change_detection");
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_EQ(metrics["scenario"], "none");
  EXPECT_EQ(metrics["decision"], "none");
  EXPECT_EQ(metrics["correct"], true);
  EXPECT_EQ(metrics["changed_correct"], true);
  EXPECT_EQ(metrics["truth"], "cereal_box_1");
  EXPECT_EQ(metrics["expected"]["object"], "cereal_box_1");
  EXPECT_EQ(metrics["expected"]["yaw_rad"], metrics["true_yaw_rad"]);
  EXPECT_LE(metrics["change_probability"], 0.6);
  EXPECT_EQ(metrics["detectable"], true);
  EXPECT_EQ(metrics["detectable_correct"], true);
  ASSERT_THAT(metrics["observations"], testing::Not(testing::IsEmpty()));
  const double seen_rad = metrics["expected"]["yaw_rad"].get<double>() -
                          metrics["observations"][0]["view_rad"].get<double>();
  EXPECT_NEAR(std::remainder(seen_rad, std::numbers::pi / 4.0), 0.0, 1e-9) << "mid of its bin";
  for (const json& view : metrics["observations"]) {
    for (const char* key : {"view_rad", "entropy_bits", "feature_time_s", "selection_time_s",
                            "view_time_s", "change_probability"}) {
      EXPECT_TRUE(view.at(key).is_number()) << key;
    }
    EXPECT_TRUE(view.at("features").is_array());
  }
  EXPECT_EQ(metrics["observations"].back()["change_probability"], metrics["change_probability"]);
}

TEST_F(ChangeEpisode, AnotherObjectIsFoundAndItsFlightReplays) {
  const json metrics = metrics_of("object");
  EXPECT_EQ(metrics["decision"], "object");
  EXPECT_EQ(metrics["correct"], true);
  EXPECT_NE(metrics["truth"], "cereal_box_1");
  EXPECT_GT(metrics["change_probability"], 0.6);
  const ReplayResult result = support::replayed(*folder_ / "object");
  EXPECT_FALSE(result.first_difference) << result.what;
  EXPECT_GE(result.ticks, 50U);
  EXPECT_EQ(test::undescribed(*folder_ / "object", ChangeDetectionTask::records()),
            std::vector<std::string>{});
  const std::string steps = read_file(*folder_ / "object" / "steps.csv");
  EXPECT_THAT(steps, testing::HasSubstr(",collisions,change_probability,decision\n"));
}

TEST_F(ChangeEpisode, ATurnedObjectIsFound) {
  const json metrics = metrics_of("pose", {"turned_rad=1.5707963267948966"});
  EXPECT_EQ(metrics["decision"], "pose");
  EXPECT_EQ(metrics["truth"], "cereal_box_1");
  EXPECT_NEAR(std::abs(wrap_angle(metrics["true_yaw_rad"].get<double>() -
                                  metrics["expected"]["yaw_rad"].get<double>())),
              0.5 * std::numbers::pi, 1e-9);
}

TEST_F(ChangeEpisode, ATurnWithinAYawBinCannotBeTold) {
  const json metrics = metrics_of("pose", {"turned_rad=0.1"});
  EXPECT_EQ(metrics["detectable"], false);
  EXPECT_EQ(metrics["detectable_correct"], false);
}

TEST_F(ChangeEpisode, WhatTheModelDoesNotKnowCanBeTold) {
  ChangeDetectionTask task;
  const auto names_of_first = [&](int objects) {
    task.database.objects = objects;
    std::vector<std::string> names;
    for (const ObjectName& name : known_objects(task)) names.push_back(name.object);
    return names;
  };
  const std::vector<std::string> known = names_of_first(support::kSmallObjects);
  std::vector<std::string> unknown = names_of_first(support::kSmallObjects + 1);
  std::erase_if(unknown,
                [&](const auto& name) { return std::ranges::find(known, name) != known.end(); });
  ASSERT_EQ(unknown.size(), 1U);
  const json metrics =
      metrics_of("object", {fmt::format("database.objects={}", support::kSmallObjects + 1),
                            "object=" + unknown.front()});
  EXPECT_EQ(metrics["truth"], unknown.front());
  EXPECT_EQ(metrics["detectable"], true);
}

TEST_F(ChangeEpisode, AnEmptyTableIsLookedAtTwice) {
  const json metrics = metrics_of("removed");
  EXPECT_EQ(metrics["decision"], "removed");
  EXPECT_EQ(metrics["correct"], true);
  EXPECT_EQ(metrics["change_probability"], 1.0);
  EXPECT_TRUE(metrics["truth"].is_null());
  EXPECT_TRUE(metrics["bin_error"].is_null());
  ASSERT_EQ(metrics["observations"].size(), 2U);
  EXPECT_THAT(metrics["observations"][0]["skipped"], testing::Not(testing::IsEmpty()));
  EXPECT_FALSE(support::replayed(*folder_ / "removed").first_difference);
}

TEST_F(ChangeEpisode, WhatCannotBeIsRefused) {
  EXPECT_THROW(load_episode(kChange, overrides("stolen", {})), ConfigError);
  EXPECT_THROW(load_episode(kChange, overrides("none", {"object=mug_1"})), ConfigError);
  EXPECT_THROW(load_episode(kChange, overrides("object", {"object=cereal_box_1"})), ConfigError);
  EXPECT_THROW(load_episode(kChange, overrides("pose", {"turned_rad=0"})), ConfigError);
  EXPECT_THROW(load_episode(kChange, overrides("pose", {"turned_rad=-6.283185307179586"})),
               ConfigError);
  EXPECT_NO_THROW(load_episode(kChange, overrides("object", {"turned_rad=0"})));
  EXPECT_THROW(load_episode(kChange, overrides("none", {"enough.object_probability=0.5"})),
               ConfigError);
  EXPECT_THROW(load_episode(kChange, overrides("none", {"enough.entropy_bits=0.5"})), ConfigError);
  const Validation found =
      validate_episode(kChange, overrides("pose", {"expected_object=spaceship_1"}));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_THAT(found.problems[0], testing::HasSubstr("expected_object"));
  EXPECT_THAT(validate_episode(kChange, overrides("object", {})).problems, testing::IsEmpty());
}

ChangeDetectionTask scenario(const std::string& name) {
  ChangeDetectionTask task;
  task.scenario = name;
  return task;
}

TEST(ChangeScenario, AnObjectThatIsExpectedAnywayIsNoChange) {
  ChangeDetectionTask task = scenario("object");
  task.object = draw_expected_object(task, 7).object;
  EXPECT_THAT([&] { draw_object(task, 7); },
              testing::ThrowsMessage<ConfigError>(testing::HasSubstr("nothing would change")));
}

TEST(ChangeScenario, MakesOfWhatIsExpectedWhatItSays) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ObjectOnTable expected = draw_expected_object(scenario("none"), seed);
    const ObjectOnTable same = draw_object(scenario("none"), seed);
    EXPECT_EQ(same.object, expected.object);
    EXPECT_EQ(same.yaw_rad, expected.yaw_rad);
    EXPECT_GT(same.offset_m.norm(), 0.0) << "nobody puts a thing exactly where it was";
    const ObjectOnTable turned = draw_object(scenario("pose"), seed);
    EXPECT_EQ(turned.object, expected.object);
    EXPECT_GT(std::abs(wrap_angle(turned.yaw_rad - expected.yaw_rad)), std::numbers::pi / 8.0);
    EXPECT_NE(draw_object(scenario("object"), seed).object, expected.object);
    EXPECT_TRUE(draw_object(scenario("removed"), seed).object.empty());
  }
}

TEST(ChangeScenario, StartsFromWhatARecognitionWouldSee) {
  const ObjectOnTable seen = draw_object(RecognitionTask{}, 7);
  const ObjectOnTable expected = draw_expected_object(scenario("object"), 7);
  EXPECT_EQ(seen.object, expected.object);
  EXPECT_EQ(seen.yaw_rad, expected.yaw_rad);
}

/// Knocked down before its first view.
TEST_F(ChangeEpisode, WithoutAViewNothingIsDecided) {
  RunOptions options;
  options.directory = *folder_ / "blown";
  const std::string gust =
      "tracking.gusts=[{start_s: 0.05, duration_s: 2, force_N: 50, direction: [0, 0, "
      "-1]}]";
  const RunOutcome outcome =
      run(load_episode(kChange, overrides("none", {gust, "settle_s=1.5"})), options);
  const json metrics = json::parse(outcome.metrics);
  EXPECT_EQ(outcome.code, ExitCode::goal_failed);
  EXPECT_THAT(metrics["observations"], testing::IsEmpty());
  EXPECT_TRUE(metrics["decision"].is_null());
  EXPECT_TRUE(metrics["change_probability"].is_null());
  for (const char* key : {"correct", "changed_correct", "detectable_correct"}) {
    EXPECT_EQ(metrics[key], false) << key;
  }
}

TEST_F(ChangeEpisode, NeverSureItTakesNoMoreViewsThanItMay) {
  const json metrics = metrics_of("none", {"max_views=1", "unchanged_below=0", "changed_above=1"});
  EXPECT_EQ(metrics["observations"].size(), 1U);
  EXPECT_THAT(metrics["reason"].get<std::string>(), testing::HasSubstr("limit of 1 views"));
}

/// It is commanded at every step, and has no wheels.
TEST(ChangeScenario, IsOfAFlightLikeAnyOther) {
  const ChangeDetectionTask task = scenario("none");
  EpisodeOptions episode;
  EXPECT_THROW(task.check_with(episode), ConfigError);
  episode.simulation.control_period_s = episode.simulation.timestep_s;
  EXPECT_NO_THROW(task.check_with(episode));
  episode.faults.odometry_slip = 0.1;
  EXPECT_THROW(task.check_with(episode), ConfigError);
}

/// More than half an eighth of a turn and less than the rest of it; nothing else is drawn anew.
TEST(ChangeScenario, TurnsTheObjectByAnythingThatAMapWouldTell) {
  constexpr double kHalfEighth_rad = std::numbers::pi / 8.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ObjectOnTable expected = draw_expected_object(scenario("pose"), seed);
    const ObjectOnTable turned = draw_object(scenario("pose"), seed);
    const double turn_rad =
        Rng::stream(seed, "object turned").uniform(kHalfEighth_rad, 15.0 * kHalfEighth_rad);
    EXPECT_NEAR(turned.yaw_rad, wrap_turn(expected.yaw_rad + turn_rad), 1e-9);
    EXPECT_EQ(turned.category, expected.category);
    EXPECT_EQ(turned.offset_m, drawn_offset_m(seed, ChangeDetectionTask{}.placement_m));
  }
}

TEST(ChangeScenario, PutsAnotherObjectThereAsItIsNamedAndTurned) {
  ChangeDetectionTask task = scenario("object");
  task.expected_object = "cereal_box_1";
  task.expected_yaw_rad = 7.0;
  const ObjectOnTable expected = draw_expected_object(task, 4);
  EXPECT_EQ(expected.object, "cereal_box_1");
  EXPECT_EQ(expected.category, "cereal_box");
  EXPECT_NEAR(expected.yaw_rad, 7.0 - 2.0 * std::numbers::pi, 1e-12);
  EXPECT_EQ(expected.offset_m.norm(), 0.0) << "the map has it in the middle";
  task.object = "mug_1";
  const ObjectOnTable there = draw_object(task, 4);
  EXPECT_EQ(there.object, "mug_1");
  EXPECT_EQ(there.category, "mug");
  EXPECT_EQ(there.yaw_rad, drawn_yaw_rad(4, "other object yaw"));
  EXPECT_EQ(there.offset_m, drawn_offset_m(4, task.placement_m));
  task.object = "unicorn_1";
  EXPECT_THROW(draw_object(task, 4), ConfigError);
  ChangeDetectionTask lonely = scenario("object");
  lonely.database.objects = 1;
  EXPECT_THROW(draw_object(lonely, 4), ConfigError) << "there is no other";
}

/// By less than a millionth of a radian.
TEST_F(ChangeEpisode, ATurnOfNothingIsRefused) {
  for (const char* turned : {"turned_rad=0.0000008", "turned_rad=-0.0000008"}) {
    EXPECT_THROW(load_episode(kChange, overrides("pose", {turned})), ConfigError) << turned;
  }
  for (const char* turned : {"turned_rad=0.0000015", "turned_rad=-0.0000015"}) {
    EXPECT_NO_THROW(load_episode(kChange, overrides("pose", {turned}))) << turned;
  }
  EXPECT_THROW(load_episode(kChange, overrides("none", {"prior_pose=0.6", "prior_object=0.5"})),
               ConfigError);
}

/// Held for as it was whatever it sees.
TEST_F(ChangeEpisode, AnExchangeThatIsNotFoundIsWrong) {
  const json metrics =
      metrics_of("object", {"max_views=1", "threshold=1", "changed_above=1", "unchanged_below=0"});
  EXPECT_EQ(metrics["decision"], "none");
  for (const char* key : {"correct", "changed_correct", "detectable_correct"}) {
    EXPECT_EQ(metrics[key], false) << key;
  }
}

/// Held for changed whatever it sees.
TEST_F(ChangeEpisode, AChangeThatIsNoneIsWrong) {
  const json metrics = metrics_of("none", {"max_views=1", "threshold=0", "unchanged_below=0"});
  EXPECT_NE(metrics["decision"], "none");
  for (const char* key : {"correct", "changed_correct", "detectable_correct"}) {
    EXPECT_EQ(metrics[key], false) << key;
  }
  EXPECT_EQ(metrics["detectable"], true);
  const double start_rad = Rng::stream(1, "start bearing").uniform(0.0, 2.0 * std::numbers::pi);
  const double first_rad = metrics["observations"][0]["view_rad"];
  EXPECT_LE(std::abs(wrap_angle(first_rad - start_rad)), std::numbers::pi / 8.0 + 1e-9)
      << "the nearest that is in the middle of a bin";
  EXPECT_GE(first_rad, 0.0);
}

/// A turn is no prior of its own, so that what is turned is taken for something else.
TEST_F(ChangeEpisode, AChangeOfAnotherKindIsHalfRight) {
  const json metrics = metrics_of("pose", {"turned_rad=1.5707963267948966", "max_views=1",
                                           "prior_pose=0", "threshold=0", "unchanged_below=0"});
  EXPECT_EQ(metrics["decision"], "object");
  EXPECT_EQ(metrics["correct"], false);
  EXPECT_EQ(metrics["changed_correct"], true);
  EXPECT_EQ(metrics["detectable_correct"], metrics["detectable"]);
}

TEST_F(ChangeEpisode, TheModelMustKnowWhatIsExpected) {
  const Validation found = validate_episode(
      kChange, overrides("none", {"database.objects=326", "expected_object=lamp_2"}));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_THAT(found.problems[0], testing::AllOf(testing::HasSubstr("lamp_2"),
                                                testing::HasSubstr("is expected there")));
  const std::vector<std::string> exchanged{"database.objects=326", "object=lamp_2"};
  EXPECT_THAT(validate_episode(kChange, overrides("object", exchanged)).problems,
              testing::IsEmpty())
      << "it may be unknown";
  std::vector<std::string> certain = exchanged;
  certain.emplace_back("recogniser.unknown_prior=0");
  EXPECT_THAT(validate_episode(kChange, overrides("object", certain)).problems,
              testing::ElementsAre(testing::HasSubstr("stands on the table")));
}

}  // namespace
}  // namespace vantage
