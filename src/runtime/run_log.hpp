/// What every run folder has, whatever the task: states and commands for replay, where the robot
/// was and believed to be, and a film of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "vantage/sim/world/world.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/runtime/film.hpp"
#include "vantage/runtime/spectator.hpp"
#include "vantage/runtime/state_log.hpp"

namespace vantage {

struct RecordedRobot {
  World& world;
  std::function<Pose()> T_world_body;       ///< truth
  std::function<Pose()> T_world_estimated;  ///< the body, as the robot believes it
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

  /// What stands beside the room in the film.
  void set_panel(PanelPainter panel);
  [[nodiscard]] bool watched() const { return static_cast<bool>(spectator_.on_event); }
  /// Tells the spectator, at the present tick.
  void tell(StoryEvent& event);
  /// Keeps the present picture as a frame of that number.
  void keep_still(std::size_t index);
  void commit();  ///< puts the growing files under their final names
  void finish_video();

  [[nodiscard]] std::uint64_t state_hash() const { return states_.hash(); }
  [[nodiscard]] double path_length_m() const { return path_length_m_; }

 private:
  void tick();
  void pose_rows();

  RecordedRobot robot_;
  StateLog states_;
  GrowingFile trajectory_;
  GrowingFile estimated_;
  std::optional<Film> film_;
  Spectator spectator_;
  double next_pose_s_ = 0.0;
  double path_length_m_ = 0.0;
  std::optional<Pose> last_body_;
};

}  // namespace vantage
