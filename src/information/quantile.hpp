/// What so many of some values are below.
#pragma once

#include <vector>

namespace vantage {

/// Of the nearest rank: one of the values.
/// @param values at least one
/// @param share 0 .. 1, of the values that are below
double quantile(std::vector<double> values, double share);

}  // namespace vantage
