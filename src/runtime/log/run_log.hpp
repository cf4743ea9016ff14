/// What every run folder has, whatever the task: states and commands for replay, where the robot
/// was and believed to be, and a video of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "vantage/core/atomic_file.hpp"
#include "vantage/runtime/log/recording_options.hpp"
#include "vantage/runtime/log/spectator.hpp"
#include "vantage/runtime/log/state_log.hpp"
#include "vantage/runtime/log/video.hpp"

namespace vantage {

class RobotFaults;
class VideoRecorder;
class World;

struct RecordedRobot {
  World& world;
  std::function<Pose()> T_world_body;       ///< truth
  std::function<Pose()> T_world_estimated;  ///< the body, as the robot believes it
  const RobotFaults* faults = nullptr;      ///< null: it has none
};

class RunLog {
 public:
  /// Hooks itself to the world's ticks. Lean: states are hashed, not kept.
  /// @throws OutputError, RendererError
  RunLog(RecordedRobot robot, const RecordingOptions& options,
         const std::filesystem::path& directory, bool with_video, bool lean, Spectator spectator);
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// What stands beside the room in the video.
  void set_panel(PanelPainter panel);
  [[nodiscard]] bool watched() const { return static_cast<bool>(spectator_.on_event); }
  /// Tells the spectator, at the present tick.
  void tell(EpisodeEvent& event);
  /// Keeps the present image as a frame of that number.
  void save_still(std::size_t number);
  void commit();  ///< puts the growing files under their final names
  void finish_video();

  [[nodiscard]] std::uint64_t state_hash() const { return states_.hash(); }
  [[nodiscard]] double path_length_m() const { return path_length_m_; }
  [[nodiscard]] const RobotFaults* faults() const { return robot_.faults; }

 private:
  void tick();
  void pose_rows();

  RecordedRobot robot_;
  StateLog states_;
  GrowingFile trajectory_;
  GrowingFile estimated_;
  std::unique_ptr<VideoRecorder> video_recorder_;  ///< none: no video is wanted
  Spectator spectator_;
  double next_pose_s_ = 0.0;
  double path_length_m_ = 0.0;
  std::optional<Pose> last_body_;
};

}  // namespace vantage
