/// Reference map for localisation: scans of the planar scanner from known poses.
#pragma once

#include "vantage/perception/clouds/registration.hpp"

namespace vantage {

class ReferenceMap {
 public:
  /// A point nearer than `novelty_m` to one remembered earlier is not remembered: the older a
  /// point, the less drift is in it. 0 remembers all.
  explicit ReferenceMap(const RegistrationOptions& options, double novelty_m = 0.0)
      : options_(options), novelty_m_(novelty_m) {}

  void remember(const PlanarScan& scan, double scanner_height_m, const Pose2& T_world_base);
  /// Where the scan says the base is; `guess` while nothing is remembered.
  [[nodiscard]] RegistrationResult locate(const PlanarScan& scan, double scanner_height_m,
                                          const Pose2& guess,
                                          const Correction& plausible = {}) const;
  /// Whether a scan shows enough to tell by it, later, where the base was.
  [[nodiscard]] bool fixes_pose(const PlanarScan& scan, double scanner_height_m) const;
  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }

 private:
  [[nodiscard]] PointCloud prepare(const PlanarScan& scan, double scanner_height_m) const;

  RegistrationOptions options_;
  double novelty_m_;
  PointCloud cloud_;  ///< world, with normals
};

}  // namespace vantage
