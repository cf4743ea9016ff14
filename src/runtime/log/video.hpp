/// H.264 video of a run.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace vantage {

/// Draws what the robot knows: CV_8UC3, BGR, of that size.
using PanelPainter = std::function<cv::Mat(cv::Size)>;

/// Encodes frames into an .mp4 that any browser plays. The file appears under its name only after
/// finish(); destroyed without it (an error on the way), the writer removes what it wrote.
class VideoWriter {
 public:
  /// Odd edges of `size` are made even by repeating the last column or row, as H.264 asks.
  /// @throws OutputError if the folder refuses or no H.264 encoder is installed, saying which
  /// package has one.
  VideoWriter(std::filesystem::path path, cv::Size size, double frames_per_s);
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;
  ~VideoWriter();

  /// `frame_bgr`: CV_8UC3 of the size given at construction.
  void write(const cv::Mat& frame_bgr);

  /// Closes the file, reads it back (frame count and size) and gives it its name.
  /// @throws OutputError; nothing is left then.
  void finish();

  [[nodiscard]] std::size_t frames() const { return frames_; }

 private:
  void verify() const;

  std::filesystem::path path_;
  std::filesystem::path part_;
  cv::Size size_;
  cv::Size even_size_;
  cv::VideoWriter encoder_;
  std::size_t frames_ = 0;
};

/// What `vantage doctor` asks: empty if an H.264 .mp4 can be written, else why not.
std::string missing_video_codec();

}  // namespace vantage
