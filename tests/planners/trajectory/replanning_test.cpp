#include "vantage/planners/trajectory/replanning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/planners/trajectory/straight_flight.hpp"
#include "vantage/planners/trajectory/optimisers/smoothness.hpp"
#include "vantage/planners/trajectory/simple_paths.hpp"

namespace vantage {
namespace {

TEST(Smoothest, IsTheStraightFlightBetweenItsEnds) {
  Horizon bent = test::straight_flight();
  for (Eigen::Index i = 1; i < 9; ++i) bent.points.col(i) << 0.3, 7.0, -2.0, 0.5;
  const Horizon smooth = smoothest(bent);
  EXPECT_LT((smooth.points - test::straight_flight().points).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Smoothest, CostsLeastControl) {
  Horizon turn = test::straight_flight();
  turn.points.col(9) << 2.0, 3.0, 1.5, 3.0;
  turn.after << 2.0, 3.5, 1.5, -3.0;  // the short way on
  const auto nothing = [](const Horizon&, const Eigen::Ref<Eigen::VectorXd>&) {};
  const Horizon smooth = smoothest(turn);
  const double least = path_cost(smooth, nothing);
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    Horizon other = smooth;
    for (double& value : other.points.middleCols(1, 8).reshaped()) value += 0.01 * rng.normal();
    EXPECT_GT(path_cost(other, nothing), least);
  }
}

TEST(Cheapest, IsTheFirstOfThoseThatCostLeast) {
  const auto height = [](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> of_point) {
    for (Eigen::Index i = 0; i < horizon.count(); ++i) of_point[i] = horizon.points(2, i);
  };
  const auto of_heights = [&](const std::vector<double>& heights_m) {
    std::vector<Horizon> starts;
    for (const double height_m : heights_m) {
      starts.push_back(test::straight_flight());
      starts.back().points.row(2).setConstant(height_m);
      starts.back().before[2] = starts.back().after[2] = height_m;
    }
    return cheapest(starts, height);
  };
  EXPECT_EQ(of_heights({3.0, 1.0, 2.0}), 1U);
  EXPECT_EQ(of_heights({3.0, 2.0, 1.0}), 2U);
  EXPECT_EQ(of_heights({2.0, 1.0, 1.0, 3.0}), 1U);
  EXPECT_EQ(of_heights({1.0, 1.0}), 0U);
}

class ReplanTest : public ::testing::Test {
 protected:
  OptimisedHorizon run(const Horizon& plan, std::span<const ObservedObject> objects) {
    FlightSurroundings scene;
    scene.target = observation_target(objects, {0.0, 0.0, 1.2}, nominal_, 0.1);
    Rng rng(1);
    const auto turned = [&](const Eigen::Matrix4Xd& waypoints) {
      return initial_yaw(waypoints, objects);
    };
    return replan(Stomp{}, plan, nominal_, turned, flight_cost({}, {}, scene), rng);
  }

  Horizon flight_ = test::straight_flight();
  Eigen::Matrix4Xd nominal_ = flight_.points;
};

TEST_F(ReplanTest, GoesBackToThePathWhenNothingIsLeftToSee) {
  Horizon bent = flight_;
  for (Eigen::Index i = 1; i < 9; ++i) {
    bent.points(1, i) = 1.5 * std::sin(M_PI * static_cast<double>(i) / 9.0);
  }
  const auto result = run(bent, {});
  EXPECT_LT((result.points - nominal_).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GT(result.initial_cost, result.cost);
  EXPECT_EQ(result.evaluations, 1001 + 7);
}

TEST_F(ReplanTest, TurnsToWhatTheCameraDoesNotSee) {
  ObservedObject object;
  object.ring.p_world_object_m << 2.0, 1.5, 1.2;
  object.ring.height_m = 1.2;
  const auto result = run(flight_, {&object, 1});
  int seen = 0;
  for (const auto waypoint : result.points.colwise()) {
    const auto v = in_frame({}, waypoint, object.ring.p_world_object_m);
    if (v && v->norm() < 1.0) ++seen;
  }
  EXPECT_GE(seen, 6);
  EXPECT_EQ(result.points.col(0), flight_.points.col(0));
  EXPECT_EQ(result.points.col(9), flight_.points.col(9));
}

TEST_F(ReplanTest, KeepsAPlanThatIsBetterThanAnyOtherStart) {
  ObservedObject object;
  object.ring.p_world_object_m << 2.0, 1.5, 1.2;
  object.ring.height_m = 1.2;
  const auto first = run(flight_, {&object, 1});
  const auto second = run({flight_.before, first.points, flight_.after}, {&object, 1});
  EXPECT_NEAR(second.initial_cost, first.cost, 1e-9);
  EXPECT_LE(second.cost, first.cost);
}

TEST_F(ReplanTest, TakesTheLastTwoWaypoints) {
  flight_ = test::straight_flight(2);
  nominal_ = flight_.points;
  EXPECT_EQ(run(flight_, {}).points, nominal_);
}

TEST_F(ReplanTest, NeedsANominalPointForEach) {
  nominal_ = nominal_.leftCols(4).eval();
  EXPECT_DEATH(run(flight_, {}), "a nominal point for each");
}

TEST(Cheapest, MayComeBehindOneThatCostsMore) {
  const auto height = [](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> of_point) {
    for (Eigen::Index i = 0; i < horizon.count(); ++i) of_point[i] = horizon.points(2, i);
  };
  std::vector<Horizon> starts(3, test::straight_flight());
  for (const auto& [start, height_m] : {std::pair{0, 2.0}, {1, 3.0}, {2, 1.0}}) {
    Horizon& horizon = starts[static_cast<std::size_t>(start)];
    horizon.points.row(2).setConstant(height_m);
    horizon.before[2] = horizon.after[2] = height_m;
  }
  EXPECT_EQ(cheapest(starts, height), 2U);
}

}  // namespace
}  // namespace vantage
