#include "vantage/perception/images/image_files.hpp"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/images/npy.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

/// What cameras of 16 bits write for "nothing": no range of theirs reaches it.
constexpr double kSaturated = 65535.0;
/// Floats below this are metres: no depth camera sees farther, none measures nearer in mm.
constexpr double kMetresBelow = 20.0;
constexpr double kNearest_mm = 100.0;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw InputError(fmt::format("{}: {}", file.string(), why));
}

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Past the headers up to the first scan, which may hold a small picture with an end of its own,
/// the first end that follows is the picture's: no scan contains one. What a camera puts behind it
/// does not matter.
bool is_whole_jpeg(std::string_view bytes) {
  constexpr std::string_view kStart("\xff\xd8", 2);
  constexpr std::string_view kEnd("\xff\xd9", 2);
  constexpr auto kScan = static_cast<unsigned char>(0xda);
  if (!bytes.starts_with(kStart)) return false;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  std::size_t at = kStart.size();
  while (at + 4 <= bytes.size() && byte(at) == 0xff) {
    if (byte(at + 1) == kScan) return bytes.find(kEnd, at) != std::string_view::npos;
    const bool is_fill = byte(at + 1) == 0xff;
    at += is_fill ? 1 : 2 + std::size_t{256} * byte(at + 2) + byte(at + 3);
  }
  return false;
}

/// OpenCV returns what it has of a file that is cut short; what ends a whole one tells.
bool is_whole(const std::string& bytes, const std::string& extension) {
  constexpr std::string_view kPngEnd("IEND\xae\x42\x60\x82", 8);
  if (extension == ".png") return bytes.starts_with("\x89PNG") && bytes.ends_with(kPngEnd);
  if (extension == ".jpg" || extension == ".jpeg") return is_whole_jpeg(bytes);
  return !bytes.empty();
}

cv::Mat read_image(const fs::path& file) {
  const std::string bytes = read_file(file);
  const std::string extension = extension_of(file);
  if (!is_whole(bytes, extension)) {
    fail(file, extension == ".png" ? "is no whole PNG" : "is no whole image");
  }
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                        const_cast<char*>(bytes.data()));
  cv::Mat image;
  try {
    image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
  }
  if (image.empty()) fail(file, "cannot be decoded");
  return image.isContinuous() ? image : image.clone();
}

std::string what_it_is(const cv::Mat& image) {
  constexpr std::array kDepths{"8-bit",          "8-bit signed", "16-bit", "16-bit signed",
                               "32-bit integer", "float",        "double", "half"};
  return fmt::format("an image of {} channel{} of {} values", image.channels(),
                     image.channels() == 1 ? "" : "s",
                     kDepths.at(static_cast<std::size_t>(image.depth())));
}

cv::Mat rgb_of(const cv::Mat& image) {
  cv::Mat rgb;
  if (image.channels() == 1) cv::cvtColor(image, rgb, cv::COLOR_GRAY2RGB);
  if (image.channels() == 3) cv::cvtColor(image, rgb, cv::COLOR_BGR2RGB);
  if (image.channels() == 4) cv::cvtColor(image, rgb, cv::COLOR_BGRA2RGB);
  return rgb;
}

/// Numbers of a depth file before it is known what they mean.
struct RawDepth {
  int width_px = 0;
  int height_px = 0;
  bool integers = true;
  std::vector<double> values;
};

RawDepth read_raw_depth(const fs::path& file) {
  if (extension_of(file) == ".npy") {
    NpyMatrix matrix = read_npy(file);
    return {matrix.columns, matrix.rows, matrix.integers, std::move(matrix.values)};
  }
  const cv::Mat image = read_image(file);
  const int depth = image.depth();
  if (image.channels() != 1 || (depth != CV_16U && depth != CV_32F && depth != CV_64F)) {
    fail(file, fmt::format("is {}; expected 16-bit depth, one channel, or an NPY file",
                           what_it_is(image)));
  }
  cv::Mat numbers;
  image.convertTo(numbers, CV_64F);
  return {image.cols, image.rows, depth == CV_16U,
          std::vector<double>(numbers.begin<double>(), numbers.end<double>())};
}

