#include "vantage/tasks/trajectory/trajectory_panel.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/runtime/drawing/panel_style.hpp"

namespace vantage {
namespace {

using panel::Align;
using panel::Layout;
using panel::text;

const cv::Scalar kUnknown(80, 110, 240);
const cv::Scalar kKnown(140, 210, 90);

cv::Scalar colour_of(const TrajectoryPanelInput& input, const RecognisedObject& object) {
  return input.observations.known(object) ? kKnown : kUnknown;
}

void draw_camera_image(cv::Mat& image, const cv::Rect& place, const cv::Mat& camera_image) {
  cv::rectangle(image, place, panel::kCard, cv::FILLED);
  if (camera_image.empty()) return;
  const double scale = std::min(static_cast<double>(place.width) / camera_image.cols,
                                static_cast<double>(place.height) / camera_image.rows);
  cv::Mat scaled;
  cv::resize(camera_image, scaled, {}, scale, scale, cv::INTER_AREA);
  scaled.copyTo(
      image(cv::Rect(place.x + (place.width - scaled.cols) / 2,
                     place.y + (place.height - scaled.rows) / 2, scaled.cols, scaled.rows)));
}

/// The path from above, scaled to fit.
class PathMap {
 public:
  PathMap(cv::Mat& image, const Layout& layout, const cv::Rect& place,
          const std::vector<Eigen::Vector4d>& path)
      : image_(image), layout_(layout), place_(place) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector4d& q : path) box.extend(Eigen::Vector2d(q.head<2>()));
    const Eigen::Vector2d room_m = box.sizes() + Eigen::Vector2d::Constant(2.4);
    middle_m_ = box.center();
    scale_ = std::min(place.width / room_m.x(), place.height / room_m.y());
  }
  [[nodiscard]] cv::Point2d at(const Eigen::Vector2d& p_m) const {
    const Eigen::Vector2d d = scale_ * (p_m - middle_m_);
    return {place_.x + 0.5 * place_.width + d.x(), place_.y + 0.5 * place_.height - d.y()};
  }
  [[nodiscard]] double px(double length_m) const { return scale_ * length_m; }
  void line(const std::vector<Eigen::Vector4d>& path, std::size_t first, std::size_t last,
            const cv::Scalar& colour, double width) const {
    for (std::size_t i = first; i + 1 < last; ++i) {
      cv::line(image_, at(path[i].head<2>()), at(path[i + 1].head<2>()), colour,
               layout_.stroke(width), cv::LINE_AA);
    }
  }
  void dot(const Eigen::Vector2d& p_m, double radius, const cv::Scalar& colour) const {
    cv::circle(image_, at(p_m), std::max(1, static_cast<int>(layout_.px(radius))), colour,
               cv::FILLED, cv::LINE_AA);
  }

 private:
  cv::Mat& image_;
  const Layout& layout_;
  cv::Rect place_;
  Eigen::Vector2d middle_m_ = Eigen::Vector2d::Zero();
  double scale_ = 1.0;
};

void draw_object(cv::Mat& image, const Layout& layout, const PathMap& map,
                 const TrajectoryPanelInput& input, const RecognisedObject& object) {
  const Eigen::Vector2d middle_m = object.p_world_m.head<2>();
  const cv::Scalar colour = colour_of(input, object);
  const auto directions = static_cast<double>(object.used.size());
  for (std::size_t i = 0; i < object.used.size(); ++i) {
    const double a = 2.0 * std::numbers::pi * static_cast<double>(i) / directions;
    const Eigen::Vector2d ray(std::cos(a), std::sin(a));
    cv::line(image, map.at(middle_m + 0.2 * ray), map.at(middle_m + 0.45 * ray),
             object.used[i] ? colour : panel::kFaint, layout.stroke(object.used[i] ? 2.5 : 1),
             cv::LINE_AA);
  }
  for (const ObjectObservation& observation : object.observations) {
    map.dot(observation.T_world_camera.translation().head<2>(), 2, colour);
  }
  map.dot(middle_m, 4, colour);
  text(image, layout, fmt::format("{}", object.id),
       map.at(middle_m) + cv::Point2d(layout.px(8), -layout.px(6)), 10, panel::kText);
}

