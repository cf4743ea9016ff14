/// Messages of Foxglove's well-known schemas, as JSON. Lengths are in metres, world z up.
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/geometry/pose.hpp"

namespace vantage {

inline constexpr std::string_view kWorldFrame = "world";

std::uint64_t nanoseconds(double time_s);

struct NamedPose {
  std::string frame;
  Pose T_world_frame;
};
nlohmann::ordered_json frame_transforms(double time_s, const std::vector<NamedPose>& frames);
nlohmann::ordered_json pose_in_frame(double time_s, const Pose& T_world_body);
/// x, y, z as 32-bit numbers.
nlohmann::ordered_json point_cloud(double time_s, std::span<const Eigen::Vector3f> points_m);
nlohmann::ordered_json compressed_image(double time_s, std::string_view frame,
                                        std::string_view png);
/// Of a pinhole without distortion whose axis meets the middle of the image.
nlohmann::ordered_json camera_calibration(double time_s, std::string_view frame, int width_px,
                                          int height_px, double focal_px);

using MarkerColour = std::array<double, 4>;  ///< red, green, blue, opacity in [0, 1]
/// Along the x axis of its pose.
struct Arrow {
  Pose T_world_arrow;
  double length_m = 0.3;
  MarkerColour colour{};
};
struct SceneEntity {
  std::string id;
  std::vector<Arrow> arrows = {};
  std::vector<Eigen::Vector3d> path_m = {};  ///< a line; empty: none
  MarkerColour path_colour{};
  std::vector<std::pair<std::string, std::string>> metadata = {};
};
/// Entities replace those of the same id.
nlohmann::ordered_json scene_update(double time_s, const std::vector<SceneEntity>& entities,
                                    const std::vector<std::string>& deleted = {});

/// The JSON schema called "foxglove.<name>", with what the messages above have.
/// `name`: FrameTransforms, PoseInFrame, PointCloud, CompressedImage, CameraCalibration,
/// SceneUpdate
nlohmann::ordered_json foxglove_schema(std::string_view name);

}  // namespace vantage
