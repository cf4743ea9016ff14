#include "vantage/sim/robots/quadrotor.hpp"

#include <Eigen/LU>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

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

/// Mass, centre and inertia of the tree of bodies under `root`, whose joints are at their
/// reference.
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
    Eigen::Matrix3d R = quaternion_at(model.body_iquat + 4 * body).toRotationMatrix();
    for (int b = body; b != root; b = model.body_parentid[b]) {
      const Eigen::Matrix3d R_parent_b = quaternion_at(model.body_quat + 4 * b).toRotationMatrix();
      p_m = R_parent_b * p_m + vector_at(model.body_pos, b);
      R = R_parent_b * R;
    }
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

double downward_gravity(const mjModel& model, const std::string& scene) {
  const Eigen::Vector3d gravity = vector_at(model.opt.gravity, 0);
  if (gravity.head<2>().norm() > 0.0 || !(gravity.z() < 0.0)) {
    throw InputError(fmt::format(
        "{}: option gravity: a quadrotor flies where it points down, not along {} {} {}", scene,
        gravity.x(), gravity.y(), gravity.z()));
  }
  return -gravity.z();
}

/// Where the state of an actuator is. Those without one come first.
int activation_of(const RobotNames& names, const mjModel& model, std::string_view key,
                  int actuator) {
  const int activation = actuator - (model.nu - model.na);
  if (model.actuator_dyntype[actuator] == mjDYN_NONE || activation < 0) {
    names.fail(key, fmt::format("actuator '{}' must have a lag: dyntype=\"filter\"",
                                model_name(model, ModelObject::actuator, actuator)));
  }
  return activation;
}

/// Force along z of one newton for one newton commanded, and a torque about it.
bool is_thrust(const mjtNum* gear) {
  return gear[0] == 0.0 && gear[1] == 0.0 && gear[2] == 1.0 && gear[3] == 0.0 && gear[4] == 0.0;
}

/// The greatest thrust, which the rotors have in common.
double common_thrust_max_N(const RobotNames& names, const mjModel& model,
                           std::span<const int> rotors) {
  const double max_N = model.actuator_ctrlrange[2 * rotors.front() + 1];
  for (const int rotor : rotors) {
    const mjtNum* range = model.actuator_ctrlrange + 2 * rotor;
    if (range[0] == 0.0 && range[1] == max_N) continue;
    names.fail(
        "rotors",
        fmt::format("actuator '{}' has the ctrlrange {} {}; all rotors need one from 0, and "
                    "the same, 0 {}",
                    model_name(model, ModelObject::actuator, rotor), range[0], range[1], max_N));
  }
  return max_N;
}

/// Four thrusts must give any small torque beside the weight.
void require_flight(const RobotNames& names, const Airframe& airframe) {
  const Eigen::FullPivLU<Eigen::Matrix4d> mixing(mixing_matrix(airframe));
  if (!mixing.isInvertible() || !(mixing.inverse().col(0).array() > 0.0).all()) {
    names.fail("rotors",
               "the four thrusts do not give force and torque about each axis alone: the centre of "
               "mass must lie amid the rotors, two of which turn each way");
  }
  if (kRotors * airframe.thrust_max_N <= airframe.weight_N()) {
    names.fail("rotors", fmt::format("four times {:.3g} N do not carry {:.3g} kg",
                                     airframe.thrust_max_N, airframe.mass_kg));
  }
}

}  // namespace

Quadrotor::Quadrotor(const mjModel& model, const QuadrotorDescription& description,
                     const std::string& where, const std::string& scene)
    : free_joint_(description.free_joint),
      tilt_joint_(description.camera_tilt),
      base_body_(RobotNames(model, where).find(ModelObject::body, "base", description.base)),
      rotor_radius_m_(description.rotor_radius_m) {
  const RobotNames names(model, where);
  const int joint = names.free_joint("free_joint", free_joint_, base_body_);
  qpos_ = model.jnt_qposadr[joint];
  dof_ = model.jnt_dofadr[joint];
  find_camera(names, model, description);
  airframe_.gravity_m_s2 = downward_gravity(model, scene);
  add_bodies(model, base_body_, airframe_);
  find_rotors(names, model, description);
}

