/// Views whose scans take some images of a sweep alone, in a planning problem.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gaze_choice.hpp"
#include "vantage/planners/tours/planning_problem.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"
#include "vantage/planners/visibility/block_sums.hpp"

namespace vantage {

/// Of a robot that need not take all images of a sweep.
struct PartialScans {
  SweepImages images;
  GazeOptions gaze;
};

/// Of about so long an edge, in whole cells.
CellBlocks blocks_of(const GridFrame& frame, double block_m);

/// Per view, the images that it takes, ascending.
using ImagesOfViews = std::vector<std::vector<std::size_t>>;

/// Those that are worth their time if the robot comes from the nearest place that it can come from.
/// @param problem of whole scans
ImagesOfViews worthwhile_images(const PartialScans& scans, const GridFrame& frame,
                                const CellBlocks& blocks, std::span<const Candidate> views,
                                const PlanningProblem& problem);

/// Where images are about to be taken from.
struct Lookout {
  const OccupancyGrid& grid;
  Attenuation attenuation;
  FieldOfView field_of_view;
  Pose T_world_sweep;
  double block_m = 0.0;  ///< edge of the blocks by which it is told what is seen where
};
/// Per image of a sweep from there, what it is expected to show; see gaze_choice.hpp.
std::vector<double> gains_of_images(const SweepImages& images, const Lookout& lookout);

/// A scan that is about to be taken.
struct ScanToCome {
  Lookout lookout;
  double scan_s = 0.0;  ///< of a whole scan, > 0
  double way_s = 0.0;   ///< that it took to get there
};
/// Its images that are worth their time.
std::vector<std::size_t> worthwhile_images(const PartialScans& scans, const ScanToCome& scan);

/// What whole scans of the views show is left to these images. @param shows one of each view
void leave_to_images(const SweepImages& images, const ImagesOfViews& taken, const GridFrame& frame,
                     const CellBlocks& blocks, std::span<const Candidate> views,
                     std::span<const float> cells, std::vector<ShownShares>& shows);

/// The shares of a whole scan's time.
std::vector<double> shares_of_scan(const SweepImages& images, const ImagesOfViews& taken);

}  // namespace vantage
