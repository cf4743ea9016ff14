#include "vantage/study/figures/flight_figure.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "vantage/report/page.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPlot_px = 600.0;  ///< the longer side
constexpr double kLeft_px = 52.0;
constexpr double kRight_px = 14.0;
constexpr double kTop_px = 34.0;
constexpr double kBelow_px = 46.0;  ///< tick labels and the name of the axis
constexpr double kMargin_m = 0.4;
constexpr double kLegendColumn_px = 222.0;
constexpr double kLegendRow_px = 20.0;
constexpr int kDirections = 8;

constexpr std::string_view kRoom = "fill=\"#dde2e9\" stroke=\"#8a96a5\" stroke-width=\"0.8\"";
constexpr std::string_view kGiven =
    "fill=\"none\" stroke=\"#566375\" stroke-width=\"1.2\" stroke-dasharray=\"4 3\"";
constexpr std::string_view kFlown = "fill=\"none\" stroke=\"#0f6fde\" stroke-width=\"2\"";
constexpr std::string_view kSeen = "stroke=\"#d9480f\" stroke-width=\"3\"";
constexpr std::string_view kNotSeen = "stroke=\"#aab3bf\" stroke-width=\"1\"";
constexpr std::string_view kCamera = "r=\"2.6\" fill=\"#d9480f\"";
constexpr std::string_view kStart =
    "r=\"4.5\" fill=\"#ffffff\" stroke=\"#0f6fde\" stroke-width=\"2\"";
constexpr std::string_view kRecognised = "r=\"8\" fill=\"#0c8a5b\"";
constexpr std::string_view kMistaken = "r=\"8\" fill=\"#c92a4b\"";
constexpr std::string_view kUnseen = "r=\"8\" fill=\"#5c6b7e\"";

Eigen::Vector2d place(const Json& waypoint) {
  return {waypoint[0].get<double>(), waypoint[1].get<double>()};
}
Eigen::Vector2d named_place(const Json& json) {
  return {json.at("x_m").get<double>(), json.at("y_m").get<double>()};
}

/// Everything that is drawn.
Eigen::AlignedBox2d extent_of(const Json& metrics, const std::vector<FloorOutline>& room) {
  Eigen::AlignedBox2d box;
  for (const FloorOutline& outline : room) {
    for (const Eigen::Vector2d& corner : outline) box.extend(corner);
  }
  for (const char* line : {"path", "plan"}) {
    for (const Json& q : metrics.at(line)) box.extend(place(q));
  }
  for (const Json& object : metrics.at("objects")) box.extend(named_place(object));
  if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
  return {box.min().array() - kMargin_m, box.max().array() + kMargin_m};
}

/// From metres to pixels, the same along both axes.
class RoomFrame {
 public:
  explicit RoomFrame(const Eigen::AlignedBox2d& extent)
      : box(extent), px_per_m_(kPlot_px / extent.sizes().maxCoeff()) {}
  [[nodiscard]] double x(double x_m) const { return kLeft_px + px(x_m - box.min().x()); }
  [[nodiscard]] double y(double y_m) const { return kTop_px + px(box.max().y() - y_m); }
  [[nodiscard]] double px(double length_m) const { return px_per_m_ * length_m; }
  [[nodiscard]] double left() const { return x(box.min().x()); }
  [[nodiscard]] double right() const { return x(box.max().x()); }
  [[nodiscard]] double top() const { return y(box.max().y()); }
  [[nodiscard]] double bottom() const { return y(box.min().y()); }

  const Eigen::AlignedBox2d box;  ///< world, m

 private:
  double px_per_m_;
};

std::string text_at(double x, double y, std::string_view attributes, std::string_view content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes,
                     html_escaped(content));
}

std::string line_between(double x1, double y1, double x2, double y2, std::string_view style) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", x1, y1, x2, y2, style);
}

std::string dot(double x, double y, std::string_view style) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" {}/>\n", x, y, style);
}

