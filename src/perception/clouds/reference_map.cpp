#include "vantage/perception/clouds/reference_map.hpp"

#include <cmath>

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
  walls_ = std::make_shared<const UprightMap>(make_upright_map(cloud_, options_));
  posts_.remember(find_posts(scan, options_.posts), T_world_base);
}

RegistrationResult ReferenceMap::locate(const PlanarScan& scan, double scanner_height_m,
                                        const Pose2& guess, const Correction& plausible) const {
  RegistrationResult result;
  result.T_world_base = guess;
  result.reason = "no wall is known yet";
  if (!cloud_.empty()) {
    result = register_scan(prepare(scan, scanner_height_m), *walls_, guess, options_, plausible);
  }
  if (!result.converged && by_posts_) locate_by_posts(scan, plausible, result);
  return result;
}

/// Leaves `result` as it is, with its reason, if they say nothing either.
void ReferenceMap::locate_by_posts(const PlanarScan& scan, const Correction& plausible,
                                   RegistrationResult& result) const {
  const Pose2 guess = result.T_world_base;
  const PostFix fix = posts_.locate(find_posts(scan, options_.posts), guess);
  const Pose2& pose = fix.T_world_base;
  const double shift_m = std::hypot(pose.x_m - guess.x_m, pose.y_m - guess.y_m);
  const double turn_rad = std::abs(wrap_angle(pose.yaw_rad - guess.yaw_rad));
  if (!fix.found || shift_m > plausible.shift_m || turn_rad > plausible.turn_rad) return;
  result = {};
  result.T_world_base = pose;
  result.converged = true;
  result.information = fix.information;
}

bool ReferenceMap::walls_fix_pose(const PlanarScan& scan, double scanner_height_m) const {
  const PointCloud seen = prepare(scan, scanner_height_m);
  const RegistrationResult found = register_scan(seen, seen, {}, options_);
  return found.converged && found.unconstrained == 0;
}

bool ReferenceMap::posts_fix_pose(const PlanarScan& scan) const {
  const auto posts = find_posts(scan, options_.posts);
  PostMap here(options_.posts);
  here.remember(posts, {});
  return here.locate(posts, {}).found;
}

PointCloud ReferenceMap::prepare(const PlanarScan& scan, double scanner_height_m) const {
  return prepare_scan(to_cloud(scan, scanner_height_m),
                      to_se3(scan.T_base_sensor, scanner_height_m).translation(), options_);
}

}  // namespace vantage