bool measures(double value, bool integers) {
  return std::isfinite(value) && value > 0.0 && !(integers && value == kSaturated);
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double unit_of(const fs::path& file, const RawDepth& raw) {
  std::vector<double> measured;
  std::ranges::copy_if(raw.values, std::back_inserter(measured),
                       [&](double value) { return measures(value, raw.integers); });
  if (measured.empty()) return 0.001;
  const double median = median_of(std::move(measured));
  if (!raw.integers && median < kMetresBelow) return 1.0;
  if (median >= kNearest_mm && median <= 1000.0 * kMetresBelow) return 0.001;
  fail(file, fmt::format("its depth is {:.4g} in the middle, neither millimetres nor metres; say "
                         "what 1 stands for, with --depth-unit of an import, --depth-unit-m of "
                         "`recognise`",
                         median));
}

}  // namespace

ColourImage read_colour_image(const fs::path& file) {
  const cv::Mat image = read_image(file);
  if (image.depth() != CV_8U)
    fail(file, fmt::format("is {}; expected 8-bit colour", what_it_is(image)));
  const cv::Mat rgb = rgb_of(image);
  if (rgb.empty()) fail(file, fmt::format("is {}; expected 8-bit colour", what_it_is(image)));
  return {rgb.cols, rgb.rows, std::vector<std::uint8_t>(rgb.datastart, rgb.dataend)};
}

DepthImage read_depth_image(const fs::path& file, double unit_m) {
  const RawDepth raw = read_raw_depth(file);
  DepthImage depth{.width_px = raw.width_px,
                   .height_px = raw.height_px,
                   .depth_m = {},
                   .unit_m = unit_m > 0.0 ? unit_m : unit_of(file, raw)};
  depth.depth_m.reserve(raw.values.size());
  const auto scale = static_cast<float>(depth.unit_m);
  bool any = false;
  bool saturated = false;
  for (const double value : raw.values) {
    const bool measured = measures(value, raw.integers);
    any = any || measured;
    saturated = saturated || (raw.integers && value == kSaturated);
    depth.depth_m.push_back(measured ? scale * static_cast<float>(value) : 0.0F);
  }
  if (saturated && !any) {
    fail(file, "holds no measurement: all that is not 0 is 65535, the greatest number of 16 bits");
  }
  return depth;
}

MaskImage read_mask_image(const fs::path& file) {
  const cv::Mat image = read_image(file);
  MaskImage result{image.cols, image.rows, {}};
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  if (channels.size() == 4) channels.pop_back();  // alpha
  cv::Mat1b mask = cv::Mat1b::zeros(image.size());
  for (const cv::Mat& channel : channels) mask |= channel != 0;
  std::ranges::transform(mask, std::back_inserter(result.mask),
                         [](std::uint8_t value) { return static_cast<std::uint8_t>(value != 0); });
  return result;
}

ImageKind image_kind(const fs::path& file) {
  const std::string extension = extension_of(file);
  if (extension == ".npy") return ImageKind::depth;
  if (extension == ".jpg" || extension == ".jpeg" || extension == ".bmp" || extension == ".ppm") {
    return ImageKind::colour;
  }
  if (extension == ".png") {  // IHDR: 8 bytes of signature, 8 of the chunk, 4 + 4 of size
    std::string head(26, '\0');
    std::ifstream(file, std::ios::binary)
        .read(head.data(), static_cast<std::streamsize>(head.size()));
    const int bits = static_cast<unsigned char>(head[24]);
    const int type = static_cast<unsigned char>(head[25]);  // 0 grey, 4 grey with alpha
    if (type != 0 && type != 4) return ImageKind::colour;
    return bits == 16 ? ImageKind::depth : ImageKind::mask;
  }
  if (extension == ".tif" || extension == ".tiff") {
    const cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    if (image.empty()) return ImageKind::other;
    if (image.channels() > 1) return ImageKind::colour;
    return image.depth() == CV_8U ? ImageKind::mask : ImageKind::depth;
  }
  return ImageKind::other;
}

}  // namespace vantage
