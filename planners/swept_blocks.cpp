#include "vantage/planners/swept_blocks.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/planners/visibility/visibility_sweep.hpp"

namespace vantage {
namespace {

/// A share of less than that of a block is none: the traces that interpolation leaves.
constexpr float kLeastShare = 0.01F;

/// Adds the utility of the cells of a row along x, one after the other, to that of their blocks.
void add_row(const float* utility, int begin, int end, int edge, float* block) {
  for (int x = begin; x < end;) {
    const int next = std::min((x / edge + 1) * edge, end);
    float& sum = block[x / edge];
    sum = std::accumulate(utility + x, utility + next, sum,
                          [](float so_far, float cell) { return so_far + std::max(cell, 0.0F); });
    x = next;
  }
}

std::vector<float> unobserved_of_blocks(const SweepTables& tables, const CellBlocks& blocks,
                                        int threads) {
  const auto& [begin, end] = tables.region;
  std::vector<float> cells(blocks.size(), 0.0F);
  const float* utility = tables.layers[2].get();  // in the order of the grid's index
  parallel_for(static_cast<std::size_t>(blocks.blocks().z()), threads, [&](std::size_t slab) {
    const int low = static_cast<int>(slab) * blocks.edge.z();
    for (int z = std::max(low, begin.z()); z < std::min(low + blocks.edge.z(), end.z()); ++z) {
      for (int y = begin.y(); y < end.y(); ++y) {
        add_row(utility + tables.frame.index({0, y, z}), begin.x(), end.x(), blocks.edge.x(),
                &cells[blocks.index_of_cell({0, y, z})]);
      }
    }
  });
  return cells;
}

ShownShares shown_by_view(const SweepTables& tables, const Candidate& candidate,
                          const FieldOfView& field_of_view, const CellBlocks& blocks,
                          const std::vector<float>& cells) {
  BlockSums seen(blocks);
  const std::array view{
      SweptView{ViewCone(candidate.T_world_sensor, field_of_view), kNoRays, &seen}};
  for (const Pyramid& pyramid : kPyramids) sweep_pyramid(tables, view, pyramid);
  return shares_of_blocks(seen.sums(), cells);
}

}  // namespace

ShownShares shares_of_blocks(const std::vector<float>& seen, const std::vector<float>& cells) {
  ShownShares shown;
  for (std::size_t block = 0; block < seen.size(); ++block) {
    if (seen[block] <= kLeastShare * cells[block]) continue;
    shown.block.push_back(static_cast<std::uint32_t>(block));
    shown.share.push_back(std::min(seen[block] / cells[block], 1.0F));
  }
  return shown;
}

ShownBlocks swept_blocks(const Attenuation& attenuation, const OccupancyGrid& grid,
                         std::span<const Candidate> candidates, const FieldOfView& field_of_view,
                         const CellBlocks& blocks, int threads) {
  const SweepTables tables(grid, attenuation, threads);
  ShownBlocks result{unobserved_of_blocks(tables, blocks, threads), {}};
  result.shows.resize(candidates.size());
  parallel_for(candidates.size(), threads, [&](std::size_t i) {
    result.shows[i] = shown_by_view(tables, candidates[i], field_of_view, blocks, result.cells);
    poll_stop();
  });
  return result;
}

ShownBlocks swept_blocks_of_view(const Attenuation& attenuation, const OccupancyGrid& grid,
                                 const Candidate& candidate, const FieldOfView& field_of_view,
                                 const CellBlocks& blocks) {
  const SweepTables tables(grid, attenuation, 1,
                           region_of_sweeps(grid.frame, candidate.T_world_sensor.translation(),
                                            field_of_view.range_max_m, blocks.edge));
  ShownBlocks result{unobserved_of_blocks(tables, blocks, 1), {}};
  result.shows.push_back(shown_by_view(tables, candidate, field_of_view, blocks, result.cells));
  return result;
}

ShownBlocks separate_blocks(std::span<const double> gains) {
  ShownBlocks result;
  for (const double gain : gains) {
    const auto block = static_cast<std::uint32_t>(result.cells.size());
    result.cells.push_back(static_cast<float>(std::max(gain, 0.0)));
    result.shows.push_back({{block}, {1.0F}});
  }
  return result;
}

}  // namespace vantage
