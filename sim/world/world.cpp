#include "vantage/sim/world/world.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/sim/stepping/model_part.hpp"
#include "vantage/sim/stepping/near_geoms.hpp"
#include "vantage/sim/world/mujoco_errors.hpp"

namespace vantage {
namespace {

DataPtr make_data(const mjModel& model) {
  DataPtr data(mj_makeData(&model));
  if (!data) throw InputError("the model is too large for the memory of this machine");
  return data;
}

/// " of body 'x'" for the degree of freedom or coordinate that a warning is about.
std::string culprit(const mjModel& model, int warning, int index) {
  int dof = -1;
  if (warning == mjWARN_BADQVEL || warning == mjWARN_BADQACC || warning == mjWARN_INERTIA) {
    dof = index;
  } else if (warning == mjWARN_BADQPOS) {
    for (int joint = 0; joint < model.njnt && model.jnt_qposadr[joint] <= index; ++joint) {
      dof = model.jnt_dofadr[joint];
    }
  }
  if (dof < 0 || dof >= model.nv) return "";
  const int joint = model.dof_jntid[dof];
  return fmt::format(" (joint '{}' of body '{}')", model_name(model, ModelObject::joint, joint),
                     model_name(model, ModelObject::body, model.dof_bodyid[dof]));
}

std::string advice(int warning) {
  if (warning == mjWARN_CONTACTFULL) return "; raise nconmax in the scene's <size>";
  if (warning == mjWARN_CNSTRFULL) return "; raise njmax in the scene's <size>";
  return "";
}

Pose make_world_pose(const mjtNum* position, const mjtNum* row_major_rotation) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(position);
  pose.linear() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major_rotation);
  return pose;
}

void find_poses(const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
}

template <class Visit>
void visit_state(const mjModel& model, mjData& data, Visit&& visit) {
  visit(&data.time, 1);
  visit(data.qpos, model.nq);
  visit(data.qvel, model.nv);
  visit(data.act, model.na);
  visit(data.qacc_warmstart, model.nv);
}

}  // namespace

void DataDeleter::operator()(mjData* data) const { mj_deleteData(data); }

int WorldOptions::steps_per_tick() const {
  return static_cast<int>(std::lround(control_period_s / timestep_s));
}

void WorldOptions::check() const {
  const int steps = steps_per_tick();
  if (steps < 1 || std::abs(steps * timestep_s - control_period_s) > 1e-9) {
    throw ConfigError(
        fmt::format("control_period_s is {} s, not a whole multiple of timestep_s, {} s",
                    control_period_s, timestep_s));
  }
}

World::World(const ModelSource& source, const WorldOptions& options)
    : World(source, options, load_model(source)) {}

World::World(const ModelSource& source, const WorldOptions& options, LoadedModel&& loaded)
    : source_(source),
      options_(options),
      warnings_(std::move(loaded.warnings)),
      model_(std::move(loaded.model)) {
  check_options(options_, "world");
  model_->opt.timestep = options_.timestep_s;
  near_geoms_ = std::make_unique<NearGeoms>(*model_);
  moving_ = std::make_unique<ModelPart>(*model_);
  data_ = make_data(*model_);
  snapshot_ = make_data(*model_);
  find_poses(*model_, *snapshot_);
}

World::~World() = default;

const mjData& World::snapshot() const {
  mjData& view = *snapshot_;
  view.time = data_->time;
  std::copy_n(data_->qpos, model_->nq, view.qpos);
  std::copy_n(data_->mocap_pos, 3 * model_->nmocap, view.mocap_pos);
  std::copy_n(data_->mocap_quat, 4 * model_->nmocap, view.mocap_quat);
  moving_->run(view, find_poses);
  return view;
}

DataPtr World::copy_data() const {
  DataPtr copy = make_data(*model_);
  mj_copyData(copy.get(), model_.get(), data_.get());
  return copy;
}

double World::time_s() const { return data_->time; }

void World::advance_tick() {
  expects(!diverged_, "a diverged world is not stepped before set_state()");
  if (on_clock) on_clock(*this);
  push();
  if (!on_command) {
    step_for_a_tick();
    return;
  }
  const std::vector<double> commanded(controls().begin(), controls().end());
  on_command({data_->ctrl, commanded.size()});
  step_for_a_tick();
  set_controls(commanded);
}

void World::step_for_a_tick() {
  const double start_s = wall_s();
  for (int i = 0; i < options_.steps_per_tick(); ++i) {
    step();
    if (on_step) on_step(*this);
  }
  stepping_wall_s_ += wall_s() - start_s;
  ++ticks_;
  if (on_tick) on_tick(*this);
}

void World::push() {
  for (const OutsideForce& force : forces_) {
    std::fill_n(data_->xfrc_applied + 6 * force.body_id, 3, 0.0);
  }
  for (const OutsideForce& force : forces_) {
    Eigen::Map<Eigen::Vector3d>(data_->xfrc_applied + 6 * force.body_id) +=
        force.force_world_N(data_->time);
  }
}

void World::put_fixed_body(int body_id, const Eigen::Vector3d& p_parent_body_m) {
  expects(model_->body_weldid[body_id] == 0, "a body that hangs on no joint");
  Eigen::Map<Eigen::Vector3d> place(model_->body_pos + 3 * body_id);
  if (place == p_parent_body_m) return;
  p_in_file_m_.try_emplace(body_id, place);
  place = p_parent_body_m;
  find_poses(*model_, *snapshot_);
  moving_->list_moving();
  positions_jumped_ = true;
}

