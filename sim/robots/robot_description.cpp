#include "vantage/sim/robots/robot_description.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "vantage/core/yaml.hpp"
#include "vantage/sim/robots/robot_outline.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDescription = "robot.yaml";
constexpr std::size_t kRotorCount = 4;

using NamedKey = std::pair<std::string_view, const std::string&>;

void require_names(std::initializer_list<NamedKey> keys) {
  for (const auto& [key, name] : keys) {
    if (name.empty()) {
      throw ConfigError(fmt::format("{}: missing; the name that the MJCF file gives it", key));
    }
  }
}

void require_size(std::string_view key, double size_m) {
  if (!(size_m > 0.0)) throw ConfigError(fmt::format("{}: missing, in m", key));
}

const ConfigNode& required(const ConfigNode& root, const std::string& key, const fs::path& file) {
  if (const ConfigNode* node = root.find(key)) return *node;
  throw ConfigError(fmt::format("{}: {}: missing", file.string(), key));
}

/// The keys of its kind, beside those that every robot has.
RobotKind read_kind(const ConfigNode& root, const fs::path& file) {
  const ConfigNode& node = required(root, "kind", file);
  std::string name;
  read_into(node, name);
  RobotKind kind;
  try {
    kind = make_strategy<RobotKind>(name);
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}", node.where(), error.what()));
  }
  std::visit(
      [&](auto& description) {
        FieldReader reader(root);
        for (const char* key : {"kind", "model", "episode_defaults"}) reader.allow(key);
        reader.set_owners(detail::owners_of<RobotKind>);
        description.fields(reader);
        reader.finish();
        detail::run_check(root, description);
      },
      kind);
  return kind;
}

template <class Description>
const Description& kind_of(const RobotFolder& robot, const std::string& key) {
  require_kind(robot, Description::name, key);
  return std::get<Description>(robot.kind);
}

}  // namespace

void Footprint::check() const {
  require_size("inscribed_radius_m", inscribed_radius_m);
  require_size("circumscribed_radius_m", circumscribed_radius_m);
  if (!outline_m.empty() && outline_of_corners(outline_m).size() < 3) {
    throw ConfigError(fmt::format("outline_m: {} corners enclose nothing", outline_m.size()));
  }
  if (inscribed_radius_m <= circumscribed_radius_m) return;
  throw ConfigError(fmt::format("inscribed_radius_m: {} is above circumscribed_radius_m {}",
                                inscribed_radius_m, circumscribed_radius_m));
}

void OmnidirectionalDrive::check() const { require_names({{"x", x}, {"y", y}, {"yaw", yaw}}); }

void DifferentialDrive::check() const {
  require_names(
      {{"free_joint", free_joint}, {"left_wheel", left_wheel}, {"right_wheel", right_wheel}});
  require_size("wheel_radius_m", wheel_radius_m);
  require_size("track_m", track_m);
  if (on_floor.empty()) {
    throw ConfigError("on_floor: missing; the geoms of wheels and casters that touch the floor");
  }
}

void HeadNames::check() const { require_names({{"pan", pan}, {"tilt", tilt}, {"camera", camera}}); }

void TiltingLaserNames::check() const { require_names({{"tilt", tilt}, {"site", site}}); }

void MobileBaseDescription::check() const {
  require_names({{"base", base}, {"planar_scanner", planar_scanner}});
  detail::run_check("footprint", footprint);  // each may have been left out as a whole
  std::visit([](const auto& kind) { detail::run_check("drive", kind); }, drive);
}

void QuadrotorDescription::check() const {
  require_names({{"base", base},
                 {"free_joint", free_joint},
                 {"camera", camera},
                 {"camera_tilt", camera_tilt}});
  if (rotors.size() != kRotorCount) {
    throw ConfigError(
        fmt::format("rotors: {} actuators, a quadrotor has {}", rotors.size(), kRotorCount));
  }
  require_size("rotor_radius_m", rotor_radius_m);
}

RobotFolder read_robot(const fs::path& folder_or_mjcf) {
  const bool is_folder = fs::is_directory(folder_or_mjcf);
  const fs::path folder = is_folder ? folder_or_mjcf : folder_or_mjcf.parent_path();
  RobotFolder robot;
  robot.description = folder / kDescription;
  if (!fs::is_regular_file(robot.description)) {
    throw InputError(fmt::format(
        "{}: no {} {}: a robot is a folder with an MJCF file and {}, which says what its joints "
        "are",
        folder_or_mjcf.string(), kDescription, is_folder ? "in it" : "beside it", kDescription));
  }
  const ConfigNode root = read_yaml(robot.description);
  detail::require_kind(root, ConfigNode::Kind::map);
  robot.kind = read_kind(root, robot.description);
  const ConfigNode& model = required(root, "model", robot.description);
  std::string name;
  read_into(model, name);
  const bool is_mjcf = !is_folder && folder_or_mjcf.filename() != kDescription;
  robot.mjcf = is_mjcf ? folder_or_mjcf : folder / name;
  if (!fs::is_regular_file(robot.mjcf)) {
    throw InputError(fmt::format("{}: {}: no such file", model.where(), robot.mjcf.string()));
  }
  if (const ConfigNode* defaults = root.find("episode_defaults")) {
    detail::require_kind(*defaults, ConfigNode::Kind::map);
    robot.episode_defaults = *defaults;
  }
  return robot;
}

void require_kind(const RobotFolder& robot, std::string_view kind, const std::string& key) {
  if (strategy_name_of(robot.kind) == kind) return;
  throw ConfigError(fmt::format("{}: {} is a {}; this task needs a {}", key,
                                robot.description.parent_path().string(),
                                strategy_name_of(robot.kind), kind));
}

const MobileBaseDescription& mobile_base_of(const RobotFolder& robot, const std::string& key) {
  return kind_of<MobileBaseDescription>(robot, key);
}

const QuadrotorDescription& quadrotor_of(const RobotFolder& robot, const std::string& key) {
  return kind_of<QuadrotorDescription>(robot, key);
}

}  // namespace vantage
