#include "vantage/perception/dataset_reader.hpp"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

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

cv::Mat read_image(const fs::path& file, int type, std::string_view kind) {
  const std::string bytes = read_file(file);
  if (!is_whole_png(bytes)) fail(file, "is no whole PNG");
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                        const_cast<char*>(bytes.data()));
  cv::Mat image;
  try {
    image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
  }
  if (image.empty()) fail(file, "cannot be decoded");
  if (image.type() != type) fail(file, fmt::format("expected a PNG of {}", kind));
  return image.isContinuous() ? image : image.clone();
}

void require_same_size(const fs::path& file, const cv::Mat& image, const ObjectView& view) {
  if (image.cols == view.width_px && image.rows == view.height_px) return;
  fail(file, fmt::format("is {} x {} px, the colour crop {} x {}", image.cols, image.rows,
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
  const cv::Mat image = read_image(file, CV_8UC3, "8-bit colour");
  view.width_px = image.cols;
  view.height_px = image.rows;
  view.rgb.assign(image.datastart, image.dataend);
  for (std::size_t i = 0; i < view.rgb.size(); i += 3) std::swap(view.rgb[i], view.rgb[i + 2]);
}

void read_depth(const fs::path& file, ObjectView& view) {
  const cv::Mat image = read_image(file, CV_16UC1, "16-bit depth");
  require_same_size(file, image, view);
  view.depth_m.reserve(image.total());
  std::transform(
      image.begin<std::uint16_t>(), image.end<std::uint16_t>(), std::back_inserter(view.depth_m),
      [](std::uint16_t depth_mm) { return kMetresPerMillimetre * static_cast<float>(depth_mm); });
}

/// The file beside `<stem>_crop.png` with another ending; nothing if it is not there.
std::optional<fs::path> file_beside(const fs::path& colour, std::string_view ending) {
  constexpr std::string_view kEnding = "crop.png";
  std::string name = colour.filename().string();
  if (!name.ends_with("_crop.png")) return std::nullopt;
  name.replace(name.size() - kEnding.size(), kEnding.size(), ending);
  const fs::path file = colour.parent_path() / name;
  if (!fs::exists(file)) return std::nullopt;
  return file;
}

/// Of the video in the file's name, if it has that form.
std::optional<double> elevation_in_name(const fs::path& colour) {
  const std::string name = colour.filename().string();
  const auto view = parse_view_name(name.substr(0, name.rfind('_')));
  return view ? video_elevation_rad(view->video) : std::nullopt;
}

/// What is measured and no farther than `max_depth_m`; everything if that is 0.
void mask_by_depth(const fs::path& file, double max_depth_m, ObjectView& view) {
  for (const float depth_m : view.depth_m) {
    const bool near = depth_m > 0.0F && static_cast<double>(depth_m) <= max_depth_m;
    view.mask.push_back(static_cast<std::uint8_t>(max_depth_m <= 0.0 || near));
  }
  if (std::ranges::find(view.mask, 1) == view.mask.end()) {
    fail(file, fmt::format("nothing is nearer than {} m", max_depth_m));
  }
}

void read_mask(const fs::path& file, ObjectView& view) {
  const cv::Mat image = read_image(file, CV_8UC1, "1 or 8 bits of grey");
  require_same_size(file, image, view);
  view.mask.reserve(image.total());
  std::transform(image.begin<std::uint8_t>(), image.end<std::uint8_t>(),
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

ObjectView load_image_pair(const fs::path& colour, const fs::path& depth,
                           const PairSetting& setting) {
  ObjectView view;
  read_colour(colour, view);
  read_depth(depth, view);
  if (const auto mask = file_beside(colour, "maskcrop.png")) {
    read_mask(*mask, view);
  } else {
    mask_by_depth(depth, setting.max_depth_m, view);
  }
  if (const auto place = file_beside(colour, "loc.txt")) {
    std::tie(view.left_px, view.top_px) = read_location(*place);
  } else {
    view.left_px = static_cast<int>(view.centre_px.x()) - view.width_px / 2;
    view.top_px = static_cast<int>(view.centre_px.y()) - view.height_px / 2;
  }
  view.up = up_in_camera(elevation_in_name(colour).value_or(setting.elevation_rad));
  return view;
}

std::optional<double> yaw_beside(const fs::path& colour) {
  const auto file = file_beside(colour, "pose.txt");
  if (!file) return std::nullopt;
  const std::string text = read_file(*file);
  double yaw_deg = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), yaw_deg);
  if (read.ec != std::errc{} || !std::isfinite(yaw_deg)) fail(*file, "expected a yaw in degrees");
  const double yaw_rad = std::remainder(yaw_deg * std::numbers::pi / 180.0, 2.0 * std::numbers::pi);
  return yaw_rad < 0.0 ? yaw_rad + 2.0 * std::numbers::pi : yaw_rad;
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
