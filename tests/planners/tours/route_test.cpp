#include "vantage/planners/tours/route.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "tests/planners/tours/small_problem.hpp"
#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/planners/tours/route_search.hpp"

namespace vantage {
namespace {

RouteCosts random_costs(std::size_t places, Rng& rng) {
  return {test::random_problem(places, 1, rng).travel_s};
}

/// Nothing holds between its entries, not even the triangle inequality.
RouteCosts any_costs(std::size_t places, Rng& rng) {
  RouteCosts costs{
      Eigen::MatrixXd(static_cast<Eigen::Index>(places) + 1, static_cast<Eigen::Index>(places))};
  for (double& cost : costs.cost.reshaped()) cost = rng.uniform(0.0, 10.0);
  return costs;
}

bool visits_all(const test::Order& order, std::size_t places) {
  test::Order sorted = order;
  std::ranges::sort(sorted);
  test::Order all(places);
  std::iota(all.begin(), all.end(), 0U);
  return sorted == all;
}

TEST(ShortestRoute, IsTheShortestOfAllOrders) {
  Rng rng(1);
  for (int k = 0; k < 30; ++k) {
    const RouteCosts costs = k % 2 == 0 ? random_costs(8, rng) : any_costs(7, rng);
    const auto order = shortest_route(costs);
    ASSERT_TRUE(visits_all(order, costs.places()));
    EXPECT_NEAR(route_cost(costs, order), test::shortest_by_trying(costs.cost), 1e-9);
  }
}

TEST(ShortestRoute, EndsWhereItIsTold) {
  Rng rng(2);
  for (int k = 0; k < 20; ++k) {
    const RouteCosts costs = any_costs(6, rng);
    const auto order = shortest_route(costs, 4);
    ASSERT_TRUE(visits_all(order, 6));
    EXPECT_EQ(order.back(), 4U);
    // The same with ways on from there closed: only at its end it costs nothing.
    RouteCosts closed = costs;
    closed.cost.row(4).setConstant(1e6);
    EXPECT_NEAR(route_cost(costs, order), test::shortest_by_trying(closed.cost), 1e-9);
  }
}

TEST(ShortestRoute, OfNoneIsNoneAndOfOneIsThere) {
  EXPECT_TRUE(shortest_route({Eigen::MatrixXd(1, 0)}).empty());
  EXPECT_EQ(shortest_route({Eigen::MatrixXd::Constant(2, 1, 3.0)}), test::Order{0});
}

TEST(ShortestRoute, GoesThroughPlacesOutOfReachTooIfItMust) {
  RouteCosts costs{Eigen::MatrixXd::Constant(4, 3, std::numeric_limits<double>::infinity())};
  EXPECT_TRUE(visits_all(shortest_route(costs), 3));
}

/// By trying all, and by search.
TEST(ShortestRoute, GoesLastWhereItCannotGet) {
  constexpr double kNoWay = std::numeric_limits<double>::infinity();
  Rng rng(5);
  for (const std::size_t places : {std::size_t{6}, kExactRoutePlaces + 3}) {
    for (std::size_t hidden = 0; hidden < places; ++hidden) {
      RouteCosts costs = random_costs(places, rng);
      costs.cost.row(static_cast<Eigen::Index>(hidden)).setConstant(kNoWay);
      costs.cost.col(static_cast<Eigen::Index>(hidden)).setConstant(kNoWay);
      // From the start alone, and so far that nobody would go there first.
      costs.cost(static_cast<Eigen::Index>(places), static_cast<Eigen::Index>(hidden)) = 1e6;
      auto order = shortest_route(costs);
      ASSERT_TRUE(visits_all(order, places));
      EXPECT_EQ(order.back(), hidden);
      order.pop_back();
      EXPECT_LT(route_cost(costs, order), 1e6);
    }
  }
}

TEST(SearchedRoute, IsSeldomMuchLongerThanTheShortest) {
  Rng rng(3);
  double sum = 0.0;
  double worst = 1.0;
  for (int k = 0; k < 50; ++k) {
    const RouteCosts costs = random_costs(kExactRoutePlaces, rng);
    const auto order = searched_route(costs, std::nullopt);
    ASSERT_TRUE(visits_all(order, kExactRoutePlaces));
    const double ratio = route_cost(costs, order) / route_cost(costs, shortest_route(costs));
    EXPECT_GE(ratio, 1.0 - 1e-12);
    sum += ratio;
    worst = std::max(worst, ratio);
  }
  EXPECT_LT(sum / 50.0, 1.02);
  EXPECT_LT(worst, 1.15);
}

TEST(SearchedRoute, KeepsALastPlaceAtTheEnd) {
  Rng rng(4);
  for (int k = 0; k < 20; ++k) {
    const RouteCosts costs = random_costs(20, rng);
    const auto order = shortest_route(costs, 7);
    ASSERT_TRUE(visits_all(order, 20));
    EXPECT_EQ(order.back(), 7U);
  }
}

/// Four places on a line, taken in one after the other: 4 + 3 + 2 + 1 to choose from; then parts of
/// one, two and three to move from 4 + 3 + 2 places, and parts to turn round from 4. None helps.
TEST(SearchedRoute, AsksNowAndThenWhetherToGoOn) {
  RouteCosts costs{Eigen::MatrixXd(5, 4)};
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      costs.cost(i, j) = std::abs(static_cast<double>(j + 1 - (i == 4 ? 0 : i + 1)));
    }
  }
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  EXPECT_EQ(searched_route(costs, std::nullopt), (test::Order{0, 1, 2, 3}));
  EXPECT_EQ(asked, 10 + 9 + 4);
}

