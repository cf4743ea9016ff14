#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/planners/travel/path_lengths.hpp"
#include "vantage/runtime/interrupt.hpp"

namespace vantage {
namespace {

/// A way along cells takes corners and ends by whole cells.
constexpr double kCellsOff = 2.0 * std::numbers::sqrt2;

bool is_in(const CellSet& set, std::size_t cell) {
  return (set[cell / 64] >> (cell % 64) & 1U) != 0;
}

/// The members of `among` that are in `set`, numbered as they come in `among`.
CellSet numbered_among(const CellSet& set, const std::vector<std::size_t>& among) {
  CellSet result((among.size() + 63) / 64);
  for (std::size_t i = 0; i < among.size(); ++i) {
    if (is_in(set, among[i])) result[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  return result;
}

NavigationOptions barely_fitting(const OpenFloor& floor) {
  NavigationOptions options;
  options.footprint_radius_m =
      std::max(0.0, floor.inscribed_radius_m - kCellsOff * floor.map.cell_m);
  options.margin_m = 0.0;
  options.clearance_weight = 0.0;
  return options;
}

}  // namespace

FloorMap free_floor(const FloorMapOptions& options) {
  FloorMap floor = make_floor_map(options);
  std::ranges::fill(floor.log_odds, -1.0F);
  return floor;
}

Eigen::MatrixXd least_ways_m(const OpenFloor& floor, std::span<const Eigen::Vector2d> places_m,
                             int threads) {
  const Pose2 start{places_m.front().x(), places_m.front().y(), 0.0};
  const PathField field = make_path_field(floor.map, start, barely_fitting(floor));
  Eigen::MatrixXd ways_m = path_lengths_m(field, places_m, threads);
  for (Eigen::Index i = 0; i < ways_m.rows(); ++i) {
    for (Eigen::Index j = 0; j < ways_m.cols(); ++j) {
      const auto a = static_cast<std::size_t>(i);
      const auto b = static_cast<std::size_t>(j);
      const double along_cells_m = ways_m(i, j) - kCellsOff * floor.map.cell_m;
      const double straight_m = (places_m[a] - places_m[b]).norm();
      const double least_m = along_cells_m * std::cos(std::numbers::pi / 8.0);
      ways_m(i, j) = std::isfinite(least_m) ? std::max(straight_m, least_m) : straight_m;
    }
  }
  return ways_m;
}

ViewCoverage view_coverage(const GroundTruthMapEvaluator& evaluator, const ScanPlaces& places,
                           const OpenFloor& floor, int threads) {
  const CellSet all = evaluator.observable_set();
  std::vector<std::size_t> observable;
  for (std::size_t cell = 0; cell < 64 * all.size(); ++cell) {
    if (is_in(all, cell)) observable.push_back(cell);
  }
  ViewCoverage coverage;
  coverage.observable_cells = observable.size();
  Progress progress("what poses show", static_cast<double>(places.T_world_sensors.size()));
  for (const Pose& T_world_sensor : places.T_world_sensors) {
    throw_if_interrupted();
    progress.update(static_cast<double>(coverage.shows.size()));
    coverage.shows.push_back(numbered_among(evaluator.visible_set(T_world_sensor), observable));
  }
  progress.update(static_cast<double>(coverage.shows.size()));
  coverage.way_m = least_ways_m(floor, places.base_m, threads);
  return coverage;
}

}  // namespace vantage
