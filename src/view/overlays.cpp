#include "vantage/view/overlays.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "vantage/runtime/drawing/frustum.hpp"
#include "vantage/runtime/drawing/panel_style.hpp"
#include "vantage/runtime/drawing/tour_drawing.hpp"

namespace vantage {
namespace {

using namespace panel;

constexpr double kWayHeight_m = 0.03;
const cv::Scalar kChosen(255, 255, 255);

struct GainRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  [[nodiscard]] double share(double gain) const {
    return high > low ? (gain - low) / (high - low) : 1.0;
  }
};

GainRange gain_range(const Decision& decision) {
  GainRange range;
  for (const Candidate& view : decision.candidates) {
    if (!view.reachable || !std::isfinite(view.gain_bits)) continue;
    range.low = std::min(range.low, view.gain_bits);
    range.high = std::max(range.high, view.gain_bits);
  }
  return range;
}

cv::Scalar gain_colour(double share) { return cv::Scalar(height_colour_bgr(share)); }

void lay_way(MapCanvas& canvas, const MapCamera& camera, const std::vector<Eigen::Vector3d>& path,
             double unit) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto lifted = [&](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(p + Eigen::Vector3d(0.0, 0.0, kWayHeight_m));
    };
    draw_line(canvas, camera, lifted(path[i - 1]), lifted(path[i]),
              {kAccent, 4.0 * unit, 0.95, 0.35});
  }
}

/// As on an image 720 px high.
Layout layout_of(const cv::Mat& image) { return {image.rows / 720.0, image.size()}; }

void darken(cv::Mat& image, cv::Rect area) {
  area &= cv::Rect({}, image.size());
  if (area.empty()) return;
  cv::Mat part = image(area);
  part = part * 0.25 + kBottom * 0.75;
}

int text_width(const Layout& layout, const std::string& words, double size) {
  return cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, layout.px(size) / 22.0,
                         layout.stroke(0.85), nullptr)
      .width;
}

constexpr double kHeadline = 34.0;

/// A line of text on a dark ground at the upper edge, or below that.
void headline(cv::Mat& image, const std::string& words, bool right, int row = 0,
              const cv::Scalar& colour = kText) {
  if (words.empty()) return;
  const Layout layout = layout_of(image);
  const int width = text_width(layout, words, 15.0);
  const int pad = layout.stroke(12.0);
  const int x = right ? image.cols - width - 2 * pad : 0;
  const int y = row * layout.stroke(kHeadline);
  darken(image, {x, y, width + 2 * pad, layout.stroke(kHeadline)});
  text(image, layout, words, cv::Point2d(x + pad, y + layout.px(23.0)), 15.0, colour);
}

/// Cells in whole numbers, bits and nats with the digits that tell them apart.
std::string gain_text(double gain, const GainRange& range) {
  if (range.high >= 100.0 || !std::isfinite(gain)) return grouped(gain);
  return fmt::format("{:.{}f}", gain, range.high >= 10.0 ? 1 : 3);
}

void legend(cv::Mat& image, const Decision& decision, const std::string& unit, double foot_px) {
  const GainRange range = gain_range(decision);
  if (range.high < range.low) return;
  const Layout layout = layout_of(image);
  const int width = layout.stroke(330.0);
  const int height = layout.stroke(58.0);
  const cv::Rect card(image.cols - width, image.rows - static_cast<int>(foot_px) - height, width,
                      height);
  darken(image, card);
  const int pad = layout.stroke(14.0);
  const cv::Rect bar(card.x + pad, card.y + layout.stroke(12.0), width - 2 * pad,
                     layout.stroke(12.0));
  for (int x = 0; x < bar.width; ++x) {
    const cv::Scalar colour = gain_colour(static_cast<double>(x) / bar.width);
    cv::line(image, {bar.x + x, bar.y}, {bar.x + x, bar.y + bar.height}, colour);
  }
  const double base = bar.y + bar.height + layout.px(20.0);
  text(image, layout, gain_text(range.low, range), cv::Point2d(bar.x, base), 13.0, kText);
  text(image, layout, "gain, " + unit, cv::Point2d(bar.x + 0.5 * bar.width, base), 13.0, kDim,
       Align::centre);
  text(image, layout, gain_text(range.high, range), cv::Point2d(bar.x + bar.width, base), 13.0,
       kText, Align::right);
}

void timeline(cv::Mat& image, double share) {
  const int height = static_cast<int>(timeline_height_px(image.rows));
  const cv::Rect area =
      cv::Rect(0, image.rows - height, image.cols, height) & cv::Rect({0, 0}, image.size());
  darken(image, area);
  const int done = static_cast<int>(std::clamp(share, 0.0, 1.0) * image.cols);
  image(cv::Rect(0, area.y + height / 4, done, height - height / 2) & area).setTo(kAccent);
}

