/// The pose beside a user's picture.
#pragma once

#include <filesystem>
#include <optional>

namespace vantage {

struct PicturePose {
  double yaw_deg = 0.0;  ///< of the object as the camera sees it, counter-clockwise from above
  std::optional<double> elevation_deg;
};

/// One number: the yaw; two: yaw and elevation of the camera; 12 or 16: rows of the camera's pose
/// in the object's frame, z up, OpenCV's axes: the object's front is its +x side.
/// @throws InputError naming the file if it is none of these.
PicturePose read_picture_pose(const std::filesystem::path& file);

}  // namespace vantage
