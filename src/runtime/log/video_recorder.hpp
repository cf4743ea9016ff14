/// Records the video of an episode: the robot in its scene beside its map or belief.
#pragma once

#include <opencv2/core.hpp>

#include <filesystem>
#include <memory>

#include "vantage/runtime/log/recording_options.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/sim/render/renderer.hpp"

namespace vantage {

class World;

/// `left_rgb` (as renderers give it) scaled to the panel's size, beside `right_bgr`.
/// @return CV_8UC3, BGR, as cv::imwrite and VideoWriter take it
cv::Mat side_by_side(const cv::Mat& left_rgb, const cv::Mat& right_bgr);

class VideoRecorder {
 public:
  /// Makes `directory`/video.mp4; stills go to `directory`/frames. @throws RendererError,
  /// OutputError
  VideoRecorder(const World& world, const RecordingOptions& options,
                std::filesystem::path directory);

  void set_panel(PanelPainter panel) { panel_ = std::move(panel); }
  /// Adds the frames that are due at the world's time.
  void tick(const World& world);
  /// Keeps the present view as frames/scan_<number>.png.
  void save_still(const World& world, std::size_t number);
  /// An episode that ended before its first tick has no video. @throws OutputError
  void finish();

 private:
  cv::Mat draw(const World& world);

  std::filesystem::path directory_;
  RecordingOptions options_;
  cv::Size half_;
  std::unique_ptr<Renderer> renderer_;
  VideoWriter video_;
  CameraView camera_;
  RenderedImages overview_;
  PanelPainter panel_;
  double next_frame_s_;
};

}  // namespace vantage
