#include "vantage/belief/observation/psi_rule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

/// Ten states a standard deviation apart.
constexpr int kStates = 10;

/// A feature that says the same thing `repeats` times.
ObservationModel repeating_model(int repeats) {
  ObservationModel model;
  model.mean =
      Eigen::VectorXf::Ones(repeats) * Eigen::RowVectorXf::LinSpaced(kStates, 0.0F, kStates - 1.0F);
  model.variance = Eigen::MatrixXf::Ones(repeats, kStates);
  return model;
}

struct World {
  std::vector<ObservationModel> models;
  HeldOutViews held_out;

  [[nodiscard]] PsiContext context() const { return {models, held_out}; }
};

/// Views whose features are measured with noise of deviation `noise[f]`, where 1 is the model's.
World make_world(const std::vector<int>& repeats, const std::vector<double>& noise, int views) {
  World world;
  Rng rng(11);
  for (int v = 0; v < views; ++v) {
    world.held_out.state.push_back(static_cast<int>(rng.uniform_index(kStates)));
  }
  for (std::size_t f = 0; f < repeats.size(); ++f) {
    world.models.push_back(repeating_model(repeats[f]));
    Eigen::MatrixXf densities(kStates, views);
    for (int v = 0; v < views; ++v) {
      const double seen =
          world.held_out.state[static_cast<std::size_t>(v)] + noise[f] * rng.normal();
      densities.col(v) = log_density(world.models[f], Eigen::VectorXf::Constant(
                                                          repeats[f], static_cast<float>(seen)))
                             .cast<float>();
    }
    world.held_out.log_density.push_back(densities);
  }
  return world;
}

TEST(CalibratedPsi, IsOneForAModelThatIsTrue) {
  const World world = make_world({1}, {1.0}, 4000);
  EXPECT_NEAR(CalibratedPsi{}(world.context())[0], 1.0, 0.06);
}

TEST(CalibratedPsi, TakesWhatIsSaidTenTimesForOnce) {
  const World world = make_world({10}, {1.0}, 4000);
  EXPECT_NEAR(CalibratedPsi{}(world.context())[0], 0.1, 0.006);
}

TEST(CalibratedPsi, TrustsANoisyFeatureAsTheSquareOfItsNoise) {
  const World world = make_world({1}, {2.0}, 4000);
  EXPECT_NEAR(CalibratedPsi{}(world.context())[0], 0.25, 0.03);
}

TEST(CalibratedPsi, SharesTheTemperatureBetweenFeaturesThatRepeatEachOther) {
  World world = make_world({1}, {1.0}, 500);
  const double alone = CalibratedPsi{}(world.context())[0];
  world.models.push_back(world.models[0]);
  world.held_out.log_density.push_back(world.held_out.log_density[0]);
  const std::vector<double> both = CalibratedPsi{}(world.context());
  EXPECT_NEAR(both[0], 0.5 * alone, 1e-3);
  EXPECT_NEAR(both[1], 0.5 * alone, 1e-3);
}

RC_GTEST_PROP(CalibratedPsi, IsTheMostLikely, ()) {
  const int repeats = *rc::gen::inRange(1, 50);
  const World world = make_world({repeats}, {0.1 * *rc::gen::inRange(5, 30)}, 100);
  const double psi = CalibratedPsi{}(world.context())[0];
  const auto likelihood = [&](double p) {
    return mean_log_posterior(world.held_out, std::vector{p});
  };
  for (const double other : {0.3 * psi, 0.98 * psi, 1.02 * psi, 3.0 * psi}) {
    RC_ASSERT(likelihood(psi) >= likelihood(other));
  }
}

