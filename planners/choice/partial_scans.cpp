#include "vantage/planners/choice/partial_scans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "vantage/core/error.hpp"
#include "vantage/planners/swept_blocks.hpp"

namespace vantage {
namespace {

double shortest_way_s(const PlanningProblem& problem, std::size_t view) {
  double shortest_s = std::numeric_limits<double>::infinity();
  for (std::size_t from = 0; from <= problem.here(); ++from) {
    if (from != view) shortest_s = std::min(shortest_s, problem.leg_s(from, view));
  }
  return shortest_s;
}

std::vector<std::size_t> all_images(const SweepImages& images) {
  std::vector<std::size_t> all(images.gazes().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

CellBlocks blocks_of(const GridFrame& frame, double block_m) {
  const Eigen::Array3d cells = (block_m / frame.cell_size_m.array()).round();
  return {frame.cells, cells.min(frame.cells.cast<double>()).cast<int>().max(1)};
}

ImagesOfViews worthwhile_images(const PartialScans& scans, const GridFrame& frame,
                                const CellBlocks& blocks, std::span<const Candidate> views,
                                const PlanningProblem& problem) {
  expects(views.size() == problem.views(), "the views of the problem");
  const double image_s = problem.scan_s / static_cast<double>(scans.images.gazes().size());
  ImagesOfViews taken;
  for (std::size_t view = 0; view < views.size(); ++view) {
    const double way_s = shortest_way_s(problem, view);
    if (!std::isfinite(way_s)) {
      taken.push_back(all_images(scans.images));
      continue;
    }
    const SeenBlocks seen{frame, blocks, problem.cells, problem.shows[view],
                          views[view].T_world_sensor};
    taken.push_back(worthwhile_images(
        {gains_of_images(scans.images, seen), image_s, way_s, problem.seen}, scans.gaze));
  }
  return taken;
}

std::vector<double> gains_of_images(const SweepImages& images, const Lookout& lookout) {
  const OccupancyGrid& grid = lookout.grid;
  const CellBlocks blocks = blocks_of(grid.frame, lookout.block_m);
  Candidate view;
  view.T_world_sensor = lookout.T_world_sweep;
  const ShownBlocks shown =
      swept_blocks_of_view(lookout.attenuation, grid, view, lookout.field_of_view, blocks);
  return gains_of_images(
      images, {grid.frame, blocks, shown.cells, shown.shows.front(), lookout.T_world_sweep});
}

std::vector<std::size_t> worthwhile_images(const PartialScans& scans, const ScanToCome& scan) {
  const Lookout& lookout = scan.lookout;
  const auto known =
      static_cast<double>(lookout.grid.size() - lookout.grid.count(CellState::unobserved));
  return worthwhile_images(
      {.gains = gains_of_images(scans.images, lookout),
       .image_s = scan.scan_s / static_cast<double>(scans.images.gazes().size()),
       .way_s = scan.way_s,
       .known = lookout.attenuation.utility * known},
      scans.gaze);
}

void leave_to_images(const SweepImages& images, const ImagesOfViews& taken, const GridFrame& frame,
                     const CellBlocks& blocks, std::span<const Candidate> views,
                     std::span<const float> cells, std::vector<ShownShares>& shows) {
  expects(taken.size() == views.size() && shows.size() == views.size(), "images of each view");
  for (std::size_t view = 0; view < views.size(); ++view) {
    shows[view] = shown_by_images(images, taken[view],
                                  {frame, blocks, cells, shows[view], views[view].T_world_sensor});
  }
}

std::vector<double> shares_of_scan(const SweepImages& images, const ImagesOfViews& taken) {
  std::vector<double> shares;
  for (const auto& of_view : taken) {
    shares.push_back(static_cast<double>(of_view.size()) /
                     static_cast<double>(images.gazes().size()));
  }
  return shares;
}

}  // namespace vantage
