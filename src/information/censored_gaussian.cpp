#include "vantage/information/censored_gaussian.hpp"

#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"

namespace vantage {

double log_upper_tail(double z) {
  constexpr double kFarOut = 12.0;
  if (z < kFarOut) return std::log(0.5 * std::erfc(z / std::numbers::sqrt2));
  double fraction = z;
  for (int k = 24; k >= 1; --k) fraction = z + k / fraction;
  return -0.5 * (z * z + std::log(2.0 * std::numbers::pi)) - std::log(fraction);
}

double log_likelihood(Reading reading, double value, double mean, double variance) {
  expects(variance > 0.0, "a variance above 0");
  const double error = value - mean;
  switch (reading) {
    case Reading::exact:
      return -0.5 * (error * error / variance + std::log(2.0 * std::numbers::pi * variance));
    case Reading::at_least: return log_upper_tail(error / std::sqrt(variance));
    case Reading::none: break;
  }
  return 0.0;
}

}  // namespace vantage
