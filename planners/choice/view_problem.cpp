#include "vantage/planners/choice/view_problem.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/planners/choice/drawn_map.hpp"
#include "vantage/planners/swept_blocks.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/travel/path_lengths.hpp"
#include "vantage/planners/views/space_beyond.hpp"

namespace vantage {
namespace {

/// Ways from the robot are those that the candidates have, pulled straight.
Eigen::MatrixXd travel_times_s(const ViewPlanningInput& input) {
  Eigen::MatrixXd lengths_m = input.ways != nullptr
                                  ? input.ways->between_m(input.places_m, input.threads)
                                  : path_lengths_m(input.paths, input.places_m, input.threads);
  const Eigen::Index n = lengths_m.rows();
  lengths_m.conservativeResize(n + 1, Eigen::NoChange);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Candidate& view = input.candidates[static_cast<std::size_t>(i)];
    lengths_m(n, i) = view.reachable ? view.path_length_m : std::numeric_limits<double>::infinity();
  }
  return lengths_m.unaryExpr([&](double length_m) { return input.travel_time.of_m(length_m); });
}

/// Per block, the share that no view is expected to show.
std::vector<float> unshown_shares(const ShownBlocks& shown) {
  std::vector<float> unshown(shown.cells.size(), 1.0F);
  for (const ShownShares& view : shown.shows) {
    for (std::size_t i = 0; i < view.block.size(); ++i) {
      unshown[view.block[i]] *= 1.0F - view.share[i];
    }
  }
  return unshown;
}

/// Per view, the cells of unknown space that it leads to and no view shows, as far as such cells
/// are seen at all.
std::vector<double> beyond_views(const ViewPlanningInput& input, const CellBlocks& blocks,
                                 const std::vector<float>& unshown, double reach_m) {
  const OccupancyGrid& grid = input.map.grid;
  const SpaceBeyond space = space_beyond(grid, input.places_m, reach_m);
  std::vector<double> beyond(input.candidates.size(), 0.0);
  const std::size_t columns = space.place_of.size();
  for (std::size_t column = 0; column < columns; ++column) {
    if (space.place_of[column] == SpaceBeyond::kNone) continue;
    double cells = 0.0;
    for (std::size_t cell = column; cell < grid.size(); cell += columns) {
      if (grid.state(cell) != CellState::unobserved) continue;
      cells += static_cast<double>(unshown[blocks.index_of_cell(grid.frame.cell(cell))]);
    }
    beyond[static_cast<std::size_t>(space.place_of[column])] += space.seen_share * cells;
  }
  return beyond;
}

/// What is seen already, how fast, and what is still beyond all views.
/// @param unit of a cell, in that of the gain
void add_whole(const ViewPlanningInput& input, const ViewPlanningOptions& options,
               const ShownBlocks& shown, double unit, PlanningProblem& problem) {
  const OccupancyGrid& grid = input.map.grid;
  problem.seen = unit * static_cast<double>(grid.size() - grid.count(CellState::unobserved));
  if (input.elapsed_s <= 0.0 || options.beyond_m <= 0.0) return;
  const CellBlocks blocks = blocks_of(grid.frame, options.block_m);
  const bool by_blocks = shown.cells.size() == blocks.size();
  if (!by_blocks) return;
  problem.pace_per_s = problem.seen / input.elapsed_s;
  problem.beyond = beyond_views(input, blocks, unshown_shares(shown), options.beyond_m);
  for (double& beyond : problem.beyond) beyond *= unit;
}

PlanningProblem with_ways(const ViewPlanningInput& input, const ViewPlanningOptions& options,
                          ShownBlocks shown, double unit = 1.0) {
  expects(input.places_m.size() == input.candidates.size(), "a place of each candidate");
  PlanningProblem problem;
  add_whole(input, options, shown, unit, problem);
  problem.cells = std::move(shown.cells);
  problem.shows = std::move(shown.shows);
  problem.place_m.assign(input.places_m.begin(), input.places_m.end());
  problem.travel_s = travel_times_s(input);
  problem.scan_s = input.scan_s;
  return problem;
}

/// Takes whole scans for scans of the images that are worth their time.
/// @param blocks of space, which the problem's are
/// @return those images; none where all scans stay whole
ImagesOfViews take_partial_scans(const ViewPlanningInput& input, const CellBlocks& blocks,
                                 PlanningProblem& problem) {
  const PartialScans* scans = input.partial_scans;
  if (scans == nullptr) return {};
  const GridFrame& frame = input.map.grid.frame;
  ImagesOfViews taken = worthwhile_images(*scans, frame, blocks, input.candidates, problem);
  problem.scan_share = shares_of_scan(scans->images, taken);
  leave_to_images(scans->images, taken, frame, blocks, input.candidates, problem.cells,
                  problem.shows);
  return taken;
}

/// Of a gain that cannot be swept. What is seen is not known in beams, say: it counts for nothing.
double unit_of_a_cell(const Gain& gain) {
  const std::string_view unit = unit_of(gain);
  return unit == "bits" || unit == "cells" ? 1.0 : 0.0;
}

/// Of the gain, if it can be swept.
std::optional<Attenuation> attenuation_of(const ViewPlanningInput& input) {
  if (!can_sweep(input.gain)) return std::nullopt;
  return attenuation_of(input.gain, input.map);
}

ShownBlocks shown_by(const ViewPlanningInput& input, const ViewPlanningOptions& options,
                     const std::optional<Attenuation>& attenuation) {
  if (!attenuation) {
    return separate_blocks(view_gains_bits(input.gain, input.map, input.candidates,
                                           input.field_of_view, input.threads));
  }
  const CellBlocks blocks = blocks_of(input.map.grid.frame, options.block_m);
  return swept_blocks(*attenuation, input.map.grid, input.candidates, input.field_of_view, blocks,
                      input.threads);
}

/// Of each view, the share of each block's unobserved cells that it really shows.
ShownBlocks truly_shown(const ViewPlanningInput& input, const CellBlocks& blocks) {
  const OccupancyGrid& grid = input.map.grid;
  ShownBlocks result{std::vector<float>(blocks.size(), 0.0F), {}};
  std::vector<std::uint32_t> block_of(grid.size());
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    block_of[cell] = static_cast<std::uint32_t>(blocks.index_of_cell(grid.frame.cell(cell)));
    if (grid.state(cell) == CellState::unobserved) result.cells[block_of[cell]] += 1.0F;
  }
  for (const Candidate& view : input.candidates) {
    expects(view.true_new_cell_set != nullptr, "what each candidate really shows");
    std::vector<float> seen(blocks.size(), 0.0F);
    for (std::size_t i = 0; i < view.true_new_cell_set->size(); ++i) {
      for (std::uint64_t left = (*view.true_new_cell_set)[i]; left != 0; left &= left - 1) {
        const std::size_t cell = 64 * i + static_cast<std::size_t>(std::countr_zero(left));
        // Holes that were filled are known without being seen.
        if (grid.state(cell) == CellState::unobserved) seen[block_of[cell]] += 1.0F;
      }
    }
    result.shows.push_back(shares_of_blocks(seen, result.cells));
  }
  return result;
}

}  // namespace

