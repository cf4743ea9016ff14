/// The shortest way through given places: an open, asymmetric travelling salesman problem.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace vantage {

/// Between n places and from a start: entry (i, j) from place i to place j, row n from the start.
struct RouteCosts {
  Eigen::MatrixXd cost;  ///< (n + 1) x n, at least 0; infinity: no way

  [[nodiscard]] std::size_t places() const { return static_cast<std::size_t>(cost.cols()); }
};

/// Total cost from the start through `order`.
double route_cost(const RouteCosts& costs, const std::vector<std::size_t>& order);

/// Up to so many places the shortest route is found by dynamic programming.
inline constexpr std::size_t kExactRoutePlaces = 11;

/// Through all places, ending anywhere, or at `last`. The shortest one for up to kExactRoutePlaces;
/// above that cheapest insertion refined by 2-opt and Or-opt. Of equal ones always the same.
/// [HeldKarp1962, Or1976]
std::vector<std::size_t> shortest_route(const RouteCosts& costs,
                                        std::optional<std::size_t> last = std::nullopt);

}  // namespace vantage
