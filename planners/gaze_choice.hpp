/// Which images of a sweep a scan takes: those that are worth their time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/gaze.hpp"
#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/tours/planning_problem.hpp"
#include "vantage/planners/visibility/block_sums.hpp"

namespace vantage {

struct GazeOptions {
  double worth = 0.0;
  double share = 0.0;
  double on_the_way_m = 0.0;
  void fields(auto&& f) {
    f("worth", worth,
      "an image is taken if it promises at least so many times the new cells a second that the "
      "whole stop does, the way there included; 1 makes most of the stop's time, higher takes "
      "fewer images; 0: any is worth it",
      between(0.0, 10.0));
    f("share", share,
      "an image is taken if it promises at least so many new cells, as a share of the known ones; "
      "higher leaves more to scans to come, or for ever; 0: any is worth it",
      between(0.0, 0.1));
    f("on_the_way_m", on_the_way_m,
      "distance driven between images that are taken while driving, each where most is promised; "
      "higher takes fewer; 0: none",
      between(0.0, 100.0));
  }
  [[nodiscard]] bool chooses() const { return worth > 0.0 || share > 0.0; }
};

/// What the images of a stop are weighed by.
struct StopOffer {
  std::vector<double> gains;  ///< of each image, none of them counted twice
  double image_s = 0.0;       ///< that one takes, > 0
  double way_s = 0.0;         ///< that it takes to get there, at least 0
  double known = 0.0;         ///< what is known already, in the unit of the gains
};

/// The best images, at least one, up to the first that is not worth its time: one that promises
/// less a second than `worth` times what the stop does with those before it, or too little a share
/// of what is known. Ascending. With `worth` 1 no other choice of images has a higher rate of gain,
/// by the marginal value theorem.  [Charnov1976]
std::vector<std::size_t> worthwhile_images(const StopOffer& offer, const GazeOptions& options);

/// What is seen from one place, by the blocks of a grid's cells.
struct SeenBlocks {
  const GridFrame& frame;
  const CellBlocks& blocks;
  std::span<const float> cells;  ///< per block, as in ShownBlocks
  const ShownShares& shown;      ///< by a whole sweep
  Pose T_world_sweep;
};

/// Per image, what it is expected to show; a block is of the image that looks most directly at it.
std::vector<double> gains_of_images(const SweepImages& images, const SeenBlocks& seen);

/// Of what a whole sweep shows, what `taken` images of it do, block by block.
ShownShares shown_by_images(const SweepImages& images, std::span<const std::size_t> taken,
                            const SeenBlocks& seen);

}  // namespace vantage
