/// Writes the run folder of an episode that maps while it runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/runtime/recorder.hpp"
#include "vantage/tasks/mapping/drawing/map_panel.hpp"
#include "vantage/tasks/mapping/drawing/map_voxels.hpp"
#include "vantage/tasks/mapping/driving/scan_record.hpp"
#include "vantage/tasks/mapping/plans/plan_table.hpp"

namespace vantage {

struct Predictor;

class MappingRecorder : public EpisodeRecorder {
 public:
  /// Lean: neither states nor voxels nor event log are kept.
  /// @param scans at most
  /// @throws OutputError, RendererError
  MappingRecorder(const EpisodeRun& run, RecordedRobot robot,
                  const std::vector<Predictor>& predictors, int scans);

  void set_panel(std::function<MapPanelInput()> panel);
  /// Adds a row to steps.csv, and notes since when cells are occupied.
  /// @param number of the scan, the first is 1
  void scan(const ScanRecord& record, std::size_t number, const OccupancyGrid& grid);
  /// Whether somebody will look at decisions and what they were made by.
  [[nodiscard]] bool logs_events() const { return event_log_ || log().watched(); }
  /// What was chosen among, weighed by `gain`, and the route that was planned to it.
  void decision(const std::vector<Candidate>& candidates, std::size_t chosen, const Gain& gain);
  /// The tour that the decision begins; none of a choice that does not plan ahead.
  void plan(const PlannedTour& tour, const PlanMoment& moment);
  void route(const std::vector<Pose2>& waypoints);
  void commit() override;
  void write_map(const OccupancyGrid& grid, const PointCloud& cloud);

 private:
  void tell(EpisodeEvent event);

  int planned_scans_;
  std::size_t scans_ = 0;  ///< so far
  std::optional<EventLog> event_log_;
  std::optional<PlanTable> plans_;  ///< from the first plan on
  MapVoxels voxels_;
  std::vector<CellState> known_;  ///< of the map, as far as the history goes
};

/// What the names in the run folder mean.
RecordTexts mapping_records();

}  // namespace vantage
