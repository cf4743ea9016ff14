#include "vantage/tasks/mapping/drawing/map_panel.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/runtime/drawing/frustum.hpp"
#include "vantage/runtime/drawing/map_view.hpp"
#include "vantage/runtime/drawing/panel_style.hpp"
#include "vantage/runtime/drawing/tour_drawing.hpp"

namespace vantage {
namespace {

using namespace panel;

constexpr int kSupersampling = 2;

void paint_background(cv::Mat& image) {
  for (int y = 0; y < image.rows; ++y) {
    const double t = static_cast<double>(y) / image.rows;
    image.row(y).setTo(kTop * (1.0 - t) + kBottom * t);
  }
}

std::array<Eigen::Vector3d, 8> corners_of(const Eigen::AlignedBox3d& box) {
  std::array<Eigen::Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<std::size_t>(i)] =
        box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
  }
  return corners;
}

void draw_ground(MapCanvas& canvas, const MapCamera& camera, const Eigen::AlignedBox3d& box,
                 double unit) {
  const double z = box.min().z();
  const double step = round_step(box.sizes().head<2>().maxCoeff(), 10);
  const LineStyle style{kFaint, 0.8 * unit, 0.45};
  for (const int axis : {0, 1}) {
    const int other = 1 - axis;
    for (double at = std::ceil(box.min()[axis] / step) * step; at < box.max()[axis]; at += step) {
      Eigen::Vector3d p0(0.0, 0.0, z);
      Eigen::Vector3d p1(0.0, 0.0, z);
      p0[axis] = p1[axis] = at;
      p0[other] = box.min()[other];
      p1[other] = box.max()[other];
      draw_line(canvas, camera, p0, p1, style);
    }
  }
}

void draw_box(MapCanvas& canvas, const MapCamera& camera, const Eigen::AlignedBox3d& box,
              double unit) {
  const auto corners = corners_of(box);
  for (std::size_t i = 0; i < 8; ++i) {
    for (const std::size_t bit : {1U, 2U, 4U}) {
      const bool ground = ((i | bit) & 4U) == 0;
      if ((i & bit) != 0) continue;
      const LineStyle style{kDim, (ground ? 1.6 : 1.0) * unit, ground ? 0.9 : 0.4};
      draw_line(canvas, camera, corners[i], corners[i | bit], style);
    }
  }
}

void draw_robot(MapCanvas& canvas, const MapCamera& camera, const MapPanelInput& input, double z,
                double size_m, double unit) {
  for (std::size_t i = 1; i < input.path_m.size(); ++i) {
    const auto& p0 = input.path_m[i - 1];
    const auto& p1 = input.path_m[i];
    draw_line(canvas, camera, {p0.x(), p0.y(), z}, {p1.x(), p1.y(), z},
              {kRobot, 2.0 * unit, 0.55, 0.2});
  }
  const Pose T = to_se3(input.T_world_base, z);
  const std::array<Eigen::Vector3d, 4> outline{
      {{1.0, 0.0, 0.0}, {-0.7, 0.7, 0.0}, {-0.35, 0.0, 0.0}, {-0.7, -0.7, 0.0}}};
  std::vector<cv::Point> polygon;
  for (const auto& corner : outline) {
    const Eigen::Vector3d p = camera.project(T * Eigen::Vector3d(size_m * corner));
    if (p.z() <= 0.0) return;
    polygon.emplace_back(static_cast<int>(std::lround(p.x())),
                         static_cast<int>(std::lround(p.y())));
  }
  cv::fillPoly(canvas.bgr, std::vector<std::vector<cv::Point>>{polygon}, kRobot, cv::LINE_AA);
}

/// The order numbers of the views taken. A view taken twice shows all its numbers.
void draw_order_numbers(cv::Mat& image, const Layout& layout, const MapCamera& camera,
                        const std::vector<Pose>& chosen) {
  std::vector<std::pair<Eigen::Vector2d, std::string>> labels;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Eigen::Vector3d p = camera.project(chosen[i].translation());
    if (p.z() <= 0.0) continue;
    const auto same = std::find_if(labels.begin(), labels.end(), [&](const auto& label) {
      return (label.first - p.head<2>()).norm() < layout.px(12.0);
    });
    if (same != labels.end()) {
      same->second += fmt::format(",{}", i + 1);
    } else {
      labels.emplace_back(p.head<2>(), std::to_string(i + 1));
    }
  }
  const std::string newest = std::to_string(chosen.size());
  for (const auto& [p, label] : labels) {
    const bool current = label == newest || label.ends_with("," + newest);
    const double half = layout.px(9.0 + 3.4 * static_cast<double>(label.size() - 1));
    const cv::Point left(static_cast<int>(p.x() - half + layout.px(9.0)), static_cast<int>(p.y()));
    const cv::Point right(static_cast<int>(p.x() + half - layout.px(9.0)), static_cast<int>(p.y()));
    const cv::Scalar fill = current ? kAccent : kVisited;
    cv::line(image, left, right, kBottom, layout.stroke(21.0), cv::LINE_AA);
    cv::line(image, left, right, fill, layout.stroke(18.0), cv::LINE_AA);
    text(image, layout, label, {p.x(), p.y() + layout.px(4.2)}, 12.0, kBottom, Align::centre, true);
  }
}

