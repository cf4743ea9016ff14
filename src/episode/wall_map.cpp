#include "src/episode/wall_map.hpp"

namespace vantage {

void WallMap::remember(const PlanarScan& scan, double scanner_height_m, const Pose2& T_world_base) {
  append(cloud_, transform(prepare(scan, scanner_height_m), lift(T_world_base)));
}

RegistrationResult WallMap::locate(const PlanarScan& scan, double scanner_height_m,
                                   const Pose2& guess) const {
  if (cloud_.empty()) {
    RegistrationResult unknown;
    unknown.T_world_base = guess;
    unknown.reason = "no wall is known yet";
    return unknown;
  }
  return register_scan(prepare(scan, scanner_height_m), cloud_, guess, options_);
}

PointCloud WallMap::prepare(const PlanarScan& scan, double scanner_height_m) const {
  return prepare_scan(to_cloud(scan, scanner_height_m),
                      lift(scan.T_base_sensor, scanner_height_m).translation(), options_);
}

}  // namespace vantage
