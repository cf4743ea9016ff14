/// A small dataset on disk, written without the code under test.
#pragma once

#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <string>

#include "vantage/core/atomic_file.hpp"

namespace vantage::support {

/// A view of 5 x 4 px at (300, 200): colour (row, column, 7), depth 1000 + column mm but for a hole
/// at (0, 0), mask on rows 1 and 2.
inline void put_view(const std::filesystem::path& root, const std::string& category,
                     const std::string& object, int video, int frame, const std::string& pose) {
  const auto folder = root / category / object;
  std::filesystem::create_directories(folder);
  const std::string stem =
      (folder / (object + "_" + std::to_string(video) + "_" + std::to_string(frame))).string();
  cv::Mat colour(4, 5, CV_8UC3);
  cv::Mat depth(4, 5, CV_16UC1);
  cv::Mat mask(4, 5, CV_8UC1);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      colour.at<cv::Vec3b>(row, column) = {7, static_cast<unsigned char>(column),
                                           static_cast<unsigned char>(row)};  // blue first
      depth.at<std::uint16_t>(row, column) = static_cast<std::uint16_t>(1000 + column);
      mask.at<unsigned char>(row, column) = row == 1 || row == 2 ? 255 : 0;
    }
  }
  depth.at<std::uint16_t>(0, 0) = 0;
  cv::imwrite(stem + "_crop.png", colour);
  cv::imwrite(stem + "_depthcrop.png", depth);
  cv::imwrite(stem + "_maskcrop.png", mask, {cv::IMWRITE_PNG_BILEVEL, 1});
  write_file(stem + "_loc.txt", "300,200\n");
  write_file(stem + "_pose.txt", pose);
}

}  // namespace vantage::support
