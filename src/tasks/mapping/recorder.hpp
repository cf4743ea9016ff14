/// Writes the run folder of an episode that maps while it runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "vantage/core/log.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/run_log.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/mapping/map_panel.hpp"
#include "vantage/tasks/mapping/mobile_robot_interface.hpp"
#include "vantage/tasks/mapping/scan_record.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

class Recorder {
 public:
  /// Hooks itself to the world's ticks. Lean: neither states nor voxels nor event log are kept.
  /// @throws OutputError, RendererError
  Recorder(const ResolvedEpisode& resolved, MobileRobotInterface& robot,
           std::filesystem::path directory, bool with_video, bool lean, Spectator spectator = {});

  void set_panel(std::function<MapPanelInput()> panel);
  /// Adds a row to steps.csv, and the cells that became occupied to the report's voxels.
  void scan(const ScanRecord& record, std::size_t index, const OccupancyGrid& grid);
  /// Whether somebody will look at decisions and what they were made by.
  [[nodiscard]] bool logs_events() const { return event_log_ || log_.watched(); }
  /// What was chosen among, and the way that was planned to it.
  void decision(const std::vector<Candidate>& candidates, std::size_t chosen);
  void route(const std::vector<Pose2>& waypoints);
  void commit();  ///< puts the growing files under their final names
  void write_map(const OccupancyGrid& grid, const PointCloud& cloud);
  void finish_video() { log_.finish_video(); }

  [[nodiscard]] std::uint64_t state_hash() const { return log_.state_hash(); }
  [[nodiscard]] double path_length_m() const { return log_.path_length_m(); }
  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }

 private:
  void tell(EpisodeEvent event);
  void add_occupied_voxels(const OccupancyGrid& grid, std::size_t step);
  void add_voxel(const OccupancyGrid& grid, std::size_t cell, std::size_t step, std::uint8_t kind);

  std::filesystem::path directory_;
  int planned_scans_;
  bool lean_;
  RunLog log_;
  GrowingFile steps_;
  std::optional<EventLog> event_log_;
  std::vector<VoxelRecord> voxels_;
  std::vector<std::uint8_t> was_occupied_;
  std::vector<CellState> known_;  ///< of the map, as far as the history goes
  Progress progress_;
  std::size_t scans_done_ = 0;
};

}  // namespace vantage
