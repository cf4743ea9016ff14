/// A short route through many places, by insertion and local search.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vantage/planners/tours/route.hpp"

namespace vantage {

/// Cheapest insertion, then 2-opt and Or-opt moves as long as one makes it shorter. [Or1976]
/// @param costs finite, as shortest_route() makes them @param last where it ends, if given; of any
/// number of places, at least 1
std::vector<std::size_t> searched_route(const RouteCosts& costs, std::optional<std::size_t> last);

}  // namespace vantage
