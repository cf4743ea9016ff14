#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "vantage/report/page.hpp"
#include "vantage/study/figures/figure.hpp"
#include "vantage/study/figures/svg_text.hpp"

namespace vantage {
namespace {

constexpr double kPanelWidth = 470.0;
constexpr double kPanelHeight = 330.0;
constexpr double kLeft = 66.0;
constexpr double kRight = 14.0;
constexpr double kTop = 34.0;
constexpr double kBottom = 48.0;
constexpr double kTitleRow = 21.0;
constexpr double kTextRow = 17.0;
constexpr double kLegendRow = 24.0;
constexpr double kNearZero = 0.35;  ///< curves that fall below this share of their top show zero

constexpr std::string_view kInk = "#16202e";
constexpr auto kColours =
    std::to_array<std::string_view>({"#0f6fde", "#d9480f", "#0c8a5b", "#a61e8c", "#7048e8",
                                     "#a87400", "#0b8599", "#c92a4b", "#5c6b7e"});
constexpr auto kDashes = std::to_array<std::string_view>({"", "7 4", "2 4"});

std::string_view colour(std::size_t style) { return kColours[style % kColours.size()]; }
std::string_view dash(std::size_t style) {
  return kDashes[style / kColours.size() % kDashes.size()];
}

double row_of(std::size_t index, std::size_t columns) {
  const std::size_t row = index / columns;
  return static_cast<double>(row);
}

struct Axis {
  double low = 0.0;
  double high = 1.0;
  double step = 0.2;
};

/// Ticks at 1, 2 or 5 times a power of ten; both ends are ticks.
Axis axis_over(double low, double high, double wanted, double smallest_step) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (high - low <= 1e-9 * largest) high = low + std::max(1.0, 1e-6 * largest);
  const double raw = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= raw * 0.999) step = factor * power;
  }
  step = std::max(step, smallest_step);
  return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step};
}

/// The multiples of the step.
std::vector<double> ticks(const Axis& axis) {
  const auto first = static_cast<int>(std::ceil(axis.low / axis.step - 1e-9));
  const auto last = static_cast<int>(std::floor(axis.high / axis.step + 1e-9));
  std::vector<double> values;
  for (int i = first; i <= last; ++i) values.push_back(i * axis.step);
  return values;
}

std::string tick_label(double value, const Axis& axis) {
  if (std::abs(value) < 1e-9 * axis.step) return "0";
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  if (largest >= 1e6 && axis.step >= 1e4) return fmt::format("{:.6g} M", value / 1e6);
  if (largest >= 1e4 && axis.step >= 100.0) return fmt::format("{:.6g} k", value / 1e3);
  return fmt::format("{:.6g}", value);
}

struct Frame {
  double left = 0.0;
  double top = 0.0;
  Axis x;
  Axis y;
  [[nodiscard]] double at_x(double value) const {
    return left + kLeft + (value - x.low) / (x.high - x.low) * (kPanelWidth - kLeft - kRight);
  }
  [[nodiscard]] double at_y(double value) const {
    const double height = kPanelHeight - kTop - kBottom;
    return top + kTop + (1.0 - (value - y.low) / (y.high - y.low)) * height;
  }
};

Frame frame_of(const Figure& figure, const FigurePanel& panel, double left, double top) {
  double low_x = std::numeric_limits<double>::infinity();
  double high_x = -low_x;
  double low_y = low_x;
  double high_y = high_x;
  for (const FigureSeries& series : panel.series) {
    for (const FigurePoint& point : series.points) {
      low_x = std::min(low_x, point.x);
      high_x = std::max(high_x, point.x);
      low_y = std::min(low_y, point.interval.low);
      high_y = std::max(high_y, point.interval.high);
    }
  }
  if (low_x > high_x) low_x = high_x = low_y = high_y = 0.0;
  if (low_y > 0.0 && low_y < kNearZero * high_y) low_y = 0.0;
  Frame frame{left, top, axis_over(low_x, high_x, 10.0, figure.least_x_step),
              axis_over(low_y, high_y, 5.0, 0.0)};
  frame.x.low = low_x;  // the curves begin at the axis
  frame.x.high = std::max(high_x, low_x + figure.least_x_step);
  return frame;
}

constexpr SvgText kLabel{.anchor = "middle"};

std::string grid_svg(const Frame& frame) {
  std::string svg;
  const double x0 = frame.at_x(frame.x.low);
  const double x1 = frame.at_x(frame.x.high);
  const double y0 = frame.at_y(frame.y.low);
  const auto line = [&](double ax, double ay, double bx, double by, std::string_view stroke) {
    svg += fmt::format(R"(<path d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke="{}"/>)"
                       "\n",
                       ax, ay, bx, by, stroke);
  };
  for (const double value : ticks(frame.y)) {
    line(x0, frame.at_y(value), x1, frame.at_y(value), "#e3e8ef");
    svg += svg_line(x0 - 8.0, frame.at_y(value) + 4.0, kLeft - 10.0, tick_label(value, frame.y),
                    {.anchor = "end"});
  }
  for (const double value : ticks(frame.x)) {
    line(frame.at_x(value), y0, frame.at_x(value), y0 + 4.0, "#566375");
    svg += svg_line(frame.at_x(value), y0 + 18.0, kLeft, tick_label(value, frame.x), kLabel);
  }
  line(x0, y0, x1, y0, "#566375");
  return svg;
}

