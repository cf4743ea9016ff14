// Whole short episodes of recognition: a small database is rendered and learnt, then flown round.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/drawn_pixels.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/small_recognition.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/drawn_scene.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/validate.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using support::make_small_model;
using support::small_flight;

const fs::path kRecognition = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/recognition.yaml";

class RecognitionEpisode : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::quiet);
    folder_.emplace();
    make_small_model(folder_->path());
    first_ = metrics_of("first", {});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::vector<std::string> overrides(const std::vector<std::string>& more) {
    std::vector<std::string> all = small_flight(folder_->path());
    all.emplace_back("enough={object_probability: 1, entropy_bits: 0}");
    all.emplace_back("object=cereal_box_1");
    all = support::overridden(std::move(all), more);
    return all;
  }
  static json metrics_of(const std::string& name, const std::vector<std::string>& more) {
    RunOptions options;
    options.directory = *folder_ / name;
    const RunOutcome outcome = run(load_episode(kRecognition, overrides(more)), options);
    return json::parse(outcome.metrics);
  }

  static inline std::optional<support::TemporaryDirectory> folder_;
  static inline json first_;
};

TEST_F(RecognitionEpisode, SaysWhatTheContractAsksFor) {
  EXPECT_EQ(first_["task"], "recognition");
  EXPECT_EQ(first_["status"], "completed");
  EXPECT_EQ(first_["reason"], "limit of 2 views, not sure");
  EXPECT_EQ(first_["method"], "mutual_information");
  EXPECT_EQ(first_["truth"], "cereal_box_1");
  EXPECT_EQ(first_["correct"], first_["estimate"] == "cereal_box_1");
  EXPECT_TRUE(first_["category_correct"].is_boolean());
  EXPECT_GE(first_["entropy_bits"], 0.0);
  EXPECT_LE(first_["map_probability"], 1.0);
  EXPECT_LE(first_["bin_error"], 4);
  ASSERT_EQ(first_["observations"].size(), 2U);
  for (const json& view : first_["observations"]) {
    for (const char* key :
         {"view_rad", "entropy_bits", "feature_time_s", "selection_time_s", "view_time_s"}) {
      EXPECT_TRUE(view.at(key).is_number()) << key;
    }
    EXPECT_LT(view["position_error_m"], 0.05);
    EXPECT_GT(view["object_px"], 40);
  }
  EXPECT_THAT(first_["observations"][0]["features"], testing::Not(testing::IsEmpty()));
  EXPECT_EQ(first_["observations"].back()["entropy_bits"], first_["entropy_bits"]);
  EXPECT_EQ(first_["collisions"], 0);
}

TEST_F(RecognitionEpisode, KnowsAnObjectThatIsLikeNoOther) {
  EXPECT_EQ(first_["correct"], true) << first_["estimate"];
}

TEST_F(RecognitionEpisode, FliesToAnotherBearingAndTurnsWhatItBelieves) {
  const json& views = first_["observations"];
  EXPECT_EQ(views[0]["chosen_view"], 0);
  EXPECT_NE(views[1]["chosen_view"], 0);
  const auto turned = [&](const char* key) {
    return wrap_angle(views[1][key].get<double>() - views[0][key].get<double>());
  };
  EXPECT_NEAR(wrap_angle(turned("view_rad") + turned("true_yaw_rad")), 0.0, 0.08);
}

TEST_F(RecognitionEpisode, WritesItsFolder) {
  for (const char* name :
       {"manifest.json", "config.yaml", "steps.csv", "metrics.json", "trajectory.tum",
        "trajectory_estimated.tum", "states.bin", "actions.csv", "report.html", "log.txt",
        "views/view_01.png", "views/view_02.png"}) {
    EXPECT_TRUE(fs::exists(*folder_ / "first" / name)) << name;
  }
  const std::string steps = read_file(*folder_ / "first" / "steps.csv");
  EXPECT_EQ(std::ranges::count(steps, '\n'), 3) << "a header and a row a view";
}

