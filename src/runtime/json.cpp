#include "vantage/runtime/json.hpp"

#include <nlohmann/json.hpp>

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;
}  // namespace

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json config_json(const ConfigNode& node) {
  Json json;
  if (node.kind == ConfigNode::Kind::list) json = Json::array();
  if (node.kind == ConfigNode::Kind::map) json = Json::object();
  for (const auto& item : node.items) json.push_back(config_json(item));
  for (const auto& [name, child] : node.entries) json[name] = config_json(child);
  if (node.kind != ConfigNode::Kind::scalar) return json;
  json = node.scalar;
  if (node.quoted) return json;
  auto number = Json::parse(node.scalar, nullptr, false);
  return number.is_discarded() ? json : number;
}

Json box_json(const Eigen::AlignedBox3d& box) {
  return {{"min_m", {box.min().x(), box.min().y(), box.min().z()}},
          {"max_m", {box.max().x(), box.max().y(), box.max().z()}}};
}

Json view_json(const Pose& T_world_sensor) {
  const Eigen::Vector3d p = T_world_sensor.translation();
  return {{"x_m", p.x()},
          {"y_m", p.y()},
          {"z_m", p.z()},
          {"yaw_rad", project_to_se2(T_world_sensor).yaw_rad}};
}

Json candidates_json(std::span<const Candidate> views) {
  Json list = Json::array();
  for (const Candidate& view : views) {
    Json entry = {{"id", view.id}};
    entry.update(view_json(view.T_world_sensor));
    list.push_back(entry);
  }
  return list;
}

}  // namespace vantage
