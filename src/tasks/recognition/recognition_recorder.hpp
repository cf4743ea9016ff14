/// Writes the run folder of an episode of recognition while it runs.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "vantage/core/log.hpp"
#include "vantage/tasks/recognition/flight_rig.hpp"
#include "vantage/tasks/recognition/recognition_panel.hpp"
#include "vantage/runtime/run_log.hpp"
#include "vantage/tasks/recognition/sighting.hpp"

namespace vantage {

class RecognitionRecorder {
 public:
  /// Hooks itself to the world's ticks. Lean: neither states nor pictures are kept.
  /// @throws OutputError, RendererError
  RecognitionRecorder(const ResolvedEpisode& resolved, FlightRig& rig,
                      std::filesystem::path directory, bool with_video, bool lean,
                      Spectator spectator = {});

  void set_panel(std::function<RecognitionPanelInput()> panel);
  /// Adds a row to steps.csv, and the picture with the object's outline to views/.
  void sighting(const Sighting& sighting, std::size_t index, const CameraImages& picture,
                const std::optional<ObjectView>& cut);
  void commit();  ///< puts the growing files under their final names
  void finish_video() { log_.finish_video(); }

  [[nodiscard]] std::uint64_t state_hash() const { return log_.state_hash(); }
  [[nodiscard]] double path_length_m() const { return log_.path_length_m(); }

 private:
  std::filesystem::path directory_;
  int most_views_;
  bool lean_;
  RunLog log_;
  GrowingFile steps_;
  Progress progress_;
};

}  // namespace vantage
