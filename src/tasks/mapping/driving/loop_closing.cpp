#include "vantage/tasks/mapping/driving/loop_closing.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/localisation/map_contradiction.hpp"

namespace vantage {
namespace {

/// At that distance a heading moves what is seen.
constexpr double kSight_m = 3.0;
/// Poses of loops are not taken where beams go through walls so many times as often as at the
/// tracked ones: such loops are false. A little more often is no sign of it, as a pose that is
/// tracked by the walls just seen fits these best.
constexpr double kMuchWorse = 1.5;
/// Encoders and time stamps are no better.
const Eigen::Vector3d kLeastSigma(0.001, 0.001, 0.0005);

double moved_m(const Pose2& from, const Pose2& to) {
  return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) +
         kSight_m * std::abs(wrap_angle(to.yaw_rad - from.yaw_rad));
}

}  // namespace

Pose2 PoseCorrection::moved(const Pose2& T_world_base, std::size_t keyframe) const {
  return compose(T_world_after[keyframe], compose(inverse(T_world_before[keyframe]), T_world_base));
}

Eigen::Vector2d PoseCorrection::moved(const Eigen::Vector2d& p_world_m,
                                      std::size_t keyframe) const {
  const Pose2 there = moved(Pose2{p_world_m.x(), p_world_m.y(), 0.0}, keyframe);
  return {there.x_m, there.y_m};
}

Eigen::Matrix3d wheel_covariance(const OdometryOptions& odometry, double driven_m,
                                 double turned_rad) {
  const auto grown = [&](double sigma, double bias) {
    return (sigma * sigma + 2.0 * odometry.bias_length_m * bias * bias) * driven_m;
  };
  const double place_m2 = grown(odometry.sigma_translation_m, odometry.bias_translation_m_per_m);
  const double yaw_rad2 = grown(odometry.sigma_yaw_rad, odometry.bias_yaw_rad_per_m) +
                          odometry.sigma_turn_rad * odometry.sigma_turn_rad * turned_rad;
  Eigen::Matrix3d covariance = kLeastSigma.cwiseAbs2().asDiagonal();
  // A heading that is lost evenly along the step moves its end by half of it.
  covariance(0, 0) += place_m2;
  covariance(1, 1) += place_m2 + yaw_rad2 * driven_m * driven_m / 3.0;
  covariance(2, 2) += yaw_rad2;
  covariance(1, 2) = covariance(2, 1) = 0.5 * yaw_rad2 * driven_m;
  return covariance;
}

LoopClosing::LoopClosing(const LoopOptions& options, const RegistrationOptions& registration,
                         const OdometryOptions& odometry, const Pose2& T_world_base)
    : options_(options),
      registration_(registration),
      odometry_(odometry),
      graph_(options, registration),
      T_world_put_(T_world_base) {}

void LoopClosing::moved_to(const Pose2& T_world_base_wheels, const Pose2& T_world_base) {
  const Pose2 step = compose(inverse(T_world_put_), T_world_base_wheels);
  T_keyframe_wheels_ = compose(T_keyframe_wheels_, step);
  driven_m_ += std::hypot(step.x_m, step.y_m);
  turned_rad_ += std::abs(step.yaw_rad);
  T_world_put_ = T_world_base;
}

void LoopClosing::remember(const PlanarScan& scan, double scanner_height_m,
                           const Pose2& T_world_base) {
  const PointCloud seen =
      prepare_scan(to_cloud(scan, scanner_height_m),
                   to_se3(scan.T_base_sensor, scanner_height_m).translation(), registration_);
  if (graph_.size() == 0) {
    graph_.begin(seen, T_world_base);
  } else {
    graph_.add(
        seen, {T_keyframe_wheels_, wheel_covariance(odometry_, driven_m_, turned_rad_), driven_m_});
    graph_.close_loops();
  }
  remembered_.push_back({scan, scanner_height_m, T_world_base});
  T_keyframe_wheels_ = {};
  driven_m_ = turned_rad_ = 0.0;
}

double LoopClosing::disagreement_m() const {
  double most_m = 0.0;
  for (std::size_t i = 0; i < remembered_.size(); ++i) {
    most_m = std::max(most_m, moved_m(remembered_[i].T_world_base, graph_.T_world_bases()[i]));
  }
  return most_m;
}

bool LoopClosing::wants_correction() const {
  if (graph_.loops() <= loops_corrected_ || disagreement_m() <= options_.correct_m) return false;
  std::vector<Pose2> tracked;
  for (const Remembered& seen : remembered_) tracked.push_back(seen.T_world_base);
  return contradicted_at(graph_.T_world_bases()) <= kMuchWorse * contradicted_at(tracked);
}

PoseCorrection LoopClosing::correct() {
  PoseCorrection correction;
  correction.T_world_after = graph_.T_world_bases();
  for (std::size_t i = 0; i < remembered_.size(); ++i) {
    correction.T_world_before.push_back(remembered_[i].T_world_base);
    remembered_[i].T_world_base = correction.T_world_after[i];
  }
  loops_corrected_ = graph_.loops();
  ++corrections_;
  return correction;
}

double LoopClosing::contradicted_share() const {
  std::vector<Pose2> poses;
  for (const Remembered& seen : remembered_) poses.push_back(seen.T_world_base);
  return contradicted_at(poses);
}

double LoopClosing::contradicted_at(std::span<const Pose2> poses) const {
  std::vector<PointCloud> clouds;
  for (const Remembered& seen : remembered_) {
    clouds.push_back(prepare_scan(
        to_cloud(seen.scan, seen.scanner_height_m),
        to_se3(seen.scan.T_base_sensor, seen.scanner_height_m).translation(), registration_));
  }
  std::vector<SeenFrom> scans;
  for (std::size_t i = 0; i < remembered_.size(); ++i) {
    const Pose2& sensor = remembered_[i].scan.T_base_sensor;
    scans.push_back({clouds[i], {sensor.x_m, sensor.y_m}, poses[i]});
  }
  return vantage::contradicted_share(scans);
}

}  // namespace vantage
