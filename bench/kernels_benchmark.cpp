// One table-top decision: 30 views of a half-explored grid of 129 x 129 x 65 cells, per gain.
#include <benchmark/benchmark.h>

#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/views/view_candidates.hpp"

namespace vantage {
namespace {

const FieldOfView kField{.half_width_rad = 0.1309, .tilt_min_rad = -0.36, .tilt_max_rad = 0.62};

/// A scan of clutter: beams stop at distances that vary smoothly over the table.
RangeScan clutter_scan(Rng& rng) {
  RangeScan scan;
  scan.field_of_view = kField;
  for (int i = 0; i <= 60; ++i) scan.azimuth_rad.push_back(-0.1309 + 0.2618 * i / 60);
  for (int i = 0; i <= 600; ++i) scan.tilt_rad.push_back(-0.36 + 0.98 * i / 600);
  for (std::size_t i = 0; i < scan.lines() * scan.beams(); ++i) {
    scan.range_m.push_back(static_cast<float>(rng.uniform(0.8, 1.8)));
  }
  return scan;
}

OccupancyGrid half_explored(std::span<const Candidate> views) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.982}, {1.0, 1.0, 0.504}, {129, 129, 65}));
  Rng rng(1);
  for (const std::size_t view : {1U, 10U, 20U}) {
    carve_free_space(grid, clutter_scan(rng), views[view].T_world_sensor, FreeSpaceUpdate{});
  }
  return grid;
}

template <class G>
void decision(benchmark::State& state) {
  const auto views = ring_of_views(RingOfViews{}, Eigen::Vector3d::Zero());
  const OccupancyGrid grid = half_explored(views);
  const BlockField transmission = uniform_field(grid.frame.cells, 0.99);
  const int threads = static_cast<int>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(exact_gains_bits(G{}, {grid, &transmission}, views, kField, threads));
  }
}

void carve(benchmark::State& state) {
  const auto views = ring_of_views(RingOfViews{}, Eigen::Vector3d::Zero());
  const OccupancyGrid before = half_explored(views);
  Rng rng(2);
  const RangeScan scan = clutter_scan(rng);
  for (auto _ : state) {
    OccupancyGrid grid = before;
    benchmark::DoNotOptimize(
        carve_free_space(grid, scan, views[5].T_world_sensor, FreeSpaceUpdate{}));
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