/// Where a tour is drawn: among the views, which of a table stand beside the map.
double z_of_views(const MapPanelInput& input) {
  const auto& chosen = input.T_world_chosen;
  return chosen.empty() ? input.grid->frame.box().min().z() : chosen.back().translation().z();
}

void draw_map(cv::Mat& image, const Layout& layout, const MapPanelInput& input,
              const cv::Rect& viewport) {
  const Eigen::AlignedBox3d box = input.grid->frame.box();
  const double frustum_m = 0.13 * std::min(box.sizes().x(), box.sizes().y());
  const auto corners = corners_of(box);
  std::vector<Eigen::Vector3d> shown(corners.begin(), corners.end());
  for (const Pose& T : input.T_world_candidates) shown.emplace_back(T.translation());
  for (const Pose& T : input.T_world_chosen) shown.emplace_back(T.translation());
  const MapCamera camera = fit_camera(shown, input.azimuth_rad, input.elevation_rad, viewport);

  MapCanvas canvas{image, cv::Mat(image.size(), CV_32F, cv::Scalar())};
  draw_ground(canvas, camera, box, layout.unit);
  draw_voxels(canvas, camera, *input.grid);
  draw_box(canvas, camera, box, layout.unit);
  for (const Pose& T : input.T_world_candidates) {
    draw_frustum(canvas, camera, T, frustum_m, {kDim, 0.9 * layout.unit, 0.42, 0.12});
  }
  draw_robot(canvas, camera, input, box.min().z(), 0.8 * frustum_m, layout.unit);
  for (std::size_t i = 0; i < input.T_world_chosen.size(); ++i) {
    const bool current = i + 1 == input.T_world_chosen.size();
    const LineStyle style{current ? kAccent : kVisited, (current ? 2.2 : 1.5) * layout.unit, 0.95,
                          0.3};
    draw_frustum(canvas, camera, input.T_world_chosen[i], frustum_m * (current ? 1.6 : 1.0), style);
  }
  draw_tour(canvas, camera, input.tour,
            {.from_m = Eigen::Vector2d(input.T_world_base.x_m, input.T_world_base.y_m),
             .z_m = z_of_views(input),
             .number = input.T_world_chosen.size(),
             .marks_next = false,
             .unit = layout.unit});
  draw_order_numbers(image, layout, camera, input.T_world_chosen);
}

struct PlotFrame {
  cv::Rect area;
  double x_max;
  double y_max;
  [[nodiscard]] cv::Point at(double x, double y) const {
    return {area.x + static_cast<int>(std::lround(x / x_max * area.width)),
            area.y + area.height - static_cast<int>(std::lround(y / y_max * area.height))};
  }
};

void draw_axes(cv::Mat& image, const Layout& layout, const PlotFrame& plot) {
  const double y_step = round_step(plot.y_max, 3);
  for (double y = 0.0; y <= plot.y_max * 1.0001; y += y_step) {
    cv::line(image, plot.at(0.0, y), plot.at(plot.x_max, y), kFaint * 0.7, layout.stroke(0.8),
             cv::LINE_AA);
    const std::string label =
        y >= 1000.0 ? fmt::format("{:g}k", y / 1000.0) : fmt::format("{:g}", y);
    text(image, layout, label,
         cv::Point2d(plot.at(0.0, y)) + cv::Point2d(-layout.px(6), layout.px(4)), 11.0, kDim,
         Align::right);
  }
  const double x_step = std::max(1.0, round_step(plot.x_max, 9));
  for (double x = x_step; x <= plot.x_max; x += x_step) {
    text(image, layout, fmt::format("{:g}", x),
         cv::Point2d(plot.at(x, 0.0)) + cv::Point2d(0.0, layout.px(15)), 11.0, kDim, Align::centre);
  }
}

