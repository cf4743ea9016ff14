#include "vantage/belief/map/floor_detail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

// Log odds of a beam that ends in a cell, or passes it: their ratio is the share of beams from
// which on the cell is occupied. The limit is some twenty beams' worth.
constexpr float kEnds = 0.7F;
constexpr float kPasses = 0.3F;
constexpr float kLimit = 6.0F;

}  // namespace

void FloorDetailOptions::check() const {
  if (parts % 2 == 0) throw ConfigError(fmt::format("parts: {} is even", parts));
}

void check_floor_detail(const FloorMapOptions& floor, const FloorDetailOptions& detail) {
  const double cells = std::pow(floor.edge_cells() * detail.parts, 2);
  if (cells <= kMaxFloorCells) return;
  throw ConfigError(
      fmt::format("floor_detail.parts {}, floor_map.half_size_m {} and floor_map.cell_m {} make "
                  "{:.3g} cells, more than 2^26",
                  detail.parts, floor.half_size_m, floor.cell_m, cells));
}

FloorMap make_floor_detail(const FloorMap& floor, const FloorDetailOptions& options) {
  check_options(options, "detail");
  return {floor.min_corner_m, floor.cell_m / options.parts, floor.nx * options.parts,
          floor.ny * options.parts};
}

void add_beams(FloorMap& detail, const PlanarScan& scan, const Pose2& T_world_base,
               const FloorDetailOptions& options) {
  expects(scan.azimuth_rad.size() == scan.range_m.size(), "a range for each beam of the scan");
  constexpr double kLayer = 0.5;  // height of the cell centres in FloorMap::frame()
  const GridFrame frame = detail.frame();
  const Pose2 T_world_sensor = compose(T_world_base, scan.T_base_sensor);
  const Eigen::Vector3d from(T_world_sensor.x_m, T_world_sensor.y_m, kLayer);
  for (std::size_t beam = 0; beam < scan.range_m.size(); ++beam) {
    const auto measured_m = static_cast<double>(scan.range_m[beam]);
    if (std::isnan(measured_m)) continue;
    const double reach_m = std::min({measured_m, scan.range_max_m, options.range_m});
    const double yaw_rad = T_world_sensor.yaw_rad + scan.azimuth_rad[beam];
    const Eigen::Vector3d to =
        from + reach_m * Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    const Eigen::Array2i last = detail.cell_at(to.head<2>());
    const bool ends = measured_m <= reach_m && detail.contains(last);
    const std::size_t end = ends ? detail.index(last) : detail.size();
    walk_ray(frame, from, to, [&](std::size_t cell) {
      if (cell != end) detail.log_odds[cell] = std::max(detail.log_odds[cell] - kPasses, -kLimit);
      return true;
    });
    if (ends) detail.log_odds[end] = std::min(detail.log_odds[end] + kEnds, kLimit);
  }
}

void clear_outline(FloorMap& detail, std::span<const Eigen::Vector2d> outline_world) {
  const Eigen::Vector2d origin_m = detail.centre({0, 0});
  for_each_row_inside(outline_world, origin_m, detail.cell_m, [&](int row, int first, int last) {
    for (int column = first; column <= last; ++column) {
      if (!detail.contains({column, row})) continue;
      float& log_odds = detail.log_odds[detail.index({column, row})];
      log_odds = std::min(log_odds, kStandingLogOdds);
    }
  });
}

}  // namespace vantage
