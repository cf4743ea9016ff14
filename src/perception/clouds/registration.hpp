/// Where did the robot really stand? Aligns a scan with the map's cloud, starting from odometry.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/perception/clouds/kd_tree.hpp"
#include "vantage/perception/clouds/normals.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/perception/clouds/posts.hpp"

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
  double min_constraint = 0.005;  ///< noise of the normals alone gives about 0.002
  double min_constraint_correspondences = 3.0;
  double min_overlap = 0.02;
  int min_correspondences = 40;
  int max_iterations = 60;
  double tolerance_m = 5e-5;
  double tolerance_rad = 2e-5;
  double max_correction_m = 0.25;
  double max_correction_rad = 0.15;
  PostOptions posts;
  void fields(auto&& f) {
    f("voxel_m", voxel_m, "voxel size that a scan is thinned to; higher is faster and coarser",
      above(0.0));
    f("normals", normals, "how the surface normals of a scan are estimated");
    f("max_correspondence_m", max_correspondence_m,
      "search radius for correspondences at first; higher tolerates a worse initial pose",
      above(0.0));
    f("min_correspondence_m", min_correspondence_m,
      "search radius for correspondences at last; higher lets in more outliers", above(0.0));
    f("shrink", shrink, "factor of the search radius per iteration; higher narrows it more slowly",
      between(0.1, 0.99));
    f("trim_fraction", trim_fraction,
      "share of the correspondences that is kept, the best ones; higher trusts more of them",
      between(0.1, 1.0));
    f("kernel_scale_m", kernel_scale_m,
      "residual that the robust kernel weights by 1/4, once the search radius is small; higher "
      "tolerates more noise",
      above(0.0));
    f("max_normal_angle_rad", max_normal_angle_rad,
      "greatest angle between the normals of a correspondence; higher keeps more of them",
      between(0.0, 3.1416));
    f("max_normal_z", max_normal_z,
      "greatest |z| of the unit normal of a surface that counts; flatter ones tell nothing of x, y "
      "and yaw",
      between(0.0, 1.0));
    f("min_constraint", min_constraint,
      "least mean squared alignment of the surface normals with a direction, below which odometry "
      "decides along it",
      between(0.0, 1.0));
    f("min_constraint_correspondences", min_constraint_correspondences,
      "the same as a number of correspondences whose normals point along the direction; the "
      "stricter of both holds",
      at_least(0.0));
    f("min_overlap", min_overlap,
      "least share of the points on upright surfaces with a correspondence, below which the result "
      "is rejected",
      between(0.0, 1.0));
    f("min_correspondences", min_correspondences,
      "least number of correspondences, below which the result is rejected", at_least(3));
    f("max_iterations", max_iterations,
      "greatest number of iterations; without convergence by then the result is rejected",
      at_least(1));
    f("tolerance_m", tolerance_m,
      "length of a step below which the registration has converged, if it turns less than "
      "`tolerance_rad`",
      above(0.0));
    f("tolerance_rad", tolerance_rad,
      "turn of a step below which the registration has converged, if it is shorter than "
      "`tolerance_m`",
      above(0.0));
    f("max_correction_m", max_correction_m,
      "greatest distance of the result from the initial pose, beyond which it is rejected",
      above(0.0));
    f("max_correction_rad", max_correction_rad,
      "greatest turn of the result from the initial pose, beyond which it is rejected", above(0.0));
    f("posts", posts,
      "posts, such as the legs of a table, by which the base is located where walls do not do");
  }
  void check() const;  ///< the search radius shrinks
};

/// How far a registration may move the guess.
struct Correction {
  double shift_m = std::numeric_limits<double>::infinity();
  double turn_rad = std::numeric_limits<double>::infinity();
};

/// What is known of a pose before its scan is registered.
struct PosePrior {
  Pose2 T_world_base;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< inverse covariance of (x, y, yaw)
};

struct RegistrationResult {
  Pose2 T_world_base;  ///< the guess itself unless converged
  bool converged = false;
  std::string reason;    ///< why not; empty when converged
  double rmse_m = 0.0;   ///< point-to-plane, of the pairs of the last iteration
  double overlap = 0.0;  ///< share of upright scan points with a partner, [0, 1]
  int iterations = 0;
  int unconstrained = 0;  ///< directions of (x, y, yaw) left to odometry in the last iteration
  /// Inverse covariance of (x, y, yaw), each pair good to `voxel_m`; zero in directions that are
  /// left to odometry, and unless converged.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

/// Thins a raw cloud and gives it normals towards `p_viewpoint` (same frame): what register_scan
/// works on, and what is worth appending to the map's cloud afterwards.
PointCloud prepare_scan(const PointCloud& cloud, const Eigen::Vector3d& p_viewpoint,
                        const RegistrationOptions& options);

/// The surfaces of a map that tell something of x, y and yaw, ready to be searched; world.
struct UprightMap {
  std::vector<Eigen::Vector3f> normals;
  KdTree tree;
};

/// @param map_world points with normals in the world frame; must have normals unless empty
UprightMap make_upright_map(const PointCloud& map_world, const RegistrationOptions& options);

/// Point-to-plane ICP [BeslMcKay1992, ChenMedioni1992] over x, y and yaw of the base; height, roll
/// and pitch are known. Directions that no surface constrains keep the guess [ZhangKaessSingh2016].
/// @param scan_base points in the base frame; normals, if any, sort out opposite faces
/// @param map made by the same options
/// @param plausible corrections beyond these are no drift but a wrong optimum
/// Never throws: a result that cannot be trusted is the guess, with the reason.
RegistrationResult register_scan(const PointCloud& scan_base, const UprightMap& map,
                                 const Pose2& T_world_base_guess,
                                 const RegistrationOptions& options,
                                 const Correction& plausible = {});

/// The same on a map that no other scan is registered on.
RegistrationResult register_scan(const PointCloud& scan_base, const PointCloud& map_world,
                                 const Pose2& T_world_base_guess,
                                 const RegistrationOptions& options,
                                 const Correction& plausible = {});

/// The same as a maximum of the posterior: nothing is left out or taken whole, each direction
/// weighs what the surfaces say of it, above what noise of their normals alone would say, against
/// the prior, each pair good to `kernel_scale_m`. The prior is the initial guess. Its information
/// is not in the result's.
RegistrationResult register_with_prior(const PointCloud& scan_base, const PointCloud& map_world,
                                       const PosePrior& prior, const RegistrationOptions& options,
                                       const Correction& plausible = {});

}  // namespace vantage
