// Which episode a worker takes next, of a study where others are at work.
#include "vantage/study/sweep/work_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/study/manifest_of_files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;

class Work : public testing::Test {
 protected:
  void SetUp() override {
    const auto base = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml";
    const ResolvedEpisode resolved = load_episode(base, {});
    for (const char* name : {"a", "b", "c", "d", "e", "f"}) plan_.push_back({name, {0}, resolved});
    states_.assign(plan_.size(), EpisodeState::missing);
    options_.directory = study_.path();
  }
  void TearDown() override {
    for (const char* name : {"SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_ID",
                             "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_JOB_ID", "SLURM_CLUSTER_NAME"}) {
      ::unsetenv(name);
    }
  }
  /// Of everything that can be taken now, in order.
  static std::vector<std::size_t> taken_from(WorkList& list) {
    std::vector<std::size_t> episodes;
    while (const auto taken = list.take()) episodes.push_back(taken->episode);
    return episodes;
  }
  fs::path claims(std::size_t episode) { return claims_folder(study_.path(), plan_[episode]); }

  support::TemporaryDirectory study_;
  std::vector<PlannedEpisode> plan_;
  std::vector<EpisodeState> states_;
  StudySweepOptions options_;
};

TEST_F(Work, IsWhatHasNoResult) {
  states_[1] = EpisodeState::completed;
  states_[4] = EpisodeState::failed;
  WorkList list(plan_, options_, states_);
  EXPECT_EQ(list.open(), 4U);
  EXPECT_THAT(taken_from(list), ElementsAre(0U, 2U, 3U, 5U));
  EXPECT_EQ(list.open(), 0U);
}

/// The third of four tasks begins in the middle.
TEST_F(Work, OfATaskOfAnArrayBeginsWhereOthersDoNot) {
  ::setenv("SLURM_ARRAY_TASK_COUNT", "4", 1);
  ::setenv("SLURM_ARRAY_TASK_ID", "7", 1);
  ::setenv("SLURM_ARRAY_TASK_MIN", "5", 1);
  WorkList list(plan_, options_, states_);
  EXPECT_THAT(taken_from(list), ElementsAre(3U, 4U, 5U, 0U, 1U, 2U));
}

TEST_F(Work, OfATaskOfAnArrayThatBeginsAtZero) {
  ::setenv("SLURM_ARRAY_TASK_COUNT", "4", 1);
  ::setenv("SLURM_ARRAY_TASK_ID", "2", 1);
  WorkList list(plan_, options_, states_);
  ASSERT_TRUE(list.open() > 0);
  EXPECT_EQ(list.take()->episode, 3U);
}

TEST_F(Work, ThatOthersHaveDoneMeanwhileIsNotClaimed) {
  WorkList list(plan_, options_, states_);
  const fs::path folder = episode_folder(study_.path(), plan_[1]);
  fs::create_directories(folder);
  write_file(folder / "config.yaml", episode_yaml(plan_[1].resolved));
  write_file(folder / "manifest.json", manifest_of_files(plan_[1].resolved));
  write_file(folder / "metrics.json", R"({"status": "completed"})");
  EXPECT_THAT(taken_from(list), ElementsAre(0U, 2U, 3U, 4U, 5U));
  EXPECT_EQ(states_[1], EpisodeState::completed);
  EXPECT_FALSE(fs::exists(claims(1) / "1.json"));
}

/// A program that stands in for Slurm's says that of two jobs of this cluster one is at work.
TEST_F(Work, OfTasksOfThisClusterIsAskedOfSlurm) {
  const fs::path asked = study_ / "asked";
  write_file(study_ / "squeue", "#!/bin/sh\nprintf '%s\\n' \"$@\" > " + asked.string() +
                                    "\necho '12|0|RUNNING|None|0|n7|'\n");
  fs::permissions(study_ / "squeue", fs::perms::owner_all);
  const auto hold = [&](std::size_t episode, const char* cluster, const char* job) {
    Worker other = this_worker();
    other.host = other.machine = "n7";
    other.slurm = SlurmPlace{cluster, job, "0", 0};
    ASSERT_TRUE(take_claim(claims(episode), 1, other));
  };
  hold(0, "c", "12");
  hold(1, "c", "13");
  hold(2, "d", "14");
  ::setenv("SLURM_CLUSTER_NAME", "c", 1);
  ::setenv("SLURM_ARRAY_JOB_ID", "15", 1);
  ::setenv("SLURM_ARRAY_TASK_ID", "0", 1);
  const char* path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  ::setenv("PATH", study_.path().c_str(), 1);
  WorkList list(plan_, options_, states_);
  const std::vector<std::size_t> taken = taken_from(list);
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_THAT(read_file(asked), testing::HasSubstr("--jobs=12,13\n"));
  EXPECT_THAT(taken, ElementsAre(3U, 4U, 5U, 1U));
  EXPECT_THAT(list.held(), ElementsAre(0U, 2U));
}