/// A tick every metre, or every 2, 5, 10... where that is too many.
int tick_step_m(double size_m) {
  constexpr double kMostTicks = 14.0;
  int power = 1;
  for (;; power *= 10) {
    for (const int factor : {1, 2, 5}) {
      if (size_m / (factor * power) <= kMostTicks) return factor * power;
    }
  }
}

std::string axes_svg(const RoomFrame& frame) {
  constexpr std::string_view kGrid = "stroke=\"#eef1f5\"";
  constexpr std::string_view kTick = "stroke=\"#566375\"";
  const int step = tick_step_m(frame.box.sizes().maxCoeff());
  const auto ticks = [&](int axis, auto&& draw) {
    const double last = std::floor(frame.box.max()[axis] / step);
    const double first = std::ceil(frame.box.min()[axis] / step) + 0.0;  // never -0
    for (double i = first; i <= last; i += 1.0) draw(i * step);
  };
  std::string svg;
  ticks(0, [&](double m) {
    const double x = frame.x(m);
    svg += line_between(x, frame.top(), x, frame.bottom(), kGrid);
    svg += line_between(x, frame.bottom(), x, frame.bottom() + 4.0, kTick);
    svg += text_at(x, frame.bottom() + 17.0, "text-anchor=\"middle\"", fmt::format("{:.0f}", m));
  });
  ticks(1, [&](double m) {
    const double y = frame.y(m);
    svg += line_between(frame.left(), y, frame.right(), y, kGrid);
    svg += line_between(frame.left() - 4.0, y, frame.left(), y, kTick);
    svg += text_at(frame.left() - 8.0, y + 4.0, "text-anchor=\"end\"", fmt::format("{:.0f}", m));
  });
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" {}/>\n",
      frame.left(), frame.top(), frame.right() - frame.left(), frame.bottom() - frame.top(), kTick);
  const double middle_y = 0.5 * (frame.top() + frame.bottom());
  svg += text_at(0.5 * (frame.left() + frame.right()), frame.bottom() + 36.0,
                 "text-anchor=\"middle\"", "x, m");
  return svg + text_at(14.0, middle_y,
                       fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 14 {:.1f})\"",
                                   middle_y),
                       "y, m");
}

/// A metre, below the right end of the axis.
std::string scale_svg(const RoomFrame& frame) {
  constexpr std::string_view kBar = "stroke=\"#16202e\" stroke-width=\"3\"";
  const double x = frame.right() - frame.px(1.0);
  const double y = frame.bottom() + 32.0;
  return line_between(x, y, frame.right(), y, kBar) +
         text_at(x - 7.0, y + 4.0, "text-anchor=\"end\" fill=\"#16202e\"", "1 m");
}

std::string room_svg(const RoomFrame& frame, const std::vector<FloorOutline>& room) {
  std::string svg;
  for (const FloorOutline& outline : room) {
    std::string points;
    for (const Eigen::Vector2d& p : outline) {
      points += fmt::format("{:.1f},{:.1f} ", frame.x(p.x()), frame.y(p.y()));
    }
    svg += fmt::format("<polygon points=\"{}\" {}/>\n", points, kRoom);
  }
  return svg;
}

std::string polyline(const RoomFrame& frame, const Json& path, std::string_view style) {
  std::string points;
  for (const Json& q : path) {
    points += fmt::format("{:.1f},{:.1f} ", frame.x(place(q).x()), frame.y(place(q).y()));
  }
  return fmt::format("<polyline points=\"{}\" {}/>\n", points, style);
}

