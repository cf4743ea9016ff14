#include "vantage/sim/robots/robot_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr std::string_view kRobotPrefix = "robot/";

std::string_view text(ModelObject kind) {
  switch (kind) {
    case ModelObject::body: return "body";
    case ModelObject::joint: return "joint";
    case ModelObject::geom: return "geom";
    case ModelObject::site: return "site";
    case ModelObject::camera: return "camera";
    case ModelObject::actuator: return "actuator";
  }
  return "object";
}

}  // namespace

Eigen::Isometry3d pose_of(const double* p, const double* wxyz) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Map<const Eigen::Vector3d>(p);
  T.linear() =
      Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
  return T;
}

void RobotNames::fail(std::string_view key, const std::string& what) const {
  throw InputError(fmt::format("{}: {}: {}", where_, key, what));
}

int RobotNames::find(ModelObject kind, std::string_view key, const std::string& name) const {
  if (const auto id = find_model_id(model_, kind, name)) return *id;
  std::vector<std::string> known = model_names(model_, kind);
  std::erase_if(known, [](const std::string& n) { return !n.starts_with(kRobotPrefix); });
  fail(key, fmt::format("the model has no {} '{}'; {}", text(kind), name,
                        known.empty() ? "it has none that starts with robot/"
                                      : fmt::format("known: {}", fmt::join(known, ", "))));
}

int RobotNames::find_root(std::string_view key, const std::string& name) const {
  const int body = find(ModelObject::body, key, name);
  if (model_.body_rootid[body] == body) return body;
  fail(key,
       fmt::format("body '{}' stands in another one; the one that all others stand in is meant",
                   name));
}

DrivenJoint RobotNames::driven(std::string_view key, const std::string& name,
                               JointType type) const {
  const int joint = find(ModelObject::joint, key, name);
  const bool slides = type == JointType::slide;
  if (model_.jnt_type[joint] != (slides ? mjJNT_SLIDE : mjJNT_HINGE)) {
    fail(key, fmt::format("joint '{}' is no {}", name, slides ? "slide" : "hinge"));
  }
  std::vector<int> actuators;
  for (int i = 0; i < model_.nu; ++i) {
    if (model_.actuator_trntype[i] == mjTRN_JOINT && model_.actuator_trnid[2 * i] == joint) {
      actuators.push_back(i);
    }
  }
  if (actuators.size() != 1) {
    fail(key, fmt::format("{} actuators drive joint '{}', expected one", actuators.size(), name));
  }
  const int actuator = actuators.front();
  if (model_.actuator_ctrllimited[actuator] == 0) {
    fail(key, fmt::format("the actuator of joint '{}' has no ctrlrange", name));
  }
  return {.joint = joint,
          .qpos = model_.jnt_qposadr[joint],
          .dof = model_.jnt_dofadr[joint],
          .actuator = actuator,
          .min = model_.actuator_ctrlrange[2 * actuator],
          .max = model_.actuator_ctrlrange[2 * actuator + 1]};
}

int RobotNames::free_joint(std::string_view key, const std::string& name, int body) const {
  const int joint = find(ModelObject::joint, key, name);
  if (model_.jnt_type[joint] != mjJNT_FREE || model_.jnt_bodyid[joint] != body) {
    fail(key, fmt::format("joint '{}' is not the free joint of body '{}'", name,
                          model_name(model_, ModelObject::body, body)));
  }
  return joint;
}

void RobotNames::require_part(std::string_view key, int body, int ancestor) const {
  for (int at = body; at != ancestor; at = model_.body_parentid[at]) {
    if (at != 0) continue;
    fail(key, fmt::format("it is no part of body '{}'",
                          model_name(model_, ModelObject::body, ancestor)));
  }
}

Eigen::Isometry3d RobotNames::pose_in(int ancestor, int body, std::string_view key) const {
  require_part(key, body, ancestor);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int at = body; at != ancestor; at = model_.body_parentid[at]) {
    T = pose_of(model_.body_pos + 3 * at, model_.body_quat + 4 * at) * T;
  }
  return T;
}

void RobotNames::require_axis(std::string_view key, int joint, int ancestor,
                              const Eigen::Vector3d& axis) const {
  const Eigen::Isometry3d T = pose_in(ancestor, model_.jnt_bodyid[joint], key);
  const Eigen::Vector3d is =
      T.linear() * Eigen::Map<const Eigen::Vector3d>(model_.jnt_axis + 3 * joint);
  require_direction(
      key, fmt::format("the axis of joint '{}'", model_name(model_, ModelObject::joint, joint)), is,
      axis);
}

