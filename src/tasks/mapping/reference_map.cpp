#include "vantage/tasks/mapping/reference_map.hpp"

#include "vantage/perception/clouds/kd_tree.hpp"

namespace vantage {

void ReferenceMap::remember(const PlanarScan& scan, double scanner_height_m,
                            const Pose2& T_world_base) {
  PointCloud seen = transform(prepare(scan, scanner_height_m), to_se3(T_world_base));
  if (novelty_m_ > 0.0 && !cloud_.empty()) {
    const KdTree known(cloud_.points);
    std::vector<std::size_t> novel;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!known.nearest(seen.points[i], novelty_m_)) novel.push_back(i);
    }
    seen = select(seen, novel);
  }
  append(cloud_, seen);
}

RegistrationResult ReferenceMap::locate(const PlanarScan& scan, double scanner_height_m,
                                        const Pose2& guess, const Correction& plausible) const {
  if (cloud_.empty()) {
    RegistrationResult unknown;
    unknown.T_world_base = guess;
    unknown.reason = "no wall is known yet";
    return unknown;
  }
  return register_scan(prepare(scan, scanner_height_m), cloud_, guess, options_, plausible);
}

bool ReferenceMap::fixes_pose(const PlanarScan& scan, double scanner_height_m) const {
  const PointCloud seen = prepare(scan, scanner_height_m);
  const RegistrationResult found = register_scan(seen, seen, {}, options_);
  return found.converged && found.unconstrained == 0;
}

PointCloud ReferenceMap::prepare(const PlanarScan& scan, double scanner_height_m) const {
  return prepare_scan(to_cloud(scan, scanner_height_m),
                      to_se3(scan.T_base_sensor, scanner_height_m).translation(), options_);
}

}  // namespace vantage
