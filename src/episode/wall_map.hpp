/// What the planar scanner saw from known places, to drive by.
#pragma once

#include "src/perception/registration.hpp"

namespace vantage {

class WallMap {
 public:
  explicit WallMap(const RegistrationOptions& options) : options_(options) {}

  void remember(const PlanarScan& scan, double scanner_height_m, const Pose2& T_world_base);
  /// Where the scan says the base is; `guess` while nothing is remembered.
  [[nodiscard]] RegistrationResult locate(const PlanarScan& scan, double scanner_height_m,
                                          const Pose2& guess) const;
  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }

 private:
  [[nodiscard]] PointCloud prepare(const PlanarScan& scan, double scanner_height_m) const;

  RegistrationOptions options_;
  PointCloud cloud_;  ///< world, with normals
};

}  // namespace vantage
