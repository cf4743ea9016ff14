#include "vantage/planners/views/forecast_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vantage {

ForecastCalibration::ForecastCalibration(const ForecastCalibrationOptions& options)
    : options_(options) {
  check_options(options, "forecast");
}

BlockField ForecastCalibration::transmission(BlockField counted, double factor) const {
  const double exponent = scale_ * factor;
  if (exponent == 1.0) return counted;
  for (double& t : counted.per_block) t = std::pow(t, exponent);
  return counted;
}

void ForecastCalibration::observe(double predicted_cells, double predicted_at_half_cells,
                                  double actual_cells) {
  constexpr double kFewest = 1.0;     // cells: a forecast of less says nothing
  constexpr double kFlattest = 1e-3;  // a slope of less neither
  constexpr double kMost = 2.0;       // nor may one scan claim more than e^2
  if (!options_.calibrate || predicted_cells < kFewest || actual_cells < kFewest) return;
  const double slope = -std::log(predicted_at_half_cells / predicted_cells) / std::numbers::ln2;
  if (slope > -kFlattest) return;
  const double ln_scale =
      std::log(scale_) +
      std::clamp(std::log(actual_cells / predicted_cells) / slope, -kMost, kMost);
  const double weight = actual_cells * slope * slope;
  weighted_sum_ += weight * ln_scale;
  weight_ += weight;
  ++scans_;
  const double prior = options_.prior_scans * weight_ / scans_;
  scale_ = std::exp(weighted_sum_ / (weight_ + prior));
}

}  // namespace vantage
