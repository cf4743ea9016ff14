#include "vantage/planners/objects/information_measure.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "tests/planners/objects/small_models.hpp"
#include "tests/planners/rank_correlation.hpp"
#include "tests/support/near_duplicate_families.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

using test::about;

constexpr double kMeasureTolerance = 1e-4;  // divergences are single precision

double bits_of(const InformationMeasure& measure, const InformationQuery& query) {
  Rng rng(1);
  return expected_information(measure, query, rng).bits;
}

std::vector<InformationMeasure> every_measure() {
  std::vector<InformationMeasure> measures;
  for (const auto name : strategy_names<InformationMeasure>()) {
    measures.push_back(make_strategy<InformationMeasure>(name));
  }
  measures.emplace_back(LossOfEntropy{.at_mean = true});
  return measures;
}

/// In bits of information.
std::vector<InformationMeasure> every_measure_but_jeffreys() {
  auto measures = every_measure();
  std::erase_if(measures, [](const auto& m) { return strategy_name_of(m) == "jeffreys"; });
  return measures;
}

TEST(EveryInformationMeasure, OfStatesThatAreAlikeIsNothing) {
  const auto model = test::scalar_model({1.0F, 1.0F});
  const ObservationModel* feature = &model;
  for (const auto& measure : every_measure()) {
    EXPECT_NEAR(bits_of(measure, about({&feature, 1}, {0.5, 0.5})), 0.0, 1e-12)
        << strategy_name_of(measure);
  }
}

TEST(EveryInformationMeasure, OfTwoStatesFarApartIsABit) {
  const auto model = test::scalar_model({-50.0F, 50.0F});
  const ObservationModel* feature = &model;
  for (const auto& measure : every_measure_but_jeffreys()) {
    EXPECT_NEAR(bits_of(measure, about({&feature, 1}, {0.5, 0.5})), 1.0, 1e-9)
        << strategy_name_of(measure);
  }
}

TEST(EveryInformationMeasure, OfAFeatureThatIsIgnoredIsNothing) {
  auto model = test::scalar_model({-50.0F, 50.0F});
  model.psi = 0.0;
  const ObservationModel* feature = &model;
  for (const auto& measure : every_measure()) {
    EXPECT_NEAR(bits_of(measure, about({&feature, 1}, {0.5, 0.5})), 0.0, 1e-12)
        << strategy_name_of(measure);
  }
}

TEST(EveryInformationMeasure, OfACertainStateIsNothingAndNotMinusNothing) {
  const auto model = test::scalar_model({-50.0F});
  const ObservationModel* feature = &model;
  for (const auto& measure : every_measure()) {
    for (const std::vector<int>& group : {std::vector<int>{}, std::vector<int>{3}}) {
      const double bits = bits_of(measure, about({&feature, 1}, {1.0}, group));
      EXPECT_EQ(bits, 0.0) << strategy_name_of(measure);
      EXPECT_FALSE(std::signbit(bits)) << strategy_name_of(measure);
    }
  }
}

TEST(EveryInformationMeasure, AboutOneObjectIsNothing) {
  const auto model = test::scalar_model({-5.0F, 5.0F});
  const ObservationModel* feature = &model;
  for (const auto& measure : every_measure()) {
    EXPECT_NEAR(bits_of(measure, about({&feature, 1}, {0.5, 0.5}, {2, 2})), 0.0, 1e-12)
        << strategy_name_of(measure);
  }
}

TEST(EveryInformationMeasure, IsTheSameFromTables) {
  Rng rng(2);
  const auto families = test::near_duplicate_families(4);
  const auto model = test::near_duplicate_model(families, 20, 2.0, {}, rng);
  const ObservationModel* feature = &model;
  const DivergenceTables tables{
      .bhattacharyya_nats = divergence_table(Divergence::bhattacharyya, model, 1),
      .kullback_leibler_nats = divergence_table(Divergence::kullback_leibler, model, 1)};
  const DivergenceTables not_made{};
  Eigen::VectorXd belief = Eigen::VectorXd::LinSpaced(32, 1.0, 9.0);
  belief /= belief.sum();
  InformationQuery query{.likely = likely_states(belief, 12), .features = {&feature, 1}};
  for (const auto& measure : every_measure()) {
    query.tables = nullptr;
    const double bits = bits_of(measure, query);
    query.tables = &tables;
    EXPECT_NEAR(bits_of(measure, query), bits, kMeasureTolerance * (1.0 + bits));
    query.tables = &not_made;
    EXPECT_EQ(bits_of(measure, query), bits) << "worked out";
  }
}

