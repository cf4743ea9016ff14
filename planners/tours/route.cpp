#include "vantage/planners/tours/route.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "vantage/core/error.hpp"
#include "vantage/planners/tours/route_search.hpp"

namespace vantage {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// A leg that cannot be gone costs more than all that can: differences stay numbers.
RouteCosts finite_costs(RouteCosts costs) {
  const auto finite = costs.cost.array().isFinite();
  const double beyond = 1.0 + finite.select(costs.cost.array(), 0.0).sum();
  costs.cost = finite.select(costs.cost.array(), beyond).eval();
  return costs;
}

/// Shortest ways from the start through every set of places to each of its members.
/// [HeldKarp1962]
class ExactRoutes {
 public:
  explicit ExactRoutes(const RouteCosts& costs)
      : costs_(costs), n_(costs.places()), best_(n_ << n_, kUnbounded), from_(n_ << n_, n_) {
    for (std::size_t set = 1; set < std::size_t{1} << n_; ++set) {
      for (std::size_t last = 0; last < n_; ++last) {
        if ((set >> last & 1U) != 0) solve(set, last);
      }
    }
  }

  [[nodiscard]] std::vector<std::size_t> route(std::optional<std::size_t> last) const {
    std::size_t set = (std::size_t{1} << n_) - 1;
    std::size_t at = last ? *last : cheapest_end(set);
    std::vector<std::size_t> order;
    while (at != n_) {
      order.push_back(at);
      const std::size_t before = from_[entry(set, at)];
      set &= ~(std::size_t{1} << at);
      at = before;
    }
    std::ranges::reverse(order);
    return order;
  }

 private:
  [[nodiscard]] std::size_t entry(std::size_t set, std::size_t last) const {
    return set * n_ + last;
  }
  [[nodiscard]] double leg(std::size_t from, std::size_t to) const {
    return costs_.cost(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to));
  }

  void solve(std::size_t set, std::size_t last) {
    const std::size_t rest = set & ~(std::size_t{1} << last);
    double& best = best_[entry(set, last)];
    if (rest == 0) {
      best = leg(n_, last);
      return;
    }
    for (std::size_t before = 0; before < n_; ++before) {
      if ((rest >> before & 1U) == 0) continue;
      const double cost = best_[entry(rest, before)] + leg(before, last);
      if (cost >= best) continue;
      best = cost;
      from_[entry(set, last)] = before;
    }
  }

  [[nodiscard]] std::size_t cheapest_end(std::size_t set) const {
    std::size_t end = 0;
    for (std::size_t last = 1; last < n_; ++last) {
      if (best_[entry(set, last)] < best_[entry(set, end)]) end = last;
    }
    return end;
  }

  const RouteCosts& costs_;
  std::size_t n_;
  std::vector<double> best_;
  std::vector<std::size_t> from_;
};

}  // namespace

double route_cost(const RouteCosts& costs, const std::vector<std::size_t>& order) {
  double sum = 0.0;
  std::size_t at = costs.places();
  for (const std::size_t place : order) {
    sum += costs.cost(static_cast<Eigen::Index>(at), static_cast<Eigen::Index>(place));
    at = place;
  }
  return sum;
}

std::vector<std::size_t> shortest_route(const RouteCosts& costs, std::optional<std::size_t> last) {
  expects(costs.cost.rows() == costs.cost.cols() + 1,
          "costs between all places and from the start");
  expects(!last || *last < costs.places(), "a last place among the places");
  if (costs.places() == 0) return {};
  const RouteCosts finite = finite_costs(costs);
  if (costs.places() <= kExactRoutePlaces) return ExactRoutes(finite).route(last);
  return searched_route(finite, last);
}

}  // namespace vantage
