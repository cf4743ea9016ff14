/// Finding in a compiled model what robot.yaml names, with errors that say which key is wrong.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "vantage/sim/world/world.hpp"

namespace vantage {

enum class JointType { slide, hinge };

/// A joint of one degree of freedom and the actuator that drives it.
struct DrivenJoint {
  int joint = 0;
  int qpos = 0;
  int dof = 0;
  int actuator = 0;
  double min = 0.0;  ///< of the command
  double max = 0.0;
};

/// The names of one robot in one model.
class RobotNames {
 public:
  /// @param where the robot's folder, for messages
  RobotNames(const mjModel& model, std::string where) : model_(model), where_(std::move(where)) {}

  /// @throws InputError naming folder, key and name, and the names of that kind that there are.
  [[nodiscard]] int find(ModelObject kind, std::string_view key, const std::string& name) const;
  /// A body that stands in no other. @throws InputError
  [[nodiscard]] int find_root(std::string_view key, const std::string& name) const;
  /// @throws InputError also if the joint is of another type, or no one actuator with a control
  /// range drives it.
  [[nodiscard]] DrivenJoint driven(std::string_view key, const std::string& joint,
                                   JointType type) const;
  /// A joint of the body with six degrees of freedom. @throws InputError
  [[nodiscard]] int free_joint(std::string_view key, const std::string& joint, int body) const;
  /// @throws InputError if `body` is no part of `ancestor`.
  void require_part(std::string_view key, int body, int ancestor) const;
  /// The pose of a body's child in its `ancestor`, every joint between them at its reference.
  /// @throws InputError if `body` is no part of `ancestor`.
  [[nodiscard]] Eigen::Isometry3d pose_in(int ancestor, int body, std::string_view key) const;
  /// @throws InputError unless the joint's axis in `ancestor` is `axis`, every joint at its
  /// reference.
  void require_axis(std::string_view key, int joint, int ancestor,
                    const Eigen::Vector3d& axis) const;
  /// @param what has that direction, for the message
  /// @throws InputError unless unit vectors are the same, to a milliradian.
  void require_direction(std::string_view key, std::string_view what, const Eigen::Vector3d& is,
                         const Eigen::Vector3d& expected) const;
  /// @throws InputError unless the place in `ancestor` is on the joint's axis, to a millimetre,
  /// every joint at its reference.
  void require_on_axis(std::string_view key, int joint, int ancestor,
                       const Eigen::Vector3d& p_m) const;
  /// @throws InputError unless `body` is fixed to `ancestor`, no joint between them.
  void require_fixed(std::string_view key, int body, int ancestor) const;
  /// @throws InputError unless these joints of `body`, the turning one last, move it in the plane
  /// of the world, from its origin.
  void require_planar(std::string_view key, int body, const std::array<int, 3>& joints) const;
  /// @throws InputError unless the camera looks along the x axis of `ancestor`, with its y axis to
  /// the left, every joint at its reference.
  void require_level_camera(std::string_view key, int camera, int ancestor) const;
  /// "models/robots/x: head.pan: what" as an InputError.
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;

 private:
  const mjModel& model_;
  std::string where_;
};

/// The body that carries all others of the robot, and the robot's first camera, of a model where
/// names that start with robot/ are the robot's.
/// @throws InputError if there is no such body.
int robot_base(const mjModel& model);
std::optional<int> robot_camera(const mjModel& model);
/// In the order of the model.
std::vector<int> robot_actuators(const mjModel& model);

/// Of a position and a quaternion (w, x, y, z, of any length) of MuJoCo.
Eigen::Isometry3d pose_of(const double* p, const double* wxyz);

/// Pose of a site in its body; of the camera, looking along -z, too.
Eigen::Isometry3d site_in_body(const mjModel& model, int site);
Eigen::Isometry3d camera_in_body(const mjModel& model, int camera);

}  // namespace vantage
