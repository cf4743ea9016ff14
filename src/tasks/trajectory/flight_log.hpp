/// What a flight along a path keeps of its map, decision after decision: story.bin for `view`,
/// voxels.bin for the report.
#pragma once

#include <optional>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/planners/trajectory/flight_planner.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/runtime/log/run_log.hpp"

namespace vantage {

/// The ring of places that an object would be looked at from, with what each is expected to tell;
/// the one that is flown to is where the planner wants it.
/// @param highest_m where the path is, which no ring is above
Decision view_decision(const std::vector<PlannableObject>& objects, const Pose& T_body_camera,
                       double distance_m, double highest_m,
                       const std::optional<ViewTarget>& target);

class FlightLog {
 public:
  /// @param log tells the spectator, and which tick it is
  /// @param keep whether files are written into `run_dir`
  FlightLog(RunLog& log, const std::filesystem::path& run_dir, bool keep);

  [[nodiscard]] bool wanted() const { return file_.has_value() || log_.watched(); }
  void map(const OccupancyGrid& grid, int waypoint);
  void decision(Decision decision) { tell({0, std::move(decision)}); }
  void plan(const std::vector<Eigen::Vector4d>& plan, std::size_t from, std::size_t count);
  void commit();

 private:
  void tell(EpisodeEvent event);

  RunLog& log_;
  std::filesystem::path run_dir_;
  std::optional<EventLog> file_;
  std::vector<CellState> known_;
  std::vector<std::uint16_t> occupied_since_;  ///< waypoint, by cell; while it is occupied
  GridFrame frame_;
};

}  // namespace vantage
