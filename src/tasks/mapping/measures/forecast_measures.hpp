/// What the forecasts of an episode were worth: cells that `adaptive` said a scan would show, over
/// those it showed.
#pragma once

#include <limits>
#include <optional>

#include "vantage/runtime/measure.hpp"

namespace vantage {

/// Of all scans but the first, before which nothing is known, and of the cells between two
/// distances from the sensor.
std::optional<double> forecast_ratio(const MeasuredEpisode& episode, double from_m = 0.0,
                                     double to_m = std::numeric_limits<double>::infinity());
/// Scan by scan; a cell is added to either side, so that scans that show nothing have a ratio.
Curve forecast_ratios(const MeasuredEpisode& episode);
/// Of the scans with an interval, those whose new cells were within it.
std::optional<double> interval_coverage(const MeasuredEpisode& episode);
/// How sure the robot was at the end that it had seen the share that its `stop` asks for; none: it
/// was not asked.
std::optional<double> stop_confidence(const MeasuredEpisode& episode);
/// Of the cells newly seen, those outside the field of view that was forecast for.
std::optional<double> outside_share(const MeasuredEpisode& episode);

}  // namespace vantage
