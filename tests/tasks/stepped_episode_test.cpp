// Choices from outside: asked with what the robot knows, held to what can be done, and the same
// episode as without them where they choose the same.
#include "vantage/tasks/stepped_episode.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/log.hpp"

namespace vantage {
namespace {

ResolvedEpisode tabletop(const std::vector<std::string>& more) {
  set_verbosity(Verbosity::quiet);
  return load_episode(
      VANTAGE_SOURCE_DIR "/assets/episodes/tabletop.yaml",
      support::overridden({"scans=4", "map.cells=[33,33,17]", "laser.scan_duration_s=1"}, more));
}

class OutsideChoices : public testing::Test {
 protected:
  RunOptions options() {
    RunOptions options;
    options.directory = folder.path() / std::to_string(runs++);
    options.lean = true;
    return options;
  }
  nlohmann::json asked(const ResolvedEpisode& episode, const auto& decide) {
    RunOptions with = options();
    with.outside = {.name = "mine", .decide = decide, .ended = {}};
    return nlohmann::json::parse(run(episode, with).metrics);
  }

  support::TemporaryDirectory folder;
  int runs = 0;
};

TEST_F(OutsideChoices, ThatAskTheEpisodesOwnGiveTheSameEpisode) {
  for (const char* choice : {"greedy", "random", "tour"}) {
    const ResolvedEpisode episode = tabletop({std::string("choice=") + choice});
    const nlohmann::json own = nlohmann::json::parse(run(episode, options()).metrics);
    int decisions = 0;
    const nlohmann::json same = asked(episode, [&](const DecisionRequest& request) {
      ++decisions;
      return OutsideDecision(request.own_choice());
    });
    EXPECT_EQ(own["state_hash"], same["state_hash"]) << choice;
    EXPECT_EQ(decisions, 3);
    EXPECT_EQ(same["method"], "mine");
  }
}

TEST_F(OutsideChoices, AreToldWhatTheRobotKnows) {
  std::size_t before = 0;
  asked(tabletop({"budget.time_s=1000"}), [&](const DecisionRequest& request) {
    const MapSituation& now = request.situation;
    EXPECT_EQ(request.candidates.size(), 30U);
    EXPECT_EQ(request.travel_s.size(), 30U);
    EXPECT_EQ(now.scans, ++before);
    EXPECT_EQ(now.scans_left, 4 - static_cast<int>(before));
    EXPECT_GT(now.time_s, 0.0);
    EXPECT_LT(now.left.time_s, 1000.0);
    EXPECT_LT(now.grid.count(CellState::unobserved), now.grid.size());
    EXPECT_GT(request.candidates[5].gain_bits, 0.0);
    for (const Candidate& view : request.candidates) {
      EXPECT_FALSE(view.true_new_cells || view.true_new_cell_set);
    }
    EXPECT_TRUE(
        request.paths.reachable(Eigen::Vector2d(now.T_world_base.x_m, now.T_world_base.y_m)));
    return OutsideDecision(std::size_t{3});
  });
  EXPECT_EQ(before, 3U);
}

TEST_F(OutsideChoices, MayGoWhereNoCandidateIs) {
  const nlohmann::json metrics = asked(tabletop({"scans=3"}), [&](const DecisionRequest& request) {
    if (request.situation.scans == 2) return OutsideDecision(request.candidates.size() - 1);
    Pose2 pose = request.situation.T_world_base;
    pose.x_m += 0.2;
    pose.yaw_rad += 0.1;
    return OutsideDecision(pose);
  });
  EXPECT_EQ(metrics["status"], "completed");
  const nlohmann::json& scans = metrics["scans"];
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[1]["chosen_view"], 30);  // behind the ring's
  EXPECT_FALSE(scans[1]["fallback"].get<bool>());
  EXPECT_NEAR(scans[1]["leg_length_m"].get<double>(), 0.2, 0.05);
  EXPECT_EQ(scans[2]["chosen_view"], 30);  // and a candidate from then on
  EXPECT_EQ(scans[2]["candidates"], 31);
}

TEST_F(OutsideChoices, ThatCannotBeCarriedOutFailTheEpisodeWithTheReason) {
  const auto reason = [&](const OutsideDecision& decision) {
    const nlohmann::json metrics =
        asked(tabletop({}), [&](const DecisionRequest&) { return decision; });
    EXPECT_EQ(metrics["status"], "failed");
    return metrics["reason"].get<std::string>();
  };
  EXPECT_EQ(reason(std::size_t{30}), "mine: view 30 was chosen, there are 30");
  EXPECT_NE(reason(Pose2{0.0, 0.0, 0.0}).find("not on known free floor"), std::string::npos);
  EXPECT_NE(reason(Pose2{NAN, 0.0, 0.0}).find("not finite"), std::string::npos);
  EXPECT_NE(reason(Pose2{1e300, 0.0, 0.0}).find("not on known free floor"), std::string::npos);
}

TEST_F(OutsideChoices, HaveNothingToAskGroundTruthBy) {
  const auto decide = [](const DecisionRequest&) { return OutsideDecision(std::size_t{0}); };
  EXPECT_THROW(asked(tabletop({"choice=oracle"}), decide), ConfigError);
  EXPECT_THROW(
      asked(load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/trajectory.yaml", {}), decide),
      ConfigError);
}

using SteppedEpisodes = OutsideChoices;

TEST_F(SteppedEpisodes, StopAtEachDecision) {
  const ResolvedEpisode resolved = tabletop({});
  const nlohmann::json own = nlohmann::json::parse(run(resolved, options()).metrics);
  SteppedEpisode episode(resolved, "mine", options());
  int decisions = 0;
  while (episode.wait() == SteppedEpisode::State::asks) {
    EXPECT_THROW(episode.answer(std::size_t{99}), BadDecision);  // asks still
    episode.answer(episode.request().own_choice());
    ++decisions;
  }
  EXPECT_EQ(decisions, 3);
  ASSERT_EQ(episode.wait(), SteppedEpisode::State::ended);
  EXPECT_TRUE(episode.at_limit());
  EXPECT_EQ(episode.last_situation().scans, 4U);
  EXPECT_EQ(episode.last_situation().scans_left, 0);
  episode.let_go();
  ASSERT_EQ(episode.wait(), SteppedEpisode::State::over);
  EXPECT_EQ(nlohmann::json::parse(episode.outcome().metrics)["state_hash"], own["state_hash"]);
}

TEST_F(SteppedEpisodes, MayBeLeftAtAnyTime) {
  for (int answers = 0; answers <= 1; ++answers) {
    SteppedEpisode episode(tabletop({}), "mine", options());
    for (int i = 0; i < answers; ++i) {
      ASSERT_EQ(episode.wait(), SteppedEpisode::State::asks);
      episode.answer(std::size_t{0});
    }
  }
  SteppedEpisode episode(tabletop({}), "mine", options());
  ASSERT_EQ(episode.wait(), SteppedEpisode::State::asks);
  episode.interrupt();
  ASSERT_EQ(episode.wait(), SteppedEpisode::State::over);
  EXPECT_EQ(nlohmann::json::parse(episode.outcome().metrics)["status"], "interrupted");
}

TEST_F(SteppedEpisodes, ThatCannotBeginSayWhy) {
  SteppedEpisode episode(tabletop({"choice=oracle"}), "mine", options());
  ASSERT_EQ(episode.wait(), SteppedEpisode::State::over);
  EXPECT_THROW(static_cast<void>(episode.outcome()), ConfigError);
}

/// Who watches it is told of its ticks all the same.
TEST_F(SteppedEpisodes, MayBeWaitedForInPieces) {
  constexpr std::chrono::milliseconds kPiece(1);
  std::atomic<int> ticks = 0;
  RunOptions with = options();
  with.spectator.on_tick = [&](const World&) { ++ticks; };
  SteppedEpisode episode(tabletop({"scans=2"}), "mine", with);
  int pieces = 0;
  SteppedEpisode::State state = SteppedEpisode::State::runs;
  for (; state == SteppedEpisode::State::runs; ++pieces) state = episode.wait(kPiece);
  EXPECT_EQ(state, SteppedEpisode::State::asks);
  EXPECT_GT(pieces, 1);
  EXPECT_GT(ticks.load(), 0);
}

/// One that looks at nothing learns nothing of the truth.
TEST_F(OutsideChoices, MayTakeTheOraclesPlaceIfTheyAreBlind) {
  const ResolvedEpisode episode = tabletop({"choice=oracle", "scans=2"});
  const nlohmann::json own = nlohmann::json::parse(run(episode, options()).metrics);
  RunOptions with = options();
  with.outside = {
      .name = "mine",
      .decide =
          [](const DecisionRequest& request) { return OutsideDecision(request.own_choice()); },
      .ended = {},
      .blind = true};
  const nlohmann::json same = nlohmann::json::parse(run(episode, with).metrics);
  EXPECT_EQ(same["status"], "completed");
  EXPECT_EQ(same["state_hash"], own["state_hash"]);
  EXPECT_EQ(same["method"], "mine");
}

}  // namespace
}  // namespace vantage
