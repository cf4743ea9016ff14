/// An upright cylinder: as much of an object's shape as one needs to know what hides it.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace vantage {

struct UprightCylinder {
  Eigen::Vector3d p_foot_m = Eigen::Vector3d::Zero();  ///< middle of the foot, world
  double radius_m = 0.0;
  double height_m = 0.0;

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_world_m, double margin_m = 0.0) const {
    const Eigen::Vector3d d = p_world_m - p_foot_m;
    return d.head<2>().norm() <= radius_m + margin_m && d.z() >= -margin_m &&
           d.z() <= height_m + margin_m;
  }
};

struct SurfaceSample {
  Eigen::Vector3d p_world_m;
  double weight = 0.0;  ///< share of the surface as the eye sees it
};

/// Places spread over the part of the surface that faces the eye, by the area that the eye sees:
/// half of the side, and the top if the eye is above it. Weights sum to 1. The eye is taken to be
/// far away: rays to all samples are parallel.
/// @param p_eye_m outside of the cylinder
std::vector<SurfaceSample> facing_samples(const UprightCylinder& cylinder,
                                          const Eigen::Vector3d& p_eye_m);

}  // namespace vantage
