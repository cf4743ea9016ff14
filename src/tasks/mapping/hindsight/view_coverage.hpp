/// What could have been seen from where, and how far it would have been: for bounds on what any
/// policy could do, once an episode is over.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"

namespace vantage {

/// Of the poses that observability is defined by, and of poses that a robot has scanned from.
struct ViewCoverage {
  std::vector<CellSet> shows;  ///< observable cells that a noise-free scan shows, numbered anew
  std::size_t observable_cells = 0;
  Eigen::MatrixXd way_m;  ///< no way between two is shorter
};

/// Where scans can be taken from.
struct ScanPlaces {
  std::vector<Pose> T_world_sensors;
  std::vector<Eigen::Vector2d> base_m;  ///< where the base stands for each, world
};

/// Where the middle of the base cannot be.
struct OpenFloor {
  FloorMap map;  ///< what is not free is blocked
  double inscribed_radius_m = 0.0;
};

ViewCoverage view_coverage(const GroundTruthMapEvaluator& evaluator, const ScanPlaces& places,
                           const OpenFloor& floor, int threads);

/// Between places on a floor. No way of a disc of the inscribed radius is shorter: a way along
/// cells is, but for their size, at most 1 / cos(pi / 8) as long as the shortest one. Where the
/// cells know no way it is the straight line.
Eigen::MatrixXd least_ways_m(const OpenFloor& floor, std::span<const Eigen::Vector2d> places_m,
                             int threads);

/// Everything is free as yet.
FloorMap free_floor(const FloorMapOptions& options);

}  // namespace vantage
