/// Event log of an episode: map changes, decisions and planned paths by tick, as `view` shows them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/tours/planned_tour.hpp"

namespace vantage {

/// A run of consecutive cells of a grid, in `GridFrame::index` order, in one state.
struct CellRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  CellState state = CellState::unobserved;
};
/// The cells whose state a scan has changed.
struct MapChange {
  std::vector<CellRun> runs;
};
/// The views that the robot chose from; of each: id (its index), pose, gain, reachability.
struct Decision {
  std::vector<Candidate> candidates;
  std::size_t chosen = 0;  ///< as many as there are candidates: it wants none of them
};
/// The path it is about to drive, world frame.
struct PlannedRoute {
  std::vector<Eigen::Vector2d> path_m;
};

/// The path that it is about to fly, world frame.
struct PlannedFlight {
  std::vector<Eigen::Vector3d> path_m;
};

struct EpisodeEvent {
  std::uint64_t tick = 0;  ///< it came after this state of states.bin, before the next
  /// A planned tour follows the decision that begins it.
  std::variant<MapChange, Decision, PlannedRoute, PlannedFlight, PlannedTour> what;
};

/// Cells whose state in `grid` is not the one in `known`, which becomes that of `grid`. An empty
/// `known` is a map of which nothing was observed.
MapChange map_change(std::vector<CellState>& known, const OccupancyGrid& grid);

/// Writes story.bin as the episode goes. Little-endian: "VANTAGE STORY 1\n", then per event tick
/// (u64), kind (u32: 0 map, 1 decision, 2 way, 3 flight, 4 tour), count (u32), chosen (u64, of a
/// tour its PlanChange, else 0 but for decisions) and count entries: of a map first (u32), count
/// (u32), state (u32: 0 free, 1 unobserved, 2 occupied); of a decision the upper three rows of
/// T_world_sensor row by row, gain, reachable (14 x f64); of a way x, y (2 x f64); of a flight x,
/// y, z (3 x f64); of a tour, after the time that it saves (f64, NaN but for `cheaper`), id, x, y,
/// yaw, arrival, departure, gain, beyond (8 x f64).
class EventLog {
 public:
  explicit EventLog(const std::filesystem::path& run_dir);
  void add(const EpisodeEvent& event);
  void commit() { file_.commit(); }

 private:
  GrowingFile file_;
};

/// @param cells of the grid that the map changes are of
/// @throws InputError naming the file if it is missing, cut short or not of this format.
std::vector<EpisodeEvent> read_event_log(const std::filesystem::path& path, std::size_t cells);

/// Map, decision and path after some of the events of an event log.
class EventReplay {
 public:
  explicit EventReplay(const GridFrame& frame) : grid_(frame) {}

  /// Goes to the moment after the first `count` of `events`, forward or back.
  void go_to(std::span<const EpisodeEvent> events, std::size_t count);

  /// Log odds tell no more than the cells' states.
  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  [[nodiscard]] const std::optional<Decision>& decision() const { return decision_; }
  /// Of the decision, until its scan is in the map; without stops if it was not planned ahead.
  [[nodiscard]] const PlannedTour& tour() const { return tour_; }
  /// Of a way over the floor z is 0.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& path_m() const { return path_m_; }
  [[nodiscard]] std::size_t scans() const { return scans_; }

 private:
  void apply(const MapChange& change);
  void apply(const Decision& decision);
  void apply(const PlannedRoute& route);
  void apply(const PlannedFlight& flight);
  void apply(const PlannedTour& tour) { tour_ = tour; }

  OccupancyGrid grid_;
  std::optional<Decision> decision_;
  PlannedTour tour_;
  std::vector<Eigen::Vector3d> path_m_;
  std::size_t scans_ = 0;
  std::size_t applied_ = 0;
};

}  // namespace vantage
