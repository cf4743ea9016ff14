/// How far the robot's own forecasts were off, and what hazard would have made them right.
#pragma once

#include "vantage/belief/map/block_field.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

struct ForecastCalibrationOptions {
  bool calibrate = false;
  double prior_scans = 1.0;
  void fields(auto&& f) {
    f("calibrate", calibrate,
      "true: the learnt hazard is scaled so that past forecasts of `adaptive` would have been "
      "right; false: it is taken as it was counted");
    f("prior_scans", prior_scans,
      "number of scans that the hazard as counted is worth; higher corrects more slowly",
      above(0.0));
  }
};

/// Beams count places, forecasts count cells, and clutter comes in heaps: a hazard counted right
/// need not forecast right. After each scan it is known what it should have been. With s the factor
/// on optical depths, A cells seen and P(s) forecast, b = d ln P / d ln s, the scan says
/// ln s* = ln s + ln(A / P(s)) / b; scans are averaged with weights A b^2.
class ForecastCalibration {
 public:
  /// @throws ConfigError if `options` are out of range.
  explicit ForecastCalibration(const ForecastCalibrationOptions& options);

  /// The factor on the optical depth of unobserved cells; 1 at first.
  [[nodiscard]] double scale() const { return scale_; }
  /// `counted` with all optical depths times `factor` and the scale.
  [[nodiscard]] BlockField transmission(BlockField counted, double factor = 1.0) const;

  /// Takes in one scan.
  /// @param predicted_cells with scale() @param predicted_at_half_cells with half of it
  /// @param actual_cells of the same field of view
  void observe(double predicted_cells, double predicted_at_half_cells, double actual_cells);

 private:
  ForecastCalibrationOptions options_;
  double scale_ = 1.0;
  double weighted_sum_ = 0.0;  ///< of ln s*
  double weight_ = 0.0;
  int scans_ = 0;
};

}  // namespace vantage