Eigen::Vector3d World::moved_m(const std::string& body) const {
  const auto id = find_model_id(*model_, ModelObject::body, body);
  const auto found = id ? p_in_file_m_.find(*id) : p_in_file_m_.end();
  if (found == p_in_file_m_.end()) return Eigen::Vector3d::Zero();
  return Eigen::Map<const Eigen::Vector3d>(model_->body_pos + 3 * found->first) - found->second;
}

void World::look_for_near_geoms() {
  positions_jumped_ ? near_geoms_->start(snapshot()) : near_geoms_->follow(*data_);
  positions_jumped_ = false;
}

void World::step() {
  look_for_near_geoms();
  const double before_s = data_->time;
  // MuJoCo restarts a diverged episode at time 0 and goes on as if nothing had happened.
  const auto end = [&](const char* how, const std::string& why) {
    diverged_ = true;
    data_->time = before_s;
    throw DivergedError(fmt::format("the simulation {} at {:.4f} s: {}", how, before_s, why));
  };
  std::vector<std::string> messages;
  try {
    const WarningCollector collector(messages);
    near_geoms_->step(*data_);
  } catch (const MujocoError& error) {
    end("failed", error.what());
  }
  for (int i = 0; i < mjNWARNING; ++i) {
    const mjWarningStat& warning = data_->warning[i];
    if (warning.number == 0) continue;
    end("diverged", (messages.empty() ? "MuJoCo warned" : messages.front()) +
                        culprit(*model_, i, warning.lastinfo) + advice(i));
  }
  if (!(data_->time > before_s)) end("diverged", "time stood still");
}

std::vector<double> World::state() const {
  std::vector<double> state;
  visit_state(*model_, *data_, [&](const double* numbers, int count) {
    state.insert(state.end(), numbers, numbers + count);
  });
  return state;
}

void World::set_state(std::span<const double> state) {
  const auto size = 1 + static_cast<std::size_t>(model_->nq) +
                    2 * static_cast<std::size_t>(model_->nv) + static_cast<std::size_t>(model_->na);
  if (state.size() != size) {
    throw InputError(fmt::format("a state of {} has {} numbers, not {}", source_.scene.string(),
                                 size, state.size()));
  }
  for (const double number : state) {
    if (std::isfinite(number)) continue;
    throw InputError(
        fmt::format("a state of {} holds a number that is not finite", source_.scene.string()));
  }
  mj_resetData(model_.get(), data_.get());
  const double* next = state.data();
  visit_state(*model_, *data_, [&](double* numbers, int count) {
    std::copy_n(next, count, numbers);
    next += count;
  });
  ticks_ = static_cast<std::uint64_t>(std::llround(data_->time / options_.control_period_s));
  diverged_ = false;
  positions_jumped_ = true;
  if (on_clock) on_clock(*this);
}

std::span<const double> World::controls() const {
  return {data_->ctrl, static_cast<std::size_t>(model_->nu)};
}

void World::set_controls(std::span<const double> controls) {
  if (controls.size() != static_cast<std::size_t>(model_->nu)) {
    throw InputError(fmt::format("{} has {} actuators, not {}", source_.scene.string(), model_->nu,
                                 controls.size()));
  }
  std::copy(controls.begin(), controls.end(), data_->ctrl);
}

void World::set_initial_joint(const std::string& name, double position) {
  expects(ticks_ == 0, "initial positions are set before the first tick");
  const int joint = model_id(*model_, ModelObject::joint, name);
  const int type = model_->jnt_type[joint];
  if (type != mjJNT_SLIDE && type != mjJNT_HINGE) {
    throw InputError(fmt::format("joint '{}' is neither slide nor hinge", name));
  }
  if (!std::isfinite(position)) {
    throw InputError(fmt::format("the start position of joint '{}' is {}", name, position));
  }
  data_->qpos[model_->jnt_qposadr[joint]] = position;
}

void World::set_initial_pose(const std::string& free_joint, const Pose& T_world_body) {
  expects(ticks_ == 0, "initial positions are set before the first tick");
  const int joint = model_id(*model_, ModelObject::joint, free_joint);
  if (model_->jnt_type[joint] != mjJNT_FREE) {
    throw InputError(fmt::format("joint '{}' is not free", free_joint));
  }
  if (!T_world_body.matrix().allFinite()) {
    throw InputError(fmt::format("the start pose of joint '{}' is not finite", free_joint));
  }
  mjtNum* qpos = data_->qpos + model_->jnt_qposadr[joint];
  const Eigen::Quaterniond q(T_world_body.linear());
  const Eigen::Vector3d& p = T_world_body.translation();
  const std::array<double, 7> start = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
  std::copy(start.begin(), start.end(), qpos);
}

std::string mujoco_version() { return mj_versionString(); }

Pose body_pose(const World& world, int body_id) {
  const mjData& now = world.snapshot();
  return make_world_pose(now.xpos + 3 * body_id, now.xmat + 9 * body_id);
}

Pose site_pose(const World& world, int site_id) {
  const mjData& now = world.snapshot();
  return make_world_pose(now.site_xpos + 3 * site_id, now.site_xmat + 9 * site_id);
}

}  // namespace vantage