constexpr std::array<std::pair<const char*, const char*>, 14> kHelp{
    {{"left drag", "turn"},
     {"wheel", "nearer, farther"},
     {"right or middle drag", "move"},
     {"c", "camera: overview, follow, the robot's own"},
     {"m", "map: occupied cells, coloured by height"},
     {"g", "gains of the views, the chosen one, the way, the plan"},
     {"space", "pause"},
     {". or right", "one control tick"},
     {"+ - or up, down", "faster, slower"},
     {", or left", "recording: one tick back"},
     {"page up, down", "recording: 5 s back, on; or drag the line below"},
     {"r", "recording: from the start"},
     {"s", "screenshot"},
     {"h, q or Esc", "this help, close"}}};

void help_card(cv::Mat& image) {
  const Layout layout = layout_of(image);
  const double line = 25.0;
  const double height = line * kHelp.size() + 24.0;
  const cv::Rect card = layout.rect(20.0, 54.0, 750.0, height);
  darken(image, card);
  double y = 54.0 + 29.0;
  for (const auto& [key, what] : kHelp) {
    text(image, layout, key, {layout.px(36.0), layout.px(y)}, 14.0, kAccent);
    text(image, layout, what, {layout.px(276.0), layout.px(y)}, 14.0, kText);
    y += line;
  }
}

}  // namespace

double timeline_height_px(int frame_height_px) { return std::max(8.0, frame_height_px / 45.0); }

void lay_map(MapCanvas& canvas, const MapCamera& camera, const OccupancyGrid& grid) {
  MapCanvas layer = make_canvas(canvas.bgr.size());
  draw_voxels(layer, camera, grid);
  const auto tolerance_m = static_cast<float>(0.5 * grid.frame.cell_size_m.norm());
  for (int y = 0; y < canvas.bgr.rows; ++y) {
    const auto* cells = layer.inverse_depth.ptr<float>(y);
    const auto* colours = layer.bgr.ptr<cv::Vec3b>(y);
    auto* scene = canvas.inverse_depth.ptr<float>(y);
    auto* pixels = canvas.bgr.ptr<cv::Vec3b>(y);
    for (int x = 0; x < canvas.bgr.cols; ++x) {
      if (cells[x] <= 0.0F) continue;
      if (scene[x] > 0.0F && 1.0F / cells[x] > 1.0F / scene[x] + tolerance_m) continue;
      pixels[x] = colours[x];
      scene[x] = std::max(scene[x], cells[x]);
    }
  }
}

void lay_views(MapCanvas& canvas, const MapCamera& camera, const EventReplay& known) {
  if (!known.decision()) return;
  const Decision& decision = *known.decision();
  const double unit = canvas.bgr.rows / 720.0;
  const Eigen::Vector3d room_m = known.grid().frame.box().sizes();
  const double length_m = std::clamp(0.13 * std::min(room_m.x(), room_m.y()), 0.05, 0.4);
  const GainRange range = gain_range(decision);
  lay_way(canvas, camera, known.path_m(), unit);
  for (const Candidate& view : decision.candidates) {
    const bool weighed = view.reachable && std::isfinite(view.gain_bits);
    const cv::Scalar colour = weighed ? gain_colour(range.share(view.gain_bits)) : kFaint;
    draw_frustum(canvas, camera, view.T_world_sensor, length_m, {colour, 2.2 * unit, 0.95, 0.3});
  }
  if (decision.chosen == decision.candidates.size()) return;
  draw_frustum(canvas, camera, decision.candidates[decision.chosen].T_world_sensor, 1.6 * length_m,
               {kChosen, 3.5 * unit, 1.0, 0.5});
  draw_tour(canvas, camera, known.tour(),
            {.z_m = kWayHeight_m, .number = known.scans() + 1, .unit = 1.3 * unit});
}

void lay_captions(cv::Mat& bgr, const ViewCaptions& captions) {
  const double foot_px = captions.progress ? timeline_height_px(bgr.rows) : 0.0;
  headline(bgr, captions.scene, false);
  headline(bgr, captions.plan, false, 1, kPlan);
  headline(bgr, captions.playback, true);
  if (captions.decision) legend(bgr, *captions.decision, captions.gain_unit, foot_px);
  if (captions.progress) timeline(bgr, *captions.progress);
  if (captions.help) help_card(bgr);
}

}  // namespace vantage
