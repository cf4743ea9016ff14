// What objects look like that nothing was learnt of.
#include "vantage/recognition/calibration/unknown_training.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "vantage/information/log_space.hpp"
#include "vantage/recognition/calibration/near_duplicates.hpp"

namespace vantage {
namespace {

using ::testing::ElementsAre;
using Kind = ShownView::Kind;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

double mean_log_posterior(const std::vector<ShownView>& views, double instance, double category) {
  std::array<double, 3> sum{};
  std::array<double, 3> count{};
  for (const ShownView& view : views) {
    const std::array log_p{std::log(0.5) + view.known, std::log(0.25) + view.instance + instance,
                           std::log(0.25) + view.category + category};
    const auto kind = static_cast<std::size_t>(view.kind);
    sum[kind] += log_p[kind] - log_sum_exp(log_p);
    count[kind] += 1.0;
  }
  return 0.5 * sum[0] / count[0] + 0.25 * sum[1] / count[1] + 0.25 * sum[2] / count[2];
}

TEST(MostLikelyFactors, AreTheBestOfAGrid) {
  Rng rng(4);
  std::vector<ShownView> views;
  for (int i = 0; i < 300; ++i) {
    const auto kind = static_cast<Kind>(i % 3);
    const auto own = [&](Kind k) { return kind == k ? 2.0 : 0.0; };
    views.push_back({.kind = kind,
                     .known = 10.0 + own(Kind::known) + 3.0 * rng.normal(),
                     .instance = 40.0 + own(Kind::instance) + 3.0 * rng.normal(),
                     .category = -25.0 + own(Kind::category) + 3.0 * rng.normal()});
  }
  const UnknownFactors found = most_likely_factors(views);
  const double best = mean_log_posterior(views, found.instance, found.category);
  for (const double a : {-0.2, 0.0, 0.2}) {
    for (const double b : {-0.2, 0.0, 0.2}) {
      if (a == 0.0 && b == 0.0) continue;
      EXPECT_GT(best, mean_log_posterior(views, found.instance + a, found.category + b));
    }
  }
  EXPECT_NEAR(found.instance, -30.0, 2.0);
  EXPECT_NEAR(found.category, 35.0, 2.0);
}

TEST(MostLikelyFactors, WithoutInstancesAreOne) {
  std::vector<ShownView> views;
  for (int i = 0; i < 100; ++i) {
    views.push_back({.kind = Kind::known, .known = 5.0, .instance = kImpossible, .category = 0.0});
    views.push_back(
        {.kind = Kind::category, .known = -5.0, .instance = kImpossible, .category = 0.0});
  }
  const UnknownFactors found = most_likely_factors(views);
  EXPECT_EQ(found.instance, found.category);
  EXPECT_NEAR(found.category, 0.0, 1e-6) << "half way between the two";
}

/// Known views count half together, however many they are: half way between 5 and 1.
TEST(MostLikelyFactors, DoNotDependOnHowManyViewsThereAreOfAKind) {
  std::vector<ShownView> views(
      30, {.kind = Kind::known, .known = 5.0, .instance = kImpossible, .category = 0.0});
  views.insert(views.end(), 10,
               {.kind = Kind::category, .known = 1.0, .instance = kImpossible, .category = 0.0});
  EXPECT_NEAR(most_likely_factors(views).category, 3.0, 1e-5);
}

/// Views of each kind of unknown objects fit the other kind not at all, so that both factors are f,
/// where s(f - 6) = s(2 + ln 2 - f), s the logistic function.
TEST(MostLikelyFactors, OfBothKindsCountHalfTogether) {
  for (const auto& [of_known, of_instances, of_categories] : {std::array{12, 3, 7}, {1, 1, 1}}) {
    std::vector<ShownView> views(
        static_cast<std::size_t>(of_known),
        {.kind = Kind::known, .known = 6.0, .instance = 0.0, .category = 0.0});
    views.insert(views.end(), static_cast<std::size_t>(of_instances),
                 {.kind = Kind::instance, .known = 2.0, .instance = 0.0, .category = -1000.0});
    views.insert(views.end(), static_cast<std::size_t>(of_categories),
                 {.kind = Kind::category, .known = 2.0, .instance = -1000.0, .category = 0.0});
    const UnknownFactors found = most_likely_factors(views);
    EXPECT_NEAR(found.instance, 0.5 * (8.0 + std::numbers::ln2), 1e-5);
    EXPECT_NEAR(found.category, 0.5 * (8.0 + std::numbers::ln2), 1e-5);
  }
}

/// As above, with 205 and 199 in the place of 6 and 2.
TEST(MostLikelyFactors, OfBothKindsAreFoundFarAway) {
  std::vector<ShownView> views(
      4, {.kind = Kind::known, .known = 205.0, .instance = 0.0, .category = 0.0});
  views.insert(views.end(), 4,
               {.kind = Kind::instance, .known = 199.0, .instance = 0.0, .category = -1e5});
  views.insert(views.end(), 4,
               {.kind = Kind::category, .known = 199.0, .instance = -1e5, .category = 0.0});
  const UnknownFactors found = most_likely_factors(views);
  EXPECT_NEAR(found.instance, 0.5 * (404.0 + std::numbers::ln2), 1e-4);
  EXPECT_NEAR(found.category, 0.5 * (404.0 + std::numbers::ln2), 1e-4);
}

/// The first step, of 10, leads too far.
TEST(MostLikelyFactors, OfWhatNothingTellsApartMakeBothAsLikely) {
  const std::vector<ShownView> views{
      {.kind = Kind::known, .known = 3.0, .instance = kImpossible, .category = 0.0},
      {.kind = Kind::category, .known = 3.0, .instance = kImpossible, .category = 0.0}};
  EXPECT_NEAR(most_likely_factors(views).category, 3.0, 1e-5);
}

TEST(MostLikelyFactors, AreFoundFarAway) {
  std::vector<ShownView> views(
      4, {.kind = Kind::known, .known = 205.0, .instance = kImpossible, .category = 0.0});
  views.insert(views.end(), 4,
               {.kind = Kind::category, .known = 199.0, .instance = kImpossible, .category = 0.0});
  EXPECT_NEAR(most_likely_factors(views).category, 202.0, 1e-4);
}

/// Objects are points of a plane, the same from all sides: in each category the first two within a
/// hair, the third apart. Recordings are told from each other by nothing.
struct PointWorld {
  static constexpr int kCategories = 12;
  static constexpr double kNoise = 0.1;
  ObjectStates states;
  std::vector<Eigen::Vector2d> point;