TEST(CalibratedPsi, JointRoundsFindTheBestProportion) {
  const World world = make_world({1, 1}, {0.5, 3.0}, 1000);
  const std::vector<double> in_proportion = CalibratedPsi{}(world.context());
  const std::vector<double> joint = CalibratedPsi{.joint_rounds = 10}(world.context());
  const double best = mean_log_posterior(world.held_out, joint);
  EXPECT_GE(best, mean_log_posterior(world.held_out, in_proportion));
  for (const double factor : {0.95, 1.05}) {
    EXPECT_GT(best, mean_log_posterior(world.held_out, std::vector{factor * joint[0], joint[1]}));
    EXPECT_GT(best, mean_log_posterior(world.held_out, std::vector{joint[0], factor * joint[1]}));
  }
}

/// Mean of ln p(object) over the views held out.
double mean_log_object(const HeldOutViews& held_out, double psi) {
  double sum = 0.0;
  for (Eigen::Index v = 0; v < held_out.log_density[0].cols(); ++v) {
    Eigen::ArrayXd p = psi * held_out.log_density[0].col(v).cast<double>().array();
    p = (p - p.maxCoeff()).exp();
    const int first = held_out.state[static_cast<std::size_t>(v)] / held_out.bins * held_out.bins;
    sum += std::log(p.segment(first, held_out.bins).sum() / p.sum());
  }
  return sum / static_cast<double>(held_out.log_density[0].cols());
}

/// Objects are measured with noise of deviation 1.5, where 1 is the model's; which of its two poses
/// an object seems to be in is anyone's guess.
TEST(CalibratedPsi, AboutObjectsDoesNotMindMistakesOfPose) {
  World world = make_world({1}, {1.0}, 4000);
  world.held_out.bins = 2;
  Rng rng(3);
  for (Eigen::Index v = 0; v < 4000; ++v) {
    const int object = world.held_out.state[static_cast<std::size_t>(v)] / 2;
    const double seen = object + 1.5 * rng.normal();
    const int seeming_pose = rng.uniform() < 0.5 ? 1 : 0;
    for (int j = 0; j < kStates; ++j) {
      const int supposed = j / 2;
      const double apart = supposed - seen;
      world.held_out.log_density[0](j, v) =
          static_cast<float>(-0.5 * apart * apart - (j % 2 == seeming_pose ? 0.0 : 4.0));
    }
  }
  EXPECT_NEAR(CalibratedPsi{}(world.context())[0], 1.0 / 2.25, 0.04);
  EXPECT_LT(CalibratedPsi{.about_object = false}(world.context())[0], 0.2);
}

TEST(CalibratedPsi, OfASingleObjectIsThatOfItsPoses) {
  World world = make_world({10, 1}, {1.0, 1.5}, 1000);
  world.held_out.bins = kStates;
  EXPECT_EQ(CalibratedPsi{}(world.context()),
            CalibratedPsi{.about_object = false}(world.context()));
}

TEST(CalibratedPsi, AboutObjectsIsWhereTheLikelihoodPeaks) {
  World world = make_world({3}, {1.5}, 2000);
  world.held_out.bins = 2;
  const double psi = CalibratedPsi{}(world.context())[0];
  for (const double factor : {0.5, 0.95, 1.05, 2.0}) {
    EXPECT_GT(mean_log_object(world.held_out, psi), mean_log_object(world.held_out, factor * psi));
  }
}

TEST(CalibratedPsi, GivesUpAFeatureThatMisleads) {
  World world = make_world({1}, {1.0}, 200);
  world.held_out.log_density[0] = -world.held_out.log_density[0];
  EXPECT_LT(CalibratedPsi{}(world.context())[0], 1e-6);
}

TEST(CalibratedPsi, SurvivesStatesThatAreImpossible) {
  World world = make_world({1}, {1.0}, 200);
  constexpr float kImpossible = -std::numeric_limits<float>::infinity();
  for (int v = 0; v < 200; ++v) {
    const int truth = world.held_out.state[static_cast<std::size_t>(v)];
    world.held_out.log_density[0]((truth + 5) % kStates, v) = kImpossible;
  }
  EXPECT_NEAR(CalibratedPsi{}(world.context())[0], 1.0, 0.3);
  world.held_out.log_density[0].col(3).setConstant(kImpossible);
  EXPECT_NEAR(CalibratedPsi{}(world.context())[0], 1.0, 0.3);
}

