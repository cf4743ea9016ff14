#include "vantage/sim/robots/pr2.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kSpeedCap_m_s = 1.0;

Eigen::Vector3d site_in_model(const mjModel& model, int site) {
  return Eigen::Map<const Eigen::Vector3d>(model.site_pos + 3 * site);
}

}  // namespace

Pr2::Axis Pr2::find_axis(const mjModel& model, const std::string& name) {
  const int joint = model_id(model, ModelObject::joint, name);
  const int actuator = model_id(model, ModelObject::actuator, name);
  return {.qpos = model.jnt_qposadr[joint],
          .dof = model.jnt_dofadr[joint],
          .actuator = actuator,
          .min = model.actuator_ctrlrange[2 * actuator],
          .max = model.actuator_ctrlrange[2 * actuator + 1]};
}

Pr2::Pr2(const mjModel& model)
    : x_(find_axis(model, "robot/base_x")),
      y_(find_axis(model, "robot/base_y")),
      yaw_(find_axis(model, "robot/base_yaw")),
      torso_(find_axis(model, "robot/torso_lift")),
      head_pan_(find_axis(model, "robot/head_pan")),
      head_tilt_(find_axis(model, "robot/head_tilt")),
      laser_tilt_(find_axis(model, "robot/laser_tilt")),
      base_body_(model_id(model, ModelObject::body, "robot/base")),
      laser_body_(model_id(model, ModelObject::body, "robot/laser_tilt")),
      camera_(model_id(model, ModelObject::camera, "robot/camera")),
      laser_site_(model_id(model, ModelObject::site, "robot/laser")),
      base_scan_site_(model_id(model, ModelObject::site, "robot/base_scan")) {
  Eigen::Vector3d p_base_laser = site_in_model(model, laser_site_);
  for (int body = laser_body_; body != base_body_; body = model.body_parentid[body]) {
    expects(body > 0, "the laser is part of the base");
    p_base_laser += Eigen::Map<const Eigen::Vector3d>(model.body_pos + 3 * body);
  }
  T_base_laser_low_.translation() = p_base_laser;
  const Eigen::Vector3d p_base_scan = site_in_model(model, base_scan_site_);
  T_base_base_scan_ = {p_base_scan.x(), p_base_scan.y(), 0.0};
  base_scan_height_m_ = p_base_scan.z();
}

void Pr2::place(World& world, const Pose2& T_world_base, double torso_m) const {
  world.set_initial_joint("robot/base_x", T_world_base.x_m);
  world.set_initial_joint("robot/base_y", T_world_base.y_m);
  world.set_initial_joint("robot/base_yaw", T_world_base.yaw_rad);
  world.set_initial_joint("robot/torso_lift", std::clamp(torso_m, torso_.min, torso_.max));
  command_torso(world, torso_m);
}

double Pr2::position(const World& world, const Axis& axis) { return world.data().qpos[axis.qpos]; }

void Pr2::command(World& world, const Axis& axis, double target) {
  expects(std::isfinite(target), "a command is a finite number");
  world.data().ctrl[axis.actuator] = std::clamp(target, axis.min, axis.max);
}

void Pr2::command_twist(World& world, const Twist2& twist) const {
  const double speed = std::hypot(twist.vx_m_s, twist.vy_m_s);
  const double scale = speed > kSpeedCap_m_s ? kSpeedCap_m_s / speed : 1.0;
  const double yaw_rad = position(world, yaw_);
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  command(world, x_, scale * (c * twist.vx_m_s - s * twist.vy_m_s));
  command(world, y_, scale * (s * twist.vx_m_s + c * twist.vy_m_s));
  command(world, yaw_, twist.wz_rad_s);
}

void Pr2::command_torso(World& world, double height_m) const { command(world, torso_, height_m); }

void Pr2::command_head(World& world, double pan_rad, double tilt_rad) const {
  command(world, head_pan_, pan_rad);
  command(world, head_tilt_, tilt_rad);
}

void Pr2::command_laser_tilt(World& world, double tilt_rad) const {
  command(world, laser_tilt_, tilt_rad);
}

double Pr2::torso_m(const World& world) const { return position(world, torso_); }
double Pr2::head_pan_rad(const World& world) const { return position(world, head_pan_); }
double Pr2::head_tilt_rad(const World& world) const { return position(world, head_tilt_); }
double Pr2::laser_tilt_rad(const World& world) const { return position(world, laser_tilt_); }
AngleRange Pr2::laser_tilt_range() const { return {laser_tilt_.min, laser_tilt_.max}; }

Pose2 Pr2::T_world_base(const World& world) const {
  return {position(world, x_), position(world, y_), wrap_angle(position(world, yaw_))};
}

Twist2 Pr2::twist(const World& world) const {
  const mjtNum* qvel = world.data().qvel;
  const double yaw_rad = position(world, yaw_);
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {c * qvel[x_.dof] + s * qvel[y_.dof], -s * qvel[x_.dof] + c * qvel[y_.dof],
          qvel[yaw_.dof]};
}

Pose Pr2::T_world_laser(const World& world) const { return site_pose(world, laser_site_); }
Pose Pr2::T_world_base_scan(const World& world) const { return site_pose(world, base_scan_site_); }

Pose Pr2::T_base_laser_mount(const World& world) const {
  return Eigen::Translation3d(0.0, 0.0, torso_m(world)) * T_base_laser_low_;
}

Pose2 Pr2::base_for_laser(const Pose& T_world_sensor) const {
  return compose(project_to_se2(T_world_sensor), inverse(project_to_se2(T_base_laser_low_)));
}

std::vector<int> Pr2::touched_geoms(const World& world) const {
  return vantage::touched_geoms(world.model(), world.data(), base_body_);
}

std::vector<int> Pr2::touched_by_turning(const World& world) const {
  constexpr int kHeadings = 24;
  const DataPtr copy = world.copy_data();
  std::set<int> geoms;
  for (int i = 0; i < kHeadings; ++i) {
    copy->qpos[yaw_.qpos] += 2.0 * std::numbers::pi / kHeadings;
    mj_fwdPosition(&world.model(), copy.get());
    for (const int geom : contact_points(world.model(), *copy, base_body_)) geoms.insert(geom);
  }
  return {geoms.begin(), geoms.end()};
}

int Pr2::contacts(const World& world) const {
  return static_cast<int>(contact_points(world.model(), world.data(), base_body_).size());
}

}  // namespace vantage
