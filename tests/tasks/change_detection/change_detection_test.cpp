// Is the object on the table as the map says? Whole short episodes, and what each scenario makes.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/small_recognition.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
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

}  // namespace
}  // namespace vantage