TEST(CalibratedPsi, NeedsViews) {
  World world = make_world({1}, {1.0}, 10);
  world.held_out.state.clear();
  EXPECT_THROW(choose_psi(CalibratedPsi{}, world.context()), InputError);
}

TEST(PsiRule, PerDimensionIsOneOverIts) {
  const World world = make_world({4, 10}, {1.0, 1.0}, 1);
  EXPECT_EQ(choose_psi(PerDimensionPsi{}, world.context()), (std::vector{0.25, 0.1}));
}

TEST(PsiRule, DissertationGoesByName) {
  World world = make_world({1, 1, 1, 1, 1}, {1.0, 1.0, 1.0, 1.0, 1.0}, 1);
  const std::vector<std::string> names{"colour", "bounding_box", "sift", "vfh", "size"};
  for (std::size_t f = 0; f < names.size(); ++f) world.models[f].feature = names[f];
  EXPECT_EQ(choose_psi(DissertationPsi{}, world.context()),
            (std::vector{1.0, 0.02, 0.2, 0.001, 1.0}));
  EXPECT_THROW(choose_psi(DissertationPsi{.vfh = -1.0}, world.context()), ConfigError);
}

TEST(MeanLogPosterior, WithoutFeaturesThatCountIsAGuess) {
  const World world = make_world({1}, {1.0}, 20);
  EXPECT_NEAR(mean_log_posterior(world.held_out, std::vector{0.0}), -std::log(kStates), 1e-6);
}

TEST(CalibratedPsi, EndsAtItsBounds) {
  World world = make_world({1}, {0.01}, 50);
  EXPECT_EQ(CalibratedPsi{}(world.context())[0], 10.0) << "it is never mistaken";
  world.held_out.log_density[0] = -world.held_out.log_density[0];
  EXPECT_EQ(CalibratedPsi{}(world.context())[0], 1e-7) << "it always is";
}

/// The first and the last feature are one, the other is as good as either.
TEST(CalibratedPsi, AJointRoundAdjustsEachFeatureToTheOthers) {
  World world = make_world({1, 1}, {1.0, 1.0}, 1000);
  world.models.push_back(world.models[0]);
  world.held_out.log_density.push_back(world.held_out.log_density[0]);
  const std::vector<double> in_proportion = CalibratedPsi{}(world.context());
  EXPECT_EQ(in_proportion[0], in_proportion[2]);
  const std::vector<double> joint = CalibratedPsi{.joint_rounds = 1}(world.context());
  EXPECT_LT(joint[0], 0.7 * joint[2]) << "each had been given a share";
  EXPECT_GT(joint[1], 1.3 * in_proportion[1]) << "it repeats none of them";
  const double best = mean_log_posterior(world.held_out, joint);
  for (const double factor : {0.95, 1.05}) {
    const std::vector<double> other{joint[0], joint[1], factor * joint[2]};
    EXPECT_GT(best, mean_log_posterior(world.held_out, other));
  }
}

TEST(MeanLogPosteriorDeathTest, RefusesViewsThatAreNotOfTheDensities) {
  const World world = make_world({1}, {1.0}, 10);
  const std::vector<double> psi{1.0};
  HeldOutViews views = world.held_out;
  views.bins = 3;
  EXPECT_DEATH(mean_log_posterior(views, psi), "states of whole objects");
  views = world.held_out;
  for (const int none : {-1, kStates}) {
    views.state[4] = none;
    EXPECT_DEATH(mean_log_posterior(views, psi), "states that are modelled");
  }
  views = world.held_out;
  views.state.pop_back();
  EXPECT_DEATH(mean_log_posterior(views, psi), "for every view held out");
}

