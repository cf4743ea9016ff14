#include "vantage/runtime/drawing/tour_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vantage/runtime/drawing/panel_style.hpp"

namespace vantage {
namespace {

using namespace panel;

constexpr double kRadius = 9.0;  // of a disc, as all lengths here in strokes' pixels
constexpr double kDot = 3.5;
constexpr double kDash = 7.0;
constexpr double kGap = 5.0;

LineStyle tour_style(double unit) { return {kPlan, 2.2 * unit, 0.95, 0.4}; }

void draw_dashed(MapCanvas& canvas, const MapCamera& camera, const Eigen::Vector3d& p0,
                 const Eigen::Vector3d& p1, double unit) {
  const Eigen::Vector3d a = camera.project(p0);
  const Eigen::Vector3d b = camera.project(p1);
  if (a.z() <= 0.0 || b.z() <= 0.0) return;
  const double length_px = (b - a).head<2>().norm();
  const int dashes =
      std::max(1, static_cast<int>(std::lround(length_px / ((kDash + kGap) * unit))));
  for (int i = 0; i < dashes; ++i) {
    const double begin = static_cast<double>(i) / dashes;
    const double end = begin + kDash / (kDash + kGap) / dashes;
    draw_line(canvas, camera, p0 + begin * (p1 - p0), p0 + end * (p1 - p0), tour_style(unit));
  }
}

cv::Point to_pixel(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
}

void draw_stop(cv::Mat& image, const Eigen::Vector2d& at_px, std::size_t number, bool next,
               double unit) {
  const Layout layout{unit, image.size()};
  const int radius = layout.stroke(kRadius);
  cv::circle(image, to_pixel(at_px), radius, next ? kPlan : kBottom, cv::FILLED, cv::LINE_AA);
  cv::circle(image, to_pixel(at_px), radius, next ? kBottom : kPlan, layout.stroke(1.2),
             cv::LINE_AA);
  text(image, layout, std::to_string(number), {at_px.x(), at_px.y() + layout.px(3.8)}, 11.0,
       next ? kBottom : kPlan, Align::centre);
}

void draw_stops(cv::Mat& image, const MapCamera& camera, const PlannedTour& tour,
                const TourDrawing& how) {
  std::vector<std::pair<std::size_t, Eigen::Vector2d>> numbered;
  for (std::size_t i = how.marks_next ? 0 : 1; i < tour.stops.size(); ++i) {
    const Eigen::Vector2d& place_m = tour.stops[i].place_m;
    const Eigen::Vector3d p = camera.project({place_m.x(), place_m.y(), how.z_m});
    if (p.z() <= 0.0) continue;
    const Eigen::Vector2d at_px = p.head<2>();
    const bool covered = std::ranges::any_of(numbered, [&](const auto& other) {
      return (other.second - at_px).norm() < 2.0 * kRadius * how.unit;
    });
    if (covered) {
      cv::circle(image, to_pixel(at_px), static_cast<int>(std::lround(kDot * how.unit)), kPlan,
                 cv::FILLED, cv::LINE_AA);
    } else {
      numbered.emplace_back(i, at_px);
    }
  }
  for (const auto& [i, at_px] : numbered) {
    draw_stop(image, at_px, how.number + i, i == 0, how.unit);
  }
}

}  // namespace

void draw_tour(MapCanvas& canvas, const MapCamera& camera, const PlannedTour& tour,
               const TourDrawing& how) {
  const auto on_floor = [&](const Eigen::Vector2d& p_m) {
    return Eigen::Vector3d(p_m.x(), p_m.y(), how.z_m);
  };
  for (std::size_t i = 0; i < tour.stops.size(); ++i) {
    const Eigen::Vector3d to = on_floor(tour.stops[i].place_m);
    if (i > 0) {
      draw_dashed(canvas, camera, on_floor(tour.stops[i - 1].place_m), to, how.unit);
    } else if (how.from_m) {
      draw_line(canvas, camera, on_floor(*how.from_m), to, tour_style(how.unit));
    }
  }
  draw_stops(canvas.bgr, camera, tour, how);
}

std::string plan_text(const PlannedTour& tour) {
  if (tour.stops.empty()) return {};
  return fmt::format("plan: {} view{}, {:.0f} s; {}", tour.stops.size(),
                     tour.stops.size() == 1 ? "" : "s", tour.ends_s(), sentence_of(tour.reason));
}

}  // namespace vantage
