// What every optimiser promises, and that each solves a made-up flight: an obstacle in the way, an
// object to look at beside it.
//
//        o             object
//
//        v             from where to look at it
//   b  q q q q q q q  a
//              X       obstacle
#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/planners/trajectory/straight_flight.hpp"

namespace vantage {
namespace {

class EveryOptimiser : public ::testing::TestWithParam<std::string_view> {
 protected:
  EveryOptimiser() {
    camera_.T_body_camera = camera_ahead(0.1, {0.12, 0.0, -0.03});
    scene_.surface = &surface_;
    scene_.target = ObservationTarget{{1.5, 2.1, 1.2}, {1.5, 0.8, 1.2}, 3.0};
  }
  [[nodiscard]] PathCost cost() const { return flight_cost({}, camera_, scene_); }
  [[nodiscard]] OptimisedHorizon run(const Horizon& horizon, const PathCost& cost,
                                     std::uint64_t seed = 1) const {
    Rng rng(seed);
    return optimise(make_strategy<TrajectoryOptimiser>(GetParam()), horizon, cost, rng);
  }

  Esdf surface_ = test::columns({{3.0, -0.25}, {1.5, 2.1}});
  FlightCamera camera_;
  FlightSurroundings scene_;
  Horizon horizon_ = test::straight_flight();
};

TEST_P(EveryOptimiser, GoesRoundTheObstacleAndLooksAtTheTarget) {
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    const auto result = run(horizon_, cost(), seed);
    EXPECT_LT(result.cost, 0.3 * result.initial_cost);
    const Horizon best{horizon_.before, result.points, horizon_.after};
    EXPECT_LT(test::clearance_m(surface_, horizon_), 0.2);
    EXPECT_GT(test::clearance_m(surface_, best), 0.6);
    const Eigen::Vector3d view = scene_.target->p_world_view_m;
    double nearest_m = std::numeric_limits<double>::infinity();
    bool seen = false;
    for (const auto waypoint : best.points.colwise()) {
      nearest_m = std::min(nearest_m, (waypoint.head<3>() - view).norm());
      const auto v = in_frame(camera_, waypoint, scene_.target->p_world_object_m);
      seen = seen || (v && v->norm() < 0.5);
    }
    EXPECT_LT(nearest_m, 0.3);
    EXPECT_TRUE(seen);
  }
}

TEST_P(EveryOptimiser, ReportsTheCostOfWhatItReturns) {
  const auto result = run(horizon_, cost());
  PathSearch search({horizon_.before, result.points, horizon_.after}, cost());
  EXPECT_NEAR(search.best_cost(), result.cost, 1e-9);
  PathSearch nominal(horizon_, cost());
  EXPECT_EQ(nominal.best_cost(), result.initial_cost);
}

TEST_P(EveryOptimiser, NeverMovesTheEnds) {
  horizon_.points(3, 0) = 3.0;
  horizon_.points(3, 9) = -3.5;  // not wrapped: it is not touched at all
  const auto result = run(horizon_, cost());
  EXPECT_EQ(result.points.col(0), horizon_.points.col(0));
  EXPECT_EQ(result.points.col(9), horizon_.points.col(9));
  EXPECT_NE(result.points.col(4), horizon_.points.col(4));
}

TEST_P(EveryOptimiser, IsTheSameForTheSameSeed) {
  const auto first = run(horizon_, cost(), 7);
  const auto second = run(horizon_, cost(), 7);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.cost, second.cost);
  EXPECT_EQ(first.evaluations, second.evaluations);
}

TEST_P(EveryOptimiser, TakesNoMoreEvaluationsThanTheOthers) {
  int calls = 0;
  const auto counted = [&, inner = cost()](const Horizon& horizon,
                                           const Eigen::Ref<Eigen::VectorXd>& of_point) {
    ++calls;
    inner(horizon, of_point);
  };
  const auto result = run(horizon_, counted);
  EXPECT_EQ(result.evaluations, calls);
  EXPECT_LE(calls, 20 * 50 + 1);
  const bool may_arrive_sooner = GetParam() == "covariant_gradient";
  EXPECT_TRUE(calls == 20 * 50 + 1 || may_arrive_sooner) << calls;
}

