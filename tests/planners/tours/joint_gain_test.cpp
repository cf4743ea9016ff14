#include "vantage/planners/tours/joint_gain.hpp"

#include <gtest/gtest.h>

#include "tests/planners/tours/small_problem.hpp"

namespace vantage {
namespace {

/// The expected cells by going through all 2^(views x blocks) outcomes of one block at a time: view
/// i shows it or not, with its share as probability.
double by_enumeration(const PlanningProblem& problem, const test::Order& views) {
  double expected = 0.0;
  for (std::size_t b = 0; b < problem.cells.size(); ++b) {
    for (std::size_t outcome = 1; outcome < std::size_t{1} << views.size(); ++outcome) {
      double p = 1.0;
      for (std::size_t i = 0; i < views.size(); ++i) {
        const ShownShares& shown = problem.shows[views[i]];
        const auto entry = std::ranges::find(shown.block, static_cast<std::uint32_t>(b));
        const double share =
            entry == shown.block.end()
                ? 0.0
                : static_cast<double>(
                      shown.share[static_cast<std::size_t>(entry - shown.block.begin())]);
        p *= (outcome >> i & 1U) != 0 ? share : 1.0 - share;
      }
      expected += p * static_cast<double>(problem.cells[b]);
    }
  }
  return expected;
}

TEST(JointGain, IsTheExpectationOverAllOutcomes) {
  Rng rng(11);
  for (int k = 0; k < 20; ++k) {
    const PlanningProblem problem = test::random_problem(5, 12, rng);
    const test::Order views{3, 0, 4, 1};
    const double expected = by_enumeration(problem, views);
    EXPECT_NEAR(joint_gain(problem, views), expected, 1e-5 * expected);
  }
}

TEST(JointGain, OfOneViewIsItsGain) {
  Rng rng(12);
  const PlanningProblem problem = test::random_problem(4, 30, rng);
  for (std::size_t view = 0; view < 4; ++view) {
    EXPECT_NEAR(joint_gain(problem, test::Order{view}), gain_of(problem, view), 1e-4);
    EXPECT_GT(gain_of(problem, view), 0.0);
  }
}

TEST(JointGain, IsMonotoneAndSubmodular) {
  Rng rng(13);
  for (int k = 0; k < 100; ++k) {
    const PlanningProblem problem = test::random_problem(6, 15, rng);
    JointGain small(problem);
    JointGain large(problem);
    small.add(0);
    for (const std::size_t view : {0U, 1U, 2U, 3U}) large.add(view);
    EXPECT_GE(large.total(), small.total());
    for (const std::size_t view : {4U, 5U}) {
      EXPECT_GE(large.of_adding(view), 0.0);
      EXPECT_LE(large.of_adding(view), small.of_adding(view) * (1.0 + 1e-6) + 1e-6);
    }
  }
}

TEST(JointGain, AddsWhatItSaidItWould) {
  Rng rng(14);
  const PlanningProblem problem = test::random_problem(6, 20, rng);
  JointGain gain(problem);
  double sum = 0.0;
  for (std::size_t view = 0; view < 6; ++view) {
    const double promised = gain.of_adding(view);
    EXPECT_EQ(gain.add(view), promised);
    sum += promised;
  }
  EXPECT_DOUBLE_EQ(gain.total(), sum);
  EXPECT_NEAR(sum, joint_gain(problem, test::Order{5, 4, 3, 2, 1, 0}), 1e-4 * sum);
}

TEST(JointGain, StartsAgainAfterClear) {
  Rng rng(15);
  const PlanningProblem problem = test::random_problem(5, 20, rng);
  JointGain gain(problem);
  const double first = gain.add(2);
  gain.add(3);
  gain.clear();
  EXPECT_EQ(gain.total(), 0.0);
  EXPECT_EQ(gain.add(2), first);
}

}  // namespace
}  // namespace vantage
