/// The planning problem of a robot that maps: from its map, its views, and the ways between them.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/choice/partial_scans.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/tours/planning_problem.hpp"
#include "vantage/planners/travel/path_lengths.hpp"
#include "vantage/planners/travel/travel_time.hpp"

namespace vantage {

struct ViewPlanningOptions {
  double block_m = 0.4;
  int drawn_cells = 3;
  double beyond_m = 0.0;
  void fields(auto&& f) {
    f("block_m", block_m,
      "edge of the blocks of cells by which planning ahead knows what views share; higher is "
      "faster and coarser",
      above(0.0));
    f("drawn_cells", drawn_cells,
      "edge, in cells, of the blocks that a map drawn for `rollout` has in place of cells; higher "
      "is faster and coarser",
      between(1, 100));
    f("beyond_m", beyond_m,
      "length of the way from a view up to which unknown space behind what it shows counts for it; "
      "higher knows of larger rooms, or of what is outside the building; 0: none counts",
      at_least(0.0));
  }
};

/// What the robot knows when it plans.
struct ViewPlanningInput {
  GainContext map;  ///< outlives the problem if maps are drawn; `transmission` is needed for that
  Gain gain;
  std::span<const Candidate> candidates;
  std::span<const Eigen::Vector2d> places_m;  ///< where the base stands for each, world
  FieldOfView field_of_view;
  const PathField& paths;  ///< from where the robot is
  TravelTime travel_time;
  double scan_s = 0.0;
  double elapsed_s =
      0.0;  ///< since the start, for the pace at which cells are observed; 0: unknown
  int threads = 1;
  const PartialScans* partial_scans = nullptr;  ///< null: every scan is a whole one
  PathLengths* ways = nullptr;                  ///< between places, in place of those of `paths`
};

/// Candidates out of reach are views that are infinitely far. A gain that cannot be swept counts
/// each view alone.
PlanningProblem make_view_problem(const ViewPlanningInput& input,
                                  const ViewPlanningOptions& options);

/// The same with what the views really show, by Candidate::true_new_cell_set, over the cells of the
/// map that are unobserved.
PlanningProblem make_true_view_problem(const ViewPlanningInput& input,
                                       const ViewPlanningOptions& options);

}  // namespace vantage
