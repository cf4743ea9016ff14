// Whole short episodes of recognition among others on a table.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/small_recognition.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kEpisode = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/recognition_clutter.yaml";

class RecognitionAmongOthers : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::quiet);
    folder_.emplace();
    support::make_small_model(folder_->path());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static json metrics_of(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all = support::small_flight(folder_->path());
    all.emplace_back("enough={object_probability: 1, entropy_bits: 0}");
    all.emplace_back("database.objects=4");
    all.emplace_back("clutter={objects: 3, near_duplicates: 1, tall: 1}");
    all.emplace_back("bearings=6");
    all = support::overridden(std::move(all), more);
    RunOptions options;
    options.directory = *folder_ / name;
    const RunOutcome outcome = run(load_episode(kEpisode, all), options);
    return json::parse(outcome.metrics);
  }

  static inline std::optional<support::TemporaryDirectory> folder_;
};

TEST_F(RecognitionAmongOthers, MapsTheTableAndSaysWhatItSees) {
  const json metrics = metrics_of("first", {"max_views=3"});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_EQ(metrics["collisions"], 0);
  EXPECT_EQ(metrics["others"].size(), 3U);
  ASSERT_EQ(metrics["targets"].size(), 1U);
  EXPECT_EQ(metrics["targets"][0]["correct"], metrics["correct"]);
  ASSERT_EQ(metrics["observations"].size(), 3U);
  for (const json& view : metrics["observations"]) {
    EXPECT_GE(view["seen_share"], 0.0);
    EXPECT_LE(view["seen_share"], 1.0);
    EXPECT_GT(view["expected_visible"], 0.0);
  }
  EXPECT_LT(metrics["observations"][1]["expected_visible"], 1.0) << "some of it is not known";
  EXPECT_EQ(test::undescribed(*folder_ / "first", RecognitionTask::records()),
            std::vector<std::string>{});
  const VoxelMap voxels = read_voxels(*folder_ / "first" / "voxels.bin");
  EXPECT_GT(voxels.voxels.size(), 100U);
  const ReplayResult replay = support::replayed(*folder_ / "first");
  EXPECT_FALSE(replay.first_difference) << replay.what;
  EXPECT_EQ(metrics_of("again", {"max_views=3", "threads=1"})["state_hash"], metrics["state_hash"]);
}

TEST_F(RecognitionAmongOthers, EveryChoiceFlies) {
  std::map<std::string, int> second_view;
  for (const char* choice : {"random", "star", "nearest_free"}) {
    const json metrics =
        metrics_of(choice, {std::string("views={weight_per_s: 1, choice: ") + choice + "}"});
    EXPECT_EQ(metrics["status"], "completed") << choice;
    EXPECT_EQ(metrics["collisions"], 0) << choice;
    second_view[choice] = metrics["observations"].at(1)["chosen_view"];
  }
  EXPECT_EQ(second_view["star"], 3) << "of six, the one opposite";
  EXPECT_THAT(second_view["nearest_free"], testing::AnyOf(1, 2, 4, 5));
}

TEST_F(RecognitionAmongOthers, FliesFromTargetToTarget) {
  const json metrics = metrics_of(
      "several",
      {"targets=2", "targets_at_once=false", "clutter={objects: 2, near_duplicates: 0}", "seed=2"});
  EXPECT_EQ(metrics["status"], "completed") << metrics["reason"];
  EXPECT_EQ(metrics["collisions"], 0);
  ASSERT_EQ(metrics["targets"].size(), 2U);
  std::vector<int> order;
  for (const json& view : metrics["observations"]) order.push_back(view["target"]);
  EXPECT_THAT(order, testing::ElementsAre(1, 1, 2, 2)) << "one after the other";
  double right = 0.0;
  for (const json& target : metrics["targets"]) {
    EXPECT_EQ(target["views"], 2);
    EXPECT_THAT(target["over"].get<std::string>(), testing::HasSubstr("limit of 2 views"));
    right += target["correct"].get<bool>() ? 0.5 : 0.0;
  }
  EXPECT_EQ(metrics["targets_correct"], right);
  EXPECT_EQ(metrics["correct"], right == 1.0);
}

/// What is not known at all tells more than a second view.
TEST_F(RecognitionAmongOthers, AtOnceItLooksAtEachBeforeItLooksAgain) {
  const json metrics =
      metrics_of("at_once", {"targets=2", "clutter={objects: 2, near_duplicates: 0}", "seed=2",
                             "views={choice: mutual_information, weight_per_s: 0}"});
  EXPECT_EQ(metrics["status"], "completed") << metrics["reason"];
  EXPECT_EQ(metrics["collisions"], 0);
  std::vector<int> order;
  for (const json& view : metrics["observations"]) order.push_back(view["target"]);
  ASSERT_EQ(order.size(), 4U);
  EXPECT_EQ(order[1], 2);
}

TEST_F(RecognitionAmongOthers, NoViewIsTakenAfterTheLimit) {
  const json metrics = metrics_of("limited", {"max_views=6", "time_limit_s=5"});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_THAT(metrics["reason"].get<std::string>(), testing::HasSubstr("time_limit_s"));
  EXPECT_GE(metrics["observations"].size(), 2U);
  EXPECT_LT(metrics["observations"].size(), 6U);
  EXPECT_LT(metrics["simulated_time_s"], 7.0) << "it settles a little later than planned";
}

TEST_F(RecognitionAmongOthers, ItsMapHoldsWhatStandsOnTheTable) {
  metrics_of("mapped", {"max_views=1"});
  const VoxelMap map = read_voxels(*folder_ / "mapped" / "voxels.bin");
  EXPECT_GT(std::ranges::count(map.voxels, kVoxelOccupied, &VoxelRecord::kind), 20);
}

}  // namespace
}  // namespace vantage
