#include "vantage/dataset/pictures/pose_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::vector<double> numbers_in(const std::filesystem::path& file) {
  std::string text = read_file(file);
  std::ranges::replace(text, ',', ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string word; stream >> word;) {
    try {
      std::size_t used = 0;
      numbers.push_back(std::stod(word, &used));
      if (used != word.size() || !std::isfinite(numbers.back())) numbers.clear();
    } catch (const std::exception&) {
      numbers.clear();
    }
    if (numbers.empty()) break;
  }
  return numbers;
}

}  // namespace

PicturePose read_picture_pose(const std::filesystem::path& file) {
  const std::vector<double> n = numbers_in(file);
  if (n.size() == 1) return {.yaw_deg = n[0], .elevation_deg = {}};
  if (n.size() == 2 && std::abs(n[1]) <= 90.0) return {.yaw_deg = n[0], .elevation_deg = n[1]};
  if (n.size() != 12 && n.size() != 16) {
    throw InputError(fmt::format(
        "{}: expected the object's yaw in degrees, yaw and elevation, or a 4 x 4 matrix",
        file.string()));
  }
  // The third row is the object's up in the camera's frame; the last column where the camera is.
  const double elevation_rad = std::asin(std::clamp(-n[10], -1.0, 1.0));
  return {.yaw_deg = -std::atan2(n[7], n[3]) * kDegrees, .elevation_deg = elevation_rad * kDegrees};
}

}  // namespace vantage
