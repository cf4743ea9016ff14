#include "vantage/planners/gaze_choice.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// From where the sweep is taken.
Eigen::Vector3d centre_of_block(const SeenBlocks& seen, const Pose& T_sweep_world,
                                std::uint32_t block) {
  const GridFrame coarse{
      .min_corner_m = seen.frame.min_corner_m,
      .cell_size_m = seen.frame.cell_size_m.cwiseProduct(seen.blocks.edge.cast<double>().matrix()),
      .cells = seen.blocks.blocks()};
  return T_sweep_world * coarse.centre(coarse.cell(block));
}

}  // namespace

std::vector<std::size_t> worthwhile_images(const StopOffer& offer, const GazeOptions& options) {
  const std::vector<double>& gains = offer.gains;
  expects(!gains.empty() && offer.image_s > 0.0 && offer.way_s >= 0.0, "images that take time");
  std::vector<std::size_t> best_first(gains.size());
  std::iota(best_first.begin(), best_first.end(), std::size_t{0});
  std::ranges::stable_sort(best_first, std::greater<>(), [&](std::size_t i) { return gains[i]; });
  std::size_t taken = 1;
  double sum = gains[best_first.front()];
  double time_s = offer.way_s + offer.image_s;
  for (; taken < best_first.size(); ++taken) {
    const double gain = gains[best_first[taken]];
    const bool slow = gain * time_s < options.worth * sum * offer.image_s;
    if (slow || gain < options.share * offer.known) break;
    sum += gain;
    time_s += offer.image_s;
  }
  best_first.resize(taken);
  std::ranges::sort(best_first);
  return best_first;
}

std::vector<double> gains_of_images(const SweepImages& images, const SeenBlocks& seen) {
  const Pose T_sweep_world = seen.T_world_sweep.inverse();
  std::vector<double> gains(images.gazes().size(), 0.0);
  for (std::size_t i = 0; i < seen.shown.block.size(); ++i) {
    const std::uint32_t block = seen.shown.block[i];
    const std::size_t image = images.nearest(centre_of_block(seen, T_sweep_world, block));
    gains[image] += static_cast<double>(seen.shown.share[i] * seen.cells[block]);
  }
  return gains;
}

ShownShares shown_by_images(const SweepImages& images, std::span<const std::size_t> taken,
                            const SeenBlocks& seen) {
  const Pose T_sweep_world = seen.T_world_sweep.inverse();
  ShownShares shown;
  for (std::size_t i = 0; i < seen.shown.block.size(); ++i) {
    const std::uint32_t block = seen.shown.block[i];
    if (!images.any_shows(taken, centre_of_block(seen, T_sweep_world, block))) continue;
    shown.block.push_back(block);
    shown.share.push_back(seen.shown.share[i]);
  }
  return shown;
}

}  // namespace vantage
