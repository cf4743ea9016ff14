/// How far off a forecast of new cells may be: an interval that the truth is in with a stated
/// confidence, whatever the errors are like, as long as none is 1.5 times any before.  [Gibbs2021]
#pragma once

#include <array>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {

struct ForecastIntervalOptions {
  double confidence = 0.9;
  double rate = 0.03;
  void fields(auto&& f) {
    f("confidence", confidence,
      "share of scans whose new cells are to be within the interval; higher makes it wider",
      between(0.01, 0.99));
    f("rate", rate,
      "how fast the interval widens after a scan outside of it, and narrows after others; higher "
      "follows sooner and varies more; 0: it only learns from the errors",
      between(0.0, 1.0));
  }
};

/// How far forecasts were off in training scenes, of ln (actual / forecast).
struct ForecastLaw {
  struct At {
    double share;   ///< forecast over the first view's cells
    double mean;    ///< median
    double spread;  ///< half of what 16 to 84 % of them are within
  };
  std::array<At, 6> at;           ///< ascending; between them by the logarithm of the share
  std::array<double, 20> errors;  ///< |those| in spreads, at 2.5, 7.5, ... 97.5 %
};
/// Of a head's sweeps in offices: the development split of planning_office_small and _large.
extern const ForecastLaw kForecastsInRooms;
/// Of a laser's scans of a worktop: that of planning_tabletop. They are less sure.
extern const ForecastLaw kForecastsAtTables;

struct CellInterval {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] bool contains(double cells) const { return low <= cells && cells <= high; }
};

/// Adaptive conformal inference on ln (actual / forecast), with its mean and spread as they were in
/// training scenes, by what the forecast is of the first view. The quantile is that of the errors
/// of training scenes and of the run so far, at a level that moves with each scan, by
/// a <- a + rate (1 - confidence - [the truth was outside]).  [Gibbs2021, (2)]
class ForecastInterval {
 public:
  /// @param trained how far such forecasts are off @throws ConfigError if `options` are out of
  /// range.
  explicit ForecastInterval(const ForecastIntervalOptions& options,
                            const ForecastLaw& trained = kForecastsInRooms);

  /// @param first_view_cells that the first scan has shown, > 0: what a view can show at all
  void start(double first_view_cells);
  /// Of so many cells forecast. Known from the first scan on.
  [[nodiscard]] CellInterval of(double forecast_cells) const;
  /// Takes in what came of it.
  void observe(double forecast_cells, double actual_cells);

 private:
  [[nodiscard]] ForecastLaw::At law(double forecast_cells) const;
  /// Of ln (actual / forecast), in which a few cells are as good as none.
  [[nodiscard]] double log_ratio(double forecast_cells, double actual_cells) const;
  [[nodiscard]] double width() const;  ///< in spreads

  ForecastIntervalOptions options_;
  std::array<ForecastLaw::At, 6> trained_;
  double first_view_cells_ = 0.0;
  double miss_;                 ///< share outside that is aimed at with the next scan
  std::vector<double> scores_;  ///< |errors| in spreads, ascending
};

}  // namespace vantage
