#include "vantage/planners/views/forecast_interval.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Cells of so small a share of the first view's are as good as none.
constexpr double kNothing = 1e-3;

struct LawAt {
  double share;   ///< forecast over the first view's cells
  double mean;    ///< of ln (actual / forecast)
  double spread;  ///< half of what 16 to 84 % of them are within
};
/// From bench/forecasts on the development split of the studies planning_office_small and _large.
constexpr std::array kLaws{
    LawAt{0.0015, 0.439, 0.278}, LawAt{0.0060, 0.325, 0.230},  LawAt{0.0167, 0.243, 0.252},
    LawAt{0.0517, 0.106, 0.190}, LawAt{0.1754, -0.035, 0.148}, LawAt{0.9600, -0.014, 0.162},
};
/// |errors| there in spreads, at 2.5, 7.5, ... 97.5 %.
constexpr std::array kTrained{0.03, 0.09, 0.14, 0.21, 0.27, 0.31, 0.38, 0.45, 0.52, 0.61,
                              0.69, 0.77, 0.84, 0.93, 1.06, 1.21, 1.39, 1.68, 2.21, 3.47};

}  // namespace

ForecastInterval::ForecastInterval(const ForecastIntervalOptions& options)
    : options_(options),
      miss_(1.0 - options.confidence),
      scores_(kTrained.begin(), kTrained.end()) {
  check_options(options, "intervals");
}

void ForecastInterval::start(double first_view_cells) {
  expects(first_view_cells > 0.0, "a first view that shows something");
  first_view_cells_ = first_view_cells;
}

ForecastInterval::Law ForecastInterval::law(double forecast_cells) const {
  const double at = std::log(std::max(forecast_cells / first_view_cells_, kNothing));
  const auto above =
      std::ranges::find_if(kLaws, [&](const LawAt& entry) { return std::log(entry.share) > at; });
  if (above == kLaws.begin()) return {kLaws.front().mean, kLaws.front().spread};
  if (above == kLaws.end()) return {kLaws.back().mean, kLaws.back().spread};
  const LawAt& to = *above;
  const LawAt& from = *(above - 1);
  const double t = (at - std::log(from.share)) / std::log(to.share / from.share);
  return {std::lerp(from.mean, to.mean, t), std::lerp(from.spread, to.spread, t)};
}

double ForecastInterval::log_ratio(double forecast_cells, double actual_cells) const {
  const double nothing = kNothing * first_view_cells_;
  return std::log((actual_cells + nothing) / (forecast_cells + nothing));
}

double ForecastInterval::width() const {
  const auto n = static_cast<double>(scores_.size());
  const double rank = std::ceil((1.0 - miss_) * (n + 1.0));
  const auto index = static_cast<std::size_t>(std::clamp(rank, 1.0, n)) - 1;
  // Beyond all errors so far it widens on.
  return scores_[index] * (rank > n ? 1.5 : 1.0);
}

CellInterval ForecastInterval::of(double forecast_cells) const {
  expects(first_view_cells_ > 0.0, "a first view before the first interval");
  const auto [mean, spread] = law(forecast_cells);
  const double nothing = kNothing * first_view_cells_;
  const auto at = [&](double log_ratio) {
    return std::max(0.0, (forecast_cells + nothing) * std::exp(log_ratio) - nothing);
  };
  return {at(mean - width() * spread), at(mean + width() * spread)};
}

void ForecastInterval::observe(double forecast_cells, double actual_cells) {
  const bool outside = !of(forecast_cells).contains(actual_cells);
  miss_ += options_.rate * (1.0 - options_.confidence - (outside ? 1.0 : 0.0));
  const auto [mean, spread] = law(forecast_cells);
  const double score = std::abs(log_ratio(forecast_cells, actual_cells) - mean) / spread;
  scores_.insert(std::ranges::upper_bound(scores_, score), score);
}

}  // namespace vantage