  explicit PointWorld(Rng& rng) {
    states.bins = 1;
    for (int c = 0; c < kCategories; ++c) {
      states.categories.push_back(fmt::format("c{}", c));
      const Eigen::Vector2d middle(rng.normal(0.0, 8.0), rng.normal(0.0, 8.0));
      const Eigen::Vector2d first = middle + Eigen::Vector2d(rng.normal(), rng.normal());
      add(c, first);
      add(c, first + Eigen::Vector2d(0.05, 0.0));
      add(c, middle + Eigen::Vector2d(rng.normal(), rng.normal()));
    }
  }
  void add(int category, const Eigen::Vector2d& at) {
    states.objects.push_back(fmt::format("o{}", point.size()));
    states.category_of.push_back(category);
    point.push_back(at);
  }
  static Eigen::VectorXf seen(const Eigen::Vector2d& at, Rng& rng) {
    return (at + kNoise * Eigen::Vector2d(rng.normal(), rng.normal())).cast<float>();
  }
};

struct Learnt {
  std::vector<ObservationModel> models;
  std::vector<std::optional<UnknownFactors>> factors;
};

/// @param psi of features that all measure the same
/// @param sides bins that objects are shown in, in turn
Learnt learn(const PointWorld& world, int views_each, Rng& rng,
             const std::vector<double>& psi = {1.0}, bool only_seen = false,
             const std::vector<int>& sides = {0}) {
  RecognitionModel model;
  model.states = world.states;
  model.features.resize(
      psi.size(),
      {.name = "point", .statistics = empty_statistics(2, world.states.size()), .blobs = {}});
  std::vector<ViewFeatures> views;
  std::vector<int> shown;
  for (int k = 0; k < world.states.object_count(); ++k) {
    for (int i = 0; i < views_each; ++i) {
      ViewFeatures& view = views.emplace_back();
      const auto object = static_cast<std::size_t>(k);
      view.name = {.category = "c", .object = world.states.objects[object], .video = 1, .frame = i};
      view.yaw_rad = i * 2.0 * std::numbers::pi / views_each;  // no burst of one direction
      view.features.resize(psi.size(), {PointWorld::seen(world.point[object], rng), {}});
      shown.push_back(world.states.state(k, sides[static_cast<std::size_t>(i) % sides.size()]));
    }
  }
  const Calibration calibration = hold_out(
      views, shown, model, {HeldOutShare{.share = 0.3}, ShrunkVariance{}, 1, only_seen}, {});
  return {calibration.folds.front().models,
          calibrate_unknown(calibration, views, world.states, psi, {})};
}

TEST(NearDuplicates, AreThoseThatOneViewTakesForEachOther) {
  Rng rng(8);
  PointWorld world(rng);
  const Learnt learnt = learn(world, 60, rng);
  const std::vector<int> group = near_duplicate_groups(learnt.models, world.states, 1);
  for (std::size_t k = 0; k < group.size(); k += 3) {
    EXPECT_EQ(group[k], group[k + 1]);
    EXPECT_NE(group[k], group[k + 2]);
  }
}

// Of objects drawn as known, as another one of a category, and as one of none, in the shares that
// the prior says, what is held for unknown with probability p is unknown in p of the cases.
TEST(CalibrateUnknown, MakesTheProbabilityOfUnknownHonest) {
  Rng rng(9);
  double error = 0.0;
  double found = 0.0;
  double alarms = 0.0;
  constexpr int kWorlds = 12;
  for (int w = 0; w < kWorlds; ++w) {
    PointWorld world(rng);
    const Learnt learnt = learn(world, 20, rng);
    ASSERT_TRUE(learnt.factors[0]);
    ObjectStates states = world.states;
    states.unknown_category = unknown_hypotheses(states);
    const ObservationModel model = with_unknown(learnt.models[0], world.states, *learnt.factors[0]);
    double sum_p = 0.0;
    double sum_true = 0.0;
    constexpr int kDraws = 400;
    for (int i = 0; i < kDraws; ++i) {
      const bool unknown = i % 2 == 1;
      const auto k = rng.uniform_index(world.point.size());
      Eigen::Vector2d at = world.point[k];
      if (unknown) at += Eigen::Vector2d(rng.normal(0.0, 1.4), rng.normal(0.0, 1.4));
      if (i % 4 == 3) at = {rng.normal(0.0, 8.0), rng.normal(0.0, 8.0)};
      ObjectBelief belief = prior_belief(states, 0.5);
      update(belief, log_likelihood(model, PointWorld::seen(at, rng)));
      const double p = p_unknown(states, belief);
      sum_p += p / kDraws;
      sum_true += unknown ? 1.0 / kDraws : 0.0;
      (unknown ? found : alarms) += p > 0.5 ? 2.0 / kDraws / kWorlds : 0.0;
    }
    error += (sum_p - sum_true) / kWorlds;
  }
  EXPECT_NEAR(error, 0.0, 0.04);
  EXPECT_GT(found, 0.9);
  EXPECT_LT(alarms, 0.08);
}

// Bins that no view is of neither count for what is known nor against it.
TEST(CalibrateUnknown, KnowsNothingOfSidesThatNoViewIsOf) {
  const auto factors = [](int bins) {
    Rng rng(9);
    PointWorld world(rng);
    world.states.bins = bins;
    return *learn(world, 20, rng, {1.0}, true).factors[0];
  };
  const UnknownFactors one = factors(1);
  const UnknownFactors four = factors(4);
  EXPECT_NEAR(four.instance, one.instance, 1e-3);
  EXPECT_NEAR(four.category, one.category, 1e-3);
}

// Each is near-duplicate to the next, so that all hang together and none could be left out.
TEST(CalibrateUnknown, LearnsOfObjectsThatAllHangTogether) {
  Rng rng(9);
  PointWorld world(rng);
  for (std::size_t k = 0; k < world.point.size(); ++k) {
    world.point[k] = {0.25 * static_cast<double>(k), 0.0};
  }
  const Learnt learnt = learn(world, 60, rng);
  const std::vector<int> group = near_duplicate_groups(learnt.models, world.states, 1);
  EXPECT_EQ(std::set(group.begin(), group.end()).size(), 1U);
  ASSERT_TRUE(learnt.factors[0]);
}

TEST(CalibrateUnknown, OfAFeatureThatSaysNothingThereAreNoFactors) {
  Rng rng(9);
  const PointWorld world(rng);
  const Learnt learnt = learn(world, 20, rng, {0.0});
  ASSERT_TRUE(learnt.factors[0]);
  EXPECT_EQ(learnt.factors[0]->instance, 0.0);
  EXPECT_EQ(learnt.factors[0]->category, 0.0);
}

TEST(CalibrateUnknown, NeedsThreeObjects) {
  Rng rng(9);
  PointWorld world(rng);
  world.states.objects.resize(2);
  world.states.category_of.resize(2);
  world.point.resize(2);
  EXPECT_FALSE(learn(world, 20, rng).factors[0]);
  EXPECT_FALSE(learn(world, 20, rng, {1.0, 0.0}).factors[1]) << "whatever the feature says";
}

/// They are at 6000, farther than any that a feature has.
TEST(MostLikelyFactors, AreLookedForByFiveHundredStepsOfTen) {
  std::vector<ShownView> views(
      4, {.kind = Kind::known, .known = 6003.0, .instance = kImpossible, .category = 0.0});
  views.insert(views.end(), 4,
               {.kind = Kind::category, .known = 5997.0, .instance = kImpossible, .category = 0.0});
  EXPECT_NEAR(most_likely_factors(views).category, 5000.0, 1e-6);
}

/// The first of the world's objects, moved to there.
std::optional<UnknownFactors> factors_of_points(const std::vector<Eigen::Vector2d>& points,
                                                double psi = 1.0, int views_each = 60) {
  Rng rng(9);
  PointWorld world(rng);
  world.states.objects.resize(points.size());
  world.states.category_of.resize(points.size());
  world.point = points;
  return learn(world, views_each, rng, {psi}).factors[0];
}

std::vector<Eigen::Vector2d> row_of_four(double step) {
  return {{0.0, 0.0}, {step, 0.0}, {2.0 * step, 0.0}, {3.0 * step, 0.0}};
}

/// D = step^2 / (8 * 0.1^2), against ln 50 = 3.912; of four that hang together none is left out.
TEST(CalibrateUnknown, TakesForNearDuplicateWhatOneOfAHundredDecisionsConfuses) {
  EXPECT_FALSE(factors_of_points(row_of_four(0.1 * std::sqrt(8.0 * 3.55)), 1.0, 1000));
  EXPECT_TRUE(factors_of_points(row_of_four(0.1 * std::sqrt(8.0 * 4.25)), 1.0, 1000));
}

TEST(CalibrateUnknown, TakesForNearDuplicateWhatPsiMakesAlike) {
  EXPECT_TRUE(factors_of_points(row_of_four(1.0))) << "12.5 nats apart";
  EXPECT_FALSE(factors_of_points(row_of_four(1.0), 0.2)) << "2.5 nats apart";
}

TEST(CalibrateUnknown, NeedsFiveObjectsWhereAllHangTogether) {
  std::vector<Eigen::Vector2d> row{{0.0, 0.0}, {0.25, 0.0}, {0.5, 0.0}, {0.75, 0.0}};
  EXPECT_FALSE(factors_of_points(row));
  row.emplace_back(1.0, 0.0);
  EXPECT_TRUE(factors_of_points(row));
}

TEST(CalibrateUnknown, OfThreeThatAreApartLearnsFromTheOtherTwo) {
  const auto factors = factors_of_points({{0.0, 0.0}, {10.0, 0.0}, {0.0, 10.0}});
  ASSERT_TRUE(factors);
  EXPECT_EQ(factors->instance, factors->category) << "no category can be left out";
}

TEST(CalibrateUnknown, DoesNotDependOnTheOrderOfCategories) {
  const auto factors = [](bool turned_round) {
    Rng rng(9);
    PointWorld world(rng);
    for (int& category : world.states.category_of) {
      if (turned_round) category = PointWorld::kCategories - 1 - category;
    }
    return *learn(world, 20, rng).factors[0];
  };
  const UnknownFactors one = factors(false);
  const UnknownFactors other = factors(true);
  EXPECT_NEAR(other.instance, one.instance, 1e-6);
  EXPECT_NEAR(other.category, one.category, 1e-6);
}

/// Four in a row, of which none can be left out.
TEST(CalibrateUnknown, OfAFeatureThatSaysNothingThereAreSomeWhateverOthersLack) {
  Rng rng(9);
  PointWorld world(rng);
  world.states.objects.resize(4);
  world.states.category_of.resize(4);
  world.point = {{0.0, 0.0}, {0.25, 0.0}, {0.5, 0.0}, {0.75, 0.0}};
  const Learnt learnt = learn(world, 60, rng, {1.0, 0.0});
  EXPECT_FALSE(learnt.factors[0]);
  ASSERT_TRUE(learnt.factors[1]);
  EXPECT_EQ(learnt.factors[1]->instance, 0.0);
}

TEST(CalibrateUnknown, OfAFeatureThatSaysNothingLeavesTheNextToBeLearnt) {
  Rng rng(9);
  const PointWorld world(rng);
  const Learnt learnt = learn(world, 20, rng, {0.0, 1.0});
  ASSERT_TRUE(learnt.factors[1]);
  EXPECT_NE(learnt.factors[1]->instance, 0.0);
}

TEST(CalibrateUnknown, GoesByTheSidesThatWereShownWhicheverTheyAre) {
  const auto factors = [](int bins, const std::vector<int>& sides) {
    Rng rng(9);
    PointWorld world(rng);
    world.states.bins = bins;
    return *learn(world, 40, rng, {1.0}, true, sides).factors[0];
  };
  const UnknownFactors all = factors(2, {0, 1});
  for (const std::vector<int>& sides : {std::vector{0, 2}, {1, 3}}) {
    const UnknownFactors some = factors(4, sides);
    EXPECT_NEAR(some.instance, all.instance, 0.3);
    EXPECT_NEAR(some.category, all.category, 0.3);
  }
}

/// Where none but one can be left out it is learnt from that one, which is far away.
TEST(CalibrateUnknown, LeavesOutNoneThatATwinWouldExplain) {
  Rng rng(9);
  PointWorld world(rng);
  world.point = row_of_four(0.25);
  world.point.emplace_back(10.0, 0.0);
  world.states.objects.resize(5);
  world.states.category_of.assign(5, 0);
  const Learnt learnt = learn(world, 60, rng);
  ASSERT_TRUE(learnt.factors[0]);
  EXPECT_LT(learnt.factors[0]->instance, -10.0);
}

/// Six points far apart, each with a twin that is of the next category. With a category all its
/// twins are left out, so that what is shown is like nothing known.
TEST(CalibrateUnknown, LeavesOutTwinsInOtherCategoriesToo) {
  Rng rng(9);
  PointWorld world(rng);
  world.states.objects.clear();
  world.states.category_of.clear();
  world.states.categories.resize(6);
  world.point.clear();
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3.0;
    const Eigen::Vector2d at(10.0 * std::cos(angle), 10.0 * std::sin(angle));
    world.add(k, at);
    world.add((k + 1) % 6, at + Eigen::Vector2d(0.02, 0.0));
  }
  const Learnt learnt = learn(world, 20, rng);
  ASSERT_TRUE(learnt.factors[0]);
  EXPECT_LT(learnt.factors[0]->category, -10.0);
  EXPECT_NE(learnt.factors[0]->category, learnt.factors[0]->instance);
}

/// Of a category whose only object is left out nothing is known.
TEST(CalibrateUnknown, OfCategoriesOfOneObjectLearnsFromCategoriesAlone) {
  Rng rng(9);
  PointWorld world(rng);
  world.states.objects.resize(3);
  world.states.category_of = {0, 1, 2};
  world.states.categories.resize(3);
  world.point = {{0.0, 0.0}, {10.0, 0.0}, {0.0, 10.0}};
  const Learnt learnt = learn(world, 60, rng);
  ASSERT_TRUE(learnt.factors[0]);
  EXPECT_EQ(learnt.factors[0]->instance, learnt.factors[0]->category);
  EXPECT_LT(std::abs(learnt.factors[0]->category), 1000.0);
}

/// The first video shows one object alone: without it none is left that a model of it has seen.
TEST(CalibrateUnknown, LearnsFromViewsOfWhichNoOtherObjectWasSeen) {
  Rng rng(9);
  PointWorld world(rng);
  world.states.objects.resize(3);
  world.states.category_of = {0, 0, 0};
  world.point = {{0.0, 0.0}, {10.0, 0.0}, {0.0, 10.0}};
  RecognitionModel model;
  model.states = world.states;
  model.features.push_back({.name = "point", .statistics = empty_statistics(2, 3), .blobs = {}});
  std::vector<ViewFeatures> views;
  std::vector<int> shown;
  for (const auto& [object, video] : {std::array{0, 1}, {0, 2}, {1, 2}, {2, 2}}) {
    const auto k = static_cast<std::size_t>(object);
    for (int i = 0; i < 20; ++i) {
      ViewFeatures& view = views.emplace_back();
      view.name = {.category = "c", .object = world.states.objects[k], .video = video, .frame = i};
      view.features.push_back({PointWorld::seen(world.point[k], rng), {}});
      shown.push_back(object);
    }
  }
  const Calibration calibration =
      hold_out(views, shown, model, {HeldOutVideos{}, ShrunkVariance{}, 1, true}, {});
  const auto factors = calibrate_unknown(calibration, views, world.states, std::vector{1.0}, {});
  ASSERT_TRUE(factors.at(0));
  EXPECT_EQ(factors[0]->instance, factors[0]->category) << "no category can be left out";
  EXPECT_LT(std::abs(factors[0]->instance), 1000.0);
}

/// At first all hang together, then all but one, which is less than half of them. Only what is
/// more alike yet is left out with its twins then, so that all can be.
TEST(CalibrateUnknown, LearnsFromHalfOfTheObjectsOrMore) {
  const auto factors = factors_of_points(
      {{0.0, 0.0}, {0.28, 0.0}, {0.56, 0.0}, {0.84, 0.0}, {1.346, 0.0}}, 1.0, 400);
  ASSERT_TRUE(factors);
  EXPECT_GT(factors->instance, -3.0);
}

}  // namespace
}  // namespace vantage
