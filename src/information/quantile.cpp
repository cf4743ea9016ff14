#include "vantage/information/quantile.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {

double quantile(std::vector<double> values, double share) {
  expects(!values.empty() && share >= 0.0 && share <= 1.0, "a share of some values");
  const auto at = values.begin() + std::lround(share * (static_cast<double>(values.size()) - 1.0));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace vantage