/// Both bounds hold of any Gaussians at psi = 1, and at any psi of those of equal variances, where
/// sampling is exact too.
RC_GTEST_PROP(InformationBounds, BracketMonteCarlo, ()) {
  const int states = *rc::gen::inRange(2, 7);
  const bool equal_variances = *rc::gen::arbitrary<bool>();
  auto model = test::random_model(states, equal_variances);
  if (equal_variances) model.psi = *rc::gen::element(0.1, 0.5, 1.0, 2.0);
  const auto b = test::random_weights(states);
  const auto group = *rc::gen::element(
      std::vector<int>{}, *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(states),
                                                                rc::gen::inRange(0, 3)));
  const ObservationModel* feature = &model;
  const auto query = about({&feature, 1}, b, group);
  Rng rng(static_cast<std::uint64_t>(*rc::gen::inRange(0, 1'000'000)));
  const auto sampled = MonteCarloInformation{.samples = 2000}(query, rng);
  const double margin = 5.0 * sampled.standard_error_bits + kMeasureTolerance;
  RC_ASSERT(bits_of(InformationUpperBound{}, query) >= sampled.bits - margin);
  RC_ASSERT(!group.empty() || bits_of(MutualInformation{}, query) <= sampled.bits + margin);
}

RC_GTEST_PROP(JeffreysDivergence, IsTheSumOverPairs, ()) {
  auto model = test::random_model(4, false);
  model.psi = *rc::gen::element(0.25, 1.0);
  const auto b = test::random_weights(4);
  double of_states = 0.0;
  double of_objects = 0.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double bits = model.psi * b[static_cast<std::size_t>(i)] *
                          b[static_cast<std::size_t>(j)] *
                          gaussian_jeffreys_divergence_bits(test::gaussian_of(model, i),
                                                            test::gaussian_of(model, j));
      of_states += bits;
      if (i / 2 != j / 2) of_objects += bits;
    }
  }
  const ObservationModel* feature = &model;
  const double scale = 1.0 + of_states;
  RC_ASSERT(std::abs(bits_of(JeffreysDivergence{}, about({&feature, 1}, b)) - of_states) <
            kMeasureTolerance * scale);
  RC_ASSERT(std::abs(bits_of(JeffreysDivergence{}, about({&feature, 1}, b, {0, 0, 1, 1})) -
                     of_objects) < kMeasureTolerance * scale);
}

RC_GTEST_PROP(MeanFeatureInformation, IsTheFormula, ()) {
  const auto model = test::random_model(4, false);
  const auto b = test::random_weights(4);
  double of_states = 0.0;
  double of_objects = 0.0;
  for (int i = 0; i < 4; ++i) {
    double own = 0.0;
    double all = 0.0;
    for (int j = 0; j < 4; ++j) {
      const double relative =
          test::log_likelihood_at_mean(model, i, j) - test::log_likelihood_at_mean(model, i, i);
      const double p = b[static_cast<std::size_t>(j)] * std::exp(relative);
      all += p;
      if (i / 2 == j / 2) own += p;
    }
    const auto first = static_cast<std::size_t>(i - i % 2);
    own /= b[first] + b[first + 1];
    of_states += b[static_cast<std::size_t>(i)] * std::log2(1.0 / all);
    of_objects += b[static_cast<std::size_t>(i)] * std::log2(own / all);
  }
  const ObservationModel* feature = &model;
  RC_ASSERT(std::abs(bits_of(MeanFeatureInformation{}, about({&feature, 1}, b)) - of_states) <
            kMeasureTolerance * (1.0 + std::abs(of_states)));
  RC_ASSERT(std::abs(bits_of(MeanFeatureInformation{}, about({&feature, 1}, b, {0, 0, 1, 1})) -
                     of_objects) < kMeasureTolerance * (1.0 + std::abs(of_objects)));
}

TEST(MeanFeatureInformation, IsFarBelowNothingWhereANarrowStateLiesAtTheMeanOfAWideOne) {
  ObservationModel model{.feature = "many",
                         .mean = Eigen::MatrixXf::Zero(40, 2),
                         .variance = Eigen::MatrixXf::Ones(40, 2)};
  model.variance.col(0) *= 0.01F;
  const ObservationModel* feature = &model;
  EXPECT_LT(bits_of(MeanFeatureInformation{}, about({&feature, 1}, {0.5, 0.5})), -50.0);
}

