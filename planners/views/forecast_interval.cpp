#include "vantage/planners/views/forecast_interval.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Cells of so small a share of the first view's are as good as none.
constexpr double kNothing = 1e-3;

}  // namespace

// Both as bench/forecasts prints them.
constexpr ForecastLaw kForecastsInRooms{
    .at = {{{0.0015, 0.439, 0.278},
            {0.0060, 0.325, 0.230},
            {0.0167, 0.243, 0.252},
            {0.0517, 0.106, 0.190},
            {0.1754, -0.035, 0.148},
            {0.9600, -0.014, 0.162}}},
    .errors = {0.03, 0.09, 0.14, 0.21, 0.27, 0.31, 0.38, 0.45, 0.52, 0.61,
               0.69, 0.77, 0.84, 0.93, 1.06, 1.21, 1.39, 1.68, 2.21, 3.47}};
constexpr ForecastLaw kForecastsAtTables{
    .at = {{{0.0016, -0.520, 0.486},
            {0.0060, -0.147, 0.695},
            {0.0175, 0.048, 0.926},
            {0.0536, 0.072, 0.140},
            {0.1698, 0.051, 0.165},
            {0.6956, 0.048, 0.334}}},
    .errors = {0.01, 0.05, 0.10, 0.14, 0.18, 0.23, 0.28, 0.33, 0.39, 0.46,
               0.53, 0.63, 0.74, 0.87, 1.03, 1.23, 1.43, 1.68, 2.06, 2.74}};

ForecastInterval::ForecastInterval(const ForecastIntervalOptions& options,
                                   const ForecastLaw& trained)
    : options_(options),
      trained_(trained.at),
      miss_(1.0 - options.confidence),
      scores_(trained.errors.begin(), trained.errors.end()) {
  check_options(options, "intervals");
}

void ForecastInterval::start(double first_view_cells) {
  expects(first_view_cells > 0.0, "a first view that shows something");
  first_view_cells_ = first_view_cells;
}

ForecastLaw::At ForecastInterval::law(double forecast_cells) const {
  const double share = std::max(forecast_cells / first_view_cells_, kNothing);
  const double at = std::log(share);
  const auto above = std::ranges::find_if(
      trained_, [&](const ForecastLaw::At& entry) { return std::log(entry.share) > at; });
  if (above == trained_.begin()) return trained_.front();
  if (above == trained_.end()) return trained_.back();
  const ForecastLaw::At& to = *above;
  const ForecastLaw::At& from = *(above - 1);
  const double t = (at - std::log(from.share)) / std::log(to.share / from.share);
  return {share, std::lerp(from.mean, to.mean, t), std::lerp(from.spread, to.spread, t)};
}

double ForecastInterval::log_ratio(double forecast_cells, double actual_cells) const {
  const double nothing = kNothing * first_view_cells_;
  return std::log((actual_cells + nothing) / (forecast_cells + nothing));
}

double ForecastInterval::width() const {
  const auto n = static_cast<double>(scores_.size());
  const double rank = std::ceil((1.0 - miss_) * (n + 1.0));
  const auto index = static_cast<std::size_t>(std::clamp(rank, 1.0, n)) - 1;
  // Beyond all errors so far it is half as wide again, where [Gibbs2021] has all there is.
  return scores_[index] * (rank > n ? 1.5 : 1.0);
}

CellInterval ForecastInterval::of(double forecast_cells) const {
  expects(first_view_cells_ > 0.0, "a first view before the first interval");
  const auto [share, mean, spread] = law(forecast_cells);
  const double nothing = kNothing * first_view_cells_;
  const auto at = [&](double log_ratio) {
    return std::max(0.0, (forecast_cells + nothing) * std::exp(log_ratio) - nothing);
  };
  return {at(mean - width() * spread), at(mean + width() * spread)};
}

void ForecastInterval::observe(double forecast_cells, double actual_cells) {
  const bool outside = !of(forecast_cells).contains(actual_cells);
  miss_ += options_.rate * (1.0 - options_.confidence - (outside ? 1.0 : 0.0));
  const auto [share, mean, spread] = law(forecast_cells);
  const double score = std::abs(log_ratio(forecast_cells, actual_cells) - mean) / spread;
  scores_.insert(std::ranges::upper_bound(scores_, score), score);
}

}  // namespace vantage
