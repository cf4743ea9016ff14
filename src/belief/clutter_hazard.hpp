/// How likely an unobserved cell stops a beam, learnt from the scans so far.
#pragma once

#include <cstddef>
#include <vector>

#include "src/belief/occupancy_grid.hpp"
#include "src/core/fields.hpp"
#include "src/geometry/range_scan.hpp"

namespace vantage {

struct ClutterHazardOptions {
  int layers = 13;                 ///< height bands with a rate of their own
  double prior_crossings = 300.0;  ///< pull of a layer towards the global rate; higher: less detail
  double prior_hazard = 0.005;     ///< mean of the Beta prior on the global rate, per cell
  double prior_weight = 300.0;     ///< crossings the prior is worth; higher: slower to learn
  void fields(auto&& f) {
    f("layers", layers, between(1, 4096));
    f("prior_crossings", prior_crossings, at_least(0.0));
    f("prior_hazard", prior_hazard, between(1e-6, 0.999));
    f("prior_weight", prior_weight, above(0.0));
  }
};

/// A beam that enters unobserved cells is a survival experiment: each cell entered is one crossing,
/// and the cell that stops it one hit. The hazard of an unobserved cell is hits / crossings, its
/// transmission 1 - hazard; both per height layer, shrunk towards the rate of all layers.
class ClutterHazard {
 public:
  /// @param slices cells of the grid along z, >= 1
  /// @throws ConfigError if `options` are out of range.
  ClutterHazard(const ClutterHazardOptions& options, int slices);

  /// Counts the beams of one scan through the grid as it was before that scan. A beam counts until
  /// it ends, or meets a cell then known to be occupied, which is no hit; without a return it
  /// crosses all to the range or the grid's end. NaN beams are ignored.
  void observe(const OccupancyGrid& before, const RangeScan& scan, const Pose& T_world_sensor);

  /// The same for a depth image, of which every `stride`-th pixel of every `stride`-th row is a
  /// beam; pixels without measurement are ignored, those beyond range cross all to the range.
  void observe(const OccupancyGrid& before, const CameraImages& image, const Pose& T_world_camera,
               int stride);

  [[nodiscard]] int layer_of(int slice) const { return slice * options_.layers / slices_; }
  [[nodiscard]] double crossings(int layer) const { return counts_of(layer).crossings; }
  [[nodiscard]] double hits(int layer) const { return counts_of(layer).hits; }

  /// Posterior means, per cell entered, in (0, 1).
  [[nodiscard]] double global_hazard() const;
  [[nodiscard]] double hazard(int layer) const;
  [[nodiscard]] double global_transmission() const { return 1.0 - global_hazard(); }
  /// 1 - hazard of the slice's layer, for every z slice of the grid.
  [[nodiscard]] std::vector<double> transmission_per_slice() const;

 private:
  struct Counts {
    double crossings = 0.0;
    double hits = 0.0;
  };
  [[nodiscard]] const Counts& counts_of(int layer) const;
  void count_beam(const OccupancyGrid& before, const Eigen::Vector3d& p_from,
                  const Eigen::Vector3d& p_to, bool returned);

  ClutterHazardOptions options_;
  int slices_;
  std::vector<Counts> counts_;  ///< per layer
};

}  // namespace vantage
