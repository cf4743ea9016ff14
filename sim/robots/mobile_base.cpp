#include "vantage/sim/robots/mobile_base.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "vantage/core/error.hpp"
#include "vantage/sim/robots/robot_outline.hpp"

namespace vantage {
namespace {

using enum JointType;

double position(const World& world, const DrivenJoint& joint) {
  return world.data().qpos[joint.qpos];
}

void command(World& world, const DrivenJoint& joint, double target) {
  expects(std::isfinite(target), "a command is a finite number");
  world.data().ctrl[joint.actuator] = std::clamp(target, joint.min, joint.max);
}

Twist2 in_base(double vx_world_m_s, double vy_world_m_s, double wz_rad_s, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {c * vx_world_m_s + s * vy_world_m_s, -s * vx_world_m_s + c * vy_world_m_s, wz_rad_s};
}

DrivenJoint find_driven(const RobotNames& names, std::string_view key, const std::string& joint,
                        JointType type, int base, const Eigen::Vector3d& axis) {
  const DrivenJoint found = names.driven(key, joint, type);
  names.require_axis(key, found.joint, base, axis);
  return found;
}

}  // namespace

std::variant<MobileBase::Slides, MobileBase::Wheels> MobileBase::find_drive(const RobotNames& names,
                                                                            const mjModel& model,
                                                                            const BaseDrive& drive,
                                                                            int base) {
  if (const auto* slides = std::get_if<OmnidirectionalDrive>(&drive)) {
    const auto found = [&](std::string_view key, const std::string& joint, JointType type,
                           const Eigen::Vector3d& axis) {
      return find_driven(names, key, joint, type, base, axis);
    };
    const Slides all{.x = found("drive.x", slides->x, slide, Eigen::Vector3d::UnitX()),
                     .y = found("drive.y", slides->y, slide, Eigen::Vector3d::UnitY()),
                     .yaw = found("drive.yaw", slides->yaw, hinge, Eigen::Vector3d::UnitZ()),
                     .speed_max_m_s = slides->speed_max_m_s};
    names.require_planar("drive", base, {all.x.joint, all.y.joint, all.yaw.joint});
    return all;
  }
  const auto& wheels = std::get<DifferentialDrive>(drive);
  const int joint = names.free_joint("drive.free_joint", wheels.free_joint, base);
  const auto wheel = [&](std::string_view key, const std::string& name) {
    return find_driven(names, key, name, hinge, base, Eigen::Vector3d::UnitY());
  };
  return Wheels{.free_joint = wheels.free_joint,
                .qpos = model.jnt_qposadr[joint],
                .dof = model.jnt_dofadr[joint],
                .left = wheel("drive.left_wheel", wheels.left_wheel),
                .right = wheel("drive.right_wheel", wheels.right_wheel),
                .options = wheels};
}

void MobileBase::find_scanner(const RobotNames& names, const mjModel& model,
                              const std::string& site) {
  constexpr std::string_view key = "planar_scanner";
  base_scan_site_ = names.find(ModelObject::site, key, site);
  base_scan_body_ = model.site_bodyid[base_scan_site_];
  const Pose T_base_scan =
      names.pose_in(base_body_, base_scan_body_, key) * site_in_body(model, base_scan_site_);
  names.require_fixed(key, base_scan_body_, base_body_);
  names.require_direction(key, "its z axis", T_base_scan.linear().col(2), Eigen::Vector3d::UnitZ());
  T_base_base_scan_ = project_to_se2(T_base_scan);
  base_scan_height_m_ = T_base_scan.translation().z();
}

int MobileBase::find_lift(const RobotNames& names, const mjModel& model, const std::string& joint) {
  if (joint.empty()) return base_body_;
  lift_joint_ = joint;
  lift_ = find_driven(names, "lift", joint, slide, base_body_, Eigen::Vector3d::UnitZ());
  return model.jnt_bodyid[lift_->joint];
}

MobileBase::Head MobileBase::find_head(const RobotNames& names, const mjModel& model,
                                       const HeadNames& head, int carrier) const {
  const DrivenJoint pan =
      find_driven(names, "head.pan", head.pan, hinge, base_body_, Eigen::Vector3d::UnitZ());
  const DrivenJoint tilt =
      find_driven(names, "head.tilt", head.tilt, hinge, base_body_, Eigen::Vector3d::UnitY());
  const int body = model.jnt_bodyid[pan.joint];
  const int camera = names.find(ModelObject::camera, "head.camera", head.camera);
  names.require_part("head.pan", body, carrier);
  names.require_part("head.tilt", model.jnt_bodyid[tilt.joint], body);
  names.require_part("head.camera", model.cam_bodyid[camera], model.jnt_bodyid[tilt.joint]);
  names.require_level_camera("head.camera", camera, base_body_);
  return {.pan = pan, .tilt = tilt, .body = body, .camera = camera};
}

MobileBase::Laser MobileBase::find_laser(const RobotNames& names, const mjModel& model,
                                         const TiltingLaserNames& laser, int carrier) const {
  constexpr std::string_view key = "tilting_laser.site";
  const DrivenJoint tilt = find_driven(names, "tilting_laser.tilt", laser.tilt, hinge, base_body_,
                                       Eigen::Vector3d::UnitY());
  const int site = names.find(ModelObject::site, key, laser.site);
  const int body = model.site_bodyid[site];
  names.require_part("tilting_laser.tilt", model.jnt_bodyid[tilt.joint], carrier);
  names.require_part(key, body, model.jnt_bodyid[tilt.joint]);
  const Pose T_base_low = names.pose_in(base_body_, body, key) * site_in_body(model, site);
  names.require_direction(key, "its y axis", T_base_low.linear().col(1), Eigen::Vector3d::UnitY());
  names.require_direction(key, "its z axis", T_base_low.linear().col(2), Eigen::Vector3d::UnitZ());
  names.require_on_axis(key, tilt.joint, base_body_, T_base_low.translation());
  return {.tilt = tilt, .body = body, .site = site, .T_base_low = T_base_low};
}

MobileBase::MobileBase(const mjModel& model, const MobileBaseDescription& description,
                       const std::string& where)
    : where_(where),
      footprint_(description.footprint),
      idle_power_w_(description.idle_power_w),
      actuators_(robot_actuators(model)),
      base_body_(RobotNames(model, where).find_root("base", description.base)),
      outline_(robot_outline(model, base_body_, description.footprint.outline_m, where)),
      drive_(find_drive(RobotNames(model, where), model, description.drive, base_body_)) {
  const RobotNames names(model, where);
  if (const auto* wheels = std::get_if<Wheels>(&drive_)) {
    for (const std::string& geom : wheels->options.on_floor) {
      on_floor_.push_back(names.find(ModelObject::geom, "drive.on_floor", geom));
    }
  }
  find_scanner(names, model, description.planar_scanner);
  const int carrier = find_lift(names, model, description.lift);
  if (description.head) head_ = find_head(names, model, *description.head, carrier);
  if (description.tilting_laser) {
    laser_ = find_laser(names, model, *description.tilting_laser, carrier);
  }
}

const MobileBase::Head& MobileBase::head() const {
  if (!head_) throw InputError(where_ + ": head: missing; this task looks with a pan-tilt camera");
  return *head_;
}

const MobileBase::Laser& MobileBase::laser() const {
  if (!laser_) {
    throw InputError(where_ + ": tilting_laser: missing; this task scans with a tilting laser");
  }
  return *laser_;
}

double MobileBase::power_w(const World& world) const {
  double power_w = idle_power_w_;
  for (const int i : actuators_) {
    power_w += std::max(world.data().actuator_force[i] * world.data().actuator_velocity[i], 0.0);
  }
  return power_w;
}

void MobileBase::place(World& world, const Pose2& T_world_base, double lift_m) const {
  if (const auto* slides = std::get_if<Slides>(&drive_)) {
    const auto set = [&](const DrivenJoint& joint, double at) {
      world.set_initial_joint(model_name(world.model(), ModelObject::joint, joint.joint), at);
    };
    set(slides->x, T_world_base.x_m);
    set(slides->y, T_world_base.y_m);
    set(slides->yaw, T_world_base.yaw_rad);
  } else {
    world.set_initial_pose(std::get<Wheels>(drive_).free_joint, to_se3(T_world_base));
  }
  if (!lift_) return;
  world.set_initial_joint(lift_joint_, std::clamp(lift_m, lift_->min, lift_->max));
  command_lift(world, lift_m);
}

void MobileBase::command_twist(World& world, const Twist2& twist) const {
  if (const auto* slides = std::get_if<Slides>(&drive_)) {
    const double speed = std::hypot(twist.vx_m_s, twist.vy_m_s);
    const double scale = speed > slides->speed_max_m_s ? slides->speed_max_m_s / speed : 1.0;
    const double yaw_rad = position(world, slides->yaw);
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    command(world, slides->x, scale * (c * twist.vx_m_s - s * twist.vy_m_s));
    command(world, slides->y, scale * (s * twist.vx_m_s + c * twist.vy_m_s));
    command(world, slides->yaw, twist.wz_rad_s);
    return;
  }
  const auto& wheels = std::get<Wheels>(drive_);
  const DifferentialDrive& options = wheels.options;
  const double v_m_s = std::clamp(twist.vx_m_s, -options.speed_max_m_s, options.speed_max_m_s);
  const double w_rad_s =
      std::clamp(twist.wz_rad_s, -options.turn_rate_max_rad_s, options.turn_rate_max_rad_s);
  const double turning_m_s = 0.5 * options.track_m * w_rad_s;
  command(world, wheels.left, (v_m_s - turning_m_s) / options.wheel_radius_m);
  command(world, wheels.right, (v_m_s + turning_m_s) / options.wheel_radius_m);
}

void MobileBase::command_lift(World& world, double height_m) const {
  if (lift_) command(world, *lift_, height_m);
}

void MobileBase::command_head(World& world, double pan_rad, double tilt_rad) const {
  command(world, head().pan, pan_rad);
  command(world, head().tilt, tilt_rad);
}

void MobileBase::command_laser_tilt(World& world, double tilt_rad) const {
  command(world, laser().tilt, tilt_rad);
}

double MobileBase::lift_m(const World& world) const {
  return lift_ ? position(world, *lift_) : 0.0;
}
double MobileBase::head_pan_rad(const World& world) const { return position(world, head().pan); }
double MobileBase::head_tilt_rad(const World& world) const { return position(world, head().tilt); }
double MobileBase::head_rate_rad_s(const World& world) const {
  const mjtNum* rates = world.data().qvel;
  return std::max(std::abs(rates[head().pan.dof]), std::abs(rates[head().tilt.dof]));
}
double MobileBase::laser_tilt_rad(const World& world) const {
  return position(world, laser().tilt);
}
AngleRange MobileBase::laser_tilt_range() const { return {laser().tilt.min, laser().tilt.max}; }

Pose2 MobileBase::pose_of(const mjData& data) const {
  if (const auto* slides = std::get_if<Slides>(&drive_)) {
    return {data.qpos[slides->x.qpos], data.qpos[slides->y.qpos],
            wrap_angle(data.qpos[slides->yaw.qpos])};
  }
  const mjtNum* q = data.qpos + std::get<Wheels>(drive_).qpos;
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized();
  const Eigen::Vector3d forward = rotation * Eigen::Vector3d::UnitX();
  return {q[0], q[1], std::atan2(forward.y(), forward.x())};
}

Pose2 MobileBase::T_world_base(const World& world) const { return pose_of(world.data()); }

Twist2 MobileBase::twist(const World& world) const {
  const mjtNum* qvel = world.data().qvel;
  if (const auto* slides = std::get_if<Slides>(&drive_)) {
    return in_base(qvel[slides->x.dof], qvel[slides->y.dof], qvel[slides->yaw.dof],
                   position(world, slides->yaw));
  }
  const mjtNum* v = qvel + std::get<Wheels>(drive_).dof;  // linear in world, angular in body
  return in_base(v[0], v[1], v[5], T_world_base(world).yaw_rad);
}

Pose MobileBase::T_world_laser(const World& world) const { return site_pose(world, laser().site); }
Pose MobileBase::T_world_base_scan(const World& world) const {
  return site_pose(world, base_scan_site_);
}

Pose MobileBase::T_base_laser_mount(const World& world) const {
  return Eigen::Translation3d(0.0, 0.0, lift_m(world)) * laser().T_base_low;
}

Pose2 MobileBase::base_for_laser(const Pose& T_world_sensor) const {
  return compose(project_to_se2(T_world_sensor), inverse(project_to_se2(laser().T_base_low)));
}

std::vector<int> MobileBase::touched_geoms(const World& world) const {
  return vantage::touched_geoms(world.model(), world.data(), base_body_, on_floor_);
}

void MobileBase::turn(mjData& data, double angle_rad) const {
  if (const auto* slides = std::get_if<Slides>(&drive_)) {
    data.qpos[slides->yaw.qpos] += angle_rad;
    return;
  }
  mjtNum* q = data.qpos + std::get<Wheels>(drive_).qpos + 3;
  const Eigen::Quaterniond turned = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()) *
                                    Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  Eigen::Map<Eigen::Vector4d>(q, 4) << turned.w(), turned.x(), turned.y(), turned.z();
}

std::vector<int> MobileBase::touched_by_turning(const World& world) const {
  constexpr int kHeadings = 24;
  const DataPtr copy = world.copy_data();
  std::set<int> geoms;
  for (int i = 0; i < kHeadings; ++i) {
    turn(*copy, 2.0 * std::numbers::pi / kHeadings);
    mj_fwdPosition(&world.model(), copy.get());
    const auto touched = contact_points(world.model(), *copy, base_body_, on_floor_);
    geoms.insert(touched.begin(), touched.end());
  }
  return {geoms.begin(), geoms.end()};
}

int MobileBase::contacts(const World& world) const {
  return static_cast<int>(
      contact_points(world.model(), world.data(), base_body_, on_floor_).size());
}

}  // namespace vantage
