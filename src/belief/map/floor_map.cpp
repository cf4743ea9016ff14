#include "vantage/belief/map/floor_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/core/parallel_for.hpp"

namespace vantage {
namespace {

enum class Touched : std::uint8_t { no, passed, hit };

/// What beams of a scan show of each cell.
class ScanTrace {
 public:
  explicit ScanTrace(const FloorMap& map)
      : map_(map), frame_(map.frame()), touched_(map.size(), Touched::no) {}

  void add(const Pose2& T_world_beam, double range_m, bool returned) {
    constexpr double kLayer = 0.5;  // height of the cell centres in FloorMap::frame()
    const Eigen::Vector2d p_end(T_world_beam.x_m + range_m * std::cos(T_world_beam.yaw_rad),
                                T_world_beam.y_m + range_m * std::sin(T_world_beam.yaw_rad));
    walk_ray(frame_, {T_world_beam.x_m, T_world_beam.y_m, kLayer}, {p_end.x(), p_end.y(), kLayer},
             [&](std::size_t cell) {
               touched_[cell] = std::max(touched_[cell], Touched::passed);
               return true;
             });
    const Eigen::Array2i end = map_.cell_at(p_end);
    if (returned && map_.contains(end)) touched_[map_.index(end)] = Touched::hit;
  }
  [[nodiscard]] Touched touched(std::size_t cell) const { return touched_[cell]; }

 private:
  const FloorMap& map_;
  GridFrame frame_;
  std::vector<Touched> touched_;
};

}  // namespace

double FloorMapOptions::edge_cells() const { return std::ceil(2.0 * half_size_m / cell_m - 1e-9); }

void FloorMapOptions::check() const {
  const double cells = std::pow(edge_cells(), 2);
  if (!(cells >= 1.0 && cells <= kMaxFloorCells)) {
    throw ConfigError(fmt::format("half_size_m {} and cell_m {} make {:.3g} cells, {}", half_size_m,
                                  cell_m, cells, cells < 1.0 ? "not one" : "more than 2^26"));
  }
  const double decisive = log_odds_of(kOccupiedAbove);
  if (std::min({log_odds_hit, log_odds_miss, log_odds_limit}) <= decisive) {
    throw ConfigError(
        "log_odds_hit, log_odds_miss and log_odds_limit must be above 0.406, or a "
        "cell stays unknown after it was measured");
  }
}

FloorMap::FloorMap(const Eigen::Vector2d& min_corner, double cell, int cells_x, int cells_y)
    : min_corner_m(min_corner), cell_m(cell), nx(cells_x), ny(cells_y) {
  expects(cell > 0.0 && cells_x > 0 && cells_y > 0, "a floor map needs cells");
  const auto count = static_cast<std::size_t>(cells_x) * static_cast<std::size_t>(cells_y);
  log_odds.assign(count, 0.0F);
  blocked.assign(count, 0);
}

CellState FloorMap::state(std::size_t cell) const {
  if (blocked[cell] != 0) return CellState::occupied;
  const double p_occupied = probability_of(log_odds[cell]);
  if (p_occupied > kOccupiedAbove) return CellState::occupied;
  return p_occupied < kFreeBelow ? CellState::free : CellState::unobserved;
}

CellState FloorMap::state_at(const Eigen::Vector2d& p_world) const {
  const Eigen::Array2i at = cell_at(p_world);
  return contains(at) ? state(index(at)) : CellState::unobserved;
}

GridFrame FloorMap::frame() const {
  GridFrame grid;
  grid.min_corner_m = {min_corner_m.x(), min_corner_m.y(), 0.0};
  grid.cell_size_m = {cell_m, cell_m, 1.0};
  grid.cells = {nx, ny, 1};
  return grid;
}

FloorMap make_floor_map(const FloorMapOptions& options) {
  check_options(options, "floor_map");
  const int cells = static_cast<int>(options.edge_cells());
  const double half_m = 0.5 * cells * options.cell_m;
  return {Eigen::Vector2d::Constant(-half_m), options.cell_m, cells, cells};
}

void add_planar_scan(FloorMap& map, const PlanarScan& scan, const Pose2& T_world_base,
                     const FloorMapOptions& options, int threads) {
  expects(scan.azimuth_rad.size() == scan.range_m.size(), "a range for each beam of the scan");
  expects(threads >= 1, "add_planar_scan needs a thread");
  const Pose2 T_world_sensor = compose(T_world_base, scan.T_base_sensor);
  const auto parts = static_cast<std::size_t>(threads);
  std::vector<ScanTrace> traces(parts, ScanTrace(map));
  parallel_for(parts, threads, [&](std::size_t part) {
    for (std::size_t beam = part; beam < scan.range_m.size(); beam += parts) {
      const auto range_m = static_cast<double>(scan.range_m[beam]);
      if (std::isnan(range_m)) continue;
      const bool returned = range_m <= scan.range_max_m;
      const Pose2 T_world_beam = compose(T_world_sensor, {0.0, 0.0, scan.azimuth_rad[beam]});
      traces[part].add(T_world_beam, std::min(range_m, scan.range_max_m), returned);
    }
  });
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    Touched touched = Touched::no;
    for (const ScanTrace& trace : traces) touched = std::max(touched, trace.touched(cell));
    if (touched == Touched::no) continue;
    const double change = touched == Touched::hit ? options.log_odds_hit : -options.log_odds_miss;
    map.log_odds[cell] =
        static_cast<float>(std::clamp(static_cast<double>(map.log_odds[cell]) + change,
                                      -options.log_odds_limit, options.log_odds_limit));
  }
}

void block_box(FloorMap& map, const Eigen::AlignedBox2d& box_m) {
  if (box_m.isEmpty()) return;
  const Eigen::Array2i low = map.cell_at(box_m.min()).max(0);
  const Eigen::Array2i high = map.cell_at(box_m.max()).min(Eigen::Array2i(map.nx - 1, map.ny - 1));
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) map.blocked[map.index({x, y})] = 1;
  }
}

void clear_footprint(FloorMap& map, const Pose2& T_world_base, double radius_m) {
  const Eigen::Vector2d p_base(T_world_base.x_m, T_world_base.y_m);
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    if ((map.centre(map.cell(cell)) - p_base).norm() > radius_m) continue;
    map.log_odds[cell] = std::min(map.log_odds[cell], kStandingLogOdds);
  }
}

}  // namespace vantage