void RobotNames::require_direction(std::string_view key, std::string_view what,
                                   const Eigen::Vector3d& is,
                                   const Eigen::Vector3d& expected) const {
  if ((is - expected).norm() < 1e-3) return;
  fail(key, fmt::format("{} is ({:.3g}, {:.3g}, {:.3g}) in the base, expected ({:.3g}, {:.3g}, "
                        "{:.3g})",
                        what, is.x(), is.y(), is.z(), expected.x(), expected.y(), expected.z()));
}

void RobotNames::require_on_axis(std::string_view key, int joint, int ancestor,
                                 const Eigen::Vector3d& p_m) const {
  constexpr double kOff_m = 1e-3;
  const Eigen::Isometry3d T = pose_in(ancestor, model_.jnt_bodyid[joint], key);
  const Eigen::Vector3d axis =
      T.linear() * Eigen::Map<const Eigen::Vector3d>(model_.jnt_axis + 3 * joint);
  const Eigen::Vector3d anchor_m =
      T * Eigen::Map<const Eigen::Vector3d>(model_.jnt_pos + 3 * joint);
  const double off_m = axis.cross(p_m - anchor_m).norm();
  if (off_m <= kOff_m) return;
  fail(key, fmt::format("it is {:.3g} m beside the axis of joint '{}', expected on it", off_m,
                        model_name(model_, ModelObject::joint, joint)));
}

void RobotNames::require_fixed(std::string_view key, int body, int ancestor) const {
  if (model_.body_weldid[body] == model_.body_weldid[ancestor]) return;
  fail(key, fmt::format("it moves against body '{}', expected fixed to it",
                        model_name(model_, ModelObject::body, ancestor)));
}

void RobotNames::require_planar(std::string_view key, int body,
                                const std::array<int, 3>& joints) const {
  const std::string name = model_name(model_, ModelObject::body, body);
  for (const int joint : joints) {
    if (model_.jnt_bodyid[joint] == body && joint <= joints.back()) continue;
    fail(key, fmt::format("the joints must all be those of body '{}', x and y before yaw", name));
  }
  const Eigen::Isometry3d T = pose_of(model_.body_pos + 3 * body, model_.body_quat + 4 * body);
  if (T.translation().head<2>().norm() < 1e-6 && T.linear().isIdentity(1e-6)) return;
  fail(key, fmt::format("body '{}' must be upright over the origin: no pos along x or y, no turn",
                        name));
}

void RobotNames::require_level_camera(std::string_view key, int camera, int ancestor) const {
  Eigen::Matrix3d level;
  level << 0.0, 0.0, -1.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  const Eigen::Isometry3d T =
      pose_in(ancestor, model_.cam_bodyid[camera], key) * camera_in_body(model_, camera);
  if (T.linear().isApprox(level, 1e-3)) return;
  fail(key, "it must look along the base's x with every joint at 0: xyaxes=\"0 -1 0 0 0 1\"");
}

std::vector<int> robot_actuators(const mjModel& model) {
  std::vector<int> actuators;
  for (int i = 0; i < model.nu; ++i) {
    if (model_name(model, ModelObject::actuator, i).starts_with(kRobotPrefix)) {
      actuators.push_back(i);
    }
  }
  return actuators;
}

int robot_base(const mjModel& model) {
  for (int body = 1; body < model.nbody; ++body) {
    if (model.body_parentid[body] == 0 &&
        model_name(model, ModelObject::body, body).starts_with(kRobotPrefix)) {
      return body;
    }
  }
  throw InputError("the model has no body whose name starts with robot/");
}

std::optional<int> robot_camera(const mjModel& model) {
  for (int camera = 0; camera < model.ncam; ++camera) {
    if (model_name(model, ModelObject::camera, camera).starts_with(kRobotPrefix)) return camera;
  }
  return std::nullopt;
}

Eigen::Isometry3d site_in_body(const mjModel& model, int site) {
  return pose_of(model.site_pos + 3 * site, model.site_quat + 4 * site);
}

Eigen::Isometry3d camera_in_body(const mjModel& model, int camera) {
  return pose_of(model.cam_pos + 3 * camera, model.cam_quat + 4 * camera);
}

}  // namespace vantage
