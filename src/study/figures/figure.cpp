#include "vantage/study/figures/figure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vantage/report/report_data.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kFigureSeed = 1;

struct ValuesAtStep {
  std::vector<double> values;
  std::vector<std::size_t> marks;
};

ValuesAtStep values_at(const MarkedCurves& episodes, std::size_t k, bool carry_last) {
  ValuesAtStep found;
  for (std::size_t i = 0; i < episodes.curves.size(); ++i) {
    const auto& curve = episodes.curves[i];
    if (k >= curve.size() && (!carry_last || curve.empty())) continue;
    found.values.push_back(k < curve.size() ? curve[k] : curve.back());
    found.marks.push_back(episodes.clusters[i]);
  }
  return found;
}

}  // namespace

std::string interval_csv(const Interval& interval, std::size_t values) {
  return has_interval(values) ? fmt::format("{},{}", interval.low, interval.high) : ",";
}

FigureSeries mean_series(const Figure& figure, const std::string& panel, const std::string& name,
                         std::size_t style, const MarkedCurves& episodes, const CurveSteps& steps,
                         bool carry_last) {
  std::size_t length = 0;
  for (const auto& curve : episodes.curves) length = std::max(length, curve.size());
  FigureSeries series{name, style, {}};
  for (std::size_t k = 0; k < length; ++k) {
    const auto [values, marks] = values_at(episodes, k, carry_last);
    const Clusters clusters = clusters_of(marks);
    Rng rng = Rng::stream(kFigureSeed, fmt::format("{}/{}/{}/{}", figure.name, panel, name, k));
    const double x = steps.first_x + static_cast<double>(k) * steps.step;
    series.points.push_back(
        {x, values.size(), clusters.size(), mean(values), bootstrap_mean(values, clusters, rng)});
  }
  return series;
}

std::string full_title(const Figure& figure) {
  if (figure.subtitle.empty() || figure.title.empty()) return figure.title + figure.subtitle;
  const bool ends = std::string_view(".?!:").find(figure.title.back()) != std::string_view::npos;
  return fmt::format("{}{} {}", figure.title, ends ? "" : ":", figure.subtitle);
}

std::string figure_csv(const Figure& figure) {
  std::string text =
      fmt::format("panel,series,{},episodes,mean,low,high\n", csv_field(figure.x_label));
  for (const FigurePanel& panel : figure.panels) {
    for (const FigureSeries& series : panel.series) {
      for (const FigurePoint& point : series.points) {
        text += fmt::format("{},{},{},{},{},{}\n", csv_field(panel.title), csv_field(series.name),
                            point.x, point.count, point.mean,
                            interval_csv(point.interval, point.clusters));
      }
    }
  }
  return text;
}

}  // namespace vantage
