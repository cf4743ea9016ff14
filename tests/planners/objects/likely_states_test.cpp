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

TEST(LikelyStates, OfEqualOnesAreEvenlySpread) {
  const auto kept = [](std::initializer_list<double> p, int count) {
    return likely_states(belief(p), count).states;
  };
  EXPECT_EQ(kept({0.25, 0.25, 0.25, 0.25}, 2), (std::vector{0, 2}));
  EXPECT_EQ(kept({0.2, 0.2, 0.2, 0.2, 0.2}, 5), (std::vector{0, 1, 2, 3, 4}));
  EXPECT_EQ(kept({0.1, 0.1, 0.5, 0.1, 0.1, 0.1}, 3), (std::vector{2, 0, 3}));
  EXPECT_EQ(kept({0.1, 0.1 + 1e-13, 0.5, 0.1, 0.1 - 1e-13, 0.1}, 3), (std::vector{2, 0, 3}))
      << "as a motion rounds";
  EXPECT_EQ(kept({0.1, 0.1, 0.2, 0.2, 0.4}, 3), (std::vector{4, 2, 3}));
}

TEST(LikelyStates, HoldAllOfTheBeliefUnlessItIsSaid) { EXPECT_EQ(LikelyStates{}.mass, 1.0); }

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

/// Fifty known objects and thirty kinds of unknown ones, each of them more probable than any known.
ObjectStates many_unknown() {
  ObjectStates states;
  states.bins = 1;
  states.objects.resize(50);
  states.unknown_category.assign(30, kNoCategory);
  return states;
}

TEST(LikelyStates, OfUnknownObjectsLeaveRoomForKnownOnes) {
  const ObjectStates states = many_unknown();
  Eigen::VectorXd belief(80);
  belief.head(50).setConstant(0.4 / 50.0);
  belief.tail(30).setConstant(0.6 / 30.0);
  belief[7] += 0.004;
  belief[8] -= 0.004;
  const LikelyStates likely = likely_states(states, belief, 16);
  ASSERT_EQ(likely.states.size(), 16U);
  EXPECT_EQ(likely.states[0], 7);
  EXPECT_EQ(likely.states[1], 0);
  EXPECT_EQ(likely.states[2], 3) << "48 are equal, 13 of them are kept, evenly spread; not 7 and 8";
  EXPECT_EQ(likely.states[13], 46);
  EXPECT_EQ(likely.states[14], 50);
  EXPECT_EQ(likely.states[15], 65);
  double known = 0.0;
  for (std::size_t i = 0; i < 14; ++i) known += likely.belief[i];
  EXPECT_NEAR(known, 0.4, 1e-12);
  EXPECT_NEAR(likely.belief[14] + likely.belief[15], 0.6, 1e-12);
  EXPECT_NEAR(likely.mass, 14.0 * 0.4 / 50.0 + 0.004 + 2.0 * 0.02, 1e-12);
  const LikelyStates fewer = likely_states(states, belief, 15);
  ASSERT_EQ(fewer.states.size(), 15U);
  EXPECT_EQ(fewer.states[13], 46) << "an eighth is one unknown";
  EXPECT_EQ(fewer.states[14], 50);
}

TEST(LikelyStates, HaveTheOnlyUnknownOneHoweverImprobable) {
  ObjectStates states;
  states.bins = 1;
  states.objects.resize(3);
  states.unknown_category = {kNoCategory};
  const LikelyStates likely = likely_states(states, belief({0.3, 0.5, 0.15, 0.05}), 2);
  EXPECT_EQ(likely.states, (std::vector{1, 3}));
  EXPECT_NEAR(likely.belief[0], 0.95, 1e-12);
  EXPECT_NEAR(likely.belief[1], 0.05, 1e-12);
  EXPECT_NEAR(likely.mass, 0.55, 1e-12);
  EXPECT_EQ(likely_states(states, belief({0.3, 0.5, 0.15, 0.05}), 1).states, likely.states);
}

TEST(LikelyStates, MayAllBeUnknown) {
  const ObjectStates states = many_unknown();
  Eigen::VectorXd belief = Eigen::VectorXd::Zero(80);
  belief[60] = 1.0;
  const LikelyStates likely = likely_states(states, belief, 16);
  EXPECT_EQ(likely.states, std::vector<int>{60});
  EXPECT_NEAR(likely.belief[0], 1.0, 1e-12);
}

TEST(LikelyStates, AreEqualWithinABillionth) {
  const auto kept_if_the_last_is_more_by = [](double share) {
    return likely_states(belief({0.25, 0.25, 0.25, 0.25 * (1.0 + share)}), 2).states;
  };
  EXPECT_EQ(kept_if_the_last_is_more_by(7e-10), (std::vector{0, 2}));
  EXPECT_EQ(kept_if_the_last_is_more_by(1.5e-9), (std::vector{3, 0}));
  EXPECT_EQ(kept_if_the_last_is_more_by(-7e-10), (std::vector{0, 2}));
  EXPECT_EQ(kept_if_the_last_is_more_by(-1.5e-9), (std::vector{0, 1}));
}

TEST(LikelyStates, AreInOrderHoweverTheyWereSpread) {
  EXPECT_EQ(likely_states(belief({0.2, 0.2, 0.2 + 1e-13, 0.2, 0.2}), 2).states,
            (std::vector{2, 0}));
  EXPECT_EQ(likely_states(belief({0.5, 0.5 + 1e-13}), 1).states, std::vector{0});
}

TEST(LikelyStates, MayBeOfUnknownObjectsAlone) {
  ObjectStates states;
  states.unknown_category = {kNoCategory};
  const LikelyStates likely = likely_states(states, belief({1.0}), 4);
  EXPECT_EQ(likely.states, std::vector{0});
  EXPECT_EQ(likely.belief, std::vector{1.0});
  EXPECT_EQ(likely.mass, 1.0);
}

TEST(LikelyStatesDeathTest, NeedABeliefWithUnknownObjectsToo) {
  ObjectStates states;
  states.bins = 1;
  states.objects.resize(2);
  states.unknown_category = {kNoCategory};
  EXPECT_DEATH(likely_states(states, belief({0.5, 0.2, 0.2}), 3), "sum to 1");
  EXPECT_DEATH(likely_states(states, belief({0.5, 0.3, 0.2}), 0), "room for a state");
  EXPECT_DEATH(likely_states(states, belief({0.5, 0.5}), 3), "a probability per state");
}

}  // namespace
}  // namespace vantage