void Quadrotor::find_camera(const RobotNames& names, const mjModel& model,
                            const QuadrotorDescription& description) {
  constexpr std::string_view key = "camera";
  camera_ = names.find(ModelObject::camera, key, description.camera);
  const int mount = model.cam_bodyid[camera_];
  if (model.body_parentid[mount] != base_body_) {
    names.fail(key, "it must be on a body of its own, a child of the base");
  }
  const Eigen::Isometry3d T_base_mount = names.pose_in(base_body_, mount, key);
  const Eigen::Isometry3d T_mount_camera = camera_in_body(model, camera_);
  names.require_level_camera(key, camera_, base_body_);
  tilt_ = names.driven("camera_tilt", tilt_joint_, JointType::hinge);
  names.require_axis("camera_tilt", tilt_.joint, base_body_, Eigen::Vector3d::UnitY());
  if (model.jnt_bodyid[tilt_.joint] != mount) names.fail("camera_tilt", "it must tilt the camera");
  tilt_activation_ = activation_of(names, model, "camera_tilt", tilt_.actuator);
  names.require_on_axis("camera_tilt", tilt_.joint, base_body_, T_base_mount.translation());
  p_body_tilt_axis_m_ = T_base_mount.translation();
  p_mount_camera_m_ = T_base_mount.linear() * T_mount_camera.translation();
}

void Quadrotor::find_rotors(const RobotNames& names, const mjModel& model,
                            const QuadrotorDescription& description) {
  constexpr std::string_view key = "rotors";
  expects(description.rotors.size() == kRotors, "a checked description");
  for (std::size_t i = 0; i < kRotors; ++i) {
    const int actuator = names.find(ModelObject::actuator, key, description.rotors[i]);
    const mjtNum* gear = model.actuator_gear + 6 * actuator;
    if (model.actuator_trntype[actuator] != mjTRN_SITE || !is_thrust(gear) ||
        model.actuator_ctrllimited[actuator] == 0) {
      names.fail(key, fmt::format("actuator '{}' must act at a site, with gear=\"0 0 1 0 0 k\" and "
                                  "a ctrlrange from 0",
                                  description.rotors[i]));
    }
    actuators_[i] = actuator;
    activations_[i] = activation_of(names, model, key, actuator);
    const int site = model.actuator_trnid[2 * actuator];
    const Eigen::Isometry3d T_base_rotor =
        names.pose_in(base_body_, model.site_bodyid[site], key) * site_in_body(model, site);
    if (T_base_rotor.linear().col(2).z() < 0.999) {
      names.fail(key, fmt::format("the site of actuator '{}' must have its z axis up",
                                  description.rotors[i]));
    }
    airframe_.rotors[i] = {.p_body_m = T_base_rotor.translation(), .torque_per_thrust_m = gear[5]};
  }
  airframe_.thrust_max_N = common_thrust_max_N(names, model, actuators_);
  require_flight(names, airframe_);
}

void Quadrotor::place(World& world, const Pose& T_world_body, double camera_pitch_rad) const {
  if (camera_pitch_rad > tilt_.max) {
    throw ConfigError(
        fmt::format("the camera shall look {:.4g} rad down, beyond the {:.4g} rad of "
                    "joint '{}'",
                    camera_pitch_rad, tilt_.max, tilt_joint_));
  }
  world.set_initial_pose(free_joint_, T_world_body);
  command_camera_pitch(world, camera_pitch_rad);
  const double pitch_rad = world.data().ctrl[tilt_.actuator];
  world.data().act[tilt_activation_] = pitch_rad;
  world.set_initial_joint(tilt_joint_, pitch_rad);
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
  world.data().ctrl[tilt_.actuator] = std::clamp(pitch_rad, 0.0, tilt_.max);
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
  return world.data().qpos[tilt_.qpos];
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
