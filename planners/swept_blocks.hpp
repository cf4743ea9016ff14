/// What each of several views is expected to show, block by block of cells: what planning several
/// views ahead needs to know, since views of one room share cells.
#pragma once

#include <span>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/tours/planning_problem.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"
#include "vantage/planners/visibility/block_sums.hpp"

namespace vantage {

/// By one sweep a view, without rays. A view's shares times the cells sum to its swept gain, up to
/// what rays would correct. Blocks of which nothing is unobserved are in no view's list. The result
/// does not depend on `threads`.
ShownBlocks swept_blocks(const Attenuation& attenuation, const OccupancyGrid& grid,
                         std::span<const Candidate> candidates, const FieldOfView& field_of_view,
                         const CellBlocks& blocks, int threads);

/// The same of one view, on one thread, by tables of what is within its range alone: `cells` says
/// how many are unobserved of the blocks that it shows, and nothing of other blocks.
ShownBlocks swept_blocks_of_view(const Attenuation& attenuation, const OccupancyGrid& grid,
                                 const Candidate& candidate, const FieldOfView& field_of_view,
                                 const CellBlocks& blocks);

/// The same where nothing of the views is known but what each shows alone: a block for each.
ShownBlocks separate_blocks(std::span<const double> gains);

/// From what is seen of each block; a trace of a block is none of it.
ShownShares shares_of_blocks(const std::vector<float>& seen, const std::vector<float>& cells);

}  // namespace vantage
