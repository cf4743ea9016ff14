/// Scenes and robots for the tests of the simulator.
#pragma once

#include <functional>
#include <string>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage::test {

/// One of the robots that come along.
inline RobotFolder robot_folder(const std::string& name) {
  return read_robot(std::filesystem::path(VANTAGE_SOURCE_DIR) / "models/robots" / name);
}

inline MobileBase mobile_base(const World& world, const RobotFolder& robot) {
  return {world.model(), mobile_base_of(robot, "robot"), robot.description.string()};
}

inline std::filesystem::path pr2_file() { return robot_folder("pr2").mjcf; }
inline MobileBase pr2(const World& world) { return mobile_base(world, robot_folder("pr2")); }

/// A folder with a scene of its own.
class SceneFolder {
 public:
  explicit SceneFolder(const std::string& mjcf) { add("scene.xml", mjcf); }
  void add(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, content);
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "scene.xml"; }
  [[nodiscard]] ModelSource alone() const { return {path(), {}}; }
  [[nodiscard]] ModelSource with_pr2() const { return {path(), pr2_file()}; }

 private:
  support::TemporaryDirectory folder_;
};

inline std::string scene_mjcf(const std::string& bodies) {
  return "<mujoco>\n<worldbody>\n<geom name='floor' type='plane' size='10 10 0.1'/>\n" + bodies +
         "\n</worldbody>\n</mujoco>\n";
}

/// The robot in a scene of its own, at the origin.
struct RobotWorld {
  explicit RobotWorld(const std::string& bodies = "", const Pose2& T_world_base = {},
                      double torso_m = 0.0)
      : folder(scene_mjcf(bodies)), world(folder.with_pr2()), robot(pr2(world)) {
    robot.place(world, T_world_base, torso_m);
  }
  void run(double duration_s) {
    const double end_s = world.time_s() + duration_s - 1e-9;
    while (world.time_s() < end_s) world.advance_tick();
  }
  SceneFolder folder;
  World world;
  MobileBase robot;
};

/// A small differential-drive robot in a scene of its own.
struct RoverWorld {
  explicit RoverWorld(const std::string& bodies = "", const Pose2& T_world_base = {},
                      const WorldOptions& options = {})
      : folder(scene_mjcf(bodies)),
        world({folder.path(), robot_folder("rover").mjcf}, options),
        robot(mobile_base(world, robot_folder("rover"))) {
    robot.place(world, T_world_base);
  }
  void run(double duration_s) {
    const double end_s = world.time_s() + duration_s - 1e-9;
    while (world.time_s() < end_s) world.advance_tick();
  }
  SceneFolder folder;
  World world;
  MobileBase robot;
};

/// What the call throws as an `Expected`; "" if it throws nothing.
template <class Expected>
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Expected& error) {
    return error.what();
  }
  return "";
}

}  // namespace vantage::test
