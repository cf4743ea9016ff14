#include "vantage/sim/world/world.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
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

int mujoco_kind(ModelObject kind) {
  switch (kind) {
    case ModelObject::body: return mjOBJ_BODY;
    case ModelObject::joint: return mjOBJ_JOINT;
    case ModelObject::geom: return mjOBJ_GEOM;
    case ModelObject::site: return mjOBJ_SITE;
    case ModelObject::camera: return mjOBJ_CAMERA;
    case ModelObject::actuator: return mjOBJ_ACTUATOR;
  }
  return mjOBJ_UNKNOWN;
}

Pose make_world_pose(const mjtNum* position, const mjtNum* row_major_rotation) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(position);
  pose.linear() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major_rotation);
  return pose;
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
      model_(std::move(loaded.model)),
      near_geoms_(*model_) {
  check_options(options_, "world");
  model_->opt.timestep = options_.timestep_s;
  stepping_.reset(mj_copyModel(nullptr, model_.get()));
  if (!stepping_) throw InputError("the model is too large for the memory of this machine");
  data_ = make_data(*model_);
  snapshot_ = make_data(*model_);
}

World::~World() = default;

const mjData& World::snapshot() const {
  mjData& view = *snapshot_;
  view.time = data_->time;
  std::copy_n(data_->qpos, model_->nq, view.qpos);
  std::copy_n(data_->mocap_pos, 3 * model_->nmocap, view.mocap_pos);
  std::copy_n(data_->mocap_quat, 4 * model_->nmocap, view.mocap_quat);
  mj_kinematics(model_.get(), &view);
  mj_comPos(model_.get(), &view);
  mj_camlight(model_.get(), &view);
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
  const double start_s = wall_s();
  for (int i = 0; i < options_.steps_per_tick(); ++i) {
    step();
    if (on_step) on_step(*this);
  }
  stepping_wall_s_ += wall_s() - start_s;
  ++ticks_;
  if (on_tick) on_tick(*this);
}

void World::look_for_near_geoms() {
  if (positions_jumped_) {
    near_geoms_.start(*stepping_, snapshot());
  } else {
    near_geoms_.follow(*stepping_, *data_);
  }
  positions_jumped_ = false;
}

void World::step() {
  look_for_near_geoms();
  const double before_s = data_->time;
  std::vector<std::string> messages;
  try {
    const WarningCollector collector(messages);
    mj_step(stepping_.get(), data_.get());
  } catch (const MujocoError& error) {
    diverged_ = true;
    throw DivergedError(
        fmt::format("the simulation failed at {:.4f} s: {}", before_s, error.what()));
  }
  // MuJoCo restarts a diverged episode at time 0 and goes on as if nothing had happened.
  for (int i = 0; i < mjNWARNING; ++i) {
    const mjWarningStat& warning = data_->warning[i];
    if (warning.number == 0) continue;
    diverged_ = true;
    throw DivergedError(fmt::format("the simulation diverged at {:.4f} s: {}{}{}", before_s,
                                    messages.empty() ? "MuJoCo warned" : messages.front(),
                                    culprit(*model_, i, warning.lastinfo), advice(i)));
  }
  if (!(data_->time > before_s)) {
    diverged_ = true;
    throw DivergedError(
        fmt::format("the simulation diverged at {:.4f} s: time stood still", before_s));
  }
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
    if (!std::isfinite(number)) throw InputError("a state holds a number that is not finite");
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

std::optional<int> find_model_id(const mjModel& model, ModelObject kind, const std::string& name) {
  const int id = mj_name2id(&model, mujoco_kind(kind), name.c_str());
  return id < 0 ? std::nullopt : std::optional(id);
}

int model_id(const mjModel& model, ModelObject kind, const std::string& name) {
  if (const auto id = find_model_id(model, kind, name)) return *id;
  throw InputError(
      fmt::format("the model has no {} called '{}'", mju_type2Str(mujoco_kind(kind)), name));
}

std::string model_name(const mjModel& model, ModelObject kind, int id) {
  const char* name = mj_id2name(&model, mujoco_kind(kind), id);
  return name == nullptr ? "" : name;
}

std::vector<std::string> model_names(const mjModel& model, ModelObject kind) {
  const auto count = [&] {
    switch (kind) {
      case ModelObject::body: return model.nbody;
      case ModelObject::joint: return model.njnt;
      case ModelObject::geom: return model.ngeom;
      case ModelObject::site: return model.nsite;
      case ModelObject::camera: return model.ncam;
      case ModelObject::actuator: return model.nu;
    }
    return 0;
  };
  std::vector<std::string> names;
  for (int id = 0; id < count(); ++id) {
    if (auto name = model_name(model, kind, id); !name.empty()) names.push_back(std::move(name));
  }
  return names;
}

Pose body_pose(const World& world, int body_id) {
  const mjData& now = world.snapshot();
  return make_world_pose(now.xpos + 3 * body_id, now.xmat + 9 * body_id);
}

Pose site_pose(const World& world, int site_id) {
  const mjData& now = world.snapshot();
  return make_world_pose(now.site_xpos + 3 * site_id, now.site_xmat + 9 * site_id);
}

}  // namespace vantage
