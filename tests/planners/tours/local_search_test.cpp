// Small instances on which each part of the local searches is needed for the best answer, found
// among random ones by leaving the parts out.
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "tests/planners/tours/small_problem.hpp"
#include "vantage/planners/tours/order_moves.hpp"
#include "vantage/planners/tours/route_search.hpp"
#include "vantage/planners/tours/tour_search.hpp"

namespace vantage {
namespace {

using Order = std::vector<std::size_t>;

TEST(OrderMoves, APartGoesForthOrBackOrTheOtherWayRound) {
  const Order order{10, 11, 12, 13, 14, 15};
  EXPECT_EQ(with_moved(order, 1, 2, 3), (Order{10, 13, 14, 11, 12, 15}));
  EXPECT_EQ(with_moved(order, 3, 2, 0), (Order{13, 14, 10, 11, 12, 15}));
  EXPECT_EQ(with_moved(order, 0, 3, 3), (Order{13, 14, 15, 10, 11, 12}));
  EXPECT_EQ(with_moved(order, 2, 3, 2), order);
  EXPECT_EQ(with_reversed(order, 1, 4), (Order{10, 13, 12, 11, 14, 15}));
  EXPECT_EQ(with_reversed(order, 0, 6), (Order{15, 14, 13, 12, 11, 10}));
  EXPECT_EQ(with_reversed(order, 6, 6), order);
}

/// From each place to each, and last from the start.
Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(rows.front().size()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      matrix(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return matrix;
}

struct KnownRoute {
  std::vector<std::vector<double>> cost;
  std::optional<std::size_t> last;
  double shortest;
};

TEST(LocalSearch, FindsTheShortestRoute) {
  const std::vector<KnownRoute> routes{{{{0, 7, 4, 5, 3, 4},
                                         {5, 0, 6, 3, 2, 7},
                                         {6, 3, 0, 2, 8, 5},
                                         {7, 7, 6, 0, 3, 4},
                                         {1, 1, 9, 7, 0, 2},
                                         {4, 5, 8, 6, 9, 0},
                                         {7, 9, 4, 2, 2, 2}},
                                        3,
                                        16.0},
                                       {{{0, 2, 6, 1, 7, 2},
                                         {4, 0, 4, 9, 3, 1},
                                         {5, 7, 0, 6, 4, 2},
                                         {5, 5, 3, 0, 3, 4},
                                         {7, 4, 3, 6, 0, 9},
                                         {7, 7, 2, 1, 9, 0},
                                         {9, 4, 2, 6, 8, 9}},
                                        {},
                                        14.0},
                                       {{{0, 1, 8, 2, 8, 7},
                                         {7, 0, 6, 8, 2, 5},
                                         {9, 3, 0, 4, 4, 2},
                                         {8, 9, 9, 0, 3, 4},
                                         {3, 7, 5, 2, 0, 2},
                                         {7, 9, 1, 7, 9, 0},
                                         {2, 1, 5, 4, 4, 5}},
                                        3,
                                        12.0},
                                       {{{0, 1, 3, 7, 6, 2},
                                         {7, 0, 3, 1, 2, 5},
                                         {9, 7, 0, 4, 1, 6},
                                         {1, 5, 2, 0, 9, 7},
                                         {5, 7, 4, 1, 0, 1},
                                         {5, 6, 7, 4, 5, 0},
                                         {8, 5, 1, 1, 3, 3}},
                                        {},
                                        8.0},
                                       {{{0, 2, 6, 5, 2, 4},
                                         {3, 0, 8, 2, 9, 4},
                                         {5, 9, 0, 6, 3, 7},
                                         {2, 2, 1, 0, 3, 5},
                                         {6, 2, 2, 1, 0, 7},
                                         {9, 2, 9, 3, 3, 0},
                                         {3, 7, 9, 8, 9, 1}},
                                        2,
                                        10.0},
                                       {{{0, 5, 8, 8, 8, 3},
                                         {7, 0, 5, 1, 4, 2},
                                         {3, 2, 0, 4, 2, 6},
                                         {9, 7, 2, 0, 1, 9},
                                         {1, 4, 8, 6, 0, 1},
                                         {8, 2, 6, 4, 1, 0},
                                         {1, 4, 2, 7, 8, 9}},
                                        {},
                                        10.0},
                                       {{{0, 6, 5, 7, 8, 1},
                                         {6, 0, 1, 3, 2, 4},
                                         {1, 4, 0, 9, 7, 7},
                                         {7, 6, 2, 0, 7, 3},
                                         {6, 8, 3, 7, 0, 3},
                                         {6, 6, 8, 9, 5, 0},
                                         {3, 7, 9, 9, 4, 5}},
                                        {},
                                        18.0}};
  for (const KnownRoute& known : routes) {
    const RouteCosts costs{matrix_of(known.cost)};
    const test::Order order = searched_route(costs, known.last);
    EXPECT_EQ(route_cost(costs, order), known.shortest);
    EXPECT_EQ(route_cost(costs, shortest_route(costs, known.last)), known.shortest);
    if (known.last) {
      EXPECT_EQ(order.back(), *known.last);
    }
  }
}

struct KnownTour {
  std::vector<float> cells;
  std::vector<ShownShares> shows;
  std::vector<std::vector<double>> travel_s;
  double scan_s;
  double left_s;
  TourObjective objective;
  std::optional<std::size_t> first;
};
constexpr double kNoEnd_s = std::numeric_limits<double>::infinity();

/// Of all that can be paid, those that begin where they are told.
double cheapest_by_trying(const PlanningProblem& problem, const KnownTour& known) {
  double cheapest = std::numeric_limits<double>::infinity();
  test::for_each_order(problem.views(), [&](const test::Order& order) {
    if (known.first && order.front() != *known.first) return;
    cheapest = std::min(cheapest, tour_cost_s(problem, known.objective, order));
  });
  return cheapest;
}

void expect_cheapest(const KnownTour& known) {
  PlanningProblem problem;
  problem.cells = known.cells;
  problem.shows = known.shows;
  problem.place_m.resize(known.shows.size(), Eigen::Vector2d::Zero());
  problem.travel_s = matrix_of(known.travel_s);
  problem.scan_s = known.scan_s;
  problem.left.time_s = known.left_s;
  const Tour tour = search_tour(problem, known.objective, {}, known.first);
  EXPECT_NEAR(tour.cost_s, cheapest_by_trying(problem, known), 1e-9);
  EXPECT_NEAR(tour.cost_s, tour_cost_s(problem, known.objective, tour.order), 1e-9);
}

TEST(LocalSearch, LeavesOutViewsFromTheLastToTheFirst) {
  expect_cheapest({{6, 7, 1, 3, 5, 1},
                   {{{1, 2}, {0.25F, 0.25F}},
                    {{4, 5}, {1.0F, 0.25F}},
                    {{0, 2, 3, 4}, {1.0F, 1.0F, 0.25F, 0.25F}},
                    {{2, 3, 4, 5}, {0.25F, 1.0F, 0.25F, 0.5F}},
                    {{0, 1, 2, 5}, {1.0F, 0.25F, 1.0F, 1.0F}},
                    {{0, 1, 5}, {0.5F, 0.5F, 1.0F}}},
                   {{0, 3, 11, 12, 7, 3},
                    {12, 0, 3, 8, 9, 3},
                    {7, 8, 0, 9, 10, 11},
                    {8, 9, 3, 0, 4, 5},
                    {9, 5, 3, 3, 0, 2},
                    {5, 11, 7, 8, 5, 0},
                    {9, 4, 5, 3, 2, 5}},
                   2.0,
                   kNoEnd_s,
                   {0.25, 200.0, 1.5},
                   5});
  expect_cheapest({{11, 7, 2, 3, 7},
                   {{{2, 3, 4}, {1.0F, 1.0F, 1.0F}},
                    {{0, 1, 2, 3}, {0.5F, 0.25F, 0.5F, 0.25F}},
                    {{1, 2, 3, 4}, {0.5F, 1.0F, 0.5F, 0.25F}},
                    {{0}, {1.0F}},
                    {{1, 2, 4}, {0.25F, 0.5F, 0.5F}}},
                   {{0, 4, 8, 10, 1},
                    {11, 0, 7, 4, 8},
                    {10, 3, 0, 5, 12},
                    {1, 8, 12, 0, 5},
                    {2, 5, 1, 7, 0},
                    {9, 9, 4, 6, 10}},
                   2.0,
                   kNoEnd_s,
                   {0.5, 20.0, 1.0},
                   {}});
}

TEST(LocalSearch, TakesInAndReordersInRounds) {
  expect_cheapest({{6, 2, 1, 10, 2, 11, 9, 12, 6},
                   {{{0, 1, 6, 7}, {0.25F, 1.0F, 0.25F, 1.0F}},
                    {{0, 3, 8}, {0.25F, 0.25F, 0.25F}},
                    {{5, 6}, {1.0F, 1.0F}},
                    {{1, 2}, {1.0F, 1.0F}},
                    {{1, 4, 7, 8}, {0.5F, 0.25F, 1.0F, 1.0F}},
                    {{3, 5, 6, 8}, {1.0F, 1.0F, 0.25F, 1.0F}}},
                   {{0, 6, 3, 11, 9, 12},
                    {12, 0, 7, 11, 4, 11},
                    {8, 12, 0, 11, 11, 10},
                    {2, 5, 12, 0, 12, 7},
                    {8, 9, 12, 12, 0, 2},
                    {3, 3, 1, 4, 8, 0},
                    {5, 8, 1, 11, 9, 7}},
                   1.0,
                   33.0,
                   {0.5, 1000.0, 1.0},
                   {}});
  expect_cheapest({{8, 1, 12, 5, 9, 4, 12, 11},
                   {{{0, 1, 2, 6}, {1.0F, 1.0F, 0.5F, 1.0F}},
                    {{2, 3, 4}, {1.0F, 1.0F, 1.0F}},
                    {{2, 3, 6}, {0.25F, 0.5F, 0.5F}},
                    {{0, 3, 4, 6}, {1.0F, 0.5F, 0.25F, 0.25F}},
                    {{0, 1, 2, 5}, {1.0F, 0.25F, 0.5F, 0.5F}}},
                   {{0, 5, 5, 4, 9},
                    {6, 0, 3, 2, 9},
                    {8, 3, 0, 10, 6},
                    {1, 5, 10, 0, 3},
                    {1, 2, 9, 7, 0},
                    {7, 8, 11, 4, 10}},
                   2.0,
                   24.0,
                   {0.5, 200.0, 1.0},
                   {}});
}

TEST(LocalSearch, MovesAndReversesParts) {
  expect_cheapest({{5, 6, 10, 1, 9, 12, 7, 5},
                   {{{2, 3, 7}, {0.25F, 0.25F, 1.0F}},
                    {{1, 3, 4, 5}, {1.0F, 0.5F, 0.25F, 0.5F}},
                    {{4, 5, 7}, {0.5F, 0.5F, 0.25F}},
                    {{5, 7}, {0.5F, 0.25F}},
                    {{2, 4}, {0.5F, 1.0F}},
                    {{4, 5}, {0.25F, 0.5F}}},
                   {{0, 4, 10, 5, 4, 5},
                    {2, 0, 10, 1, 1, 3},
                    {9, 12, 0, 3, 12, 3},
                    {3, 4, 5, 0, 10, 5},
                    {11, 4, 2, 5, 0, 9},
                    {1, 8, 11, 3, 2, 0},
                    {7, 4, 5, 11, 7, 9}},
                   1.0,
                   kNoEnd_s,
                   {0.0, 80.0, 1.0},
                   {}});
  expect_cheapest({{4, 7, 11, 4, 7, 2, 7, 2, 10},
                   {{{1, 6, 7}, {0.5F, 0.25F, 1.0F}},
                    {{1, 4, 5, 6}, {0.25F, 1.0F, 0.25F, 0.25F}},
                    {{3, 5, 6}, {1.0F, 1.0F, 0.5F}},
                    {{1, 2, 6, 7}, {0.5F, 0.5F, 0.5F, 1.0F}},
                    {{1}, {0.25F}},
                    {{6, 7, 8}, {0.25F, 0.5F, 1.0F}}},
                   {{0, 3, 8, 3, 2, 9},
                    {6, 0, 3, 6, 1, 1},
                    {8, 6, 0, 5, 4, 3},
                    {2, 5, 7, 0, 11, 11},
                    {9, 10, 1, 11, 0, 9},
                    {8, 2, 3, 12, 2, 0},
                    {11, 5, 5, 10, 7, 12}},
                   1.0,
                   kNoEnd_s,
                   {1.0, 1000.0, 1.0},
                   {}});
  expect_cheapest({{5, 9, 10, 12, 10, 4, 11},
                   {{{5}, {0.5F}},
                    {{0, 1, 6}, {0.5F, 0.5F, 0.5F}},
                    {{3}, {0.5F}},
                    {{6}, {0.5F}},
                    {{3, 4, 5}, {0.5F, 0.25F, 0.5F}}},
                   {{0, 6, 6, 8, 2},
                    {4, 0, 6, 10, 10},
                    {2, 11, 0, 1, 6},
                    {1, 8, 5, 0, 11},
                    {12, 5, 9, 3, 0},
                    {11, 3, 7, 12, 3}},
                   2.0,
                   kNoEnd_s,
                   {0.5, 1000.0, 1.5},
                   {}});
  expect_cheapest({{2, 10, 2, 12, 2, 11, 8, 4, 8},
                   {{{1, 2}, {1.0F, 0.25F}},
                    {{6}, {0.25F}},
                    {{0}, {0.25F}},
                    {{4, 8}, {0.5F, 1.0F}},
                    {{3}, {0.25F}},
                    {{0, 3, 6, 8}, {0.5F, 1.0F, 0.5F, 0.5F}}},
                   {{0, 12, 10, 5, 8, 4},
                    {6, 0, 10, 11, 8, 7},
                    {9, 6, 0, 11, 9, 12},
                    {1, 1, 5, 0, 12, 10},
                    {12, 10, 11, 8, 0, 3},
                    {2, 4, 7, 11, 3, 0},
                    {5, 5, 1, 1, 3, 6}},
                   2.0,
                   kNoEnd_s,
                   {0.25, 20.0, 1.0},
                   {}});
}

}  // namespace
}  // namespace vantage
