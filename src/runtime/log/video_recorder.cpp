#include "vantage/runtime/log/video_recorder.hpp"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "vantage/core/atomic_file.hpp"
#include "vantage/sim/render/overview.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

/// Half of a 16:9 image, both edges even.
cv::Size half_of(int height_px) { return {height_px * 8 / 9 / 2 * 2, height_px / 2 * 2}; }

}  // namespace

cv::Mat side_by_side(const cv::Mat& left_rgb, const cv::Mat& right_bgr) {
  expects(left_rgb.type() == CV_8UC3 && right_bgr.type() == CV_8UC3, "both halves are CV_8UC3");
  cv::Mat left;
  cv::cvtColor(left_rgb, left, cv::COLOR_RGB2BGR);
  if (left.size() != right_bgr.size())
    cv::resize(left, left, right_bgr.size(), 0.0, 0.0, cv::INTER_AREA);
  cv::Mat both;
  cv::hconcat(left, right_bgr, both);
  return both;
}

VideoRecorder::VideoRecorder(const World& world, const RecordingOptions& options,
                             std::filesystem::path directory)
    : directory_(std::move(directory)),
      options_(options),
      half_(half_of(options.height_px)),
      renderer_(make_offscreen_renderer(world.model(), half_.width, half_.height)),
      video_(directory_ / "video.mp4", {2 * half_.width, half_.height}, options.video_fps),
      camera_(overview_camera(world.model())),
      next_frame_s_(world.time_s()) {}

void VideoRecorder::tick(const World& world) {
  if (world.time_s() < next_frame_s_) return;
  const cv::Mat frame = draw(world);
  const double period_s = options_.video_speed / options_.video_fps;
  for (; next_frame_s_ <= world.time_s(); next_frame_s_ += period_s) video_.write(frame);
}

void VideoRecorder::finish() {
  if (video_.frames() > 0) video_.finish();
}

void VideoRecorder::save_still(const World& world, std::size_t number) {
  const cv::Mat frame = draw(world);
  make_writable_directory(directory_ / "frames");
  write_file_with(directory_ / "frames" / fmt::format("scan_{:02}.png", number),
                  [&](const auto& part) { return cv::imwrite(part.string(), frame); });
}

cv::Mat VideoRecorder::draw(const World& world) {
  RenderRequest request;
  request.depth_and_segmentation = false;
  request.for_people = true;
  renderer_->render(world.model(), world.snapshot(), camera_, request, overview_);
  const cv::Mat rgb(overview_.height_px, overview_.width_px, CV_8UC3, overview_.rgb.data());
  return side_by_side(rgb, panel_(half_));
}

}  // namespace vantage
