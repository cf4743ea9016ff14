/// A quadrotor, as its robot.yaml describes it: thrusts in, state and frames out.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "vantage/control/airframe.hpp"
#include "vantage/control/flight_controller.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/sim/robots/robot_names.hpp"
#include "vantage/sim/world/contacts.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

/// 500 Hz; thrusts are commanded at every physics step.
inline constexpr WorldOptions kFlightWorld{.timestep_s = 0.002, .control_period_s = 0.002};

/// Handles of the vehicle's rotors, camera and bodies in one model. It moves by its rotors' thrust
/// alone. Commands hold until the next one and are clipped to what the actuators take.
class Quadrotor {
 public:
  /// @param where the robot's folder, and @param scene the MJCF file whose gravity it is, for
  /// messages
  /// @throws InputError naming key and name if the model lacks what robot.yaml names, or has it
  /// otherwise than the controller takes it to be; or if gravity does not point down.
  Quadrotor(const mjModel& model, const QuadrotorDescription& description, const std::string& where,
            const std::string& scene);

  /// Where it hovers when the episode begins, rotors carrying its weight, camera looking
  /// `camera_pitch_rad` below the horizon of the body. Only before the first tick.
  /// @throws ConfigError if the camera does not tilt so far.
  void place(World& world, const Pose& T_world_body,
             double camera_pitch_rad = kDefaultCameraPitch_rad) const;

  void command_thrusts(World& world, const Eigen::Vector4d& thrust_N) const;
  /// Positive looks down; clipped to what the servo takes, [0, camera_pitch_max_rad()].
  void command_camera_pitch(World& world, double pitch_rad) const;

  /// As compiled: mass, inertia and centre of mass of all its bodies.
  [[nodiscard]] const Airframe& airframe() const { return airframe_; }
  [[nodiscard]] double rotor_radius_m() const { return rotor_radius_m_; }
  [[nodiscard]] std::span<const int> rotor_actuators() const { return actuators_; }

  /// Truth: for metrics, and as the input of an estimate.
  [[nodiscard]] FlightState state(const World& world) const;
  [[nodiscard]] Eigen::Vector4d thrusts_N(const World& world) const;  ///< with the motors' lag
  [[nodiscard]] double camera_pitch_rad(const World& world) const;
  [[nodiscard]] double camera_pitch_max_rad() const { return tilt_.max; }

  /// Axes of the camera as in sim/camera.hpp.
  [[nodiscard]] Pose T_body_camera(double pitch_rad) const;
  /// Where the body hovers level while the camera is at `p_world_camera_m`, heading `yaw_rad`.
  [[nodiscard]] Pose body_for_camera(const Eigen::Vector3d& p_world_camera_m, double yaw_rad,
                                     double pitch_rad) const;

  [[nodiscard]] int camera_id() const { return camera_; }
  [[nodiscard]] int base_body_id() const { return base_body_; }

  /// Geoms of other things that it touches, rotors included, ascending; as of the last step.
  [[nodiscard]] std::vector<int> touched_geoms(const World& world) const;
  [[nodiscard]] int contacts(const World& world) const;

  static constexpr double kDefaultCameraPitch_rad = 0.7853981633974483;  ///< 45 deg

 private:
  void find_rotors(const RobotNames& names, const mjModel& model,
                   const QuadrotorDescription& description);
  void find_camera(const RobotNames& names, const mjModel& model,
                   const QuadrotorDescription& description);

  std::string free_joint_;
  std::string tilt_joint_;
  int qpos_ = 0;  ///< of the free joint: position, quaternion
  int dof_ = 0;
  int base_body_ = 0;
  int camera_ = 0;
  DrivenJoint tilt_;
  int tilt_activation_ = 0;
  std::array<int, kRotors> actuators_{};
  std::array<int, kRotors> activations_{};
  Airframe airframe_;
  double rotor_radius_m_ = 0.0;
  Eigen::Vector3d p_body_tilt_axis_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_mount_camera_m_ = Eigen::Vector3d::Zero();
};

}  // namespace vantage
