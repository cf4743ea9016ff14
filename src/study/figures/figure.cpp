#include "vantage/study/figures/figure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vantage {
namespace {

constexpr std::uint64_t kSeed = 1;

std::vector<double> values_at(const std::vector<std::vector<double>>& curves, std::size_t k,
                              bool carry_last) {
  std::vector<double> values;
  for (const auto& curve : curves) {
    if (k < curve.size()) {
      values.push_back(curve[k]);
    } else if (carry_last && !curve.empty()) {
      values.push_back(curve.back());
    }
  }
  return values;
}

}  // namespace

std::string interval_csv(const Interval& interval, std::size_t values) {
  return has_interval(values) ? fmt::format("{},{}", interval.low, interval.high) : ",";
}

FigureSeries mean_series(const Figure& figure, const std::string& panel, const std::string& name,
                         std::size_t style, const std::vector<std::vector<double>>& curves,
                         int first_x, bool carry_last) {
  std::size_t length = 0;
  for (const auto& curve : curves) length = std::max(length, curve.size());
  FigureSeries series{name, style, {}};
  for (std::size_t k = 0; k < length; ++k) {
    const auto values = values_at(curves, k, carry_last);
    Rng rng = Rng::stream(kSeed, fmt::format("{}/{}/{}/{}", figure.name, panel, name, k));
    series.points.push_back({static_cast<double>(first_x) + static_cast<double>(k), values.size(),
                             mean(values), bootstrap_mean(values, rng)});
  }
  return series;
}

std::string full_title(const Figure& figure) {
  if (figure.subtitle.empty() || figure.title.empty()) return figure.title + figure.subtitle;
  const bool ends = std::string_view(".?!:").find(figure.title.back()) != std::string_view::npos;
  return fmt::format("{}{} {}", figure.title, ends ? "" : ":", figure.subtitle);
}

std::string figure_csv(const Figure& figure) {
  std::string text = fmt::format("panel,series,{},episodes,mean,low,high\n", figure.x_label);
  for (const FigurePanel& panel : figure.panels) {
    for (const FigureSeries& series : panel.series) {
      for (const FigurePoint& point : series.points) {
        text += fmt::format("{},{},{},{},{},{}\n", panel.title, series.name, point.x, point.count,
                            point.mean, interval_csv(point.interval, point.count));
      }
    }
  }
  return text;
}

}  // namespace vantage
