/// Laser scanners by ray casting: a tilting one that looks at the scene, a planar one for driving.
#pragma once

#include <functional>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/sim/sensors/laser_options.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"

namespace vantage {

/// Collects the lines of one scan while the tilt joint moves.
class ScanBuilder {
 public:
  /// @throws ConfigError if the options are out of range.
  explicit ScanBuilder(const LaserOptions& options);

  /// Measures one line. `T_world_laser`: x along the middle beam, z normal to the scan plane, thus
  /// turned by the true tilt; `measured_tilt_rad` is what the joint's encoder says. `sensor_body`
  /// carries the sensor and is not seen. `spoil` says what arrives of the ranges that were
  /// measured, in place; may be empty.
  void add_line(const RayScene& scene, const Pose& T_world_laser, double measured_tilt_rad,
                int sensor_body, Rng& rng,
                const std::function<void(std::vector<float>&)>& spoil = {});

  /// The scan so far, lines by ascending tilt; of lines closer together than a microradian (the
  /// joint stood still) only the first. Leaves the builder empty.
  RangeScan finish();

 private:
  struct Line {
    double tilt_rad;
    std::vector<float> range_m;
  };
  LaserOptions options_;
  std::vector<double> azimuth_rad_;
  std::vector<Line> lines_;
};

/// One line from `T_world_scanner` (x along the middle beam, z normal to the scan plane).
PlanarScan planar_scan(const RayScene& scene, const Pose& T_world_scanner,
                       const Pose2& T_base_scanner, int sensor_body,
                       const PlanarScannerOptions& options, Rng& rng);

}  // namespace vantage
