// What is kept of a decision and of a plan, whoever took it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/tasks/mapping/still_table.hpp"
#include "vantage/core/log.hpp"
#include "vantage/planners/choice/outside_choice.hpp"

namespace vantage {
namespace {

using support::still_table;
using support::StillTable;

/// At the still table, with what a decision leaves behind.
struct DecidingParts : TabletopParts {
  DecidingParts(StillTable& table, const EpisodeOptions& options, const Tabletop& task,
                TabletopBelief& belief, const OutsideChoice* outside = nullptr)
      : TabletopParts(
            MappingContext{options, table.robot, table.evaluator, table.recorder, outside}, task,
            table.robot, belief) {
    std::ranges::fill(navigator_.floor().log_odds, -2.0F);
  }
  using TabletopParts::before_update;
  using TabletopParts::current_;
  using TabletopParts::decision_start_s_;
  using TabletopParts::expected_left_cells;
  using TabletopParts::former_;
  using TabletopParts::intended_m_;
  using TabletopParts::measure;
  using TabletopParts::predict;
  using TabletopParts::scans_;
  using TabletopParts::tour_;
};

Tabletop touring() {
  Tabletop task = still_table().task;
  task.choice = TourChoice{};
  task.gain = SimpleGain{};
  return task;
}

/// From outside: what the plan says, then the same without a plan, then something else.
TEST(Decisions, KeepAPlanIfItIsFollowed) {
  std::size_t planned = 0;
  int asked = 0;
  const OutsideChoice outside{
      .name = "mine",
      .decide =
          [&](const DecisionRequest& request) {
            ++asked;
            if (asked == 2) return OutsideDecision(planned);
            planned = request.own_choice();
            const std::size_t views = request.candidates.size();
            return OutsideDecision(asked == 1 ? planned : (planned + 1) % views);
          },
      .ended = {}};
  StillTable& table = still_table();
  const Tabletop task = touring();
  TabletopBelief belief(table.options, task);
  DecidingParts parts(table, table.options, task, belief, &outside);
  std::vector<Candidate> views = parts.propose();
  parts.score(views);
  parts.decision_start_s_ = wall_s() - 1000.0;
  EXPECT_EQ(parts.choose(views), planned);
  ASSERT_FALSE(parts.tour_.stops.empty());
  EXPECT_EQ(parts.tour_.stops.front().id, views[planned].id);
  EXPECT_EQ(parts.current_.candidates, views.size());
  EXPECT_GE(parts.current_.plan_time_s, 1000.0);
  EXPECT_LE(parts.current_.plan_time_s, wall_s() - parts.decision_start_s_);
  EXPECT_EQ(parts.choose(views), planned);
  EXPECT_TRUE(parts.tour_.stops.empty()) << "nobody has planned";
  EXPECT_NE(parts.choose(views), planned);
  EXPECT_TRUE(parts.tour_.stops.empty()) << "the plan is not followed";
}

/// The last scan is followed by none.
TEST(Decisions, RememberWhereTheirPlanGoesOn) {
  StillTable& table = still_table();
  const Tabletop task = touring();
  TabletopBelief belief(table.options, task);
  DecidingParts parts(table, table.options, task, belief);
  std::vector<Candidate> views = parts.propose();
  const std::size_t chosen = parts.choose(views);
  EXPECT_GT(views[chosen].gain_bits, 0.0);
  ASSERT_GT(parts.tour_.stops.size(), 1U);
  EXPECT_EQ(parts.tour_.stops[0].id, views[chosen].id);
  EXPECT_EQ(parts.former_, FormerPlan::goes_on);
  ASSERT_TRUE(parts.intended_m_);
  EXPECT_EQ(*parts.intended_m_, parts.tour_.stops[1].place_m);
  parts.scans_.resize(static_cast<std::size_t>(task.scans) - 1);
  parts.choose(views);
  EXPECT_EQ(parts.tour_.stops.size(), 1U);
  EXPECT_EQ(parts.former_, FormerPlan::ended);
  EXPECT_FALSE(parts.intended_m_);
}

/// The second view is the first one from 1.5 m farther off.
TEST(MappingParts, ExpectOfViewsWhatTheyShowTogether) {
  StillTable& table = still_table();
  const Tabletop task = touring();
  TabletopBelief belief(table.options, task);
  DecidingParts parts(table, table.options, task, belief);
  Candidate near = parts.views().front();
  Candidate far = near;
  far.T_world_sensor = near.T_world_sensor * Eigen::Translation3d(-1.5, 0.0, 0.0);
  const double of_near = parts.expected_left_cells({near});
  const double of_far = parts.expected_left_cells({far});
  ASSERT_GT(std::max(of_near, of_far), 1.05 * std::min(of_near, of_far));
  ASSERT_GT(std::min(of_near, of_far), 0.0);
  const double of_both = parts.expected_left_cells({near, far});
  EXPECT_NEAR(parts.expected_left_cells({far, near}), of_both, 1e-6 * of_both);
  EXPECT_GE(of_both, std::max(of_near, of_far) - 1e-6 * of_both);
}

TEST(MappingParts, MeasureTheirMapWithOneThreadToo) {
  StillTable& table = still_table();
  EpisodeOptions options = table.options;
  options.threads = 1;
  TabletopBelief belief(options, table.task);
  DecidingParts parts(table, options, table.task, belief);
  const Pose T_world_sensor = parts.views().front().T_world_sensor;
  parts.predict(T_world_sensor);
  parts.measure(parts.before_update(), {}, T_world_sensor);
  EXPECT_EQ(parts.current_.unobserved_cells, belief.grid().size());
}

}  // namespace
}  // namespace vantage