TEST_F(Work, ThatIsHeldByAnotherIsLeftToIt) {
  Worker other = this_worker();
  other.host = other.machine = "elsewhere";
  ASSERT_TRUE(take_claim(claims(2), 1, other));
  WorkList list(plan_, options_, states_);
  EXPECT_THAT(taken_from(list), ElementsAre(0U, 1U, 3U, 4U, 5U));
  EXPECT_THAT(list.held(), ElementsAre(2U));
}

TEST_F(Work, OfAHolderThatIsGoneIsTakenOver) {
  Worker dead = this_worker();
  dead.started = "0";
  ASSERT_TRUE(take_claim(claims(2), 1, dead));
  WorkList list(plan_, options_, states_);
  std::vector<int> numbers;
  std::vector<std::size_t> episodes;
  while (const auto taken = list.take()) {
    episodes.push_back(taken->episode);
    numbers.push_back(taken->attempt.claim().number());
  }
  EXPECT_THAT(episodes, ElementsAre(0U, 1U, 3U, 4U, 5U, 2U));
  EXPECT_THAT(numbers, ElementsAre(1, 1, 1, 1, 1, 2));
  EXPECT_TRUE(list.held().empty());
}

TEST_F(Work, ThatCrashedIsTriedAgainOrStands) {
  fs::create_directories(episode_folder(study_.path(), plan_[1]));
  write_file(episode_folder(study_.path(), plan_[1]) / "failure.json", "{}");
  options_.retry_crashed = false;
  WorkList standing(plan_, options_, states_);
  EXPECT_THAT(taken_from(standing), ElementsAre(0U, 2U, 3U, 4U, 5U));
  EXPECT_EQ(states_[1], EpisodeState::crashed);
  options_.retry_crashed = true;
  states_.assign(plan_.size(), EpisodeState::completed);
  states_[1] = EpisodeState::missing;
  WorkList again(plan_, options_, states_);
  EXPECT_THAT(taken_from(again), ElementsAre(1U));
}

/// Not even what a holder that is gone has left is taken then.
TEST_F(Work, EndsWhenTheListIsClosed) {
  Worker dead = this_worker();
  dead.started = "0";
  ASSERT_TRUE(take_claim(claims(0), 1, dead));
  WorkList list(plan_, options_, states_);
  ASSERT_TRUE(list.take());
  EXPECT_THAT(list.held(), ElementsAre(0U));
  list.close();
  EXPECT_EQ(list.open(), 0U);
  EXPECT_TRUE(list.held().empty());
  EXPECT_FALSE(list.take());
}

TEST_F(Work, ThatCrashedIsTriedAgainWhereNothingElseIsSaid) {
  fs::create_directories(episode_folder(study_.path(), plan_[1]));
  write_file(episode_folder(study_.path(), plan_[1]) / "failure.json", "{}");
  states_.assign(plan_.size(), EpisodeState::completed);
  states_[1] = EpisodeState::crashed;
  WorkList list(plan_, options_, states_);
  EXPECT_THAT(taken_from(list), ElementsAre(1U));
}

TEST_F(Work, ThatCrashedStandsInTheArrayInWhichItCrashed) {
  ::setenv("SLURM_ARRAY_TASK_ID", "1", 1);
  const auto is_tried_again = [&](std::size_t episode, const char* cluster, const char* job) {
    Worker former = this_worker();
    former.slurm = SlurmPlace{"c", "12", "0", 0};
    take_claim(claims(episode), 1, former)->release();
    fs::create_directories(episode_folder(study_.path(), plan_[episode]));
    write_file(episode_folder(study_.path(), plan_[episode]) / "failure.json", "{}");
    states_.assign(plan_.size(), EpisodeState::completed);
    states_[episode] = EpisodeState::crashed;
    ::setenv("SLURM_CLUSTER_NAME", cluster, 1);
    ::setenv("SLURM_ARRAY_JOB_ID", job, 1);
    WorkList list(plan_, options_, states_);
    return !taken_from(list).empty();
  };
  EXPECT_FALSE(is_tried_again(0, "c", "12"));
  EXPECT_TRUE(is_tried_again(1, "d", "12"));
  EXPECT_TRUE(is_tried_again(2, "c", "13"));
}

TEST(SweepOptions, RunOneLeanEpisodeAtATimeUnlessToldOtherwise) {
  const StudySweepOptions options{};
  EXPECT_EQ(options.jobs, 1);
  EXPECT_FALSE(options.overwrite);
  EXPECT_FALSE(options.keep_states);
  EXPECT_TRUE(options.retry_crashed);
  EXPECT_FALSE(options.single_thread);
}

}  // namespace
}  // namespace vantage
