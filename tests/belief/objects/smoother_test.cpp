#include "vantage/belief/objects/smoother.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/belief/objects/recognition_world.hpp"

namespace vantage {
namespace {

using test::exp_of;
using ::testing::HasSubstr;

constexpr double kSmootherTolerance = 1e-9;
constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Sums over every path of states there is.
struct AllPaths {
  std::vector<Eigen::VectorXd> smoothed;  ///< not normalised
  double total = 0.0;
};

class PathSum {
 public:
  PathSum(const ObjectStates& states, const TransitionModel& transition,
          const std::vector<ViewStep>& steps)
      : size_(states.size()), steps_(steps) {
    for (const ViewStep& step : steps) {
      matrices_.push_back(
          step.motion_rad == 0.0
              ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(size_, size_))
              : test::dense(states, kernel_of(transition, step.motion_rad, states.bins)));
    }
    paths_.smoothed.assign(steps.size(), Eigen::VectorXd::Zero(size_));
  }

  AllPaths run(const ObjectBelief& prior) {
    for (int start = 0; start < size_; ++start) walk(start, std::exp(prior.log_p[start]));
    return paths_;
  }

 private:
  void walk(int from, double p) {
    const std::size_t t = path_.size();
    if (t == steps_.size()) {
      paths_.total += p;
      for (std::size_t s = 0; s < t; ++s) paths_.smoothed[s][path_[s]] += p;
      return;
    }
    for (int to = 0; to < size_; ++to) {
      const Eigen::VectorXd& log_likelihood = steps_[t].log_likelihood;
      const double seen = log_likelihood.size() > 0 ? std::exp(log_likelihood[to]) : 1.0;
      path_.push_back(to);
      walk(to, p * matrices_[t](from, to) * seen);
      path_.pop_back();
    }
  }