TEST(LossOfEntropy, AgreesWithMonteCarloWithinStandardErrors) {
  Rng rng(3);
  const auto families = test::near_duplicate_families(6);
  for (int trial = 0; trial < 20; ++trial) {
    const auto model = test::near_duplicate_model(families, 15, 3.0, {}, rng);
    const ObservationModel* feature = &model;
    Eigen::VectorXd belief = test::normals(48, 1.5, rng).array().exp();
    belief /= belief.sum();
    const InformationQuery query{.likely = likely_states(belief, 48), .features = {&feature, 1}};
    const auto few = LossOfEntropy{}(query, rng);
    const auto many = MonteCarloInformation{.samples = 1000}(query, rng);
    EXPECT_GT(few.standard_error_bits, many.standard_error_bits);
    EXPECT_NEAR(few.bits, many.bits,
                4.0 * std::hypot(few.standard_error_bits, many.standard_error_bits));
  }
}

/// What a second view of one of many near-duplicates is worth, by a measure and by sampling, at
/// beliefs after a first view that leaves a third of them in doubt.
class NearDuplicates : public ::testing::Test {
 protected:
  static constexpr int kSituations = 20;

  static double correlation_with_monte_carlo(const InformationMeasure& measure, bool about_object) {
    Rng rng(7);
    std::vector<double> reference;
    std::vector<double> values;
    for (int s = 0; s < kSituations; ++s) {
      const Models models = random_models(rng);
      const std::vector<const ObservationModel*> features{&models[0], &models[1]};
      const Eigen::VectorXd belief = after_first_view(models, rng);
      for (const int turn : {1, 3, 5}) {
        const Eigen::VectorXd predicted = test::turned(families().states, belief, turn);
        InformationQuery query{.likely = likely_states(predicted, 320), .features = features};
        if (about_object) query.group = objects_of(families().states, query.likely.states);
        reference.push_back(MonteCarloInformation{.samples = 500}(query, rng).bits);
        query.likely = likely_states(predicted, 48);
        if (about_object) query.group = objects_of(families().states, query.likely.states);
        values.push_back(expected_information(measure, query, rng).bits);
      }
    }
    return test::rank_correlation(values, reference);
  }

 private:
  using Models = std::array<ObservationModel, 2>;

  static const test::NearDuplicateFamilies& families() {
    static const auto families = test::near_duplicate_families(40);
    return families;
  }

  static Models random_models(Rng& rng) {
    const double unlikeness = rng.uniform(0.5, 1.5);
    const test::NearDuplicateSpread spread{.near_duplicate = 0.4 * unlikeness,
                                           .decal = 1.2 * unlikeness};
    auto first = test::near_duplicate_model(families(), 20, rng.uniform(2.0, 5.0), spread, rng);
    auto second = test::near_duplicate_model(families(), 8, rng.uniform(1.0, 3.0), spread, rng);
    return {std::move(first), std::move(second)};
  }

  static Eigen::VectorXd after_first_view(const Models& models, Rng& rng) {
    const int states = families().states.size();
    const auto truth = static_cast<int>(rng.uniform_index(static_cast<std::size_t>(states)));
    Eigen::VectorXd belief = Eigen::VectorXd::Constant(states, 1.0 / states);
    for (const ObservationModel& model : models) {
      belief = test::updated(belief, test::measured_log_likelihoods(model, truth, rng));
    }
    return belief;
  }
};

TEST_F(NearDuplicates, TheBoundRanksAsMonteCarloDoes) {
  EXPECT_GE(correlation_with_monte_carlo(MutualInformation{}, false), 0.95);
}

TEST_F(NearDuplicates, TheApproximationAboutObjectsRanksAsMonteCarloDoes) {
  EXPECT_GE(correlation_with_monte_carlo(MutualInformation{}, true), 0.95);
}

/// Two objects of two poses each, and two kinds of unknown ones, wider.
ObservationModel model_with_unknown() {
  ObservationModel model = test::scalar_model({-1.0F, -0.5F, 1.5F, 2.0F, 0.0F, 0.5F});
  model.variance << 0.2F, 0.3F, 0.25F, 0.2F, 4.0F, 9.0F;
  return model;
}