/// A spoke for each direction, bold where the object was seen from.
std::string object_svg(const RoomFrame& frame, const Json& object, std::size_t number) {
  const Eigen::Vector2d p = named_place(object);
  std::set<int> seen;
  std::string svg;
  for (const Json& look : object.at("looks")) {
    seen.insert(look.at("direction").get<int>());
    const Eigen::Vector2d camera = named_place(look.at("view"));
    svg += dot(frame.x(camera.x()), frame.y(camera.y()), kCamera);
  }
  for (int i = 0; i < kDirections; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kDirections;
    const Eigen::Vector2d along(std::cos(a), std::sin(a));
    const Eigen::Vector2d from = p + 0.18 * along;
    const Eigen::Vector2d to = p + 0.45 * along;
    svg += line_between(frame.x(from.x()), frame.y(from.y()), frame.x(to.x()), frame.y(to.y()),
                        seen.contains(i) ? kSeen : kNotSeen);
  }
  const bool correct = object.at("correct").get<bool>();
  svg += dot(frame.x(p.x()), frame.y(p.y()),
             seen.empty() ? kUnseen : (correct ? kRecognised : kMistaken));
  return svg + text_at(frame.x(p.x()), frame.y(p.y()) + 3.5,
                       "fill=\"#ffffff\" font-size=\"10\" text-anchor=\"middle\"",
                       std::to_string(number));
}

struct LegendEntry {
  std::string mark;  ///< 28 px wide round (0, 0)
  std::string_view text;
};

std::vector<LegendEntry> legend() {
  const auto stroke = [](std::string_view style) {
    return line_between(-14.0, 0.0, 14.0, 0.0, style);
  };
  const auto round = [](std::string_view style) { return dot(0.0, 0.0, style); };
  return {{stroke(kGiven), "path as given"},
          {stroke(kFlown), "path as planned at the end"},
          {round(kStart), "start"},
          {round(kCamera), "camera at an observation"},
          {stroke(kSeen), "direction it was seen from"},
          {stroke(kNotSeen), "direction it was not seen from"},
          {round(kRecognised), "object, recognised"},
          {round(kMistaken), "object, mistaken"},
          {round(kUnseen), "object, never observed"},
          {fmt::format("<rect x=\"-12\" y=\"-6\" width=\"24\" height=\"12\" {}/>\n", kRoom),
           "walls and furniture"}};
}

struct Drawing {
  std::string svg;
  double height_px = 0.0;
};

Drawing legend_svg(double top, double width) {
  const auto columns = static_cast<std::size_t>(std::max(1.0, width / kLegendColumn_px));
  const auto entries = legend();
  Drawing drawing;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t row = i / columns;
    const double x = 26.0 + kLegendColumn_px * static_cast<double>(i % columns);
    const double y = top + kLegendRow_px * (static_cast<double>(row) + 0.5);
    drawing.svg +=
        fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n{}</g>\n", x, y, entries[i].mark) +
        text_at(x + 22.0, y + 4.0, "fill=\"#16202e\"", entries[i].text);
    drawing.height_px = kLegendRow_px * (static_cast<double>(row) + 1.0);
  }
  return drawing;
}

}  // namespace

std::string flight_svg(const Json& metrics, const std::string& title,
                       const std::vector<FloorOutline>& room) {
  const RoomFrame frame(extent_of(metrics, room));
  const double width = frame.right() + kRight_px;
  const Drawing legend = legend_svg(frame.bottom() + kBelow_px, width);
  const double height = frame.bottom() + kBelow_px + legend.height_px + 8.0;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"11\" "
      "fill=\"#566375\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height);
  svg += text_at(kLeft_px, 21.0, "font-size=\"14\" font-weight=\"600\" fill=\"#16202e\"", title);
  svg += axes_svg(frame) + room_svg(frame, room);
  svg += polyline(frame, metrics.at("path"), kGiven) + polyline(frame, metrics.at("plan"), kFlown);
  if (!metrics.at("plan").empty()) {
    const Eigen::Vector2d start = place(metrics.at("plan").front());
    svg += dot(frame.x(start.x()), frame.y(start.y()), kStart);
  }
  std::size_t number = 0;
  for (const Json& object : metrics.at("objects")) svg += object_svg(frame, object, ++number);
  return svg + scale_svg(frame) + legend.svg + "</svg>\n";
}

}  // namespace vantage