std::string band_svg(const FigureSeries& series, const Frame& frame) {
  std::string path;
  for (const FigurePoint& point : series.points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", frame.at_x(point.x),
                        frame.at_y(point.interval.high));
  }
  for (std::size_t i = series.points.size(); i-- > 0;) {
    const FigurePoint& point = series.points[i];
    path += fmt::format("L{:.1f} {:.1f}", frame.at_x(point.x), frame.at_y(point.interval.low));
  }
  return fmt::format(R"(<path d="{}Z" fill="{}" fill-opacity=".13"/>)"
                     "\n",
                     path, colour(series.style));
}

std::string line_svg(const FigureSeries& series, const Frame& frame) {
  std::string path;
  std::string dots;
  for (const FigurePoint& point : series.points) {
    const double x = frame.at_x(point.x);
    const double y = frame.at_y(point.mean);
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    if (series.points.size() <= 25) {
      dots += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="2.4" fill="{}"/>)"
                          "\n",
                          x, y, colour(series.style));
    }
  }
  return fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.9" )"
                     R"(stroke-linejoin="round" stroke-dasharray="{}"/>)"
                     "\n",
                     path, colour(series.style), dash(series.style)) +
         dots;
}

bool is_empty(const FigurePanel& panel) {
  return std::ranges::all_of(panel.series,
                             [](const auto& series) { return series.points.empty(); });
}

std::string panel_svg(const Figure& figure, const FigurePanel& panel, double left, double top) {
  const Frame frame = frame_of(figure, panel, left, top);
  const double middle_y = top + 0.5 * (kPanelHeight + kTop - kBottom);
  std::string svg = svg_line(left + kLeft, top + kTop - 14.0, kPanelWidth - kLeft - kRight,
                             panel.title, {.size_px = 13.5, .bold = true, .colour = kInk});
  const double middle_x = left + 0.5 * (kPanelWidth + kLeft - kRight);
  if (is_empty(panel)) return svg + svg_line(middle_x, middle_y, kPanelWidth, "not run", kLabel);
  svg += grid_svg(frame);
  for (const FigureSeries& series : panel.series) svg += band_svg(series, frame);
  for (const FigureSeries& series : panel.series) svg += line_svg(series, frame);
  svg += svg_line(middle_x, top + kPanelHeight - 10.0, kPanelWidth - kLeft - kRight, figure.x_label,
                  kLabel);
  svg += svg_line(
      left + 14.0, middle_y, kPanelHeight - 20.0, figure.y_label, kLabel,
      fmt::format(R"svg(transform="rotate(-90 {:.1f} {:.1f})")svg", left + 14.0, middle_y));
  return svg;
}

/// One entry for each series of any panel, in rows of equal columns.
std::string legend_svg(const Figure& figure, double width, double top, double& height) {
  std::vector<const FigureSeries*> entries;
  std::set<std::size_t> seen;
  std::size_t longest = 0;
  for (const FigurePanel& panel : figure.panels) {
    for (const FigureSeries& series : panel.series) {
      if (!seen.insert(series.style).second) continue;
      entries.push_back(&series);
      longest = std::max(longest, series.name.size());
    }
  }
  std::ranges::sort(entries, {}, &FigureSeries::style);
  const double column = 46.0 + 7.4 * static_cast<double>(longest);
  const auto columns = static_cast<std::size_t>(std::max(1.0, (width - kLeft) / column));
  std::string svg;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double x = kLeft + column * static_cast<double>(i % columns);
    const double y = top + kLegendRow * row_of(i, columns) + 0.5 * kLegendRow;
    const std::size_t style = entries[i]->style;
    svg += fmt::format(R"(<path d="M{:.1f} {:.1f}h22" stroke="{}" stroke-width="2.4" )"
                       R"(stroke-dasharray="{}"/>)"
                       "\n",
                       x, y, colour(style), dash(style));
    svg += svg_line(x + 28.0, y + 4.0, width - kLeft - 36.0, entries[i]->name, {.colour = kInk});
  }
  height =
      kLegendRow * std::ceil(static_cast<double>(entries.size()) / static_cast<double>(columns));
  return svg;
}

}  // namespace

std::string figure_svg(const Figure& figure) {
  const std::size_t columns = figure.panels.size() <= 1 ? 1 : figure.panels.size() <= 4 ? 2 : 3;
  const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
  const double width = kPanelWidth * static_cast<double>(columns) + 16.0;
  const double room = width - kLeft - kRight;
  double y = 24.0;
  std::string body = svg_lines(kLeft, y, room, kTitleRow, figure.title,
                               {.size_px = 16.0, .bold = true, .colour = kInk});
  body += svg_lines(kLeft, y, room, kTextRow, figure.subtitle, {.size_px = 13.0});
  const double head = y - 5.0;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    body += panel_svg(figure, figure.panels[i], kPanelWidth * static_cast<double>(i % columns),
                      head + kPanelHeight * row_of(i, columns));
  }
  const double legend_top = head + kPanelHeight * static_cast<double>(rows) + 4.0;
  double legend_height = 0.0;
  body += legend_svg(figure, width, legend_top, legend_height);
  y = legend_top + legend_height + 18.0;
  body += svg_lines(kLeft, y, room, 0.9 * kTextRow, figure.note, {.size_px = 11.0});
  const double height = y - 4.0;
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0:.0f} {1:.0f}" width="{0:.0f}" )"
      R"(height="{1:.0f}" font-family="system-ui, 'Segoe UI', 'Noto Sans', 'DejaVu Sans', )"
      R"(sans-serif" font-size="12" fill="#566375" role="img" aria-label="{2}">)"
      "\n"
      R"(<rect width="100%" height="100%" fill="#ffffff"/>)"
      "\n{3}</svg>\n",
      width, height, html_escaped(full_title(figure)), body);
}

}  // namespace vantage
