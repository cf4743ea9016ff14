/// What every episode has, whatever its task: these keys of its file, and the files they name.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/runtime/log/recording_options.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/sim/world/world_options.hpp"

namespace vantage {

struct RobotOptions {
  std::string model = "models/robots/pr2";
  int start_view = 0;
  double start_behind_m = 0.0;
  std::string start_site;
  std::array<double, 3> start_pose{0.0, 0.0, 0.0};
  void fields(auto&& f) {
    f("model", model, "folder with an MJCF file and robot.yaml");
    f("start_view", start_view, "table top: position on the ring of views where the robot starts",
      at_least(0));
    f("start_behind_m", start_behind_m,
      "table top: how far behind that position, seen from the table", between(0.0, 100.0));
    f("start_site", start_site,
      "exploration: site of the scene where it starts; empty: start_pose");
    f("start_pose", start_pose, "exploration: x m, y m, yaw rad, world");
  }
};

struct EpisodeOptions {
  std::string scene = "models/scenes/tabletop_8/scene.xml";
  std::uint64_t seed = 1;
  int threads = 2;
  RobotOptions robot;
  WorldOptions simulation;
  RecordingOptions recording;
  void fields(auto&& f) {
    f("scene", scene, "MJCF");
    f("seed", seed, "of every random stream");
    f("threads", threads, "results do not depend on it", between(1, 256));
    f("robot", robot, "@@");
    f("simulation", simulation, "@@");
    f("recording", recording, "@@");
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