PlanningProblem make_view_problem(const ViewPlanningInput& input,
                                  const ViewPlanningOptions& options) {
  const std::optional<Attenuation> attenuation = attenuation_of(input);
  const double unit = attenuation ? attenuation->utility : unit_of_a_cell(input.gain);
  PlanningProblem problem = with_ways(input, options, shown_by(input, options, attenuation), unit);
  const CellBlocks planned_blocks = blocks_of(input.map.grid.frame, options.block_m);
  ImagesOfViews taken;
  if (attenuation) taken = take_partial_scans(input, planned_blocks, problem);
  if (input.map.transmission == nullptr) return problem;
  // Most choices draw nothing.
  auto belief = std::make_shared<std::optional<const DrawableMap>>();
  std::vector<Candidate> views(input.candidates.begin(), input.candidates.end());
  problem.draw = [=, map = input.map, field = input.field_of_view, threads = input.threads,
                  partial = input.partial_scans](Rng& rng) {
    if (!*belief) belief->emplace(map, options.drawn_cells);
    const OccupancyGrid& grid = (*belief)->grid();
    const CellBlocks blocks = blocks_of(grid.frame, options.block_m);
    Attenuation drawn = (*belief)->draw(rng);
    if (unit > 0.0) drawn.utility *= unit;  // else cells are what is shown
    ShownBlocks shown = swept_blocks(drawn, grid, views, field, blocks, threads);
    if (!taken.empty()) {
      leave_to_images(partial->images, taken, grid.frame, blocks, views, shown.cells, shown.shows);
    }
    return shown;
  };
  return problem;
}

PlanningProblem make_true_view_problem(const ViewPlanningInput& input,
                                       const ViewPlanningOptions& options) {
  // Nothing is beyond what all views show where they are all there are.
  const ViewPlanningOptions here{.block_m = options.block_m, .beyond_m = 0.0};
  const CellBlocks blocks = blocks_of(input.map.grid.frame, here.block_m);
  PlanningProblem problem = with_ways(input, here, truly_shown(input, blocks));
  take_partial_scans(input, blocks, problem);
  return problem;
}

}  // namespace vantage
