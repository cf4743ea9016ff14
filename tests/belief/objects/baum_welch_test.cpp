#include "vantage/belief/objects/baum_welch.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tests/belief/objects/recognition_world.hpp"

namespace vantage {
namespace {

constexpr double kFitTolerance = 1e-9;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

using Sequences = std::vector<std::vector<ViewStep>>;

int draw(const Eigen::VectorXd& p, Rng& rng) {
  double u = rng.uniform() * p.sum();
  int i = 0;
  while (i + 1 < p.size() && (u -= p[i]) >= 0.0) ++i;
  return i;
}

/// A view of `state` that shows it for what it is with probability `p_right`, for any other alike
/// otherwise.
Eigen::VectorXd draw_view(int state, int states, double p_right, Rng& rng) {
  const double p_wrong = (1.0 - p_right) / (states - 1);
  Eigen::VectorXd p = Eigen::VectorXd::Constant(states, p_wrong);
  p[state] = p_right;
  const int seen = draw(p, rng);
  Eigen::VectorXd likelihood = Eigen::VectorXd::Constant(states, p_wrong);
  likelihood[seen] = p_right;
  return likelihood.unaryExpr([](double l) { return std::log(l); });
}

/// Sequences of views under `truth`, by motions of the given numbers of bins.
Sequences draw_sequences(const ObjectStates& states, const TransitionModel& truth,
                         const std::vector<double>& motions, std::size_t count, double p_right,
                         Rng& rng) {
  std::vector<Eigen::MatrixXd> matrices;
  for (const double bins : motions) {
    matrices.push_back(test::dense(states, kernel_of(truth, bins * states.bin_rad(), states.bins)));
  }
  Sequences sequences(count);
  for (auto& sequence : sequences) {
    auto state = static_cast<int>(rng.uniform_index(static_cast<std::size_t>(states.size())));
    sequence.push_back({0.0, draw_view(state, states.size(), p_right, rng)});
    for (int t = 0; t < 8; ++t) {
      const std::size_t motion = rng.uniform_index(motions.size());
      state = draw(matrices[motion].row(state).transpose(), rng);
      sequence.push_back(
          {motions[motion] * states.bin_rad(), draw_view(state, states.size(), p_right, rng)});
    }
  }
  return sequences;
}

/// By one bin it slips 0.1 short and 0.3 too far; by two it is exact.
LearnedTransition slipping(int bins) {
  LearnedTransition truth = as_learned(RigidTransition{.slip = 0.0}, bins);
  Eigen::Map<Eigen::MatrixXd> slips(truth.slip.data(), bins, bins);
  slips(0, 1) = 0.6;
  slips(1, 1) = 0.3;
  slips(bins - 1, 1) = 0.1;
  return truth;
}

double slip_of(const LearnedTransition& learned, int command, int slip, int bins) {
  return learned.slip[static_cast<std::size_t>(command) * static_cast<std::size_t>(bins) +
                      static_cast<std::size_t>((slip + bins) % bins)];
}

TEST(AsLearned, SaysTheSameForWholeBins) {
  for (const std::string_view name : strategy_names<TransitionModel>()) {
    const auto model = make_strategy<TransitionModel>(name);
    const LearnedTransition learned = as_learned(model, 8);
    check_options(learned);
    for (int command = 1; command < 8; ++command) {
      const double motion_rad = command * 2.0 * std::numbers::pi / 8.0;
      const TransitionKernel expected = kernel_of(model, motion_rad, 8);
      const TransitionKernel kernel = learned.kernel(motion_rad, 8);
      EXPECT_TRUE(kernel.bin_change.isApprox(expected.bin_change, kFitTolerance)) << name;
      EXPECT_EQ(kernel.same_object, expected.same_object);
      EXPECT_EQ(kernel.other_category, expected.other_category);
    }
  }
}

TEST(PriorCounts, AreTheTransitionTheyCameFrom) {
  const TransitionCounts counts = prior_counts(TableTransition{}, 8, 17.0);
  const LearnedTransition learned = learned_from(counts, as_learned(RigidTransition{}, 8));
  const LearnedTransition expected = as_learned(TableTransition{}, 8);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_NEAR(learned.slip[i], expected.slip[i], kFitTolerance);
  EXPECT_NEAR(learned.other_instance, 0.1, kFitTolerance);
}

TEST(LearnedFrom, IsTheProportionsOfCountsHoweverFew) {
  const LearnedTransition before = as_learned(RigidTransition{}, 2);
  TransitionCounts counts{.slip = Eigen::MatrixXd::Zero(2, 2)};
  EXPECT_EQ(learned_from(counts, before).slip, before.slip);
  EXPECT_EQ(learned_from(counts, before).same_object, 1.0);
  counts.slip.col(1) << 0.125, 0.375;
  counts.same_object = 0.125;
  counts.other_instance = 0.0625;
  counts.other_category = 0.3125;
  const LearnedTransition learned = learned_from(counts, before);
  EXPECT_EQ(learned.slip, (std::vector{before.slip[0], before.slip[1], 0.25, 0.75}));
  EXPECT_EQ(learned.same_object, 0.25);
  EXPECT_EQ(learned.other_instance, 0.125);
  EXPECT_EQ(learned.other_category, 0.625);
}

RC_GTEST_PROP(BaumWelch, NeverLosesLikelihood, ()) {
  const ObjectStates states = test::random_states();
  Rng rng = test::random_generator();
  Sequences sequences(3);
  for (auto& sequence : sequences) {
    sequence.resize(4);
    for (ViewStep& step : sequence) {
      if (rng.uniform() < 0.8) step.motion_rad = rng.uniform(-7.0, 7.0);
      step.log_likelihood = test::random_logs(states.size(), rng);
    }
  }
  const BaumWelchResult result =
      baum_welch(states, TableTransition{}, sequences, {.max_iterations = 15});
  check_options(result.transition);
  for (std::size_t i = 1; i < result.log_likelihood.size(); ++i) {
    RC_ASSERT(result.log_likelihood[i] >= result.log_likelihood[i - 1] - kFitTolerance);
  }
}

TEST(BaumWelch, FindsTheSlipOfEachCommand) {
  const ObjectStates states = test::make_states({0, 0, 1}, 8);
  Rng rng(21);
  const Sequences sequences = draw_sequences(states, slipping(8), {1.0, 2.0}, 150, 0.8, rng);
  const BaumWelchResult result =
      baum_welch(states, RigidTransition{}, sequences, {.tolerance = 1e-4});
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.unexplained, 0);
  const LearnedTransition& learned = result.transition;
  EXPECT_NEAR(slip_of(learned, 1, 0, 8), 0.6, 0.05);
  EXPECT_NEAR(slip_of(learned, 1, +1, 8), 0.3, 0.05);
  EXPECT_NEAR(slip_of(learned, 1, -1, 8), 0.1, 0.05);
  EXPECT_NEAR(slip_of(learned, 2, 0, 8), 1.0, 0.05);
  EXPECT_NEAR(slip_of(learned, 5, 0, 8), 0.9, kFitTolerance);  // never commanded: as it was
  EXPECT_EQ(learned.same_object, 1.0);                         // as rigid holds for certain
  EXPECT_EQ(slip_of(learned, 1, 4, 8), 0.0);
}

TEST(BaumWelch, FindsTheSlipFromMotionsBetweenBins) {
  const ObjectStates states = test::make_states({0, 0}, 8);
  Rng rng(22);
  const Sequences sequences = draw_sequences(states, slipping(8), {1.25, 0.75}, 300, 0.9, rng);
  const LearnedTransition learned =
      baum_welch(states, RigidTransition{}, sequences, {.tolerance = 1e-4}).transition;
  EXPECT_NEAR(slip_of(learned, 1, +1, 8), 0.3, 0.08);
  EXPECT_NEAR(slip_of(learned, 1, -1, 8), 0.1, 0.08);
}

TEST(BaumWelch, FindsHowOftenObjectsChange) {
  const ObjectStates states = test::make_states({0, 0, 0, 1, 1, 2}, 3);
  LearnedTransition truth = as_learned(RigidTransition{}, 3);
  truth.same_object = 0.7;
  truth.other_instance = 0.2;
  truth.other_category = 0.1;
  Rng rng(23);
  const Sequences sequences = draw_sequences(states, truth, {1.0, 2.0}, 400, 0.9, rng);
  const BaumWelchResult result =
      baum_welch(states, TableTransition{}, sequences, {.tolerance = 1e-4});
  EXPECT_NEAR(result.transition.same_object, 0.7, 0.04);
  EXPECT_NEAR(result.transition.other_instance, 0.2, 0.04);
  EXPECT_NEAR(result.transition.other_category, 0.1, 0.04);
}

TEST(BaumWelch, LeavesOutWhatTheStartHoldsForImpossible) {
  const ObjectStates states = test::make_states({0, 0}, 4);
  Eigen::VectorXd only_first = Eigen::VectorXd::Constant(8, -kUnlimited);
  only_first.head(4).setZero();
  const Eigen::VectorXd only_second = only_first.reverse();
  const Sequences sequences{{{0.0, only_first}, {states.bin_rad(), only_second}},
                            {{0.0, only_first}, {states.bin_rad(), only_first}}};
  const BaumWelchResult result = baum_welch(states, RigidTransition{}, sequences, {});
  EXPECT_EQ(result.unexplained, 1);
  EXPECT_NEAR(result.log_likelihood.back(), std::log(0.5), kFitTolerance);
}

TEST(BaumWelch, PriorMovesHoldItBack) {
  const ObjectStates states = test::make_states({0, 0}, 8);
  Rng rng(24);
  const Sequences sequences = draw_sequences(states, slipping(8), {1.0}, 20, 0.9, rng);
  const BaumWelchResult free = baum_welch(states, RigidTransition{}, sequences, {});
  const BaumWelchResult held =
      baum_welch(states, RigidTransition{}, sequences, {.prior_moves = 1e6});
  EXPECT_GT(slip_of(free.transition, 1, +1, 8), 0.15);
  EXPECT_NEAR(slip_of(held.transition, 1, +1, 8), 0.05, 1e-3);
  EXPECT_THROW(baum_welch(states, RigidTransition{}, sequences, {.prior_moves = -1.0}),
               ConfigError);
}

TEST(LearnSequence, OneByOneIsAllAtOnceWhereStatesAreCertain) {
  const ObjectStates states = test::make_states({0, 0, 1, 1}, 4);
  Rng rng(25);
  const Sequences sequences = draw_sequences(states, slipping(4), {1.0, 2.0}, 30, 1.0, rng);
  const BaumWelchOptions once{.prior_moves = 5.0, .max_iterations = 1};
  const LearnedTransition batch = baum_welch(states, TableTransition{}, sequences, once).transition;
  TransitionCounts counts = prior_counts(TableTransition{}, 4, 5.0);
  LearnedTransition learned;
  const Sequences last_first(sequences.rbegin(), sequences.rend());
  for (const auto& sequence : last_first) {
    learned = learn_sequence(states, sequence, counts);
  }
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(learned.slip[i], batch.slip[i], kFitTolerance);
  EXPECT_NEAR(learned.same_object, batch.same_object, kFitTolerance);
  EXPECT_GT(learned.same_object, 0.9);
}

TEST(LearnSequence, ApproachesTheTruthAsSequencesComeIn) {
  const ObjectStates states = test::make_states({0, 0, 1}, 8);
  Rng rng(26);
  TransitionCounts counts = prior_counts(TableTransition{}, 8, 10.0);
  LearnedTransition learned;
  for (const auto& sequence : draw_sequences(states, slipping(8), {1.0}, 300, 0.9, rng)) {
    learned = learn_sequence(states, sequence, counts);
  }
  EXPECT_NEAR(slip_of(learned, 1, 0, 8), 0.6, 0.06);
  EXPECT_NEAR(slip_of(learned, 1, +1, 8), 0.3, 0.06);
  EXPECT_GT(learned.same_object, 0.97);
}

TEST(BaumWelch, OfNoSequenceIsTheStartAtOnce) {
  const ObjectStates states = test::make_states({0, 0}, 4);
  const BaumWelchResult result = baum_welch(states, RigidTransition{}, Sequences{}, {});
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.log_likelihood, (std::vector<double>{0.0, 0.0}));
}

