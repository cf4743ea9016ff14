#include "vantage/planners/prediction_bands.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "vantage/core/error.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/core/rounding.hpp"
#include "vantage/geometry/view_cone.hpp"
#include "vantage/planners/visibility/block_sums.hpp"
#include "vantage/planners/visibility/visibility_sweep.hpp"

namespace vantage {
namespace {

/// From the sensor to the farthest corner of the grid.
double farthest_m(const GridFrame& frame, const Eigen::Vector3d& p_m) {
  const Eigen::AlignedBox3d box = frame.box();
  return (p_m - box.min()).cwiseAbs().cwiseMax((p_m - box.max()).cwiseAbs()).norm();
}

/// The distances that part the bands, the first at the sensor; the last band is from half to one
/// and a half times as wide as the others.
std::vector<double> edges_m(double reach_m, double width_m) {
  const int bands = std::max(1, floor_int(reach_m / width_m + 0.5));
  std::vector<double> edges;
  for (int i = 0; i < bands; ++i) edges.push_back(i * width_m);
  edges.push_back(reach_m);
  return edges;
}

/// Cell by cell, of one sweep.
std::vector<PredictionBand> predict_in_sight(const SweepTables& tables, const Pose& T_world_sensor,
                                             const FieldOfView& field,
                                             const std::vector<double>& edges,
                                             const InSight& in_sight) {
  BlockSums seen({tables.frame.cells, Eigen::Array3i::Ones()});
  const std::array view{SweptView{ViewCone(T_world_sensor, field), kNoRays, &seen}};
  for (const Pyramid& pyramid : kPyramids) sweep_pyramid(tables, view, pyramid);
  std::vector<PredictionBand> bands;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    bands.push_back({edges[i], edges[i + 1], 0.0, 0, 0});
  }
  const Pose T_sensor_world = T_world_sensor.inverse();
  for (std::size_t cell = 0; cell < seen.sums().size(); ++cell) {
    if (seen.sums()[cell] <= 0.0F) continue;
    const Eigen::Vector3d p_sensor = T_sensor_world * tables.frame.centre(tables.frame.cell(cell));
    if (!in_sight(p_sensor)) continue;
    const auto beyond = std::ranges::find_if(
        bands, [&](const PredictionBand& band) { return p_sensor.norm() < band.to_m; });
    PredictionBand& band = beyond == bands.end() ? bands.back() : *beyond;
    band.predicted_cells += static_cast<double>(seen.sums()[cell]);
  }
  return bands;
}

}  // namespace

std::vector<PredictionBand> predict_by_distance(const Attenuation& attenuation,
                                                const OccupancyGrid& grid,
                                                const Pose& T_world_sensor,
                                                const FieldOfView& field, double width_m,
                                                int threads, const InSight& in_sight) {
  expects(width_m > 0.0, "bands have a width");
  const double reach_m =
      std::min(field.range_max_m, farthest_m(grid.frame, T_world_sensor.translation()));
  const std::vector<double> edges = edges_m(reach_m, width_m);
  const SweepTables tables(grid, attenuation, threads,
                           region_of_sweeps(grid.frame, T_world_sensor.translation(),
                                            field.range_max_m, Eigen::Array3i::Zero()));
  if (in_sight) return predict_in_sight(tables, T_world_sensor, field, edges, in_sight);
  std::vector<SweptView> within;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    FieldOfView nearer = field;
    nearer.range_max_m = edges[i];
    within.push_back({ViewCone(T_world_sensor, nearer), kNoRays});
  }
  std::array<std::vector<SampledSum>, kPyramids.size()> sums;
  parallel_for(sums.size(), threads,
               [&](std::size_t i) { sums[i] = sweep_pyramid(tables, within, kPyramids[i]); });
  std::vector<PredictionBand> bands;
  double nearer_cells = 0.0;
  for (std::size_t i = 0; i < within.size(); ++i) {
    double cells = 0.0;
    for (const auto& pyramid : sums) cells += pyramid[i].estimate;
    bands.push_back({edges[i], edges[i + 1], cells - nearer_cells, 0, 0});
    nearer_cells = cells;
  }
  return bands;
}

void count_new_cells(const OccupancyGrid& before, const OccupancyGrid& after,
                     const Pose& T_world_sensor, const FieldOfView& field,
                     std::vector<PredictionBand>& bands, const InSight& in_sight) {
  expects(before.size() == after.size(), "both grids have one frame");
  if (bands.empty()) return;
  const ViewCone cone(T_world_sensor, field);
  const Pose T_sensor_world = T_world_sensor.inverse();
  const auto was_predicted_for = [&](const Eigen::Vector3d& p_m) {
    return cone.contains(p_m) && (!in_sight || in_sight(T_sensor_world * p_m));
  };
  const double reach_m = bands.back().to_m;
  const double width_m = bands.front().to_m;  // of a last band alone it does not matter
  const std::size_t last = bands.size() - 1;
  bands.push_back({reach_m, std::numeric_limits<double>::infinity(), 0.0, 0, 0});
  for (std::size_t cell = 0; cell < before.size(); ++cell) {
    if (before.state(cell) != CellState::unobserved) continue;
    if (after.state(cell) == CellState::unobserved) continue;
    const Eigen::Vector3d p_m = after.frame.centre(after.frame.cell(cell));
    const double distance_m = (p_m - cone.apex_m()).norm();
    const auto within = static_cast<std::size_t>(floor_int(distance_m / width_m));
    const std::size_t band = distance_m > reach_m ? last + 1 : std::min(within, last);
    ++bands[band].actual_cells;
    if (!was_predicted_for(p_m)) ++bands[band].outside_cells;
  }
}

}  // namespace vantage
