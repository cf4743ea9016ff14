/// Writes the run folder of an episode of recognition while it runs.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "vantage/core/log.hpp"
#include "vantage/runtime/run_log.hpp"
#include "vantage/tasks/recognition/observation_record.hpp"
#include "vantage/tasks/recognition/orbit_robot_interface.hpp"
#include "vantage/tasks/recognition/recognition_panel.hpp"

namespace vantage {

class RecognitionRecorder {
 public:
  /// Hooks itself to the world's ticks. Lean: neither states nor images are kept.
  /// @throws OutputError, RendererError
  RecognitionRecorder(const ResolvedEpisode& resolved, OrbitRobotInterface& robot,
                      std::filesystem::path directory, bool with_video, bool lean,
                      Spectator spectator = {});

  void set_panel(std::function<RecognitionPanelInput()> panel);
  /// Adds a row to steps.csv, and the image with the object's outline to views/.
  void observation_record(const ObservationRecord& observation_record, std::size_t index,
                          const CameraImages& image, const std::optional<ObjectView>& cut);
  void commit();  ///< puts the growing files under their final names
  void finish_video() { log_.finish_video(); }

  [[nodiscard]] std::uint64_t state_hash() const { return log_.state_hash(); }
  [[nodiscard]] double path_length_m() const { return log_.path_length_m(); }

 private:
  std::filesystem::path directory_;
  int max_views_;
  bool lean_;
  RunLog log_;
  GrowingFile steps_;
  Progress progress_;
};

}  // namespace vantage
