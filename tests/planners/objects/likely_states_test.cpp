#include "vantage/planners/objects/likely_states.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vantage {
namespace {

Eigen::VectorXd belief(std::initializer_list<double> p) {
  return Eigen::Map<const Eigen::VectorXd>(p.begin(), static_cast<Eigen::Index>(p.size()));
}

TEST(LikelyStates, AreTheMostProbableInOrder) {
  const auto likely = likely_states(belief({0.1, 0.3, 0.05, 0.3, 0.25}), 3);
  EXPECT_EQ(likely.states, (std::vector{1, 3, 4}));
  EXPECT_DOUBLE_EQ(likely.mass, 0.85);
  EXPECT_DOUBLE_EQ(likely.belief[0], 0.3 / 0.85);
  EXPECT_DOUBLE_EQ(likely.belief[2], 0.25 / 0.85);
}

TEST(LikelyStates, LeaveTheImpossibleOut) {
  const auto likely = likely_states(belief({0.0, 1.0, 0.0}), 3);
  EXPECT_EQ(likely.states, std::vector{1});
  EXPECT_EQ(likely.belief, std::vector{1.0});
  EXPECT_EQ(likely.mass, 1.0);
}

TEST(LikelyStatesDeathTest, NeedABelief) {
  EXPECT_DEATH(likely_states(belief({0.5, 0.4}), 3), "sum to 1");
  EXPECT_DEATH(likely_states(belief({1.5, -0.5}), 3), "sum to 1");
  EXPECT_DEATH(likely_states(belief({1.0}), 0), "room for a state");
}

}  // namespace
}  // namespace vantage