/// I(object; feature) by the integral over one dimension.
double information_by_enumeration(const ObservationModel& model, const std::vector<double>& b,
                                  const std::vector<int>& object) {
  const auto entropy = [&](const Eigen::VectorXd& p) {
    std::map<int, double> mass;
    for (std::size_t i = 0; i < object.size(); ++i) {
      mass[object[i]] += p[static_cast<Eigen::Index>(i)];
    }
    double bits = 0.0;
    for (const auto& [k, m] : mass) bits -= m > 0.0 ? m * std::log2(m) : 0.0;
    return bits;
  };
  const Eigen::VectorXd prior = Eigen::Map<const Eigen::VectorXd>(b.data(), std::ssize(b));
  double bits = entropy(prior);
  constexpr double kStep = 0.005;
  for (double x = -40.0; x < 40.0; x += kStep) {
    const Eigen::VectorXf feature = Eigen::VectorXf::Constant(1, static_cast<float>(x));
    const Eigen::VectorXd joint =
        prior.cwiseProduct(log_density(model, feature).array().exp().matrix());
    bits -= kStep * joint.sum() * entropy(joint / joint.sum());
  }
  return bits;
}

TEST(InformationWithUnknown, IsWhatEnumerationSays) {
  const ObservationModel model = model_with_unknown();
  const ObservationModel* feature = &model;
  ObjectStates states;
  states.bins = 2;
  states.objects = {"cup", "mug"};
  states.unknown_category = {0, kNoCategory};
  const std::vector<double> b{0.2, 0.15, 0.25, 0.1, 0.1, 0.2};
  const std::vector<int> object = objects_of(states, std::vector<int>{0, 1, 2, 3, 4, 5});
  EXPECT_EQ(object, (std::vector<int>{0, 0, 1, 1, 2, 2}));
  const double exact = information_by_enumeration(model, b, object);
  const InformationQuery query = about({&feature, 1}, b, object);
  Rng rng(3);
  const InformationEstimate sampled = MonteCarloInformation{.samples = 40000}(query, rng);
  EXPECT_NEAR(sampled.bits, exact, 4.0 * sampled.standard_error_bits);
  EXPECT_LT(sampled.standard_error_bits, 0.01);
  EXPECT_NEAR(bits_of(MutualInformation{}, query), exact, 0.35 * exact);
  EXPECT_GE(bits_of(InformationUpperBound{}, query), exact);
}

// A factor on what is unknown is believed by the measures that look at what would be believed.
TEST(InformationWithUnknown, SamplesUseTheFactors) {
  ObservationModel model = model_with_unknown();
  const ObservationModel* feature = &model;
  const std::vector<double> b{0.0, 0.0, 0.5, 0.0, 0.0, 0.5};
  InformationQuery query = about({&feature, 1}, b, {0, 0, 1, 1, 2, 2});
  const double before = bits_of(MonteCarloInformation{}, query);
  const double at_means = bits_of(LossOfEntropy{.at_mean = true}, query);
  model.log_factor = Eigen::VectorXd::Zero(6);
  model.log_factor[5] = -200.0;  // whatever is measured, it is known
  EXPECT_GT(before, 0.1);
  EXPECT_NEAR(bits_of(MonteCarloInformation{}, query), 1.0, 1e-9) << "and believed at once";
  model.log_factor[0] = 2000.0;  // of what is impossible
  EXPECT_NEAR(bits_of(MonteCarloInformation{}, query), 1.0, 1e-9);
  EXPECT_GT(at_means, 0.1);
  EXPECT_NEAR(bits_of(LossOfEntropy{.at_mean = true}, query), 1.0, 1e-9);
}

TEST(EveryInformationMeasure, OfAViewThatCountsForLessIsAsOfASmallerPsi) {
  Rng rng(2);
  const auto families = test::near_duplicate_families(4);
  auto model = test::near_duplicate_model(families, 20, 2.0, {}, rng);
  const ObservationModel* feature = &model;
  Eigen::VectorXd belief = Eigen::VectorXd::LinSpaced(32, 1.0, 9.0);
  belief /= belief.sum();
  InformationQuery query{.likely = likely_states(belief, 12), .features = {&feature, 1}};
  const double psi = model.psi;
  for (const auto& measure : every_measure()) {
    for (const double weight : {0.4, 0.5, 2.0}) {
      model.psi = weight * psi;
      query.weight = 1.0;
      const double bits = bits_of(measure, query);
      model.psi = psi;
      query.weight = weight;
      EXPECT_NEAR(bits_of(measure, query), bits, kMeasureTolerance * (1.0 + std::abs(bits)))
          << strategy_name_of(measure) << ' ' << weight;
    }
  }
}

TEST(GainPerCost, WhatTellsLessThanNothingIsTheWorseTheMoreItCosts) {
  EXPECT_EQ(gain_per_cost(6.0, 4.0), 1.5);
  EXPECT_EQ(gain_per_cost(-6.0, 4.0), -24.0);
  EXPECT_EQ(gain_per_cost(0.0, 4.0), 0.0);
}

}  // namespace
}  // namespace vantage
