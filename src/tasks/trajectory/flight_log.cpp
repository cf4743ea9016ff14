#include "vantage/tasks/trajectory/flight_log.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "vantage/report/report_data.hpp"

namespace vantage {
namespace {

constexpr std::uint16_t kNever = std::numeric_limits<std::uint16_t>::max();

/// A frustum's pose: x along the line of sight.
Pose looking_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& object_m) {
  const Eigen::Vector3d ahead = (object_m - eye_m).normalized();
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(ahead).normalized();
  Pose T = Pose::Identity();
  T.linear() << ahead, left, ahead.cross(left);
  T.translation() = eye_m;
  return T;
}

}  // namespace

Decision view_decision(const std::vector<PlannableObject>& objects, const Pose& T_body_camera,
                       double distance_m, double highest_m,
                       const std::optional<ViewTarget>& target) {
  const Eigen::Vector3d in_body_m = T_body_camera * Eigen::Vector3d(0.0, 0.0, distance_m);
  Decision decision;
  std::optional<std::size_t> chosen;
  for (const PlannableObject& object : objects) {
    const ObservationRing ring{
        .p_world_object_m = object.p_world_m,
        .radius_m = in_body_m.head<2>().norm(),
        .height_m = std::min(highest_m, object.p_world_m.z() - in_body_m.z())};
    for (int d = 0; d < kObservationDirections; ++d) {
      const bool wanted = target && target->object == object.id && target->direction == d;
      if (wanted) chosen = decision.candidates.size();
      Candidate& view = decision.candidates.emplace_back();
      view.id = static_cast<int>(decision.candidates.size()) - 1;
      view.T_world_sensor =
          looking_at(wanted ? target->p_world_view_m : ring.view_m(d), object.p_world_m);
      view.gain_bits = object.gain_nats[static_cast<std::size_t>(d)];
      view.reachable = !object.used[static_cast<std::size_t>(d)];
    }
  }
  decision.chosen = chosen.value_or(decision.candidates.size());
  return decision;
}

FlightLog::FlightLog(RunLog& log, const std::filesystem::path& run_dir, bool keep)
    : log_(log), run_dir_(run_dir) {
  if (keep) file_.emplace(run_dir);
}

void FlightLog::tell(EpisodeEvent event) {
  log_.tell(event);
  if (file_) file_->add(event);
}

void FlightLog::map(const OccupancyGrid& grid, int waypoint) {
  frame_ = grid.frame;
  occupied_since_.resize(grid.size(), kNever);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const bool occupied = grid.state(cell) == CellState::occupied;
    const auto now = static_cast<std::uint16_t>(waypoint);
    occupied_since_[cell] = occupied ? std::min(occupied_since_[cell], now) : kNever;
  }
  tell({0, map_change(known_, grid)});
}

void FlightLog::plan(const std::vector<Eigen::Vector4d>& plan, std::size_t from,
                     std::size_t count) {
  PlannedFlight ahead;
  for (std::size_t i = from; i < std::min(plan.size(), from + count); ++i) {
    ahead.path_m.emplace_back(plan[i].head<3>());
  }
  tell({0, std::move(ahead)});
}

void FlightLog::commit() {
  if (!file_) return;
  file_->commit();
  VoxelMap map{frame_.cell_size_m, frame_.box(), {}};
  for (std::size_t cell = 0; cell < occupied_since_.size(); ++cell) {
    if (occupied_since_[cell] == kNever) continue;
    const Eigen::Vector3f p = frame_.centre(frame_.cell(cell)).cast<float>();
    map.voxels.push_back({p.x(), p.y(), p.z(), occupied_since_[cell], kVoxelOccupied});
  }
  write_voxels(run_dir_ / "voxels.bin", map);
}

}  // namespace vantage