  int size_;
  const std::vector<ViewStep>& steps_;
  std::vector<Eigen::MatrixXd> matrices_;
  std::vector<int> path_;
  AllPaths paths_;
};

TransitionModel random_transition(Rng& rng) {
  const auto names = strategy_names<TransitionModel>();
  return make_strategy<TransitionModel>(names[rng.uniform_index(names.size())]);
}

std::vector<ViewStep> random_steps(const ObjectStates& states, std::size_t count, Rng& rng) {
  std::vector<ViewStep> steps(count);
  for (ViewStep& step : steps) {
    if (rng.uniform() < 0.7) step.motion_rad = rng.uniform(-7.0, 7.0);
    if (rng.uniform() < 0.8) step.log_likelihood = test::random_logs(states.size(), rng);
  }
  return steps;
}

RC_GTEST_PROP(Smooth, IsTheSumOverAllPaths, ()) {
  const ObjectStates states = test::make_states({0, 0, 1}, *rc::gen::inRange(1, 3));
  Rng rng = test::random_generator();
  const TransitionModel transition = random_transition(rng);
  const std::vector<ViewStep> steps = random_steps(states, 3, rng);
  const ObjectBelief prior = uniform_belief(states);
  const AllPaths paths = PathSum(states, transition, steps).run(prior);
  const SmoothedSequence smoothed = smooth(states, prior, transition, steps);
  RC_ASSERT((paths.total > 0.0) == smoothed.reason.empty());
  if (paths.total == 0.0) return;
  RC_ASSERT(std::abs(smoothed.log_likelihood - std::log(paths.total)) < kSmootherTolerance);
  for (std::size_t t = 0; t < steps.size(); ++t) {
    RC_ASSERT(exp_of(smoothed.log_smoothed[t])
                  .isApprox(paths.smoothed[t] / paths.total, kSmootherTolerance));
  }
}

RC_GTEST_PROP(Smooth, FiltersAsIfItEndedThere, ()) {
  const ObjectStates states = test::make_states({0, 1}, 3);
  Rng rng = test::random_generator();
  const TransitionModel transition = random_transition(rng);
  const std::vector<ViewStep> steps = random_steps(states, 4, rng);
  const ObjectBelief prior = uniform_belief(states);
  const SmoothedSequence all = smooth(states, prior, transition, steps);
  for (std::size_t t = 0; t < all.log_filtered.size(); ++t) {
    const SmoothedSequence part = smooth(states, prior, transition, {steps.data(), t + 1});
    RC_ASSERT(
        exp_of(all.log_filtered[t]).isApprox(exp_of(part.log_smoothed[t]), kSmootherTolerance));
  }
}

TEST(Smooth, LearnsFromLaterViewsWhatTheFirstOneLeftOpen) {
  const ObjectStates states = test::make_states({0, 0}, 4);  // near-duplicates but for bin 1
  Eigen::VectorXd front = Eigen::VectorXd::Constant(8, -kEndless);
  front[states.state(0, 0)] = front[states.state(1, 0)] = 0.0;
  Eigen::VectorXd side = Eigen::VectorXd::Constant(8, -kEndless);
  side[states.state(1, 1)] = 0.0;
  const std::vector<ViewStep> steps{{0.0, front}, {states.bin_rad(), side}};
  const SmoothedSequence smoothed =
      smooth(states, uniform_belief(states), RigidTransition{.slip = 0.0}, steps);
  EXPECT_NEAR(std::exp(smoothed.log_filtered[0][states.state(0, 0)]), 0.5, kSmootherTolerance);
  EXPECT_NEAR(std::exp(smoothed.log_smoothed[0][states.state(1, 0)]), 1.0, kSmootherTolerance);
}

TEST(Smooth, NamesTheStepThatIsImpossible) {
  const ObjectStates states = test::make_states({0, 0}, 2);
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(4, -kEndless);
  const std::vector<ViewStep> steps{{}, {.motion_rad = 1.0, .log_likelihood = none}, {}};
  const SmoothedSequence smoothed =
      smooth(states, uniform_belief(states), TableTransition{}, steps);
  EXPECT_THAT(smoothed.reason, HasSubstr("step 1"));
  EXPECT_EQ(smoothed.log_filtered.size(), 1U);
  EXPECT_TRUE(smoothed.log_smoothed.empty());
  EXPECT_EQ(smoothed.log_likelihood, -kEndless);
}

TEST(Smooth, OfNoStepsIsNothing) {
  const ObjectStates states = test::make_states({0}, 2);
  const SmoothedSequence smoothed = smooth(states, uniform_belief(states), RigidTransition{}, {});
  EXPECT_TRUE(smoothed.reason.empty());
  EXPECT_TRUE(smoothed.log_smoothed.empty());
  EXPECT_EQ(smoothed.log_likelihood, 0.0);
}

/// What is most probable of it is 0, however long the sequence.
TEST(Smooth, WhatIsAheadIsOfTheViewsFromThereOn) {
  const ObjectStates states = test::make_states({0, 0, 1}, 2);
  const TransitionModel transition = TableTransition{};
  Rng rng(6);
  std::vector<ViewStep> steps(4);
  for (ViewStep& step : steps) {
    step.motion_rad = rng.uniform(0.5, 6.0);
    step.log_likelihood =
        Eigen::VectorXd::NullaryExpr(states.size(), [&] { return rng.normal(-50.0, 2.0); });
  }
  const SmoothedSequence smoothed = smooth(states, uniform_belief(states), transition, steps);
  ASSERT_EQ(smoothed.log_ahead.size(), 4U);
  Eigen::VectorXd after = Eigen::VectorXd::Ones(states.size());
  for (std::size_t t = 4; t-- > 0;) {
    const Eigen::VectorXd ahead = exp_of(steps[t].log_likelihood).cwiseProduct(after);
    EXPECT_EQ(smoothed.log_ahead[t].maxCoeff(), 0.0) << t;
    EXPECT_TRUE(exp_of(smoothed.log_ahead[t]).isApprox(ahead / ahead.maxCoeff(), 1e-9)) << t;
    after = test::dense(states, kernel_of(transition, steps[t].motion_rad, 2)) * ahead;
  }
}

}  // namespace
}  // namespace vantage
