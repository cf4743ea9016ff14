#include "vantage/planners/swept_blocks.hpp"

#include <algorithm>
#include <array>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/planners/visibility/visibility_sweep.hpp"

namespace vantage {
namespace {

/// A share of less than that of a block is none: the traces that interpolation leaves.
constexpr float kLeastShare = 0.01F;

std::vector<float> unobserved_of_blocks(const SweepTables& tables, const CellBlocks& blocks) {
  std::vector<float> cells(blocks.size(), 0.0F);
  const float* utility = tables.layers[2].get();  // in the order of the grid's index
  std::size_t i = 0;
  for (int z = 0; z < blocks.cells.z(); ++z) {
    for (int y = 0; y < blocks.cells.y(); ++y) {
      for (int x = 0; x < blocks.cells.x(); ++x, ++i) {
        if (utility[i] > 0.0F) cells[blocks.index_of_cell({x, y, z})] += utility[i];
      }
    }
  }
  return cells;
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
  ShownBlocks result{unobserved_of_blocks(tables, blocks), {}};
  result.shows.resize(candidates.size());
  parallel_for(candidates.size(), threads, [&](std::size_t i) {
    BlockSums seen(blocks);
    const std::array view{
        SweptView{ViewCone(candidates[i].T_world_sensor, field_of_view), kNoRays, &seen}};
    for (const Pyramid& pyramid : kPyramids) sweep_pyramid(tables, view, pyramid);
    result.shows[i] = shares_of_blocks(seen.sums(), result.cells);
    poll_stop();
  });
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
