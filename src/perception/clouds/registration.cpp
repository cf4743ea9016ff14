#include "vantage/perception/clouds/registration.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vantage {
namespace {

/// A scan point, the map point nearest to it, and the plane through the latter; all in the world.
struct Correspondence {
  Eigen::Vector3d lever;   ///< from the base to the scan point
  Eigen::Vector3d normal;  ///< of the map
  double residual_m;       ///< signed distance of the scan point from the map's plane
};

struct Step {
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;
  int unconstrained = 3;
  Eigen::Matrix3d strength = Eigen::Matrix3d::Zero();  ///< weight of (x, y, yaw) where constrained
};

PointCloud upright_part(const PointCloud& cloud, double max_normal_z) {
  if (!cloud.has_normals()) return cloud;
  std::vector<std::size_t> upright;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& n = cloud.normals[i];
    if (!n.isZero() && std::abs(n.z()) <= max_normal_z) upright.push_back(i);
  }
  return select(cloud, upright);
}

/// @return for each scan point with a compatible partner no farther than `radius_m`, the pair.
std::vector<Correspondence> find_correspondences(const PointCloud& scan_base, const UprightMap& map,
                                                 const Pose2& pose, double radius_m,
                                                 const RegistrationOptions& options) {
  const Pose T_world_base = to_se3(pose);
  const Eigen::Matrix3d rotation = T_world_base.linear();
  const double min_cosine = std::cos(options.max_normal_angle_rad);
  std::vector<Correspondence> correspondences;
  correspondences.reserve(scan_base.size());
  for (std::size_t i = 0; i < scan_base.size(); ++i) {
    const Eigen::Vector3d p = T_world_base * scan_base.points[i].cast<double>();
    const auto found = map.tree.nearest(p.cast<float>(), radius_m);
    if (!found) continue;
    const Eigen::Vector3d normal = map.normals[found->index].cast<double>();
    if (scan_base.has_normals() &&
        normal.dot(rotation * scan_base.normals[i].cast<double>()) < min_cosine) {
      continue;
    }
    const Eigen::Vector3d q = map.tree.points()[found->index].cast<double>();
    correspondences.push_back({p - T_world_base.translation(), normal, normal.dot(p - q)});
  }
  return correspondences;
}

/// Keeps the pairs with the smallest residuals.
void trim(std::vector<Correspondence>& correspondences, double fraction) {
  const auto keep =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(correspondences.size())));
  std::ranges::stable_sort(correspondences, {}, [](const Correspondence& correspondence) {
    return std::abs(correspondence.residual_m);
  });
  correspondences.resize(std::min(keep, correspondences.size()));
}

/// rho'(r) / r of the Geman-McClure kernel, 1 at r = 0.
double robust_weight(double residual_m, double scale_m) {
  const double ratio = residual_m / scale_m;
  const double w = 1.0 / (1.0 + ratio * ratio);
  return w * w;
}

/// How far a pair may be off, squared. A step of a walk from scan to scan shares few errors with
/// the next one, and a prior would pull each of them; a map shares all of its own.
double pair_variance_m2(const RegistrationOptions& options, const PosePrior* prior) {
  const double sigma_m = prior == nullptr ? options.voxel_m : options.kernel_scale_m;
  return sigma_m * sigma_m;
}

/// Share of a direction's strength that the noise of normals alone says; the prior decides where
/// there is no more.
constexpr double kNoiseShare = 0.003;

/// To the maximum of the posterior: the step that surfaces want, and the way back to the prior.
Eigen::Vector3d posterior_step(const Eigen::Matrix3d& information, const Eigen::Vector3d& wanted,
                               const Pose2& pose, const PosePrior& prior) {
  const Pose2& mean = prior.T_world_base;
  const Eigen::Vector3d back(mean.x_m - pose.x_m, mean.y_m - pose.y_m,
                             wrap_angle(mean.yaw_rad - pose.yaw_rad));
  return (information + prior.information)
      .ldlt()
      .solve(information * wanted + prior.information * back);
}

/// Root mean square.
double mean_lever_m(const std::vector<Correspondence>& pairs) {
  double lever2 = 0.0;
  for (const Correspondence& pair : pairs) lever2 += pair.lever.head<2>().squaredNorm();
  return std::sqrt(lever2 / static_cast<double>(pairs.size()));
}

struct NormalEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double weights = 0.0;  ///< their sum
};

