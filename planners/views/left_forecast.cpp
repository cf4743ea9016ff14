#include "vantage/planners/views/left_forecast.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage {
namespace {

/// True less expected share at 5, 15, ... 95 % of the decisions near the end of exploring, from
/// bench/forecasts on the development split of the study honest_stop. It is what stands in the
/// shade of clutter, more in denser scenes, and no multiple of what is expected.
constexpr std::array kMoreThanExpected{-0.0036, 0.0051, 0.0126, 0.0161, 0.0186,
                                       0.0197,  0.0205, 0.0217, 0.0245, 0.0278};
/// In which the rest, beyond the least and the most of them, falls by e.
constexpr double kTail = 0.005;

}  // namespace

double left_share(double expected_cells, double known_cells) {
  const double all = expected_cells + known_cells;
  return all > 0.0 ? expected_cells / all : 1.0;
}

double confidence_of_left(double expected, double left) {
  const double more = left - expected;
  const auto above = std::ranges::upper_bound(kMoreThanExpected, more);
  const auto n = static_cast<double>(kMoreThanExpected.size());
  const auto k = static_cast<double>(above - kMoreThanExpected.begin());
  if (above == kMoreThanExpected.begin()) return 0.5 / n * std::exp((more - *above) / kTail);
  const double below = *(above - 1);
  if (above == kMoreThanExpected.end()) return 1.0 - 0.5 / n * std::exp((below - more) / kTail);
  return (k - 0.5 + (more - below) / (*above - below)) / n;
}

}  // namespace vantage
