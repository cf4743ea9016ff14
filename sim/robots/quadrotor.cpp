#include "vantage/sim/robots/quadrotor.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr auto kFreeJoint = "robot/base";
constexpr auto kTiltJoint = "robot/camera_tilt";

Eigen::Vector3d vector_at(const mjtNum* numbers, int index) {
  return Eigen::Map<const Eigen::Vector3d>(numbers + 3 * index);
}

Eigen::Quaterniond quaternion_at(const mjtNum* wxyz) {
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
}

/// Inertia of a point mass.
Eigen::Matrix3d point_inertia(double mass_kg, const Eigen::Vector3d& r_m) {
  return mass_kg * (r_m.squaredNorm() * Eigen::Matrix3d::Identity() - r_m * r_m.transpose());
}

/// Mass, centre and inertia of the tree of bodies under `root`, whose joints are at their reference
/// and whose bodies are not turned against it there.
void add_bodies(const mjModel& model, int root, Airframe& airframe) {
  struct Part {
    double mass_kg;
    Eigen::Vector3d p_m;
    Eigen::Matrix3d inertia_kg_m2;
  };
  std::vector<Part> parts;
  for (int body = root; body < model.nbody; ++body) {
    if (model.body_rootid[body] != root) continue;
    Eigen::Vector3d p_m = vector_at(model.body_ipos, body);
    for (int b = body; b != root; b = model.body_parentid[b]) p_m += vector_at(model.body_pos, b);
    const Eigen::Matrix3d R = quaternion_at(model.body_iquat + 4 * body).toRotationMatrix();
    const Eigen::Vector3d principal = vector_at(model.body_inertia, body);
    parts.push_back({model.body_mass[body], p_m, R * principal.asDiagonal() * R.transpose()});
    airframe.mass_kg += parts.back().mass_kg;
    airframe.p_body_com_m += parts.back().mass_kg * p_m;
  }
  airframe.p_body_com_m /= airframe.mass_kg;
  for (const Part& part : parts) {
    airframe.inertia_kg_m2 +=
        part.inertia_kg_m2 + point_inertia(part.mass_kg, part.p_m - airframe.p_body_com_m);
  }
}

double downward_gravity(const mjModel& model) {
  const Eigen::Vector3d gravity = vector_at(model.opt.gravity, 0);
  if (gravity.head<2>().norm() > 0.0 || !(gravity.z() < 0.0)) {
    throw InputError(fmt::format("a quadrotor flies where gravity points down, not along {} {} {}",
                                 gravity.x(), gravity.y(), gravity.z()));
  }
  return -gravity.z();
}

}  // namespace

Quadrotor::Quadrotor(const mjModel& model)
    : base_body_(model_id(model, ModelObject::body, "robot/base")),
      camera_(model_id(model, ModelObject::camera, "robot/camera")),
      tilt_actuator_(model_id(model, ModelObject::actuator, kTiltJoint)),
      tilt_max_rad_(model.actuator_ctrlrange[2 * tilt_actuator_ + 1]) {
  const int joint = model_id(model, ModelObject::joint, kFreeJoint);
  qpos_ = model.jnt_qposadr[joint];
  dof_ = model.jnt_dofadr[joint];
  tilt_qpos_ = model.jnt_qposadr[model_id(model, ModelObject::joint, kTiltJoint)];
  p_body_tilt_axis_m_ = vector_at(model.body_pos, model.cam_bodyid[camera_]);
  p_mount_camera_m_ = vector_at(model.cam_pos, camera_);

  // Actuators without a state come first.
  const auto activation = [&](int actuator) { return actuator - (model.nu - model.na); };
  tilt_activation_ = activation(tilt_actuator_);
  airframe_.gravity_m_s2 = downward_gravity(model);
  add_bodies(model, base_body_, airframe_);
  for (int i = 0; i < kRotors; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::string name = fmt::format("robot/rotor_{}", i);
    const int actuator = model_id(model, ModelObject::actuator, name);
    const int site = model_id(model, ModelObject::site, name);
    actuators_[at] = actuator;
    activations_[at] = activation(actuator);
    airframe_.rotors[at] = {.p_body_m = vector_at(model.site_pos, site),
                            .torque_per_thrust_m = model.actuator_gear[6 * actuator + 5]};
    airframe_.thrust_max_N = model.actuator_ctrlrange[2 * actuator + 1];
  }
  const int swept = mj_name2id(&model, mjOBJ_GEOM, "robot/swept_0");
  expects(swept >= 0, "a rotor of the model sweeps a volume");
  rotor_radius_m_ = model.geom_size[3 * swept];
}

