#include "src/perception/dataset_reader.hpp"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "src/core/atomic_file.hpp"
#include "src/core/error.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr float kMetresPerMillimetre = 0.001F;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw InputError(fmt::format("{}: {}", file.string(), why));
}

/// OpenCV returns what it has of a truncated PNG; the chunk that ends a whole one tells.
bool is_whole_png(const std::string& bytes) {
  constexpr std::string_view kEnd("IEND\xae\x42\x60\x82", 8);
  return bytes.size() > kEnd.size() && bytes.starts_with("\x89PNG") && bytes.ends_with(kEnd);
}

cv::Mat read_picture(const fs::path& file, int type, std::string_view kind) {
  const std::string bytes = read_file(file);
  if (!is_whole_png(bytes)) fail(file, "is no whole PNG");
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                        const_cast<char*>(bytes.data()));
  cv::Mat picture;
  try {
    picture = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
  }
  if (picture.empty()) fail(file, "cannot be decoded");
  if (picture.type() != type) fail(file, fmt::format("expected a PNG of {}", kind));
  return picture.isContinuous() ? picture : picture.clone();
}

void require_same_size(const fs::path& file, const cv::Mat& picture, const ObjectView& view) {
  if (picture.cols == view.width_px && picture.rows == view.height_px) return;
  fail(file, fmt::format("is {} x {} px, the colour crop {} x {}", picture.cols, picture.rows,
                         view.width_px, view.height_px));
}

std::pair<int, int> read_location(const fs::path& file) {
  const std::string text = read_file(file);
  const char* end = text.data() + text.size();
  std::pair<int, int> xy;
  const auto x = std::from_chars(text.data(), end, xy.first);
  const bool comma = x.ec == std::errc{} && x.ptr != end && *x.ptr == ',';
  const auto y = std::from_chars(comma ? x.ptr + 1 : end, end, xy.second);
  if (y.ec != std::errc{}) fail(file, "expected the crop's top left pixel, `x,y`");
  return xy;
}

void read_colour(const fs::path& file, ObjectView& view) {
  const cv::Mat picture = read_picture(file, CV_8UC3, "8-bit colour");
  view.width_px = picture.cols;
  view.height_px = picture.rows;
  view.rgb.assign(picture.datastart, picture.dataend);
  for (std::size_t i = 0; i < view.rgb.size(); i += 3) std::swap(view.rgb[i], view.rgb[i + 2]);
}

void read_depth(const fs::path& file, ObjectView& view) {
  const cv::Mat picture = read_picture(file, CV_16UC1, "16-bit depth");
  require_same_size(file, picture, view);
  view.depth_m.reserve(picture.total());
  std::transform(picture.begin<std::uint16_t>(), picture.end<std::uint16_t>(),
                 std::back_inserter(view.depth_m), [](std::uint16_t depth_mm) {
                   return kMetresPerMillimetre * static_cast<float>(depth_mm);
                 });
}

void read_mask(const fs::path& file, ObjectView& view) {
  const cv::Mat picture = read_picture(file, CV_8UC1, "1 or 8 bits of grey");
  require_same_size(file, picture, view);
  view.mask.reserve(picture.total());
  std::transform(picture.begin<std::uint8_t>(), picture.end<std::uint8_t>(),
                 std::back_inserter(view.mask),
                 [](std::uint8_t value) { return static_cast<std::uint8_t>(value != 0); });
  if (std::ranges::find(view.mask, 1) == view.mask.end()) fail(file, "the mask is empty");
}

}  // namespace

Eigen::Vector3d up_in_camera(double elevation_rad) {
  return {0.0, -std::cos(elevation_rad), -std::sin(elevation_rad)};
}

LabelledView load_view(const ViewEntry& entry) {
  LabelledView labelled{{}, entry.name, entry.yaw_rad, yaw_bin(entry.yaw_rad)};
  ObjectView& view = labelled.view;
  read_colour(entry.file("crop.png"), view);
  read_depth(entry.file("depthcrop.png"), view);
  read_mask(entry.file("maskcrop.png"), view);
  std::tie(view.left_px, view.top_px) = read_location(entry.file("loc.txt"));
  const auto elevation_rad = video_elevation_rad(entry.name.video);
  if (!elevation_rad) fail(entry.file("crop.png"), "its video is none of 1, 2, 4");
  view.up = up_in_camera(*elevation_rad);
  return labelled;
}

std::optional<LabelledView> load_view(const ViewEntry& entry, std::vector<SkippedView>& skipped) {
  try {
    return load_view(entry);
  } catch (const InputError& error) {
    skipped.push_back({entry.file("crop.png"), error.what()});
    return std::nullopt;
  }
}

}  // namespace vantage