void draw_plot(cv::Mat& image, const Layout& layout, const MapPanelInput& input,
               const cv::Rect& area) {
  const auto& cells = input.observable_unobserved_cells;
  double highest = 1.0;
  for (const double value : cells)
    highest = std::isfinite(value) ? std::max(highest, value) : highest;
  const double x_max =
      std::max({static_cast<double>(input.scans_planned), static_cast<double>(cells.size()), 1.0});
  const PlotFrame plot{area, x_max, 1.08 * highest};
  draw_axes(image, layout, plot);
  std::vector<cv::Point> line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (std::isfinite(cells[i])) line.push_back(plot.at(static_cast<double>(i + 1), cells[i]));
  }
  if (line.size() > 1) {
    std::vector<cv::Point> fill = line;
    fill.emplace_back(line.back().x, area.y + area.height);
    fill.emplace_back(line.front().x, area.y + area.height);
    cv::fillPoly(image, std::vector<std::vector<cv::Point>>{fill}, kCard * 0.86 + kAccent * 0.14,
                 cv::LINE_AA);
    cv::polylines(image, line, false, kAccent, layout.stroke(2.2), cv::LINE_AA);
  }
  for (const cv::Point& p : line) {
    cv::circle(image, p, layout.stroke(3.2), kAccent, cv::FILLED, cv::LINE_AA);
  }
}

void rounded_card(cv::Mat& image, const cv::Rect& r, int radius) {
  const int d = 2 * radius;
  const cv::Rect inner(r.x + radius, r.y + radius, r.width - d, r.height - d);
  cv::rectangle(image, inner, kCard, d, cv::LINE_AA);
  cv::rectangle(image, inner, kCard, cv::FILLED);
}

void draw_figures(cv::Mat& image, const Layout& layout, const MapPanelInput& input, double x,
                  double y) {
  const auto& cells = input.observable_unobserved_cells;
  const std::array<std::pair<const char*, std::string>, 3> rows{
      {{"predicted new cells", grouped(input.predicted_new_cells)},
       {"actual new cells", grouped(input.actual_new_cells)},
       {"cells left to see", cells.empty() ? "-" : grouped(cells.back())}}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double top = y + 55.0 * static_cast<double>(i);
    text(image, layout, rows[i].first, {layout.px(x), layout.px(top)}, 12.0, kDim);
    text(image, layout, rows[i].second, {layout.px(x), layout.px(top + 27.0)}, 19.0,
         i == 2 ? kAccent : kText, Align::left, true);
  }
}

void draw_header(cv::Mat& image, const Layout& layout, const MapPanelInput& input) {
  const std::size_t done = input.observable_unobserved_cells.size();
  const std::string scan = input.scans_planned > 0
                               ? fmt::format("scan {} of {}", done, input.scans_planned)
                               : fmt::format("scan {}", done);
  text(image, layout, "Map", {layout.px(24), layout.px(36)}, 20.0, kText, Align::left, true);
  text(image, layout, input.method, {layout.px(88), layout.px(36)}, 15.0, kAccent);
  text(image, layout, scan, {layout.px(616), layout.px(36)}, 16.0, kText, Align::right);
  text(image, layout, plan_text(input.tour), {layout.px(24), layout.px(57)}, 12.0, kPlan);
}

}  // namespace

cv::Mat draw_map_panel(const MapPanelInput& input, cv::Size size) {
  expects(input.grid != nullptr && size.width > 0 && size.height > 0, "a panel shows a grid");
  const cv::Size large = size * kSupersampling;
  const Layout layout{large.width / 640.0, large};
  cv::Mat image(large, CV_8UC3);
  paint_background(image);
  constexpr double kFoot = 200.0;
  const double foot = layout.height() - kFoot;
  draw_map(image, layout, input, layout.rect(20, 66, 600, std::max(60.0, foot - 84)));
  rounded_card(image, layout.rect(16, foot, 608, kFoot - 16), static_cast<int>(layout.px(10)));
  text(image, layout, "observable cells not yet seen", {layout.px(34), layout.px(foot + 25)}, 12.0,
       kDim);
  draw_plot(image, layout, input, layout.rect(78, foot + 38, 322, kFoot - 84));
  draw_figures(image, layout, input, 434.0, foot + 28.0);
  draw_header(image, layout, input);
  cv::Mat panel;
  cv::resize(image, panel, size, 0.0, 0.0, cv::INTER_AREA);
  return panel;
}

}  // namespace vantage
