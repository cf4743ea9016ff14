/// A dataset on disk of painted blocks: hue tells the object, a stripe its yaw.
#pragma once

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/rng.hpp"

namespace vantage::test {

struct PaintedObject {
  std::string category;
  std::string object;
  int hue = 0;        ///< of 180
  int back_hue = -1;  ///< seen where |yaw| > 90 deg; -1: as the rest
};

/// A block 30 px wide, its stripe's width and shade go with the yaw.
inline void put_painted_view(const std::filesystem::path& root, const PaintedObject& object,
                             int video, int frame, double yaw_deg, Rng& rng) {
  const auto folder = root / object.category / object.object;
  std::filesystem::create_directories(folder);
  const std::string stem = (folder / fmt::format("{}_{}_{}", object.object, video, frame)).string();
  const bool back = std::cos(yaw_deg * std::numbers::pi / 180.0) < 0.0;
  const int hue = back && object.back_hue >= 0 ? object.back_hue : object.hue;
  cv::Mat colour(24, 30, CV_8UC3, cv::Scalar(hue, 220.0, 200.0));
  const int stripe = static_cast<int>(std::lround(yaw_deg / 360.0 * 24.0));
  colour.colRange(0, 2 + stripe).setTo(cv::Scalar((hue + 30) % 180, 220.0, 200.0));
  cv::cvtColor(colour, colour, cv::COLOR_HSV2BGR);
  cv::Mat depth(24, 30, CV_16UC1);
  for (auto& mm : cv::Mat_<std::uint16_t>(depth)) {
    mm = static_cast<std::uint16_t>(900.0 + 5.0 * rng.uniform());
  }
  cv::imwrite(stem + "_crop.png", colour);
  cv::imwrite(stem + "_depthcrop.png", depth);
  cv::imwrite(stem + "_maskcrop.png", cv::Mat(24, 30, CV_8UC1, cv::Scalar(255)));
  write_file(stem + "_loc.txt", "300,200\n");
  write_file(stem + "_pose.txt", fmt::format("{}\n", yaw_deg));
}

/// `frames` views of the object in each of the videos 1, 2, 4.
inline void put_painted_object(const std::filesystem::path& root, const PaintedObject& object,
                               int frames) {
  Rng rng = Rng::stream(1, object.object);
  for (const int video : {1, 2, 4}) {
    for (int frame = 1; frame <= frames; ++frame) {
      put_painted_view(root, object, video, frame, (frame - 1) * 360.0 / frames, rng);
    }
  }
}

}  // namespace vantage::test