void draw_path(cv::Mat& image, const Layout& layout, const cv::Rect& place,
               const TrajectoryPanelInput& input) {
  cv::rectangle(image, place, panel::kCard, cv::FILLED);
  const PathMap map(image, layout, place, input.nominal);
  const auto at = static_cast<std::size_t>(std::max(input.at, 0));
  map.line(input.nominal, 0, input.nominal.size(), panel::kFaint, 1);
  map.line(input.plan, 0, at + 1, panel::kVisited, 2);
  map.line(input.plan, at, input.plan.size(), panel::kAccent, 1.5);
  for (const RecognisedObject& object : input.observations.objects()) {
    draw_object(image, layout, map, input, object);
  }
  const Eigen::Vector2d robot_m = input.T_world_body.translation().head<2>();
  if (input.target) {
    cv::line(image, map.at(robot_m), map.at(input.target->p_world_object_m.head<2>()), panel::kDim,
             1, cv::LINE_AA);
    cv::circle(image, map.at(input.target->p_world_view_m.head<2>()),
               static_cast<int>(layout.px(6)), panel::kAccent, layout.stroke(1.5), cv::LINE_AA);
  }
  const double yaw = project_to_se2(input.T_world_body).yaw_rad;
  for (const double side : {-1.0, 1.0}) {  // what the camera sees
    const double edge_rad = yaw + side * input.half_width_rad;
    const Eigen::Vector2d edge(std::cos(edge_rad), std::sin(edge_rad));
    cv::line(image, map.at(robot_m), map.at(robot_m + input.range_m * edge), panel::kRobot, 1,
             cv::LINE_AA);
  }
  map.dot(robot_m, 5, panel::kRobot);
}

void draw_objects(cv::Mat& image, const Layout& layout, const cv::Rect& place,
                  const TrajectoryPanelInput& input) {
  cv::rectangle(image, place, panel::kCard, cv::FILLED);
  text(image, layout, "objects: what they may be",
       {place.x + layout.px(10), place.y + layout.px(18)}, 10, panel::kDim);
  double y = place.y + layout.px(38);
  for (const RecognisedObject& object : input.observations.objects()) {
    const double left = place.x + layout.px(10);
    const bool seen = !object.observations.empty();
    const std::string estimate =
        seen ? input.observations.estimate(object).object : "not seen closely yet";
    text(image, layout, fmt::format("{}  {}", object.id, estimate), {left, y}, 10,
         seen ? panel::kText : panel::kDim);
    text(image, layout,
         fmt::format("{:.2f} nats, {} observations", input.observations.entropy_nats(object),
                     object.observations.size()),
         {left, y + layout.px(14)}, 9, colour_of(input, object));
    y += layout.px(32);
    if (y > place.br().y - layout.px(10)) break;
  }
}

}  // namespace

cv::Mat draw_trajectory_panel(const TrajectoryPanelInput& input, const cv::Mat& camera_image,
                              cv::Size size) {
  const Layout layout{size.width / 640.0, size};
  cv::Mat image(size, CV_8UC3, panel::kBottom);
  text(image, layout, input.method, {layout.px(14), layout.px(24)}, 14, panel::kText, Align::left,
       true);
  text(image, layout,
       fmt::format("waypoint {} of {}, {} observations", std::max(input.at, 0) + 1,
                   input.nominal.size(), input.observations.total()),
       {layout.px(626), layout.px(24)}, 12, panel::kDim, Align::right);
  constexpr double kTop = 36;
  constexpr double kImageHeight = 284;
  const double lower = layout.height() - kTop - kImageHeight - 20;
  draw_camera_image(image, layout.rect(12, kTop, 392, kImageHeight), camera_image);
  draw_objects(image, layout, layout.rect(414, kTop, 214, layout.height() - kTop - 10), input);
  draw_path(image, layout, layout.rect(12, kTop + kImageHeight + 10, 392, lower), input);
  return image;
}

}  // namespace vantage
