#include "vantage/dataset/view_files.hpp"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <span>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Without a flush to the device: a folder of views counts only once all of it is written.
void write_bytes(const std::filesystem::path& path, std::span<const char> bytes) {
  errno = 0;
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) {
    throw OutputError(fmt::format("{}: cannot write: {}", path.string(),
                                  errno != 0 ? std::strerror(errno) : "write failed"));
  }
}

void write_image(const std::filesystem::path& path, const cv::Mat& image,
                 const std::vector<int>& parameters = {}) {
  std::vector<unsigned char> bytes;
  expects(cv::imencode(".png", image, bytes, parameters), "an image becomes a PNG");
  write_bytes(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_bytes(path, text);
}

/// A matrix that looks at the values; OpenCV only reads it here.
template <class T>
cv::Mat look_at(const ObjectView& view, int type, const std::vector<T>& values) {
  return {view.height_px, view.width_px, type, const_cast<T*>(values.data())};
}

}  // namespace

void write_view(const ObjectView& view, const ViewEntry& entry) {
  cv::Mat colour;
  cv::cvtColor(look_at(view, CV_8UC3, view.rgb), colour, cv::COLOR_RGB2BGR);
  write_image(entry.file("crop.png"), colour);
  std::vector<std::uint16_t> depth_mm(view.depth_m.size());
  std::ranges::transform(view.depth_m, depth_mm.begin(), [](float z_m) {
    return static_cast<std::uint16_t>(std::clamp(std::lround(1000.0 * z_m), 0L, 65535L));
  });
  write_image(entry.file("depthcrop.png"), look_at(view, CV_16UC1, depth_mm));
  const cv::Mat mask = 255 * look_at(view, CV_8UC1, view.mask);
  write_image(entry.file("maskcrop.png"), mask, {cv::IMWRITE_PNG_BILEVEL, 1});
  write_text(entry.file("loc.txt"), fmt::format("{},{}\n", view.left_px, view.top_px));
  write_pose(entry);
}

void write_pose(const ViewEntry& entry) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::string text = fmt::format("{:.4f}", entry.yaw_rad * kDegrees);
  if (entry.given_elevation_rad) {
    text += fmt::format(" {:.4f}", *entry.given_elevation_rad * kDegrees);
  }
  write_text(entry.file("pose.txt"), text + "\n");
}

}  // namespace vantage
