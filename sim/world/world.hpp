/// The simulated world: MuJoCo's model and state behind RAII, stepped in control periods.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vantage/geometry/pose.hpp"
#include "vantage/sim/world/model_names.hpp"
#include "vantage/sim/world/scene.hpp"
#include "vantage/sim/world/world_options.hpp"

struct mjData_;
using mjData = mjData_;

namespace vantage {

class ModelPart;
class NearGeoms;

struct DataDeleter {
  void operator()(mjData* data) const;
};
using DataPtr = std::unique_ptr<mjData, DataDeleter>;

/// What pushes a body at its centre of mass, wind say, by the clock alone: world frame, of each
/// tick as it begins.
struct OutsideForce {
  int body_id = 0;
  std::function<Eigen::Vector3d(double time_s)> force_world_N;
};

/// Deterministic: the same model, options, initial state and commands give the same bits in any
/// thread and process of one machine. Not shareable between threads while one of them steps it.
class World {
 public:
  /// @throws InputError as load_model, ConfigError if the options are out of range.
  explicit World(const ModelSource& source, const WorldOptions& options = {});
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World();

  [[nodiscard]] const mjModel& model() const { return *model_; }
  /// The stepping state. Apart from forces and mocap poses leave it alone, and never run mj_forward
  /// on it (it changes the bits of what follows): look at `snapshot()`, plan on `copy_data()`.
  [[nodiscard]] mjData& data() { return *data_; }
  [[nodiscard]] const mjData& data() const { return *data_; }
  /// Poses of bodies, geoms, sites, cameras and lights at the present positions. (In `data()` they
  /// lag by one step, and most of what stands still has none.) For sensors and rendering; valid
  /// until the next step or call.
  [[nodiscard]] const mjData& snapshot() const;
  [[nodiscard]] DataPtr copy_data() const;

  [[nodiscard]] double time_s() const;
  [[nodiscard]] const WorldOptions& options() const { return options_; }
  [[nodiscard]] const ModelSource& source() const { return source_; }
  /// MuJoCo's warnings while compiling the model.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  /// One control period of physics, then `on_tick`. What actuators get is `controls()` after
  /// `on_command`; when the tick is over they are what was commanded again.
  /// @throws DivergedError naming the time, MuJoCo's warning and the body; the world is unusable
  /// then until set_state().
  void advance_tick();
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
  /// Wall time that the physics has taken so far.
  [[nodiscard]] double stepping_wall_s() const { return stepping_wall_s_; }
  std::function<void(World&)> on_tick;        ///< recording, video; may be empty
  std::function<void(const World&)> on_step;  ///< after each physics step; may be empty
  /// What becomes of the commands on their way to the actuators; may be empty.
  std::function<void(std::span<double> controls)> on_command;
  /// Before each tick and after set_state(): what changes in the world by the clock; may be empty.
  std::function<void(World&)> on_clock;
  void add_outside_force(OutsideForce force) { forces_.push_back(std::move(force)); }
  /// Puts a body that hangs on no joint elsewhere in its parent's frame. No part of the state.
  void put_fixed_body(int body_id, const Eigen::Vector3d& p_parent_body_m);
  /// How far that took the body of that name from where its file has it, in its parent's frame; 0
  /// for all others.
  [[nodiscard]] Eigen::Vector3d moved_m(const std::string& body) const;

  /// Everything the future depends on besides commands, applied forces and mocap poses: time, qpos,
  /// qvel, act, qacc_warmstart.
  [[nodiscard]] std::vector<double> state() const;
  /// Also puts commands and applied forces to zero and mocap poses where they started.
  /// @throws InputError if the length does not fit the model or a number is not finite.
  void set_state(std::span<const double> state);
  [[nodiscard]] std::span<const double> controls() const;
  void set_controls(std::span<const double> controls);

  /// Where a slide or hinge joint starts, m or rad. Only before the first tick.
  /// @throws InputError if the model has no such joint.
  void set_initial_joint(const std::string& name, double position);
  /// The same for a free joint.
  void set_initial_pose(const std::string& free_joint, const Pose& T_world_body);

 private:
  World(const ModelSource& source, const WorldOptions& options, LoadedModel&& loaded);
  void step();
  void step_for_a_tick();
  void push();
  void look_for_near_geoms();
  ModelSource source_;
  WorldOptions options_;
  std::vector<std::string> warnings_;
  ModelPtr model_;
  DataPtr data_;
  mutable DataPtr snapshot_;
  std::unique_ptr<NearGeoms> near_geoms_;
  std::unique_ptr<ModelPart> moving_;  ///< what a snapshot looks for anew
  std::vector<OutsideForce> forces_;
  std::map<int, Eigen::Vector3d> p_in_file_m_;  ///< of bodies that were put elsewhere
  bool positions_jumped_ = true;
  std::uint64_t ticks_ = 0;
  double stepping_wall_s_ = 0.0;
  bool diverged_ = false;
};

std::string mujoco_version();

Pose body_pose(const World& world, int body_id);  ///< T_world_body, now
Pose site_pose(const World& world, int site_id);  ///< T_world_site, now

}  // namespace vantage
