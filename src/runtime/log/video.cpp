#include "vantage/runtime/log/video.hpp"

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kNoCodec =
    "no H.264 (avc1) encoder: OpenCV's videoio needs its FFmpeg backend and libavcodec with "
    "libx264 (Debian: libopencv-videoio406, libavcodec59, libx264-164)";

/// Both libraries print to stderr whatever the caller makes of it; their errors come back to us as
/// return values anyway. A user's own setting of the variables wins.
void silence_codec_chatter() {
  static const bool once = [] {
    ::setenv("OPENCV_LOG_LEVEL", "SILENT", 0);
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // AV_LOG_QUIET
    ::setenv("AV_LOG_FORCE_NOCOLOR", "1", 0);
    if (std::getenv("OPENCV_VIDEOIO_DEBUG") == nullptr) {
      cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    }
    return true;
  }();
  static_cast<void>(once);
}

bool open_encoder(cv::VideoWriter& encoder, const fs::path& path, cv::Size size, double rate) {
  try {
    return encoder.open(path.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                        rate, size);
  } catch (const cv::Exception&) {
    return false;
  }
}

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

[[noreturn]] void fail(const fs::path& path, std::string_view why) {
  throw OutputError(fmt::format("{}: cannot write the video: {}", path.string(), why));
}

}  // namespace

VideoWriter::VideoWriter(fs::path path, cv::Size size, double frames_per_s)
    : path_(std::move(path)),
      part_(part_name(path_)),
      size_(size),
      even_size_(size.width + size.width % 2, size.height + size.height % 2) {
  expects(size.width > 0 && size.height > 0 && frames_per_s > 0.0, "a video has size and rate");
  expects(path_.extension() == ".mp4", "videos are .mp4");
  silence_codec_chatter();
  const fs::path folder = path_.parent_path().empty() ? fs::path(".") : path_.parent_path();
  if (!fs::is_directory(folder)) fail(path_, "the folder does not exist");
  if (::access(folder.c_str(), W_OK) != 0) fail(path_, "the folder is not writable");
  if (!open_encoder(encoder_, part_, even_size_, frames_per_s)) {
    remove_quietly(part_);
    fail(path_, kNoCodec);
  }
}

VideoWriter::~VideoWriter() {
  encoder_.release();
  remove_quietly(part_);
}

void VideoWriter::write(const cv::Mat& frame_bgr) {
  expects(encoder_.isOpened(), "frames come before finish()");
  expects(frame_bgr.size() == size_ && frame_bgr.type() == CV_8UC3,
          "every frame is CV_8UC3 of the video's size");
  if (even_size_ == size_) {
    encoder_.write(frame_bgr);
  } else {
    cv::Mat even;
    cv::copyMakeBorder(frame_bgr, even, 0, even_size_.height - size_.height, 0,
                       even_size_.width - size_.width, cv::BORDER_REPLICATE);
    encoder_.write(even);
  }
  ++frames_;
}

void VideoWriter::finish() {
  expects(encoder_.isOpened(), "finish() comes once");
  encoder_.release();
  try {
    verify();
    fs::rename(part_, path_);
  } catch (const fs::filesystem_error& error) {
    remove_quietly(part_);
    fail(path_, error.code().message());
  } catch (const OutputError&) {
    remove_quietly(part_);
    throw;
  }
}

void VideoWriter::verify() const {
  if (frames_ == 0) fail(path_, "it has no frames");
  cv::VideoCapture reader(part_.string(), cv::CAP_FFMPEG);
  if (!reader.isOpened()) fail(path_, "what was written cannot be read back (disk full?)");
  const auto property = [&](cv::VideoCaptureProperties which) {
    return static_cast<int>(std::lround(reader.get(which)));
  };
  const int count = property(cv::CAP_PROP_FRAME_COUNT);
  const cv::Size size(property(cv::CAP_PROP_FRAME_WIDTH), property(cv::CAP_PROP_FRAME_HEIGHT));
  if (count != static_cast<int>(frames_) || size != even_size_) {
    fail(path_, fmt::format("wrote {} frames of {}x{}, read back {} of {}x{}", frames_,
                            even_size_.width, even_size_.height, count, size.width, size.height));
  }
}

std::string missing_video_codec() {
  silence_codec_chatter();
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  if (error) return fmt::format("TMPDIR: no place to try: {}", error.message());
  const fs::path probe = place / fmt::format("vantage-codec-{}.mp4", static_cast<int>(::getpid()));
  cv::VideoWriter encoder;
  const bool opened = open_encoder(encoder, probe, {64, 64}, 25.0);
  encoder.release();
  remove_quietly(probe);
  return opened ? std::string() : std::string(kNoCodec);
}

}  // namespace vantage
