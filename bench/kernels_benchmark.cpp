// One table-top decision per gain: 30 views of a grid of 129 x 129 x 65 cells that has taken in
// three scans of spheres on a table; and what a scan more frees.
#include <benchmark/benchmark.h>

#include <cmath>
#include <limits>

#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/views/view_candidates.hpp"

namespace vantage {
namespace {

const FieldOfView kField{.half_width_rad = 0.1309, .tilt_min_rad = -0.36, .tilt_max_rad = 0.62};

/// Spheres that lie on a table, whose top is below the map.
struct Clutter {
  struct Sphere {
    Eigen::Vector3d centre_m;
    double radius_m;
  };
  static constexpr double kTable_m = 0.72;
  std::vector<Sphere> spheres;

  /// From `p` along the unit vector `d` to the nearest surface; infinite if none is in range.
  [[nodiscard]] double range_m(const Eigen::Vector3d& p, const Eigen::Vector3d& d) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    double nearest_m = d.z() < 0.0 ? (kTable_m - p.z()) / d.z() : kNone;
    for (const auto& [centre_m, radius_m] : spheres) {
      const double along_m = d.dot(centre_m - p);
      const double inside_m2 =
          radius_m * radius_m - (centre_m - p).squaredNorm() + along_m * along_m;
      if (inside_m2 > 0.0) nearest_m = std::min(nearest_m, along_m - std::sqrt(inside_m2));
    }
    return nearest_m <= kField.range_max_m ? nearest_m : kNone;
  }
};

Clutter drawn_clutter() {
  Clutter clutter;
  Rng rng(1);
  for (int i = 0; i < 8; ++i) {
    const double radius_m = rng.uniform(0.04, 0.12);
    const double x_m = rng.uniform(-0.35, 0.35);
    const double y_m = rng.uniform(-0.35, 0.35);
    clutter.spheres.push_back({{x_m, y_m, Clutter::kTable_m + radius_m}, radius_m});
  }
  return clutter;
}

struct Scan {
  RangeScan ranges;
  std::vector<Eigen::Vector3f> points;  ///< world
};

Scan scan_from(const Pose& T_world_sensor) {
  const Clutter clutter = drawn_clutter();
  Scan scan;
  scan.ranges.field_of_view = kField;
  for (int i = 0; i <= 60; ++i) scan.ranges.azimuth_rad.push_back(-0.1309 + 0.2618 * i / 60);
  for (int i = 0; i <= 600; ++i) scan.ranges.tilt_rad.push_back(-0.36 + 0.98 * i / 600);
  const Eigen::Vector3d p = T_world_sensor.translation();
  for (const double tilt_rad : scan.ranges.tilt_rad) {
    for (const double azimuth_rad : scan.ranges.azimuth_rad) {
      const Eigen::Vector3d d = T_world_sensor.linear() * beam_direction({azimuth_rad, tilt_rad});
      const double range_m = clutter.range_m(p, d);
      scan.ranges.range_m.push_back(static_cast<float>(range_m));
      if (std::isfinite(range_m)) scan.points.emplace_back((p + range_m * d).cast<float>());
    }
  }
  return scan;
}

OccupancyGrid scanned_grid(std::span<const Candidate> views) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.982}, {1.0, 1.0, 0.504}, {129, 129, 65}));
  for (const std::size_t view : {1U, 10U, 20U}) {
    const Pose& T_world_sensor = views[view].T_world_sensor;
    const Scan scan = scan_from(T_world_sensor);
    add_measurements(grid, scan.points, InverseSensorModel{});
    carve_free_space(grid, scan.ranges, T_world_sensor, FreeSpaceUpdate{});
  }
  return grid;
}

template <class G>
void decision(benchmark::State& state) {
  const auto views = ring_of_views(RingOfViews{}, Eigen::Vector3d::Zero());
  const OccupancyGrid grid = scanned_grid(views);
  const BlockField transmission = uniform_field(grid.frame.cells, 0.99);
  const int threads = static_cast<int>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(exact_gains_bits(G{}, {grid, &transmission}, views, kField, threads));
  }
}

void carve(benchmark::State& state) {
  const auto views = ring_of_views(RingOfViews{}, Eigen::Vector3d::Zero());
  OccupancyGrid before = scanned_grid(views);
  const Scan scan = scan_from(views[5].T_world_sensor);
  add_measurements(before, scan.points, InverseSensorModel{});
  for (auto _ : state) {
    OccupancyGrid grid = before;
    benchmark::DoNotOptimize(
        carve_free_space(grid, scan.ranges, views[5].T_world_sensor, FreeSpaceUpdate{}));
  }
}

BENCHMARK(decision<SimpleGain>)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(decision<BeerLambertGain>)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(decision<AdaptiveGain>)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(decision<VisibilityWeightedGain>)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(decision<PosteriorChainGain>)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(carve)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace vantage
