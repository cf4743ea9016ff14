#include "vantage/planners/trajectory/optimisers/chomp.hpp"

#include <gtest/gtest.h>

#include <array>

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

}  // namespace
}  // namespace vantage