TEST_F(RecognitionEpisode, WhatItWritesIsDescribed) {
  EXPECT_EQ(test::undescribed(*folder_ / "first", RecognitionTask::records()),
            std::vector<std::string>{});
}

TEST_F(RecognitionEpisode, KeepsWhatEachDecisionWasMadeAmong) {
  const CsvTable table = read_csv(*folder_ / "first" / "candidates.csv");
  ASSERT_EQ(table.rows.size(), 7U) << "all bearings but the one it is at";
  const auto chosen =
      std::ranges::find(table.rows, "1", [](const auto& row) { return row.back(); });
  ASSERT_NE(chosen, table.rows.end());
  EXPECT_EQ((*chosen)[1], std::to_string(first_["observations"][1]["chosen_view"].get<int>()));
  const CsvTable steps = read_csv(*folder_ / "first" / "steps.csv");
  const std::vector<std::string> pose(steps.columns.begin() + 3, steps.columns.begin() + 8);
  EXPECT_EQ(pose, std::vector<std::string>(table.columns.begin() + 2, table.columns.begin() + 7));
  for (std::size_t i = 0; i < pose.size(); ++i) {
    EXPECT_NEAR(std::stod(steps.rows[1][3 + i]), std::stod((*chosen)[2 + i]), 0.1) << pose[i];
  }
}

TEST_F(RecognitionEpisode, PathLengthIsATotal) {
  double sum_m = 0.0;
  for (const json& view : first_["observations"]) {
    sum_m += view["leg_length_m"].get<double>();
    EXPECT_NEAR(view["path_length_m"].get<double>(), sum_m, 1e-9);
  }
  EXPECT_NEAR(first_["path_length_m"].get<double>(), sum_m, 1e-9);
}

TEST_F(RecognitionEpisode, ReplaysEveryState) {
  const ReplayResult result = support::replayed(*folder_ / "first");
  EXPECT_FALSE(result.first_difference) << result.what;
  EXPECT_GT(result.ticks, 500U);
}

TEST_F(RecognitionEpisode, SameSeedSameFlight) {
  EXPECT_EQ(metrics_of("second", {"threads=1"})["state_hash"], first_["state_hash"]);
  EXPECT_NE(metrics_of("other", {"seed=2", "max_views=1"})["state_hash"], first_["state_hash"]);
}

TEST_F(RecognitionEpisode, AQuadrotorThatTouchesSomethingHasFailed) {
  RunOptions options;
  options.directory = *folder_ / "blown";
  const std::string gust =
      "tracking.gusts=[{start_s: 0.05, duration_s: 2, force_N: 50, direction: [0, 0, "
      "-1]}]";
  const RunOutcome outcome =
      run(load_episode(kRecognition, overrides({gust, "settle_s=1.5"})), options);
  const json metrics = json::parse(outcome.metrics);
  EXPECT_EQ(outcome.code, ExitCode::goal_failed);
  EXPECT_EQ(metrics["status"], "failed");
  EXPECT_THAT(metrics["reason"].get<std::string>(), testing::HasSubstr("touched"));
  EXPECT_EQ(metrics["collisions"], 1);
  EXPECT_EQ(metrics["correct"], false);
  EXPECT_THAT(metrics["observations"], testing::IsEmpty());
  EXPECT_LT(metrics["simulated_time_s"], 1.5);
}

TEST_F(RecognitionEpisode, AMissingModelSaysHowToMakeOne) {
  const Validation found = validate_episode(kRecognition, overrides({"model=nowhere"}));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_THAT(found.problems[0],
              testing::AllOf(testing::HasSubstr("nowhere"),
                             testing::HasSubstr("assets/episodes/recognition.yaml")));
  EXPECT_EQ(found.code, ExitCode::bad_input);
}

