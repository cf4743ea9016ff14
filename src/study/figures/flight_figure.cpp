#include "vantage/study/figures/flight_figure.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "vantage/study/figures/svg_text.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kWidth_px = 560.0;
constexpr double kMargin_m = 1.4;
constexpr double kHead_px = 34.0;
constexpr int kDirections = 8;

/// From metres to pixels.
class Frame {
 public:
  explicit Frame(const Json& path) {
    for (const Json& q : path) {
      low_x_ = std::min(low_x_, q[0].get<double>() - kMargin_m);
      high_x_ = std::max(high_x_, q[0].get<double>() + kMargin_m);
      low_y_ = std::min(low_y_, q[1].get<double>() - kMargin_m);
      high_y_ = std::max(high_y_, q[1].get<double>() + kMargin_m);
    }
    scale_ = kWidth_px / (high_x_ - low_x_);
  }
  [[nodiscard]] double x(double x_m) const { return scale_ * (x_m - low_x_); }
  [[nodiscard]] double y(double y_m) const { return kHead_px + scale_ * (high_y_ - y_m); }
  [[nodiscard]] double px(double length_m) const { return scale_ * length_m; }
  [[nodiscard]] double height_px() const { return kHead_px + scale_ * (high_y_ - low_y_); }

 private:
  double low_x_ = std::numeric_limits<double>::infinity();
  double high_x_ = -std::numeric_limits<double>::infinity();
  double low_y_ = std::numeric_limits<double>::infinity();
  double high_y_ = -std::numeric_limits<double>::infinity();
  double scale_ = 1.0;
};

std::string polyline(const Frame& frame, const Json& path, std::string_view style) {
  std::string points;
  for (const Json& q : path) {
    points +=
        fmt::format("{:.1f},{:.1f} ", frame.x(q[0].get<double>()), frame.y(q[1].get<double>()));
  }
  return fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", points, style);
}

/// A spoke for each direction, bold where the object was seen from.
std::string object_marks(const Frame& frame, const Json& object, std::size_t number) {
  const double x = object.at("x_m").get<double>();
  const double y = object.at("y_m").get<double>();
  std::set<int> seen;
  std::string svg;
  for (const Json& look : object.at("looks")) {
    seen.insert(look.at("direction").get<int>());
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"#d9480f\"/>\n",
                       frame.x(look.at("view").at("x_m").get<double>()),
                       frame.y(look.at("view").at("y_m").get<double>()));
  }
  for (int i = 0; i < kDirections; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kDirections;
    const auto end = [&](double r) {
      return std::pair(frame.x(x + r * std::cos(a)), frame.y(y + r * std::sin(a)));
    };
    const auto [x1, y1] = end(0.18);
    const auto [x2, y2] = end(0.45);
    svg += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
        "stroke-width=\"{}\"/>\n",
        x1, y1, x2, y2, seen.contains(i) ? "#d9480f" : "#b8c0cc", seen.contains(i) ? 3 : 1);
  }
  svg += fmt::format(
      "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"8\" fill=\"{2}\"/><text x=\"{0:.1f}\" "
      "y=\"{3:.1f}\" fill=\"#ffffff\" font-size=\"10\" text-anchor=\"middle\">{4}</text>\n",
      frame.x(x), frame.y(y), object.at("correct").get<bool>() ? "#0c8a5b" : "#c92a4b",
      frame.y(y) + 3.5, number);
  return svg;
}

}  // namespace

std::string flight_svg(const Json& metrics, const std::string& title) {
  const Frame frame(metrics.at("path"));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n<rect width=\"100%\" "
      "height=\"100%\" fill=\"#ffffff\"/>\n",
      kWidth_px, frame.height_px());
  svg += svg_line(10.0, 16.0, kWidth_px - 20.0, title, {.size_px = 13.0, .colour = "#1c2733"});
  svg += svg_line(10.0, 30.0, kWidth_px - 20.0,
                  "dashed: as given, blue: as flown, spokes: seen from there; green: recognised",
                  {.size_px = 10.0, .colour = "#5c6b7e"});
  svg += polyline(frame, metrics.at("path"),
                  "stroke=\"#8a96a5\" stroke-width=\"1.2\" stroke-dasharray=\"4 3\"");
  svg += polyline(frame, metrics.at("plan"), "stroke=\"#0f6fde\" stroke-width=\"2\"");
  std::size_t number = 0;
  for (const Json& object : metrics.at("objects")) svg += object_marks(frame, object, ++number);
  return svg + "</svg>\n";
}

}  // namespace vantage
