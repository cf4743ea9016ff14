/// Quadrotors for the tests: one of numbers alone, one in a world of its own.
#pragma once

#include "tests/sim/test_world.hpp"
#include "vantage/sim/robots/trajectory_tracking_controller.hpp"

namespace vantage::test {

inline std::filesystem::path quadrotor_file(const std::string& name = "quadrotor") {
  return robot_folder(name).mjcf;
}
inline Quadrotor quadrotor(const World& world, const std::string& name = "quadrotor") {
  const RobotFolder robot = robot_folder(name);
  return {world.model(), quadrotor_of(robot, "robot"), robot.description.string(),
          world.source().scene.string()};
}

/// What models/robots/quadrotor is meant to be.
inline Airframe airframe() {
  Airframe frame;
  frame.mass_kg = 1.24;
  frame.inertia_kg_m2 = Eigen::Vector3d(0.0061, 0.0076, 0.0126).asDiagonal();
  frame.p_body_com_m = {0.008, 0.0, -0.008};
  frame.rotors = {Rotor{{0.117, 0.117, 0.032}, -0.016}, Rotor{{-0.117, 0.117, 0.032}, 0.016},
                  Rotor{{-0.117, -0.117, 0.032}, -0.016}, Rotor{{0.117, -0.117, 0.032}, 0.016}};
  frame.thrust_max_N = 8.0;
  return frame;
}

inline TrajectoryTrackingOptions exact_tracking() {
  TrajectoryTrackingOptions options;
  options.pose_noise = PoseNoiseOptions::perfect();
  return options;
}

inline Pose at_height(double z_m) { return make_pose({0.0, 0.0, z_m}, 0.0); }

/// Hovering in a scene.
struct FlightWorld {
  explicit FlightWorld(const TrajectoryTrackingOptions& options = exact_tracking(),
                       const Pose& T_world_body = at_height(3.0), const std::string& bodies = "",
                       std::uint64_t seed = 1)
      : folder(scene_mjcf(bodies)),
        world({folder.path(), quadrotor_file()}, kFlightWorld),
        vehicle(quadrotor(world)),
        tracking((vehicle.place(world, T_world_body), world), vehicle, options, Rng(seed)) {}
  [[nodiscard]] Eigen::Vector3d position_m() const {
    return vehicle.state(world).T_world_body.translation();
  }
  SceneFolder folder;
  World world;
  Quadrotor vehicle;
  TrajectoryTrackingController tracking;
};

}  // namespace vantage::test
