#include "vantage/mcap/messages.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

#include "vantage/report/report_data.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kSecond_ns = 1'000'000'000;

Json time_json(double time_s) {
  const std::uint64_t time_ns = nanoseconds(time_s);
  return {{"sec", time_ns / kSecond_ns}, {"nsec", time_ns % kSecond_ns}};
}

Json vector_json(const Eigen::Vector3d& p) { return {{"x", p.x()}, {"y", p.y()}, {"z", p.z()}}; }

Json quaternion_json(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

Json pose_json(const Pose& pose) {
  return {{"position", vector_json(pose.translation())}, {"orientation", quaternion_json(pose)}};
}

Json colour_json(const MarkerColour& colour) {
  return {{"r", colour[0]}, {"g", colour[1]}, {"b", colour[2]}, {"a", colour[3]}};
}

Json arrow_json(const Arrow& arrow) {
  return {{"pose", pose_json(arrow.T_world_arrow)}, {"shaft_length", 0.7 * arrow.length_m},
          {"shaft_diameter", 0.1 * arrow.length_m}, {"head_length", 0.3 * arrow.length_m},
          {"head_diameter", 0.25 * arrow.length_m}, {"color", colour_json(arrow.colour)}};
}

Json line_json(const std::vector<Eigen::Vector3d>& path_m, const MarkerColour& colour) {
  Json points = Json::array();
  for (const Eigen::Vector3d& p : path_m) points.push_back(vector_json(p));
  return {{"type", 0},  // a strip
          {"pose", pose_json(Pose::Identity())},
          {"thickness", 0.03},
          {"scale_invariant", false},
          {"points", points},
          {"color", colour_json(colour)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

Json entity_json(double time_s, const SceneEntity& entity) {
  Json json{{"timestamp", time_json(time_s)},
            {"frame_id", kWorldFrame},
            {"id", entity.id},
            {"lifetime", {{"sec", 0}, {"nsec", 0}}},
            {"frame_locked", false},
            {"metadata", Json::array()}};
  for (const char* kind :
       {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    json[kind] = Json::array();
  }
  for (const auto& [key, value] : entity.metadata) {
    json["metadata"].push_back({{"key", key}, {"value", value}});
  }
  for (const Arrow& arrow : entity.arrows) json["arrows"].push_back(arrow_json(arrow));
  if (!entity.path_m.empty()) {
    json["lines"].push_back(line_json(entity.path_m, entity.path_colour));
  }
  return json;
}

}  // namespace

std::uint64_t nanoseconds(double time_s) {
  return static_cast<std::uint64_t>(std::llround(std::max(time_s, 0.0) * 1e9));
}

Json frame_transforms(double time_s, const std::vector<NamedPose>& frames) {
  Json transforms = Json::array();
  for (const NamedPose& frame : frames) {
    transforms.push_back({{"timestamp", time_json(time_s)},
                          {"parent_frame_id", kWorldFrame},
                          {"child_frame_id", frame.frame},
                          {"translation", vector_json(frame.T_world_frame.translation())},
                          {"rotation", quaternion_json(frame.T_world_frame)}});
  }
  return {{"transforms", transforms}};
}

Json pose_in_frame(double time_s, const Pose& T_world_body) {
  return {{"timestamp", time_json(time_s)},
          {"frame_id", kWorldFrame},
          {"pose", pose_json(T_world_body)}};
}

Json point_cloud(double time_s, std::span<const Eigen::Vector3f> points_m) {
  constexpr int kFloat32 = 7;
  Json fields = Json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    fields.push_back(
        {{"name", std::string(1, "xyz"[i])}, {"offset", i * sizeof(float)}, {"type", kFloat32}});
  }
  const std::string_view bytes(reinterpret_cast<const char*>(points_m.data()),
                               points_m.size_bytes());
  return {{"timestamp", time_json(time_s)},
          {"frame_id", kWorldFrame},
          {"pose", pose_json(Pose::Identity())},
          {"point_stride", 3 * sizeof(float)},
          {"fields", fields},
          {"data", base64(bytes)}};
}

Json compressed_image(double time_s, std::string_view frame, std::string_view png) {
  return {{"timestamp", time_json(time_s)},
          {"frame_id", frame},
          {"data", base64(png)},
          {"format", "png"}};
}

Json camera_calibration(double time_s, std::string_view frame, int width_px, int height_px,
                        double focal_px) {
  const double u = 0.5 * (width_px - 1);
  const double v = 0.5 * (height_px - 1);
  return {{"timestamp", time_json(time_s)},
          {"frame_id", frame},
          {"width", width_px},
          {"height", height_px},
          {"distortion_model", ""},
          {"D", Json::array()},
          {"K", {focal_px, 0, u, 0, focal_px, v, 0, 0, 1}},
          {"R", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
          {"P", {focal_px, 0, u, 0, 0, focal_px, v, 0, 0, 0, 1, 0}}};
}

Json scene_update(double time_s, const std::vector<SceneEntity>& entities,
                  const std::vector<std::string>& deleted) {
  Json deletions = Json::array();
  for (const std::string& id : deleted) {
    deletions.push_back({{"timestamp", time_json(time_s)}, {"type", 0}, {"id", id}});
  }
  Json list = Json::array();
  for (const SceneEntity& entity : entities) list.push_back(entity_json(time_s, entity));
  return {{"deletions", deletions}, {"entities", list}};
}

}  // namespace vantage
