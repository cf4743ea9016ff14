/// The simulated robot of the exploration task.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/runtime/episode_setup.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/exploration/exploration_robot_interface.hpp"
#include "vantage/tasks/mapping/simulated/driven_by_base.hpp"

namespace vantage {

class SimulatedExplorationRobot : public DrivenByBase<ExplorationRobotInterface> {
 public:
  /// @throws ConfigError, InputError if the episode cannot begin
  SimulatedExplorationRobot(const EpisodeSetup& setup, const Exploration& task);

  ExplorationObservation observe(std::span<const std::size_t> images) override;
  void look(const Gaze& gaze) override;
  [[nodiscard]] bool head_rests() const override;
  std::optional<HeadView> take_image() override;
  [[nodiscard]] const SweepImages& sweep_images() const override { return images_; }
  [[nodiscard]] const Pose& T_base_sweep() const override { return T_base_sweep_; }
  [[nodiscard]] Pose estimated_sensor() const override;
  [[nodiscard]] Pose2 base_for_sensor(const Pose& T_world_sweep) const override;
  [[nodiscard]] FieldOfView view_field() const override { return field_; }

  /// What is worth a warning before it starts.
  [[nodiscard]] const std::vector<std::string>& start_notes() const { return start_notes_; }

 private:
  [[nodiscard]] std::vector<Gaze> gazes_in_turn(std::span<const std::size_t> images) const;
  void turn_head(const Gaze& gaze);
  HeadView draw_image();
  std::vector<HeadView> arriving(std::vector<HeadView> taken, std::span<const double> taken_s);

  RgbdOptions camera_;
  SweepImages images_;
  Pose T_base_sweep_;
  FieldOfView field_;
  std::unique_ptr<Renderer> renderer_;
  Rng camera_noise_;
  std::launch measuring_;  ///< beside the physics, if there are threads
  std::vector<std::string> start_notes_;
};

/// @throws ConfigError if the lift cannot bring the camera to `frontiers.height_m`.
void check_camera_reach(const World& world, const MobileBase& robot, const Exploration& task);

}  // namespace vantage
