/// Line figures with intervals: as data, as text, as an image.
#pragma once

#include <string>
#include <vector>

#include "vantage/information/resampling.hpp"

namespace vantage {

/// Of one value there is no interval to tell.
constexpr bool has_interval(std::size_t values) { return values > 1; }
/// "low,high", or "," where there is none.
std::string interval_csv(const Interval& interval, std::size_t values);

struct FigurePoint {
  double x = 0.0;
  std::size_t count = 0;     ///< episodes the mean is of
  std::size_t clusters = 0;  ///< that they fall into
  double mean = 0.0;
  Interval interval;  ///< 95 % bootstrap
};

struct FigureSeries {
  std::string name;
  std::size_t style = 0;  ///< the same in every panel: colour and dash
  std::vector<FigurePoint> points;
};

struct FigurePanel {
  std::string title;
  std::vector<FigureSeries> series;
};

struct Figure {
  std::string name;  ///< of its files
  std::string title;
  std::string subtitle = {};  ///< what is drawn, and which direction is better
  std::string x_label;
  std::string y_label;
  std::vector<FigurePanel> panels;
  double least_x_step = 1.0;  ///< between ticks: 1 where x is a count
  std::string note = "Mean over episodes; band: 95 % bootstrap interval of the mean.";  ///< below
};

/// A curve of each episode, and a mark that those that are alike have in common.
struct MarkedCurves {
  const std::vector<std::vector<double>>& curves;
  const std::vector<std::size_t>& clusters;
};

/// Where the values of a curve stand.
struct CurveSteps {
  double first_x = 1.0;
  double step = 1.0;
};

/// Adds the mean and its interval at each step of curves that may differ in length; `carry_last`: a
/// curve that has ended keeps its last value.
FigureSeries mean_series(const Figure& figure, const std::string& panel, const std::string& name,
                         std::size_t style, const MarkedCurves& episodes, const CurveSteps& steps,
                         bool carry_last);

/// Title and subtitle in one line.
std::string full_title(const Figure& figure);
std::string figure_csv(const Figure& figure);
/// Light background, no script, no external font.
std::string figure_svg(const Figure& figure);

}  // namespace vantage
