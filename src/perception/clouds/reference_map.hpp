/// Reference map for localisation: scans of the planar scanner from known poses.
#pragma once

#include <memory>

#include "vantage/perception/clouds/registration.hpp"

namespace vantage {

class ReferenceMap {
 public:
  /// A point nearer than `novelty_m` to one remembered earlier is not remembered: the older a
  /// point, the less drift is in it. 0 remembers all.
  explicit ReferenceMap(const RegistrationOptions& options, double novelty_m = 0.0)
      : options_(options), novelty_m_(novelty_m), posts_(options.posts) {}

  void remember(const PlanarScan& scan, double scanner_height_m, const Pose2& T_world_base);
  /// Where the scan says the base is, by walls or else by posts; `guess` while neither says.
  [[nodiscard]] RegistrationResult locate(const PlanarScan& scan, double scanner_height_m,
                                          const Pose2& guess,
                                          const Correction& plausible = {}) const;
  /// Whether the walls that a scan shows tell, later, where the base was.
  [[nodiscard]] bool walls_fix_pose(const PlanarScan& scan, double scanner_height_m) const;
  /// The same of posts.
  [[nodiscard]] bool posts_fix_pose(const PlanarScan& scan) const;
  /// From now on posts are asked where walls do not say.
  void go_by_posts() { by_posts_ = true; }
  [[nodiscard]] bool goes_by_posts() const { return by_posts_; }
  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }

 private:
  void locate_by_posts(const PlanarScan& scan, const Correction& plausible,
                       RegistrationResult& result) const;
  [[nodiscard]] PointCloud prepare(const PlanarScan& scan, double scanner_height_m) const;

  RegistrationOptions options_;
  double novelty_m_;
  PointCloud cloud_;                         ///< world, with normals
  std::shared_ptr<const UprightMap> walls_;  ///< of it; none while it is empty
  PostMap posts_;
  bool by_posts_ = false;
};

}  // namespace vantage