/// The way 0, 1, 2 costs 18, less what is saved; that by insertion, 0, 2, 1, costs 18.
TEST(SearchedRoute, ChangesForMoreThanRoundingMakes) {
  const auto order = [](double saved) {
    RouteCosts costs{Eigen::MatrixXd(4, 3)};
    costs.cost << 0.0, 3.0, 9.0,  //
        9.0, 0.0, 7.0 - saved,    //
        7.0, 1.0, 0.0,            //
        8.0, 6.0, 9.0;
    return searched_route(costs, std::nullopt);
  };
  EXPECT_EQ(order(0.8e-9), (test::Order{0, 2, 1}));
  EXPECT_EQ(order(1.5e-9), (test::Order{0, 1, 2}));
}

/// Round a circle the order is that of the circle.
TEST(SearchedRoute, GoesRoundACircleInOrder) {
  constexpr std::size_t kPlaces = 24;
  RouteCosts costs{Eigen::MatrixXd(kPlaces + 1, kPlaces)};
  const auto at = [](std::size_t i) {
    const double angle_rad = 2.0 * 3.14159265358979 * static_cast<double>(i) / (kPlaces + 1);
    return Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
  };
  for (std::size_t i = 0; i <= kPlaces; ++i) {
    for (std::size_t j = 0; j < kPlaces; ++j) {
      // Place j is the j + 1-st round the circle, the start the first.
      costs.cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          (at(i == kPlaces ? 0 : i + 1) - at(j + 1)).norm();
    }
  }
  const auto order = shortest_route(costs);
  EXPECT_NEAR(route_cost(costs, order), kPlaces * (at(0) - at(1)).norm(), 1e-9);
}

/// No way leads to any of them from the start.
TEST(SearchedRoute, BeginsWithTheFirstOfPlacesOutOfReach) {
  constexpr double kOutOfReach = std::numeric_limits<double>::infinity();
  EXPECT_EQ(searched_route({Eigen::MatrixXd::Constant(2, 1, kOutOfReach)}, std::nullopt),
            test::Order{0});
  RouteCosts costs{Eigen::MatrixXd(3, 2)};
  costs.cost << 0.0, 1.0,  //
      1.0, 0.0,            //
      kOutOfReach, kOutOfReach;
  EXPECT_EQ(searched_route(costs, std::nullopt), (test::Order{0, 1}));
}

TEST(ShortestRoute, OfEqualOnesIsAlwaysTheSame) {
  const RouteCosts costs{Eigen::MatrixXd::Constant(4, 3, 1.0)};
  EXPECT_EQ(shortest_route(costs), (test::Order{2, 1, 0}));
  EXPECT_EQ(shortest_route(costs, 1), (test::Order{2, 0, 1}));
}

/// Of costs between which nothing holds. Search alone finds a longer one.
TEST(ShortestRoute, OfElevenPlacesIsTheShortest) {
  RouteCosts costs{Eigen::MatrixXd(12, 11)};
  for (Eigen::Index i = 0; i < 12; ++i) {
    for (Eigen::Index j = 0; j < 11; ++j) {
      costs.cost(i, j) = static_cast<double>((7 * i * i + 11 * i * j + 3 * j * j * j) % 29 + 1);
    }
  }
  const auto order = shortest_route(costs);
  ASSERT_TRUE(visits_all(order, 11));
  EXPECT_EQ(route_cost(costs, order), 34.0);
  EXPECT_GT(route_cost(costs, searched_route(costs, std::nullopt)), 34.0);
}

}  // namespace
}  // namespace vantage
