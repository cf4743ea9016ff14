/// Views whose scans take some images of a sweep alone, in a planning problem.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/geometry/grid_frame.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gaze_choice.hpp"
#include "vantage/planners/tours/planning_problem.hpp"
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

/// What whole scans of the views show is left to these images. @param shows one of each view
void leave_to_images(const SweepImages& images, const ImagesOfViews& taken, const GridFrame& frame,
                     const CellBlocks& blocks, std::span<const Candidate> views,
                     std::span<const float> cells, std::vector<ShownShares>& shows);

/// The shares of a whole scan's time.
std::vector<double> shares_of_scan(const SweepImages& images, const ImagesOfViews& taken);

}  // namespace vantage
