/// What every episode has, whatever its task: these keys of its file, and the files they name.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/runtime/log/recording_options.hpp"
#include "vantage/sim/faults/fault_options.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/sim/world/world_options.hpp"

namespace vantage {

struct RobotOptions {
  std::string model = "models/robots/pr2";
  int start_view = 0;
  double start_behind_m = 0.0;
  std::string start_site;
  std::optional<std::array<double, 3>> start_pose;
  void fields(auto&& f) {
    f("model", model,
      "folder of the robot, with an MJCF file and `robot.yaml`; or another MJCF file in such a "
      "folder");
    f("start_view", start_view,
      "table top: index of the position on the ring of candidate views where the robot starts",
      at_least(0));
    f("start_behind_m", start_behind_m, "table top: how far outside that ring the robot starts",
      between(0.0, 100.0));
    f("start_site", start_site,
      "exploration: site of the scene where the robot starts; empty: at `start_pose`");
    f("start_pose", start_pose,
      "exploration: x (m), y (m) and yaw (rad) in the world frame where the robot starts, in place "
      "of `start_site`; null: at the site, or if there is none at 0, 0, 0");
  }
  [[nodiscard]] Pose2 posed_start() const {
    const auto [x_m, y_m, yaw_rad] = start_pose.value_or(std::array{0.0, 0.0, 0.0});
    return {x_m, y_m, wrap_angle(yaw_rad)};
  }
};

struct EpisodeOptions {
  std::string scene = "models/scenes/tabletop_8/scene.xml";
  std::uint64_t seed = 1;
  int threads = 2;
  RobotOptions robot;
  WorldOptions simulation;
  FaultOptions faults;
  RecordingOptions recording;
  void fields(auto&& f) {
    f("scene", scene, "MJCF file of the scene, which the robot is added to");
    f("seed", seed, "seed of every random stream; the same seed gives the same episode");
    f("threads", threads, "worker threads; more are faster, results do not depend on them",
      between(1, 256));
    f("robot", robot, "the robot and where it starts");
    f("simulation", simulation, "physics step and control period of the simulation");
    f("faults", faults, "what goes wrong with sensors, actuators and the world; all of it is off");
    f("recording", recording, "speed, frame rate and size of the video");
  }
};

/// An episode without its task: defaults filled in, overrides applied, files found.
struct EpisodeSetup {
  EpisodeOptions options;
  std::string name;             ///< of the file, without extension
  std::filesystem::path scene;  ///< found
  RobotFolder robot;            ///< found and read
};

}  // namespace vantage