TEST(BaumWelch, EndsWhereTheLikelihoodHardlyGrowsOrAfterThePassesAllowed) {
  const ObjectStates states = test::make_states({0, 0, 1}, 8);
  Rng rng(27);
  const Sequences sequences = draw_sequences(states, slipping(8), {1.0, 2.0}, 20, 0.8, rng);
  for (const int most : {1, 3}) {
    const BaumWelchResult cut = baum_welch(states, RigidTransition{}, sequences,
                                           {.max_iterations = most, .tolerance = 1e-12});
    EXPECT_EQ(cut.log_likelihood.size(), static_cast<std::size_t>(most));
    EXPECT_FALSE(cut.converged);
  }
  const BaumWelchResult result =
      baum_welch(states, RigidTransition{}, sequences, {.tolerance = 1e-3});
  ASSERT_TRUE(result.converged);
  const std::vector<double>& found = result.log_likelihood;
  for (std::size_t i = 1; i < found.size(); ++i) {  // a thousandth for each of 20 sequences
    EXPECT_EQ(found[i] - found[i - 1] <= 0.02, i + 1 == found.size()) << i;
  }
}

/// By 1.25 bins the object was turned by one: either by the command of one bin, 0.75 * 0.8, or by
/// that of two, a bin short, 0.25 * 0.1.
TEST(AddExpectedMoves, SharesAMoveBetweenTheCommandsThatMayHaveMadeIt) {
  const ObjectStates states = test::make_states({0, 0}, 4);
  const LearnedTransition transition = as_learned(RigidTransition{.slip = 0.2}, 4);
  const auto certain = [](int state) {
    Eigen::VectorXd view = Eigen::VectorXd::Constant(8, -kUnlimited);
    view[state] = 0.0;
    return view;
  };
  const std::vector<ViewStep> sequence{{0.0, certain(0)}, {1.25 * states.bin_rad(), certain(1)}};
  TransitionCounts counts;
  counts.slip = Eigen::MatrixXd::Zero(4, 4);
  EXPECT_NEAR(add_expected_moves(states, transition, sequence, counts), std::log(0.625 / 8.0),
              kFitTolerance);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(4, 4);
  expected(0, 1) = 0.6 / 0.625;
  expected(3, 2) = 0.025 / 0.625;
  EXPECT_TRUE(counts.slip.isApprox(expected, kFitTolerance)) << counts.slip;
  EXPECT_NEAR(counts.same_object, 1.0, kFitTolerance);
  EXPECT_EQ(counts.other_instance, 0.0);
  EXPECT_EQ(counts.other_category, 0.0);
}

