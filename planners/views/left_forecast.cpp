#include "vantage/planners/views/left_forecast.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace vantage {
namespace {

/// True over expected share at 5, 15, ... 95 % of the decisions near the end of exploring, from
/// bench/forecasts on the development split of the studies planning_office_small and _large.
constexpr std::array kTimesExpected{0.94, 1.08, 1.18, 1.27, 1.41, 1.62, 1.78, 2.04, 2.62, 3.33};

}  // namespace

double left_share(double expected_cells, double known_cells) {
  const double all = expected_cells + known_cells;
  return all > 0.0 ? expected_cells / all : 1.0;
}

double confidence_of_left(double expected, double left) {
  if (expected <= 0.0) return 1.0;
  const double times = left / expected;
  const auto above = std::ranges::upper_bound(kTimesExpected, times);
  const auto n = static_cast<double>(kTimesExpected.size());
  const auto k = static_cast<double>(above - kTimesExpected.begin());
  if (above == kTimesExpected.begin()) return 0.5 / n * times / kTimesExpected.front();
  if (above == kTimesExpected.end()) return 1.0 - 0.5 / n * kTimesExpected.back() / times;
  const double below = *(above - 1);
  return (k - 0.5 + (times - below) / (*above - below)) / n;
}

}  // namespace vantage
