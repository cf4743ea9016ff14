/// Evaluates a map against ground truth: which cells are observable, and their true state.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/tasks/mapping/driving/scan_record.hpp"

namespace vantage {

class MobileGroundTruth;
struct MapScore;

/// T_world_base at a scan, as the robot may have it.
struct ScanPoses {
  Pose2 dead_reckoned;  ///< by the wheels alone since the scan before
  Pose2 tracked;        ///< what registration of the scan starts from
  Pose2 kept;           ///< what the scan was taken into the map at
};

/// What a map knows, as it is asked for by many views of one decision.
struct KnownCells {
  std::vector<std::uint8_t> flags;  ///< 1 for each cell that is known
  CellSet set;                      ///< the same
};
KnownCells known_cells(const OccupancyGrid& grid);

/// What could be seen from where the robot might stand, if it could get there.
struct LeftOut {
  int rooms = 0;          ///< open places that no way leads to
  std::size_t cells = 0;  ///< that a noise-free sensor sees from there alone
};

/// The only one who holds a map against the truth. Whoever decides may hand it a record to fill in,
/// and learns nothing by that; the choices `oracle`, `oracle_lookahead` and `oracle_tour` ask it,
/// and say so.
class GroundTruthMapEvaluator {
 public:
  /// Nothing is observable yet. `truth` must outlive it.
  GroundTruthMapEvaluator(const MobileGroundTruth& truth, const GridFrame& frame,
                          const FieldOfView& field_of_view, int threads);
  /// Makes observable what a noise-free sensor sees from at least one of the poses.
  void add_observable(std::span<const Pose> T_world_sensors);

  /// Works out once what is really visible from each of these poses, as things stand now. The
  /// answers below stay the same, and take no time for a pose that is among them.
  void remember_visible(std::span<const Pose> T_world_sensors);

  /// Unobserved cells that a view would really show.
  [[nodiscard]] std::size_t true_new_cells(const KnownCells& known,
                                           const Pose& T_world_sensor) const;
  /// The same, cell by cell.
  [[nodiscard]] CellSet true_new_cell_set(const KnownCells& known,
                                          const Pose& T_world_sensor) const;
  /// All cells that a noise-free sensor sees from there.
  [[nodiscard]] CellSet visible_set(const Pose& T_world_sensor) const;
  [[nodiscard]] CellSet observable_set() const;
  /// The poses that observability is defined by.
  [[nodiscard]] const std::vector<Pose>& observing_poses() const { return observing_poses_; }
  /// From the start past what stands or hangs in the robot's way, as it really is; null if nobody
  /// needs to know.
  [[nodiscard]] const PathField* true_paths() const {
    return true_paths_ ? &*true_paths_ : nullptr;
  }
  [[nodiscard]] std::size_t observable_cells() const { return observable_count_; }
  /// None where it is not asked which places can be reached.
  [[nodiscard]] const std::optional<LeftOut>& left_out() const { return left_out_; }
  [[nodiscard]] std::size_t observable_unobserved(const OccupancyGrid& grid) const;
  [[nodiscard]] MapScore score(const OccupancyGrid& grid, int tolerance_cells) const;
  /// Fills in what the record says of the map, held against the truth.
  void measure(const OccupancyGrid& grid, int tolerance_cells, ScanRecord& record) const;
  /// Fills in what the record says of the pose, held against the truth.
  void measure_pose(const ScanPoses& poses, ScanRecord& record) const;
  /// The same of a scan before, which is in the map at `T_world_base` now.
  static void measure_moved_pose(const Pose2& T_world_base, ScanRecord& record);

 protected:
  /// @param T_world_sensors in `rooms` that no way leads to; after add_observable()
  void set_left_out(int rooms, std::span<const Pose> T_world_sensors);
  [[nodiscard]] const std::vector<std::uint8_t>& surface() const { return surface_; }
  void set_true_paths(PathField paths) { true_paths_ = std::move(paths); }

 private:
  struct Remembered {
    Pose T_world_sensor;
    CellSet visible;
  };
  [[nodiscard]] CellSet visible_unless(const KnownCells& known, const Pose& T_world_sensor) const;

  const MobileGroundTruth& truth_;
  GridFrame frame_;
  FieldOfView field_of_view_;
  int threads_;
  std::vector<std::uint8_t> observable_;
  std::vector<std::uint8_t> surface_;
  std::vector<Remembered> remembered_;
  std::vector<Pose> observing_poses_;
  std::optional<PathField> true_paths_;
  std::size_t observable_count_ = 0;
  std::optional<LeftOut> left_out_;
};

}  // namespace vantage
