/// How likely an unobserved cell stops a beam, learnt from the scans so far.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/belief/map/block_field.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/grid_part.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

struct ClutterHazardOptions {
  int layers = 13;
  double prior_crossings = 300.0;
  int block_cells = 6;
  double reach_cells = 20.0;
  double block_crossings = 1000.0;
  double prior_hazard = 0.005;
  double prior_weight = 300.0;
  void fields(auto&& f) {
    f("layers", layers,
      "number of height layers with a hazard of their own; more tell heights apart",
      between(1, 4096));
    f("prior_crossings", prior_crossings,
      "number of crossings that the global hazard is worth to a layer; higher gives layers less "
      "detail",
      at_least(0.0));
    f("block_cells", block_cells,
      "edge of the blocks of a layer that have a hazard of their own; lower tells places apart",
      between(1, 4096));
    f("reach_cells", reach_cells,
      "standard deviation of the neighbourhood that a block learns from; higher is smoother",
      between(0.0, 4096.0));
    f("block_crossings", block_crossings,
      "number of crossings that the layer's hazard is worth to a block; higher gives blocks less "
      "detail",
      above(0.0));
    f("prior_hazard", prior_hazard,
      "prior mean of the probability, per cell, that an unobserved cell stops a beam; higher sees "
      "less deep at first",
      between(1e-6, 0.999));
    f("prior_weight", prior_weight,
      "number of crossings that the prior is worth; higher learns more slowly", above(0.0));
  }
};

/// A beam that enters unobserved cells is a survival experiment: each cell entered is one crossing,
/// and the cell that stops it one hit. The hazard of an unobserved cell is hits / crossings, its
/// transmission 1 - hazard. A cell beside an occupied one is left out: what stops a beam there is
/// as a rule the surface known already, measured a little off. Clutter has its heights and its
/// places: each height layer has a rate, shrunk towards that of all layers, and each block of a
/// layer one of what was counted round it, shrunk towards the layer's.
class ClutterHazard {
 public:
  /// @param cells of the grid along each axis, >= 1
  /// @throws ConfigError if `options` are out of range.
  ClutterHazard(const ClutterHazardOptions& options, const Eigen::Array3i& cells);

  /// Counts the beams of one scan through the grid as it was before that scan. A beam counts until
  /// it ends, or meets a cell then known to be occupied, which is no hit; without a return it
  /// crosses all to the range or the grid's end. NaN beams are ignored. Does not depend on
  /// `threads`.
  void observe(const OccupancyGrid& before, const RangeScan& scan, const Pose& T_world_sensor,
               int threads = 1);

  /// The same for the depth images of one scan, of which every `stride`-th pixel of every
  /// `stride`-th row is a beam; pixels without measurement are ignored, those beyond range cross
  /// all to the range. What is lower than `floor_m` is the floor, which is no clutter: a beam
  /// counts down to there.
  void observe(const OccupancyGrid& before, std::span<const PosedImage> images, int stride,
               double floor_m, int threads = 1);

  [[nodiscard]] int layer_of(int slice) const { return crossings_.layout.block_of(2, slice); }
  [[nodiscard]] double crossings(int layer) const { return sum_of_layer(crossings_, layer); }
  [[nodiscard]] double hits(int layer) const { return sum_of_layer(hits_, layer); }

  /// Posterior means, per cell entered; in (0, 1) with a prior, without one 0 and 1 too.
  [[nodiscard]] double global_hazard() const;
  [[nodiscard]] double hazard(int layer) const;
  [[nodiscard]] double global_transmission() const { return 1.0 - global_hazard(); }
  /// 1 - hazard of the slice's layer, for every z slice of the grid.
  [[nodiscard]] std::vector<double> transmission_per_slice() const;
  /// 1 - hazard of each block.
  [[nodiscard]] BlockField transmission() const;

 private:
  [[nodiscard]] double sum_of_layer(const BlockField& counts, int layer) const;
  /// Ends at what it met, or goes on beyond.
  struct Beam {
    Eigen::Vector3d p_from;  ///< world
    Eigen::Vector3d p_end;   ///< world
    bool returned;
  };
  /// What beams have met, block by block.
  struct Counts {
    std::vector<double> crossings;
    std::vector<double> hits;
  };
  /// What a cell is to a beam.
  enum class Met : std::uint8_t { free, unobserved, unobserved_beside_occupied, occupied };
  struct MetCells {
    const GridFrame& frame;
    GridPart reach;  ///< of the beams
    std::vector<Met> cells;
  };

  void count_beams(const OccupancyGrid& before, std::span<const Beam> beams, int threads);
  void count_beam(const MetCells& before, const Beam& beam, Counts& counts) const;
  static MetCells met_cells(const OccupancyGrid& grid, const GridPart& reach, int threads);

  ClutterHazardOptions options_;
  BlockField crossings_;
  BlockField hits_;
  std::vector<std::size_t> column_of_;  ///< block in its layer, for each cell of a slice
};

}  // namespace vantage
