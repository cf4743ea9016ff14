#include "vantage/sim/world/settle.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/sim/stepping/near_geoms.hpp"
#include "vantage/sim/world/mujoco_errors.hpp"

namespace vantage {
namespace {

struct FreePose {
  Eigen::Vector3d p_m;
  Eigen::Quaterniond q;
};

/// Free joints of the scene; a free joint's body is never below another.
std::vector<int> scene_free_joints(const mjModel& model) {
  std::vector<int> joints;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const std::string body = model_name(model, ModelObject::body, model.jnt_bodyid[joint]);
    if (model.jnt_type[joint] == mjJNT_FREE && !body.starts_with("robot/")) joints.push_back(joint);
  }
  return joints;
}

std::vector<FreePose> poses_of(const mjModel& model, const mjData& data,
                               const std::vector<int>& joints) {
  std::vector<FreePose> poses;
  for (const int joint : joints) {
    const mjtNum* q = data.qpos + model.jnt_qposadr[joint];
    poses.push_back({{q[0], q[1], q[2]}, Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized()});
  }
  return poses;
}

double motion_m(const FreePose& from, const FreePose& to, double arm_m) {
  return std::max((to.p_m - from.p_m).norm(), arm_m * from.q.angularDistance(to.q));
}

std::string body_text(const mjModel& model, int joint) {
  const int body = model.jnt_bodyid[joint];
  const std::string name = model_name(model, ModelObject::body, body);
  return name.empty() ? fmt::format("number {}", body) : fmt::format("'{}'", name);
}

void simulate(const mjModel& model, NearGeoms& near, mjData& data, double duration_s) {
  const double end_s = data.time + duration_s - 0.5 * model.opt.timestep;
  std::vector<std::string> messages;
  try {
    const WarningCollector collector(messages);
    while (data.time < end_s && messages.empty()) {
      near.step(data);
      near.follow(data);
    }
  } catch (const MujocoError& error) {
    messages.emplace_back(error.what());
  }
  if (messages.empty()) return;
  throw InputError("the simulation fails while free bodies come to rest: " + messages.front());
}

[[noreturn]] void refuse(const mjModel& model, int joint, double speed_m_s, double max_s) {
  throw InputError(fmt::format(
      "body {} does not come to rest within {} s, it still moves at {:.2g} m/s: the map's truth "
      "would be where it is no more; give it a place where it stays, or no joint",
      body_text(model, joint), max_s, speed_m_s));
}

/// Steps `data` until nothing moves.
void wait_for_rest(const mjModel& model, NearGeoms& near, mjData& data,
                   const std::vector<int>& joints, const SettleLimits& limits) {
  std::vector<FreePose> last = poses_of(model, data, joints);
  int quiet = 0;
  while (quiet < 2) {
    simulate(model, near, data, limits.window_s);
    const std::vector<FreePose> now = poses_of(model, data, joints);
    std::size_t fastest = 0;
    std::vector<double> moved_m;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      moved_m.push_back(motion_m(last[i], now[i], limits.arm_m));
      if (moved_m[i] > moved_m[fastest]) fastest = i;
    }
    quiet = moved_m[fastest] < limits.at_rest_m ? quiet + 1 : 0;
    if (quiet == 0 && data.time >= limits.max_s) {
      refuse(model, joints[fastest], moved_m[fastest] / limits.window_s, limits.max_s);
    }
    last = now;
  }
}

}  // namespace

std::vector<std::string> settle_free_bodies(World& world, const SettleLimits& limits) {
  expects(world.ticks() == 0, "bodies come to rest before the first tick");
  const mjModel& model = world.model();
  const std::vector<int> joints = scene_free_joints(model);
  if (joints.empty()) return {};
  const DataPtr trial = world.copy_data();
  const std::vector<FreePose> start = poses_of(model, *trial, joints);
  NearGeoms near(model);
  near.start(world.snapshot());
  wait_for_rest(model, near, *trial, joints, limits);
  const std::vector<FreePose> end = poses_of(model, *trial, joints);
  std::vector<std::string> moved;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (motion_m(start[i], end[i], limits.arm_m) <= limits.moved_m) continue;
    moved.push_back(body_text(model, joints[i]));
    const int at = model.jnt_qposadr[joints[i]];
    std::copy_n(trial->qpos + at, 7, world.data().qpos + at);
  }
  return moved;
}

}  // namespace vantage
