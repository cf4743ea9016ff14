/// Where did the robot really stand? Aligns a scan with the map's cloud, starting from odometry.
#pragma once

#include <Eigen/Core>

#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/perception/clouds/normals.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"

namespace vantage {

struct RegistrationOptions {
  double voxel_m = 0.03;
  NormalOptions normals{.radius_m = 0.12};
  double max_correspondence_m = 0.20;
  double min_correspondence_m = 0.04;
  double shrink = 0.8;
  double trim_fraction = 0.9;
  double kernel_scale_m = 0.01;
  double max_normal_angle_rad = 0.8;
  double max_normal_z = 0.5;
  double min_constraint = 0.005;
  double min_constraint_correspondences = 3.0;
  double min_overlap = 0.02;
  int min_correspondences = 40;
  int max_iterations = 60;
  double tolerance_m = 5e-5;
  double tolerance_rad = 2e-5;
  double max_correction_m = 0.25;
  double max_correction_rad = 0.15;
  void fields(auto&& f) {
    f("voxel_m", voxel_m, "scan is thinned to this; higher is faster and coarser", above(0.0));
    f("normals", normals, "for prepare_scan");
    f("max_correspondence_m", max_correspondence_m,
      "first search radius; higher bears a worse start", above(0.0));
    f("min_correspondence_m", min_correspondence_m,
      "last search radius; higher lets in more outliers", above(0.0));
    f("shrink", shrink, "radius factor per iteration; higher narrows more slowly",
      between(0.1, 0.99));
    f("trim_fraction", trim_fraction, "best share of pairs kept; higher trusts more of them",
      between(0.1, 1.0));
    f("kernel_scale_m", kernel_scale_m, "residual with weight 1/4; higher tolerates more noise",
      above(0.0));
    f("max_normal_angle_rad", max_normal_angle_rad, "pairs whose normals differ more are dropped",
      between(0.0, 3.1416));
    f("max_normal_z", max_normal_z, "surfaces flatter than this say nothing of x, y, yaw",
      between(0.0, 1.0));
    f("min_constraint", min_constraint,
      "least mean squared alignment of the normals with a direction (noise of the normals gives "
      "about 0.002), and",
      between(0.0, 1.0));
    f("min_constraint_correspondences", min_constraint_correspondences,
      "the least number of pairs wholly across it; below either odometry decides there",
      at_least(0.0));
    f("min_overlap", min_overlap, "least share of upright scan points with a partner",
      between(0.0, 1.0));
    f("min_correspondences", min_correspondences, "fewer partners: rejected", at_least(3));
    f("max_iterations", max_iterations, "without convergence by then: rejected", at_least(1));
    f("tolerance_m", tolerance_m, "converged when a step is shorter, and", above(0.0));
    f("tolerance_rad", tolerance_rad, "turns less", above(0.0));
    f("max_correction_m", max_correction_m, "a result farther from the guess is rejected",
      above(0.0));
    f("max_correction_rad", max_correction_rad, "likewise", above(0.0));
  }
  void check() const;  ///< the search radius shrinks
};

struct RegistrationResult {
  Pose2 T_world_base;  ///< the guess itself unless converged
  bool converged = false;
  std::string reason;    ///< why not; empty when converged
  double rmse_m = 0.0;   ///< point-to-plane, of the pairs of the last iteration
  double overlap = 0.0;  ///< share of upright scan points with a partner, [0, 1]
  int iterations = 0;
  int unconstrained = 0;  ///< directions of (x, y, yaw) left to odometry in the last iteration
};

/// Thins a raw cloud and gives it normals towards `p_viewpoint` (same frame): what register_scan
/// works on, and what is worth appending to the map's cloud afterwards.
PointCloud prepare_scan(const PointCloud& cloud, const Eigen::Vector3d& p_viewpoint,
                        const RegistrationOptions& options);

/// Point-to-plane ICP [BeslMcKay1992, ChenMedioni1992] over x, y and yaw of the base; height, roll
/// and pitch are known. Directions that no surface constrains keep the guess [ZhangKaessSingh2016].
/// @param scan_base points in the base frame; normals, if any, sort out opposite faces
/// @param map_world points with normals in the world frame; must have normals unless empty
/// Never throws: a result that cannot be trusted is the guess, with the reason.
RegistrationResult register_scan(const PointCloud& scan_base, const PointCloud& map_world,
                                 const Pose2& T_world_base_guess,
                                 const RegistrationOptions& options);

}  // namespace vantage
