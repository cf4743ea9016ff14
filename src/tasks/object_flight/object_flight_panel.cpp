#include "vantage/tasks/object_flight/object_flight_panel.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "vantage/runtime/drawing/panel_style.hpp"

namespace vantage {
namespace {

using panel::Align;
using panel::Layout;
using panel::text;

void card(cv::Mat& image, const Layout& layout, const cv::Rect& place, const std::string& title) {
  cv::rectangle(image, place, panel::kCard, cv::FILLED);
  text(image, layout, title, {place.x + layout.px(10), place.y + layout.px(18)}, 11, panel::kDim);
}

/// As large as fits into `place`.
void draw_camera_image(cv::Mat& image, const Layout& layout, const cv::Rect& place,
                       const RecognitionPanelInput& input) {
  cv::rectangle(image, place, panel::kCard, cv::FILLED);
  if (input.camera_image == nullptr || input.camera_image->rgb.empty()) {
    text(image, layout, "no image yet", {place.x + 0.5 * place.width, place.y + 0.5 * place.height},
         12, panel::kDim, Align::centre);
    return;
  }
  const cv::Mat camera_image = outlined(*input.camera_image, input.cut);
  const double scale = std::min(static_cast<double>(place.width) / camera_image.cols,
                                static_cast<double>(place.height) / camera_image.rows);
  cv::Mat scaled;
  cv::resize(camera_image, scaled, {}, scale, scale, cv::INTER_AREA);
  const cv::Rect inside(place.x + (place.width - scaled.cols) / 2,
                        place.y + (place.height - scaled.rows) / 2, scaled.cols, scaled.rows);
  scaled.copyTo(image(inside));
}

std::vector<int> most_probable(const Eigen::VectorXd& p, std::size_t count) {
  std::vector<int> order(static_cast<std::size_t>(p.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int a, int b) { return p[a] > p[b]; });
  order.resize(std::min(order.size(), count));
  return order;
}

void draw_objects(cv::Mat& image, const Layout& layout, const cv::Rect& place,
                  const RecognitionPanelInput& input) {
  constexpr std::size_t kShown = 6;
  card(image, layout, place, "what it may be");
  double y = place.y + layout.px(38);
  const double left = place.x + layout.px(10);
  const double width = place.width - layout.px(20);
  for (const int object : most_probable(input.p_object, kShown)) {
    const double p = input.p_object[object];
    text(image, layout, input.objects[static_cast<std::size_t>(object)], {left, y}, 11,
         panel::kText);
    text(image, layout, fmt::format("{:.2f}", p), {left + width, y}, 11, panel::kDim, Align::right);
    const cv::Point2d bar(left, y + layout.px(4));
    cv::rectangle(image, cv::Rect2d(bar, cv::Size2d(width, layout.px(3))), panel::kFaint,
                  cv::FILLED);
    cv::rectangle(image, cv::Rect2d(bar, cv::Size2d(width * p, layout.px(3))), panel::kAccent,
                  cv::FILLED);
    y += layout.px(22);
  }
}

/// A bar a view. @param line at which to draw a level line; 0: none
void draw_bars(cv::Mat& image, const Layout& layout, const cv::Rect& place,
               const RecognitionPanelInput& input, double line,
               const std::function<double(const ObservationRecord&)>& value) {
  if (input.observation_records.empty()) return;
  double most = 1.0;
  for (const ObservationRecord& s : input.observation_records) most = std::max(most, value(s));
  const auto count =
      static_cast<double>(std::max<std::size_t>(input.observation_records.size(), 4));
  const double left = place.x + layout.px(10);
  const double floor_y = place.y + place.height - layout.px(12);
  const double height = place.height - layout.px(54);
  const double step = (place.width - layout.px(20)) / count;
  for (std::size_t i = 0; i < input.observation_records.size(); ++i) {
    const double shown = value(input.observation_records[i]);
    const double tall = std::max(layout.px(1), height * shown / most);
    const cv::Rect2d bar(left + step * static_cast<double>(i), floor_y - tall, 0.7 * step, tall);
    cv::rectangle(image, bar, panel::kVisited, cv::FILLED);
    text(image, layout, fmt::format("{:.{}f}", shown, line > 0.0 ? 2 : 1),
         {bar.x + 0.5 * bar.width, bar.y - layout.px(4)}, 10, panel::kText, Align::centre);
  }
  if (line == 0.0) return;
  const double y = floor_y - height * line / most;
  cv::line(image, cv::Point2d(left, y), cv::Point2d(place.x + place.width - layout.px(10), y),
           panel::kAccent, layout.stroke(1));
}

void draw_progress(cv::Mat& image, const Layout& layout, const cv::Rect& place,
                   const RecognitionPanelInput& input) {
  if (input.expected.empty()) {
    card(image, layout, place, "entropy, bits, after each view");
    draw_bars(image, layout, place, input, 0.0,
              [](const ObservationRecord& s) { return s.report.entropy_bits; });
    return;
  }
  const bool looked = !input.observation_records.empty();
  const auto verdict =
      looked ? to_string(input.observation_records.back().change->verdict) : "not known yet";
  card(image, layout, place, fmt::format("probability of a change, by now: {}", verdict));
  draw_bars(image, layout, place, input, input.threshold,
            [](const ObservationRecord& s) { return s.change->probability; });
}

/// Where something stands, and where nothing is known of, over all heights.
void draw_map(cv::Mat& image, const OccupancyGrid& grid, double scale,
              const std::function<cv::Point2d(const Eigen::Vector3d&)>& at) {
  const GridFrame& frame = grid.frame;
  const auto layer =
      static_cast<std::size_t>(frame.cells.x()) * static_cast<std::size_t>(frame.cells.y());
  const auto pixels = [&](double cell_m) { return static_cast<int>(std::ceil(scale * cell_m)); };
  const cv::Size size(pixels(frame.cell_size_m.x()), pixels(frame.cell_size_m.y()));
  for (std::size_t column = 0; column < layer; ++column) {
    bool occupied = false;
    bool free = false;
    for (std::size_t cell = column; cell < grid.size(); cell += layer) {
      occupied = occupied || grid.state(cell) == CellState::occupied;
      free = free || grid.state(cell) == CellState::free;
    }
    if (free && !occupied) continue;
    const cv::Point2d p = at(frame.centre(frame.cell(column)));
    const cv::Point corner(cvRound(p.x - 0.5 * size.width), cvRound(p.y - 0.5 * size.height));
    cv::rectangle(image, cv::Rect(corner, size), occupied ? panel::kDim : panel::kFaint,
                  cv::FILLED);
  }
}

void draw_places(cv::Mat& image, const Layout& layout, const cv::Rect& place,
                 const RecognitionPanelInput& input) {
  card(image, layout, place, "from above");
  const cv::Point2d middle(place.x + 0.5 * place.width, place.y + 0.54 * place.height);
  const double scale = 0.36 * std::min(place.width, place.height) / input.orbit.radius_m;
  const auto at = [&](const Eigen::Vector3d& p_world_m) {
    const Eigen::Vector3d d = scale * (p_world_m - input.orbit.centre_m);
    return cv::Point2d(middle.x + d.x(), middle.y - d.y());
  };
  const auto dot = [&](cv::Point2d p, double radius, const cv::Scalar& colour, int thickness) {
    cv::circle(image, p, std::max(1, static_cast<int>(layout.px(radius))), colour, thickness,
               cv::LINE_AA);
  };
  if (input.map != nullptr) draw_map(image, *input.map, scale, at);
  dot(middle, scale * input.orbit.radius_m / layout.px(1), panel::kFaint, layout.stroke(1));
  for (const Eigen::Vector3d& target_m : input.targets_m) {
    dot(at(target_m), 5, panel::kText, layout.stroke(1));
  }
  dot(middle, 5, panel::kText, cv::FILLED);
  for (std::size_t i = 0; i < input.bearings_rad.size(); ++i) {
    const auto p = at(input.orbit.place(input.bearings_rad[i]).translation());
    dot(p, 4, panel::kDim, layout.stroke(1));
    if (i >= input.visible.size()) continue;
    const double shown = 4.0 * std::sqrt(input.visible[i]);  // the area is the share that is seen
    dot(p, shown, panel::kText, cv::FILLED);
  }
  for (std::size_t i = 0; i < input.observation_records.size(); ++i) {
    const auto p =
        at(input.orbit.place(input.observation_records[i].report.view_rad).translation());
    dot(p, 9, panel::kVisited, cv::FILLED);
    text(image, layout, fmt::format("{}", i + 1), p + cv::Point2d(0, layout.px(4)), 11,
         panel::kBottom, Align::centre, true);
  }
  dot(at(input.orbit.place(input.goal_rad).translation()), 12, panel::kAccent, layout.stroke(2));
  const cv::Point2d robot = at(input.T_world_body.translation());
  const cv::Point2d nose = at(input.T_world_body * Eigen::Vector3d(0.25, 0.0, 0.0));
  cv::line(image, robot, nose, panel::kRobot, layout.stroke(2), cv::LINE_AA);
  dot(robot, 5, panel::kRobot, cv::FILLED);
}

}  // namespace

void RecognitionPanelInput::set_belief(const ObjectStates& states, const ObjectBelief& belief) {
  objects = states.objects;
  p_object = vantage::p_object(states, belief);
  if (states.unknown_size() == 0) return;
  objects.emplace_back(kUnknown);
  p_object.conservativeResize(p_object.size() + 1);
  p_object[p_object.size() - 1] = p_unknown(states, belief);
}

cv::Mat outlined(const CameraImages& camera_image, const ObjectView* cut) {
  const cv::Mat rgb(camera_image.height_px, camera_image.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(camera_image.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  if (cut == nullptr) return bgr;
  const cv::Mat mask(cut->height_px, cut->width_px, CV_8UC1,
                     const_cast<std::uint8_t*>(cut->mask.data()));
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE,
                   {cut->left_px, cut->top_px});
  cv::drawContours(bgr, outlines, -1, panel::kAccent, 1);
  return bgr;
}

cv::Mat draw_recognition_panel(const RecognitionPanelInput& input, cv::Size size) {
  const Layout layout{size.width / 640.0, size};
  cv::Mat image(size, CV_8UC3, panel::kBottom);
  const double height = layout.height();
  const std::string heading =
      input.expected.empty() ? input.method : fmt::format("is it {} still?", input.expected);
  text(image, layout, heading, {layout.px(14), layout.px(24)}, 14, panel::kText, Align::left, true);
  const std::string of_several =
      input.targets_m.size() > 1
          ? fmt::format("object {} of {}, ", input.target + 1, input.targets_m.size())
          : "";
  text(image, layout, fmt::format("{}{} views", of_several, input.observation_records.size()),
       {layout.px(626), layout.px(24)}, 12, panel::kDim, Align::right);
  const double top = 36;
  const double upper = 0.56 * (height - top);
  const double lower = height - top - upper - 20;
  draw_camera_image(image, layout, layout.rect(12, top, 386, upper), input);
  draw_objects(image, layout, layout.rect(408, top, 220, upper), input);
  draw_progress(image, layout, layout.rect(12, top + upper + 10, 386, lower), input);
  draw_places(image, layout, layout.rect(408, top + upper + 10, 220, lower), input);
  return image;
}

}  // namespace vantage
