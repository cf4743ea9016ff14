#include "vantage/planners/trajectory/optimisers/chomp.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/planners/trajectory/straight_flight.hpp"

namespace vantage {
namespace {

/// (x - 1)^2 + 2 y^2 of a point, and its squared distance from the one before.
void made_up_cost(const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point) {
  for (Eigen::Index i = 0; i < horizon.count(); ++i) {
    const Eigen::Vector4d here = horizon.point(i);
    cost_of_point[i] = (here[0] - 1.0) * (here[0] - 1.0) + 2.0 * here[1] * here[1] +
                       (here - horizon.point(i - 1)).head<3>().squaredNorm();
  }
}

TEST(PathGradient, AgreesWithOneCoordinateAtATime) {
  Horizon horizon = test::straight_flight(7);
  Rng rng(2);
  for (double& value : horizon.points.reshaped()) value += 0.2 * rng.normal();
  const PathCost cost = made_up_cost;
  PathSearch search(horizon, cost);
  const Eigen::Matrix4Xd here = search.nominal();
  PathGradient gradient_at(5);
  const Eigen::Matrix4Xd gradient = gradient_at(search, here, 1e-6);
  EXPECT_EQ(search.evaluations(), 1 + 12);
  for (Eigen::Index k = 0; k < here.size(); ++k) {
    Eigen::Matrix4Xd up = here;
    Eigen::Matrix4Xd down = here;
    up(k) += 1e-5;
    down(k) -= 1e-5;
    EXPECT_NEAR(gradient(k), (search.evaluate(up) - search.evaluate(down)) / 2e-5, 1e-4) << k;
  }
}

TEST(Chomp, ReachesTheMinimumOfAQuadratic) {
  // Its gradient vanishes there.
  const PathCost cost = made_up_cost;
  const Horizon horizon = test::straight_flight(7);
  Rng rng(1);
  const auto result = Chomp{.difference = 1e-6}(horizon, cost, rng);
  Horizon best = horizon;
  best.points = result.points;
  PathSearch search(best, cost);
  PathGradient gradient_at(5);
  EXPECT_LT(gradient_at(search, search.nominal(), 1e-6).cwiseAbs().maxCoeff(), 2e-3);
  EXPECT_LT(result.cost, result.initial_cost);
}

/// Paths tried from a straight flight on, that itself the first; 12 between steps are a gradient's.
std::vector<Eigen::Matrix4Xd> tried_by(const Chomp& chomp,
                                       const std::function<double(double)>& cost_of_y) {
  std::vector<Eigen::Matrix4Xd> tried;
  const PathCost cost = [&](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point) {
    tried.push_back(horizon.points);
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      cost_of_point[i] = cost_of_y(horizon.points(1, i));
    }
  };
  Rng rng(1);
  chomp(test::straight_flight(7), cost, rng);
  return tried;
}

double sideways_m(const Eigen::Matrix4Xd& from, const Eigen::Matrix4Xd& to) {
  return (to - from).row(1).cwiseAbs().maxCoeff();
}

/// 0.4 of a scale of 0.25 m from 0.01 m before a kink, however steep it is.
TEST(Chomp, HalvesAStepThatMakesItWorse) {
  const Chomp chomp{.first_step = 0.4, .scale_m = {0.5, 0.25, 0.2}};
  for (const double slope : {1e-3, 1.0, 50.0}) {
    const auto tried = tried_by(chomp, [&](double y) { return slope * std::abs(y - 0.01); });
    ASSERT_GT(tried.size(), 15U) << slope;
    EXPECT_NEAR(sideways_m(tried[0], tried[13]), 0.1, 1e-9) << slope;
    EXPECT_NEAR(sideways_m(tried[0], tried[14]), 0.05, 1e-9) << slope;
    EXPECT_NEAR(sideways_m(tried[0], tried[15]), 0.025, 1e-9) << slope;
  }
}

/// Each starts where the one before it led.
TEST(Chomp, TakesLongerStepsWhileTheyHelp) {
  const Chomp chomp{.first_step = 0.4, .scale_m = {0.5, 0.25, 0.2}};
  const auto tried = tried_by(chomp, [](double y) { return 10.0 * (y - 3.0) * (y - 3.0); });
  ASSERT_GT(tried.size(), 39U);
  EXPECT_NEAR(sideways_m(tried[0], tried[13]), 0.1, 1e-9);
  EXPECT_NEAR(sideways_m(tried[13], tried[26]), 0.15, 1e-9);
  EXPECT_NEAR(sideways_m(tried[26], tried[39]), 0.225, 1e-9);
}

/// A gradient takes 12 and is of use with a step after it alone; here each step makes it worse.
TEST(Chomp, TakesNoEvaluationThatLeadsNowhere) {
  const auto kink = [](double y) { return std::abs(y - 0.01); };
  EXPECT_EQ(tried_by(Chomp{.evaluations = 13}, kink).size(), 1U);
  EXPECT_EQ(tried_by(Chomp{.evaluations = 14}, kink).size(), 14U);
  EXPECT_EQ(tried_by(Chomp{.evaluations = 16}, kink).size(), 16U);
}

TEST(Chomp, DoesNotMoveAlongAnAxisWithoutAScale) {
  const PathCost cost = [](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point) {
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      cost_of_point[i] =
          (horizon.point(i).array() - Eigen::Array4d(3.0, 1.0, 2.5, 0.4)).square().sum();
    }
  };
  const Horizon horizon = test::straight_flight(7);
  for (const Eigen::Index still : {0, 1, 2, 3}) {
    std::array<double, 4> scale{0.5, 0.4, 0.2, 0.5};
    scale[static_cast<std::size_t>(still)] = 0.0;
    Chomp chomp;
    chomp.scale_m = {scale[0], scale[1], scale[2]};
    chomp.scale_yaw_rad = scale[3];
    Rng rng(1);
    const Eigen::Matrix4Xd moved = chomp(horizon, cost, rng).points - horizon.points;
    for (const Eigen::Index d : {0, 1, 2, 3}) {
      const double most = moved.row(d).cwiseAbs().maxCoeff();
      // What is best may be a path of the differences.
      EXPECT_EQ(most <= 1.001 * chomp.difference, d == still) << d << " of " << still;
    }
  }
}

TEST(Chomp, EndsAfterOneGradientWhereItMayNotMove) {
  const PathCost cost = made_up_cost;
  const Horizon horizon = test::straight_flight(7);
  Chomp chomp;
  chomp.scale_m = {0.0, 0.0, 0.0};
  chomp.scale_yaw_rad = 0.0;
  Rng rng(1);
  EXPECT_EQ(chomp(horizon, cost, rng).evaluations, 1 + 12);
}

}  // namespace
}  // namespace vantage