/// @param arm_m a turn times this is the third unknown
NormalEquations normal_equations(const std::vector<Correspondence>& pairs, double kernel_m,
                                 double arm_m) {
  NormalEquations sum;
  for (const auto& [lever, normal, residual_m] : pairs) {
    const double moment = normal.y() * lever.x() - normal.x() * lever.y();
    const Eigen::Vector3d row(normal.x(), normal.y(), moment / arm_m);
    const double w = robust_weight(residual_m, kernel_m);
    sum.matrix += w * row * row.transpose();
    sum.gradient += w * residual_m * row;
    sum.weights += w;
  }
  return sum;
}

/// One Gauss-Newton step on  sum_i w_i (r_i + n_i . (d + theta z x l_i))^2  [ChenMedioni1992, (4)].
/// The turn is scaled by the mean lever so that all three unknowns are metres; eigenvectors of the
/// normal matrix that hardly any surface constrains are left out [ZhangKaessSingh2016, (16)].
Step gauss_newton_step(const std::vector<Correspondence>& correspondences, double kernel_m,
                       const RegistrationOptions& options, const Pose2& pose,
                       const PosePrior* prior) {
  const double arm_m = mean_lever_m(correspondences);
  if (!(arm_m > 0.0)) return {};
  const NormalEquations equations = normal_equations(correspondences, kernel_m, arm_m);
  // Per unit weight: a bad start makes all weights small, which is no lack of constraint.
  const double min_share =
      prior != nullptr
          ? kNoiseShare
          : std::max(options.min_constraint, options.min_constraint_correspondences /
                                                 static_cast<double>(correspondences.size()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(equations.matrix);
  Eigen::Vector3d solution = Eigen::Vector3d::Zero();
  Step step;
  for (int i = 0; i < 3; ++i) {
    const double strength = solver.eigenvalues()[i];
    if (!(strength > min_share * equations.weights)) continue;
    const Eigen::Vector3d direction = solver.eigenvectors().col(i);
    solution -= direction * (direction.dot(equations.gradient) / strength);
    const double said = prior == nullptr ? strength : strength - min_share * equations.weights;
    step.strength += said * direction * direction.transpose();
    --step.unconstrained;
  }
  const Eigen::Vector3d scale(1.0, 1.0, arm_m);
  step.strength = scale.asDiagonal() * step.strength * scale.asDiagonal();
  if (prior != nullptr) {
    const Eigen::Vector3d wanted(solution.x(), solution.y(), solution.z() / arm_m);
    const double per_m2 = 1.0 / pair_variance_m2(options, prior);
    solution = posterior_step(per_m2 * step.strength, wanted, pose, *prior);
    solution.z() *= arm_m;
  }
  step.shift_m = solution.head<2>();
  step.turn_rad = solution.z() / arm_m;
  return step;
}

double rms_residual(const std::vector<Correspondence>& correspondences) {
  double sum = 0.0;
  for (const Correspondence& correspondence : correspondences)
    sum += correspondence.residual_m * correspondence.residual_m;
  return std::sqrt(sum / static_cast<double>(correspondences.size()));
}

/// Iterates until a step at the smallest search radius is negligible. `result.reason` says why not.
void iterate(const PointCloud& scan_base, const UprightMap& map, const RegistrationOptions& options,
             const PosePrior* prior, RegistrationResult& result) {
  double radius_m = options.max_correspondence_m;
  while (result.iterations < options.max_iterations) {
    ++result.iterations;
    auto correspondences =
        find_correspondences(scan_base, map, result.T_world_base, radius_m, options);
    result.overlap =
        static_cast<double>(correspondences.size()) / static_cast<double>(scan_base.size());
    if (correspondences.size() < static_cast<std::size_t>(options.min_correspondences)) {
      result.reason =
          fmt::format("only {} points have a partner in the map", correspondences.size());
      return;
    }
    trim(correspondences, options.trim_fraction);
    result.rmse_m = rms_residual(correspondences);
    const double kernel_m = std::max(options.kernel_scale_m, radius_m / 3.0);
    const Step step =
        gauss_newton_step(correspondences, kernel_m, options, result.T_world_base, prior);
    result.unconstrained = step.unconstrained;
    result.information = step.strength / pair_variance_m2(options, prior);
    if (step.unconstrained == 3) {
      result.reason = "no surface constrains the pose";
      return;
    }
    Pose2& pose = result.T_world_base;
    pose = {pose.x_m + step.shift_m.x(), pose.y_m + step.shift_m.y(),
            wrap_angle(pose.yaw_rad + step.turn_rad)};
    const bool at_rest = step.shift_m.norm() < options.tolerance_m &&
                         std::abs(step.turn_rad) < options.tolerance_rad;
    if (at_rest && radius_m <= options.min_correspondence_m) return;
    radius_m = std::max(options.min_correspondence_m, radius_m * options.shrink);
  }
  result.reason = fmt::format("no convergence in {} iterations", options.max_iterations);
}

/// Why a pose that the iteration came to rest at is still not to be trusted; empty if it is.
std::string rejection_reason(const RegistrationResult& result, const Pose2& guess,
                             const RegistrationOptions& options, const Correction& plausible) {
  const Pose2& pose = result.T_world_base;
  const double moved_m = std::hypot(pose.x_m - guess.x_m, pose.y_m - guess.y_m);
  const double turned_rad = std::abs(wrap_angle(pose.yaw_rad - guess.yaw_rad));
  if (result.overlap < options.min_overlap) {
    return fmt::format("overlap {:.3f} is below {}", result.overlap, options.min_overlap);
  }
  if (moved_m > options.max_correction_m) {
    return fmt::format("moved {:.3f} m, more than {} m", moved_m, options.max_correction_m);
  }
  if (turned_rad > options.max_correction_rad) {
    return fmt::format("turned {:.3f} rad, more than {} rad", turned_rad,
                       options.max_correction_rad);
  }
  if (moved_m > plausible.shift_m || turned_rad > plausible.turn_rad) {
    return fmt::format("moved {:.3f} m and {:.3f} rad, odometry explains {:.3f} m and {:.3f} rad",
                       moved_m, turned_rad, plausible.shift_m, plausible.turn_rad);
  }
  return {};
}

RegistrationResult register_from(const PointCloud& scan_base, const UprightMap& map,
                                 const Pose2& T_world_base_guess, const PosePrior* prior,
                                 const RegistrationOptions& options, const Correction& plausible) {
  RegistrationResult result;
  result.T_world_base = T_world_base_guess;
  const PointCloud scan =
      upright_part(voxel_downsample(scan_base, options.voxel_m), options.max_normal_z);
  if (map.tree.size() == 0 || scan.empty()) {
    result.reason =
        map.tree.size() == 0 ? "the map has no upright surface" : "the scan has no upright surface";
    return result;
  }
  iterate(scan, map, options, prior, result);
  if (result.reason.empty()) {
    result.reason = rejection_reason(result, T_world_base_guess, options, plausible);
  }
  result.converged = result.reason.empty();
  if (!result.converged) {
    result.T_world_base = T_world_base_guess;
    result.information.setZero();
  }
  return result;
}

}  // namespace

void RegistrationOptions::check() const {
  if (min_correspondence_m > max_correspondence_m) {
    throw ConfigError("min_correspondence_m must not be above max_correspondence_m");
  }
}

PointCloud prepare_scan(const PointCloud& cloud, const Eigen::Vector3d& p_viewpoint,
                        const RegistrationOptions& options) {
  PointCloud thin = voxel_downsample(cloud, options.voxel_m);
  estimate_normals(thin, p_viewpoint, options.normals);
  return thin;
}

UprightMap make_upright_map(const PointCloud& map_world, const RegistrationOptions& options) {
  expects(map_world.empty() || map_world.has_normals(), "the map's cloud needs normals");
  PointCloud upright = upright_part(map_world, options.max_normal_z);
  return {std::move(upright.normals), KdTree(std::move(upright.points))};
}

RegistrationResult register_scan(const PointCloud& scan_base, const UprightMap& map,
                                 const Pose2& T_world_base_guess,
                                 const RegistrationOptions& options, const Correction& plausible) {
  return register_from(scan_base, map, T_world_base_guess, nullptr, options, plausible);
}

RegistrationResult register_scan(const PointCloud& scan_base, const PointCloud& map_world,
                                 const Pose2& T_world_base_guess,
                                 const RegistrationOptions& options, const Correction& plausible) {
  return register_scan(scan_base, make_upright_map(map_world, options), T_world_base_guess, options,
                       plausible);
}

RegistrationResult register_with_prior(const PointCloud& scan_base, const PointCloud& map_world,
                                       const PosePrior& prior, const RegistrationOptions& options,
                                       const Correction& plausible) {
  return register_from(scan_base, make_upright_map(map_world, options), prior.T_world_base, &prior,
                       options, plausible);
}

}  // namespace vantage