void Quadrotor::place(World& world, const Pose& T_world_body, double camera_pitch_rad) const {
  world.set_initial_pose(kFreeJoint, T_world_body);
  command_camera_pitch(world, camera_pitch_rad);
  const double pitch_rad = world.data().ctrl[tilt_actuator_];
  world.data().act[tilt_activation_] = pitch_rad;
  world.set_initial_joint(kTiltJoint, pitch_rad);
  const Eigen::Vector4d hover_N =
      allocate(airframe_, {.collective_N = airframe_.weight_N()}).thrust_N;
  command_thrusts(world, hover_N);
  for (int i = 0; i < kRotors; ++i) {
    world.data().act[activations_[static_cast<std::size_t>(i)]] = hover_N[i];
  }
}

void Quadrotor::command_thrusts(World& world, const Eigen::Vector4d& thrust_N) const {
  expects(thrust_N.allFinite(), "a command is a finite number");
  for (int i = 0; i < kRotors; ++i) {
    world.data().ctrl[actuators_[static_cast<std::size_t>(i)]] =
        std::clamp(thrust_N[i], 0.0, airframe_.thrust_max_N);
  }
}

void Quadrotor::command_camera_pitch(World& world, double pitch_rad) const {
  expects(std::isfinite(pitch_rad), "a command is a finite number");
  world.data().ctrl[tilt_actuator_] = std::clamp(pitch_rad, 0.0, tilt_max_rad_);
}

FlightState Quadrotor::state(const World& world) const {
  const mjtNum* qpos = world.data().qpos + qpos_;
  const mjtNum* qvel = world.data().qvel + dof_;
  FlightState state;
  state.T_world_body.translation() = vector_at(qpos, 0);
  state.T_world_body.linear() = quaternion_at(qpos + 3).toRotationMatrix();
  state.v_world_m_s = vector_at(qvel, 0);
  state.w_body_rad_s = vector_at(qvel, 1);
  return state;
}

Eigen::Vector4d Quadrotor::thrusts_N(const World& world) const {
  Eigen::Vector4d thrust_N;
  for (int i = 0; i < kRotors; ++i) {
    thrust_N[i] = world.data().act[activations_[static_cast<std::size_t>(i)]];
  }
  return thrust_N;
}

double Quadrotor::camera_pitch_rad(const World& world) const {
  return world.data().qpos[tilt_qpos_];
}

Pose Quadrotor::T_body_camera(double pitch_rad) const {
  Eigen::Matrix3d R_mount_camera;  // z ahead, x right, y down
  R_mount_camera << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Pose T = Pose::Identity();
  const Eigen::Matrix3d R_body_mount =
      Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  T.linear() = R_body_mount * R_mount_camera;
  T.translation() = p_body_tilt_axis_m_ + R_body_mount * p_mount_camera_m_;
  return T;
}

Pose Quadrotor::body_for_camera(const Eigen::Vector3d& p_world_camera_m, double yaw_rad,
                                double pitch_rad) const {
  const Eigen::Vector3d p_body_camera = T_body_camera(pitch_rad).translation();
  const Pose level = make_pose(Eigen::Vector3d::Zero(), yaw_rad);
  return make_pose(p_world_camera_m - level * p_body_camera, yaw_rad);
}

std::vector<int> Quadrotor::touched_geoms(const World& world) const {
  return vantage::touched_geoms(world.model(), world.data(), base_body_);
}

int Quadrotor::contacts(const World& world) const {
  return static_cast<int>(contact_points(world.model(), world.data(), base_body_).size());
}

}  // namespace vantage