TEST_P(EveryOptimiser, NeverReturnsWorseThanItWasGiven) {
  // Best is where it starts.
  const auto stay = [&](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> of_point) {
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      of_point[i] = 50.0 * (horizon.points.col(i) - horizon_.points.col(i)).norm();
    }
  };
  const auto result = run(horizon_, stay);
  EXPECT_EQ(result.cost, result.initial_cost);
  EXPECT_EQ(result.points, horizon_.points);
}

TEST_P(EveryOptimiser, TurnsTheShortWay) {
  // From 170 deg to -170 deg: only the control cost counts, and it must not turn back through 0.
  const auto nothing = [](const Horizon&, const Eigen::Ref<Eigen::VectorXd>&) {};
  horizon_.before[3] = horizon_.points(3, 0) = 2.967;
  for (Eigen::Index i = 1; i < 9; ++i) horizon_.points(3, i) = i < 5 ? 2.967 : -2.967;
  horizon_.points(3, 9) = horizon_.after[3] = -2.967;
  const auto result = run(horizon_, nothing);
  EXPECT_LT(result.cost, 0.5);
  EXPECT_LT(result.cost, 0.8 * result.initial_cost);
  EXPECT_GT(result.points.row(3).cwiseAbs().minCoeff(), 2.9);
  EXPECT_LE(result.points.row(3).cwiseAbs().maxCoeff(), M_PI);
}

TEST_P(EveryOptimiser, LeavesAHorizonWithoutFreePoints) {
  const Horizon two = test::straight_flight(2);
  const auto result = run(two, cost());
  EXPECT_EQ(result.points, two.points);
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(result.cost, result.initial_cost);
}

TEST_P(EveryOptimiser, TakesShortAndLongHorizons) {
  for (const Eigen::Index count : {3, 4, 5, 25}) {
    const auto result = run(test::straight_flight(count), cost());
    EXPECT_LE(result.cost, result.initial_cost);
    EXPECT_EQ(result.points.cols(), count);
    EXPECT_TRUE(result.points.allFinite());
  }
}

TEST_P(EveryOptimiser, NeedsFiniteCosts) {
  const auto broken = [](const Horizon&, Eigen::Ref<Eigen::VectorXd> of_point) {
    of_point[3] = std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_THROW(static_cast<void>(run(horizon_, broken)), ConfigError);
}

TEST_P(EveryOptimiser, ItsDefaultsAreInRange) {
  std::visit([](const auto& options) { EXPECT_NO_THROW(check_options(options)); },
             make_strategy<TrajectoryOptimiser>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Trajectory, EveryOptimiser,
                         ::testing::ValuesIn(strategy_names<TrajectoryOptimiser>()),
                         [](const auto& info) { return std::string(info.param); });

TEST(PathSearch, BeginsWithTheFreePointsHoweverFew) {
  const PathCost cost = [](const Horizon&, const Eigen::Ref<Eigen::VectorXd>&) {};
  for (const Eigen::Index count : {2, 3, 4, 10}) {
    const Horizon flight = test::straight_flight(count);
    const PathSearch search(flight, cost);
    ASSERT_EQ(search.nominal().cols(), count - 2);
    EXPECT_EQ(search.nominal(), flight.points.middleCols(count > 2 ? 1 : 0, count - 2)) << count;
    EXPECT_NEAR(search.best_cost(), 0.0, 1e-12) << count;
    EXPECT_EQ(search.result().points, flight.points) << count;
  }
}

TEST(CemOptions, AreChecked) {
  EXPECT_THROW(check_options(Cem{.rollouts = 5, .elites = 6}), ConfigError);
  EXPECT_NO_THROW(check_options(Cem{.rollouts = 5, .elites = 5}));
}

TEST(TrajectoryOptimiser, NamesOfTheContract) {
  const std::vector<std::string_view> names{"stomp", "mppi", "cem", "covariant_gradient"};
  EXPECT_EQ(strategy_names<TrajectoryOptimiser>(), names);
}

}  // namespace
}  // namespace vantage
