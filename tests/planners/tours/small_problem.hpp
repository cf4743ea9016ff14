/// Planning problems small enough to be solved by trying everything.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage::test {

using Order = std::vector<std::size_t>;

/// Places in a square of 10 m, one metre a second; each view shows a third of the blocks in part.
inline PlanningProblem random_problem(std::size_t views, std::size_t blocks, Rng& rng) {
  PlanningProblem problem;
  problem.scan_s = 3.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    problem.cells.push_back(static_cast<float>(rng.uniform(1.0, 20.0)));
  }
  for (std::size_t i = 0; i < views; ++i) {
    problem.place_m.emplace_back(rng.uniform(0.0, 10.0), rng.uniform(0.0, 10.0));
    ShownShares& shown = problem.shows.emplace_back();
    for (std::size_t b = 0; b < blocks; ++b) {
      if (rng.uniform() > 0.34) continue;
      shown.block.push_back(static_cast<std::uint32_t>(b));
      shown.share.push_back(static_cast<float>(rng.uniform(0.05, 1.0)));
    }
  }
  const auto n = static_cast<Eigen::Index>(views);
  problem.travel_s.resize(n + 1, n);
  const Eigen::Vector2d here(5.0, 5.0);
  for (Eigen::Index i = 0; i <= n; ++i) {
    const Eigen::Vector2d from = i == n ? here : problem.place_m[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) {
      // Not the same both ways.
      problem.travel_s(i, j) = (problem.place_m[static_cast<std::size_t>(j)] - from).norm() +
                               0.1 * static_cast<double>(j % 3);
    }
  }
  return problem;
}

/// Calls visit(order) for every order of every subset of 0 .. n-1 but the empty one.
inline void for_each_order(std::size_t n, const std::function<void(const Order&)>& visit) {
  Order order;
  const std::function<void()> grow = [&] {
    for (std::size_t next = 0; next < n; ++next) {
      if (std::ranges::find(order, next) != order.end()) continue;
      order.push_back(next);
      visit(order);
      grow();
      order.pop_back();
    }
  };
  grow();
}

/// By trying all orders.
inline double shortest_by_trying(const Eigen::MatrixXd& cost) {
  Order order(static_cast<std::size_t>(cost.cols()));
  std::iota(order.begin(), order.end(), 0U);
  double best = std::numeric_limits<double>::infinity();
  do {
    double sum = 0.0;
    Eigen::Index at = cost.cols();
    for (const std::size_t place : order) {
      sum += cost(at, static_cast<Eigen::Index>(place));
      at = static_cast<Eigen::Index>(place);
    }
    best = std::min(best, sum);
  } while (std::ranges::next_permutation(order).found);
  return best;
}

}  // namespace vantage::test
