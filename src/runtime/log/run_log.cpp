#include "vantage/runtime/log/run_log.hpp"

#include <fmt/format.h>

#include <utility>

#include "vantage/runtime/log/video_recorder.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

constexpr double kPoseRowEvery_s = 0.1;
constexpr std::string_view kTumHeader = "# time_s x y z qx qy qz qw\n";

/// A row of a TUM trajectory: time x y z qx qy qz qw.
std::string tum_row(double time_s, const Pose& T_world_body) {
  const Eigen::Vector3d& p = T_world_body.translation();
  const Eigen::Quaterniond q(T_world_body.linear());
  return fmt::format("{:.3f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n", time_s, p.x(),
                     p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

}  // namespace

RunLog::RunLog(RecordedRobot robot, const RecordingOptions& options,
               const std::filesystem::path& directory, bool with_video, bool lean,
               Spectator spectator)
    : robot_(std::move(robot)),
      states_(lean ? std::filesystem::path() : directory, actuator_names(robot_.world),
              robot_.world.state()),
      trajectory_(directory / "trajectory.tum"),
      estimated_(directory / "trajectory_estimated.tum"),
      spectator_(std::move(spectator)) {
  trajectory_.write(kTumHeader);
  estimated_.write(kTumHeader);
  if (with_video) {
    video_recorder_ = std::make_unique<VideoRecorder>(robot_.world, options, directory);
  }
  robot_.world.on_tick = [this](World&) { tick(); };
  if (spectator_.on_tick) spectator_.on_tick(robot_.world);
}

RunLog::~RunLog() { robot_.world.on_tick = nullptr; }

void RunLog::set_panel(PanelPainter panel) {
  if (video_recorder_) video_recorder_->set_panel(std::move(panel));
}

void RunLog::tick() {
  const World& world = robot_.world;
  states_.add(world.controls(), world.state());
  if (last_body_ && world.time_s() >= next_pose_s_) pose_rows();
  const Pose body = robot_.T_world_body();
  if (last_body_) path_length_m_ += (body.translation() - last_body_->translation()).norm();
  last_body_ = body;
  if (video_recorder_) video_recorder_->tick(world);
  if (spectator_.on_tick) spectator_.on_tick(world);
}

void RunLog::tell(EpisodeEvent& event) {
  event.tick = states_.ticks();
  if (spectator_.on_event) spectator_.on_event(event);
}

/// The world ticks before the estimate does: the one at hand belongs to the tick before.
void RunLog::pose_rows() {
  const World& world = robot_.world;
  const double time_s = world.time_s() - world.options().control_period_s;
  trajectory_.write(tum_row(time_s, *last_body_));
  estimated_.write(tum_row(time_s, robot_.T_world_estimated()));
  next_pose_s_ = world.time_s() + kPoseRowEvery_s;
}

void RunLog::save_still(std::size_t number) {
  if (video_recorder_) video_recorder_->save_still(robot_.world, number);
}

void RunLog::commit() {
  states_.commit();
  trajectory_.commit();
  estimated_.commit();
}

void RunLog::finish_video() {
  if (video_recorder_) video_recorder_->finish();
}

}  // namespace vantage