TEST_F(RecognitionEpisode, AnObjectThatTheModelDoesNotKnowNeedsTheUnknown) {
  const std::vector<std::string> foreign{"database.objects=326", "object=lamp_2"};
  EXPECT_TRUE(validate_episode(kRecognition, overrides(foreign)).problems.empty());
  std::vector<std::string> certain = foreign;
  certain.emplace_back("recogniser.unknown_prior=0");
  const Validation found = validate_episode(kRecognition, overrides(certain));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_THAT(found.problems[0], testing::HasSubstr("lamp_2"));
  EXPECT_EQ(found.code, ExitCode::usage);
  EXPECT_TRUE(validate_episode(kRecognition, overrides({})).problems.empty());
}

TEST_F(RecognitionEpisode, WhatDoesNotFitIsToldBeforeItBegins) {
  const auto problem = [](const std::string& key_and_value) {
    const Validation found =
        validate_episode(kRecognition, overrides({"all_features=false", key_and_value}));
    return found.problems.size() == 1 && found.code == ExitCode::usage ? found.problems[0] : "";
  };
  EXPECT_THAT(problem("clutter={screens: 1, screen_m: 0.51}"), testing::HasSubstr("map.height_m"));
  EXPECT_EQ(problem("clutter={screens: 1, screen_m: 0.5}"), "");
  EXPECT_THAT(problem("features.first=colr"), testing::HasSubstr("features.first"));
  EXPECT_THAT(problem("transition={name: learned, slip: [1, 0, 0, 1]}"),
              testing::HasSubstr("slip has 4 numbers"));
}

TEST_F(RecognitionEpisode, AQuadrotorIsCommandedAtEveryStep) {
  EXPECT_THROW(load_episode(kRecognition, overrides({"simulation.control_period_s=0.02"})),
               ConfigError);
}

/// It holds its place by an estimate with errors.
TEST_F(RecognitionEpisode, TellsHowFarOffItsPlaceEachViewWasTaken) {
  for (const json& view : first_["observations"]) EXPECT_GT(view["position_error_m"], 1e-6);
}

TEST_F(RecognitionEpisode, KeepsTheSceneThatItsPageShows) {
  const DrawnScene scene = read_drawn_scene(*folder_ / "first/scene.bin");
  EXPECT_FALSE(scene.triangles[0].empty());
}

/// In the right half of a still: the orbit is 79.2 px round (518, 580) px.
TEST_F(RecognitionEpisode, ItsPanelHasAllPlacesToLookFrom) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  RunOptions options;
  options.directory = *folder_ / "filmed";
  options.video = true;
  const RunOutcome outcome = run(load_episode(kRecognition, overrides({"max_views=1"})), options);
  const double first_rad = json::parse(outcome.metrics)["observations"][0]["view_rad"];
  const cv::Mat still = cv::imread((*folder_ / "filmed/frames/scan_01.png").string());
  ASSERT_EQ(still.size(), cv::Size(1280, 720));
  for (int id = 1; id < 8; ++id) {
    const double bearing_rad = first_rad + 0.25 * std::numbers::pi * id;
    const cv::Point place(1158 + cvRound(79.2 * std::cos(bearing_rad)),
                          cvRound(580.2 - 79.2 * std::sin(bearing_rad)));
    EXPECT_GT(support::count_coloured(still, {place.x - 6, place.y - 6, 13, 13}, panel::kDim), 0)
        << id;
  }
}

/// It rests for settle_s, here 0.1 s, before each image, and ends with the last of them.
TEST_F(RecognitionEpisode, TellsWhenEachViewWasTaken) {
  const json& views = first_["observations"];
  const double first_s = views[0]["time_s"];
  const double second_s = views[1]["time_s"];
  EXPECT_NEAR(first_s, 0.1, 0.003);
  EXPECT_NEAR(second_s - first_s, views[1]["flight"]["duration_s"].get<double>() + 0.1, 0.003);
  EXPECT_NEAR(second_s, first_["simulated_time_s"].get<double>(), 1e-9);
}

}  // namespace
}  // namespace vantage
