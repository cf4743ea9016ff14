#include "vantage/tasks/robot_defaults.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace vantage {
namespace {

constexpr double kFootprintMargin_m = 0.01;

/// A scalar or list of `over` stands for a whole map of `defaults`: `gain: simple` has no keys.
void fill_in(ConfigNode& over, const ConfigNode& defaults) {
  for (const auto& [key, value] : defaults.entries) {
    const ConfigNode* set = over.find(key);
    if (set == nullptr || set->kind == ConfigNode::Kind::null) {
      over.set(key, value);
    } else if (set->kind == ConfigNode::Kind::map && value.kind == ConfigNode::Kind::map) {
      ConfigNode child = *set;
      fill_in(child, value);
      over.set(key, std::move(child));
    }
  }
}

ConfigNode footprint_default(const RobotFolder& robot, const Footprint& footprint) {
  ConfigNode radius = ConfigNode::make_scalar(
      fmt::format("{}", footprint.circumscribed_radius_m + kFootprintMargin_m));
  radius.origin = robot.description.string();
  radius.key = "navigation.footprint_radius_m";
  ConfigNode navigation = ConfigNode::make_map();
  navigation.set("footprint_radius_m", std::move(radius));
  ConfigNode root = ConfigNode::make_map();
  root.set("navigation", std::move(navigation));
  return root;
}

}  // namespace

ConfigNode with_robot_defaults(const ConfigNode& episode, const ConfigNode& keys,
                               const RobotFolder& robot, std::string_view task) {
  ConfigNode filled = episode;
  if (const ConfigNode* defaults = robot.episode_defaults.find(task)) fill_in(filled, *defaults);
  const auto* base = std::get_if<MobileBaseDescription>(&robot.kind);
  if (base != nullptr && keys.find("navigation") != nullptr) {
    fill_in(filled, footprint_default(robot, base->footprint));
  }
  return filled;
}

}  // namespace vantage
