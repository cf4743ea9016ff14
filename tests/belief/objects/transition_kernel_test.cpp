#include "vantage/belief/objects/transition_kernel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/belief/objects/recognition_world.hpp"

namespace vantage {
namespace {

using test::dense;
using test::exp_of;

constexpr double kKernelTolerance = 1e-12;

struct Case {
  ObjectStates states;
  TransitionKernel kernel;
  Eigen::VectorXd log_p;
  Eigen::VectorXd log_x;
};

Case random_case() {
  Case made{.states = test::random_states(), .kernel = {}, .log_p = {}, .log_x = {}};
  Rng rng = test::random_generator();
  made.kernel = test::random_kernel(made.states.bins, rng);
  made.log_p = test::random_logs(made.states.size(), rng);
  made.log_x = test::random_logs(made.states.size(), rng);
  return made;
}

bool close(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return ((a - b).array().abs() <= kKernelTolerance * (1.0 + b.array().abs())).all();
}

RC_GTEST_PROP(TransitionForward, IsTheProductWithTheMatrix, ()) {
  const Case c = random_case();
  const Eigen::VectorXd moved = transition_forward(c.states, c.kernel, c.log_p);
  RC_ASSERT(close(exp_of(moved), dense(c.states, c.kernel).transpose() * exp_of(c.log_p)));
}

RC_GTEST_PROP(TransitionBackward, IsTheProductWithTheTransposedMatrix, ()) {
  const Case c = random_case();
  const Eigen::VectorXd ahead = transition_backward(c.states, c.kernel, c.log_x);
  RC_ASSERT(close(exp_of(ahead), dense(c.states, c.kernel) * exp_of(c.log_x)));
}

RC_GTEST_PROP(TransitionForward, KeepsTheSum, ()) {
  const Case c = random_case();
  const Eigen::VectorXd moved = transition_forward(c.states, c.kernel, c.log_p);
  const double before = exp_of(c.log_p).sum();
  RC_ASSERT(std::abs(exp_of(moved).sum() - before) <= kKernelTolerance * (1.0 + before));
}

TEST(TransitionForward, LosesNoStateHoweverUnlikely) {
  const ObjectStates states = test::make_states({0, 0}, 4);
  TransitionKernel kernel{.bin_change = Eigen::VectorXd::Zero(4)};
  kernel.bin_change[1] = 1.0;
  Eigen::VectorXd log_p = Eigen::VectorXd::LinSpaced(8, 0.0, -70000.0);
  const Eigen::VectorXd moved = transition_forward(states, kernel, log_p);
  for (int j = 0; j < 8; ++j) EXPECT_EQ(moved[j / 4 * 4 + (j + 1) % 4], log_p[j]);
  EXPECT_EQ(transition_backward(states, kernel, moved), log_p);
}

RC_GTEST_PROP(ExpectedMoves, AreThePosteriorsOfAllPairs, ()) {
  const Case c = random_case();
  const Eigen::MatrixXd a = dense(c.states, c.kernel);
  Eigen::MatrixXd pair = exp_of(c.log_p).asDiagonal() * a * exp_of(c.log_x).asDiagonal();
  RC_PRE(pair.sum() > 0.0);
  pair /= pair.sum();
  const auto category = [&](int state) {
    return c.states.category_of[static_cast<std::size_t>(c.states.object_of(state))];
  };
  Eigen::VectorXd change = Eigen::VectorXd::Zero(c.states.bins);
  double instance = 0.0;
  double other = 0.0;
  for (int i = 0; i < c.states.size(); ++i) {
    for (int j = 0; j < c.states.size(); ++j) {
      if (c.states.object_of(i) == c.states.object_of(j)) {
        change[(j - i + c.states.bins) % c.states.bins] += pair(i, j);
      } else {
        (category(i) == category(j) ? instance : other) += pair(i, j);
      }
    }
  }
  const ExpectedMoves moves = expected_moves(c.states, c.kernel, c.log_p, c.log_x);
  RC_ASSERT(close(moves.bin_change, change));
  RC_ASSERT(moves.other_instance >= instance - kKernelTolerance);
  RC_ASSERT(moves.other_category >= other - kKernelTolerance);
  const double draws = moves.same_object + moves.other_instance + moves.other_category;
  RC_ASSERT(std::abs(draws - 1.0) <= kKernelTolerance);
}

TEST(ExpectedMoves, CountTheDrawsOfEmptyGroups) {
  const ObjectStates states = test::make_states({0, 1}, 1);  // no other instances
  const TransitionKernel kernel{.bin_change = Eigen::VectorXd::Ones(1),
                                .same_object = 0.5,
                                .other_instance = 0.25,
                                .other_category = 0.25};
  const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(2);
  const ExpectedMoves moves = expected_moves(states, kernel, zeros, zeros);
  EXPECT_NEAR(moves.same_object, 0.5, kKernelTolerance);
  EXPECT_NEAR(moves.other_instance, 0.25, kKernelTolerance);
  EXPECT_NEAR(moves.other_category, 0.25, kKernelTolerance);
  EXPECT_NEAR(moves.bin_change[0], 0.75, kKernelTolerance);
}

TEST(TransitionKernelDeathTest, RefusesWhatIsOfOtherStates) {
  const ObjectStates states = test::make_states({0, 0}, 4);
  const TransitionKernel kernel{.bin_change = Eigen::VectorXd::Constant(4, 0.25)};
  const TransitionKernel of_six{.bin_change = Eigen::VectorXd::Constant(6, 1.0 / 6.0)};
  const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(8);
  const Eigen::VectorXd more = Eigen::VectorXd::Zero(9);
  EXPECT_DEATH(transition_forward(states, kernel, more), "for every state");
  EXPECT_DEATH(transition_forward(states, of_six, zeros), "as many bins");
  EXPECT_DEATH(transition_backward(states, kernel, more), "for every state");
  EXPECT_DEATH(transition_backward(states, of_six, zeros), "as many bins");
  EXPECT_DEATH(expected_moves(states, kernel, more, zeros), "for every state");
  EXPECT_DEATH(expected_moves(states, kernel, zeros, more), "for every state");
  EXPECT_DEATH(expected_moves(states, of_six, zeros, zeros), "as many bins");
}

TEST(ExpectedMoves, OfAKernelThatNeverStaysAreAllToOthers) {
  const ObjectStates states = test::make_states({0, 0}, 1);
  const TransitionKernel kernel{.bin_change = Eigen::VectorXd::Ones(1),
                                .same_object = 0.0,
                                .other_instance = 1.0,
                                .other_category = 0.0};
  const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(2);
  const ExpectedMoves moves = expected_moves(states, kernel, zeros, zeros);
  EXPECT_EQ(moves.same_object, 0.0);
  EXPECT_NEAR(moves.other_instance, 1.0, kKernelTolerance);
  EXPECT_EQ(moves.other_category, 0.0);
  EXPECT_EQ(moves.bin_change[0], 0.0);
}

}  // namespace
}  // namespace vantage