/// "Single precision up to a constant a view": a thousand dimensions make large densities.
TEST(MeanLogPosterior, DoesNotMindHowLargeTheDensitiesOfAViewAre) {
  HeldOutViews views;
  views.state = {0, 2, 1};
  Eigen::MatrixXf densities(3, 3);
  densities << 0.0F, -2.5F, -1.0F, -1.5F, 0.5F, 0.0F, -4.0F, 1.0F, -3.5F;
  views.log_density = {densities};
  const std::vector<double> psi{0.3};
  const double expected = mean_log_posterior(views, psi);
  views.log_density[0].array() -= 1048576.0F;  // exact
  EXPECT_NEAR(mean_log_posterior(views, psi), expected, 1e-7);
}

/// All views seem to be of the first state, and three in four are; the others are of the second. No
/// view may be of a third.
World of_first_state(Eigen::Index states, float score) {
  World world;
  world.models.push_back(repeating_model(1));
  world.held_out.state = {0, 0, 0, 1};
  Eigen::MatrixXf densities =
      Eigen::MatrixXf::Constant(states, 4, -std::numeric_limits<float>::infinity());
  densities.row(0).setZero();
  densities.row(1).setConstant(-score);
  world.held_out.log_density = {densities};
  return world;
}

TEST(CalibratedPsi, OfTwoStatesMakesTheScoreTheLogOddsOfBeingRight) {
  for (const float score : {2.0F, 20.0F, 200.0F}) {
    World world = of_first_state(2, score);
    const double psi = CalibratedPsi{}(world.context())[0];
    EXPECT_NEAR(psi * score, std::log(3.0), 1e-5) << score;
    EXPECT_NEAR(mean_log_posterior(world.held_out, std::vector{psi}),
                0.75 * std::log(0.75) + 0.25 * std::log(0.25), 1e-6);
  }
}

TEST(MeanLogPosterior, DoesNotMindLargeDensitiesOfViewsWithAStateThatIsImpossible) {
  HeldOutViews views;
  views.state = {0, 2};
  Eigen::MatrixXf densities(3, 2);
  densities << 0.0F, -2.5F, -std::numeric_limits<float>::infinity(), -1.5F, -1.5F, 0.5F;
  views.log_density = {densities};
  const std::vector<double> psi{0.3};
  const double expected = mean_log_posterior(views, psi);
  EXPECT_NEAR(
      expected,
      -0.5 * (std::log(1.0 + std::exp(-0.45)) + std::log(1.0 + std::exp(-0.9) + std::exp(-0.6))),
      2e-6);
  views.log_density[0].array() -= 1048576.0F;  // exact
  EXPECT_NEAR(mean_log_posterior(views, psi), expected, 1e-7);
}

/// In densities that were held out as in likelihoods.
TEST(MeanLogPosterior, OneNumberRulesAStateOut) {
  HeldOutViews held_out;
  held_out.state.push_back(1);
  held_out.log_density.emplace_back(Eigen::Vector2f(7.0F, -std::numeric_limits<float>::infinity()));
  EXPECT_EQ(mean_log_posterior(held_out, std::vector{1.0}), kRulesOut);
  EXPECT_EQ(kRulesOut, -1e9);
}

/// As far from the others as can be, and yet it has no part in the answer.
TEST(CalibratedPsi, IsNotChangedByAStateThatIsNeverPossible) {
  for (const float score : {2.0F, 20.0F, 200.0F}) {
    World world = of_first_state(3, score);
    const double psi = CalibratedPsi{}(world.context())[0];
    EXPECT_NEAR(psi * score, std::log(3.0), 1e-5) << score;
  }
}

TEST(CalibratedPsi, OfAFeatureThatTellsNothingIsTheGreatest) {
  World world;
  world.models.push_back(repeating_model(1));
  world.held_out.state = {0, 1};
  world.held_out.log_density.emplace_back(Eigen::MatrixXf::Zero(2, 2));
  EXPECT_EQ(CalibratedPsi{}(world.context())[0], 10.0);
}

}  // namespace
}  // namespace vantage