TEST(AddExpectedMoves, OfViewsThatAreImpossibleOrWithoutMotionAreNone) {
  const ObjectStates states = test::make_states({0, 0, 1}, 4);
  const LearnedTransition transition = as_learned(TableTransition{}, 4);
  const TransitionCounts before = prior_counts(TableTransition{}, 4, 3.0);
  Rng rng(28);
  const Eigen::VectorXd first = draw_view(2, 12, 0.8, rng);
  const Eigen::VectorXd second = draw_view(7, 12, 0.8, rng);
  const Eigen::VectorXd impossible = Eigen::VectorXd::Constant(12, -kUnlimited);
  TransitionCounts counts = before;
  const std::vector<ViewStep> still{{0.0, first}, {0.0, second}};
  EXPECT_TRUE(std::isfinite(add_expected_moves(states, transition, still, counts)));
  const std::vector<ViewStep> cut{{0.0, first}, {1.0, second}, {1.0, impossible}};
  EXPECT_EQ(add_expected_moves(states, transition, cut, counts), -kUnlimited);
  EXPECT_EQ(counts.slip, before.slip);
  EXPECT_EQ(counts.same_object, before.same_object);
  EXPECT_EQ(counts.other_instance, before.other_instance);
  EXPECT_EQ(counts.other_category, before.other_category);
}

/// By 1.5 bins the object was not turned at all: the command of one bin and that of two may have
/// done so alike.
TEST(AddExpectedMoves, SharesAMoveEvenlyBetweenCommandsThatMakeItAsOften) {
  const ObjectStates states = test::make_states({0, 0}, 4);
  const LearnedTransition transition = as_learned(TableTransition{}, 4);
  Eigen::VectorXd first = Eigen::VectorXd::Constant(8, -kUnlimited);
  first[0] = 0.0;
  const std::vector<ViewStep> sequence{{0.0, first}, {1.5 * states.bin_rad(), first}};
  TransitionCounts counts;
  counts.slip = Eigen::MatrixXd::Zero(4, 4);
  add_expected_moves(states, transition, sequence, counts);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(4, 4);
  expected(3, 1) = 0.5;
  expected(2, 2) = 0.5;
  EXPECT_TRUE(counts.slip.isApprox(expected, kFitTolerance)) << counts.slip;
}

}  // namespace
}  // namespace vantage
