#include "vantage/localisation/keyframe_graph.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/localisation/place_match.hpp"

namespace vantage {
namespace {

constexpr double kVoxel_m = 0.03;
constexpr double kLocalWay_m = 5.0;    ///< the way that a scan is registered with
constexpr double kPlaceWay_m = 3.0;    ///< before and after a place of long ago
constexpr double kTryEvery_m = 1.0;    ///< driven
constexpr double kPlaceApart_m = 2.0;  ///< places of long ago that are looked at
constexpr double kTied_m = 3.0;        ///< between loops, along both ways together
constexpr double kRecent_m = 8.0;      ///< driven since a loop that the next one is held against
constexpr double kMaxDrift_m = 2.0;    ///< that a loop is looked for within
constexpr double kArm_m = 4.0;         ///< a heading counts by what it moves at that distance
constexpr double kMaxMisfit_m = 0.10;  ///< of a loop, once all poses are optimised
constexpr double kGate = 20.0;         ///< chi-square of three, one in 6000
constexpr std::size_t kMinPoints = 100;
/// What a registration may be off whatever its residuals say, as neighbouring scans share errors.
/// On the way it is what adds up from keyframe to keyframe. That is less than what one is off by,
/// as each is registered with all of kLocalWay_m (docs/decisions/localisation.md).
const Eigen::Vector3d kLeastSigma(0.0015, 0.0015, 0.0004);
const Eigen::Vector3d kLeastLoopSigma(0.005, 0.005, 0.0015);

Eigen::Matrix3d turn(double yaw_rad) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(yaw_rad).toRotationMatrix();
  return rotation;
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, double yaw_rad) {
  return turn(yaw_rad) * matrix * turn(yaw_rad).transpose();
}

/// Directions of (x, y, arm * yaw) that an information matrix tells of, a column each, and how
/// sure: the variance along each.
struct Told {
  Eigen::MatrixXd directions;
  Eigen::VectorXd variance;
};

const Eigen::Vector3d kScale(1.0, 1.0, kArm_m);

Told told_by(const Eigen::Matrix3d& information) {
  constexpr double kLeastInformation = 100.0;  // 1 / (0.1 m)^2
  const Eigen::Vector3d unscale = kScale.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(unscale.asDiagonal() * information *
                                                              unscale.asDiagonal());
  const auto count = (solver.eigenvalues().array() > kLeastInformation).count();
  return {solver.eigenvectors().rightCols(count), solver.eigenvalues().tail(count).cwiseInverse()};
}

/// At most as sure as `least_sigma`, and no less sure of nothing.
Eigen::Matrix3d limited(const Eigen::Matrix3d& information, const Eigen::Vector3d& least_sigma) {
  const Eigen::Matrix3d floor = least_sigma.cwiseAbs2().asDiagonal();
  return (Eigen::Matrix3d::Identity() + information * floor).inverse() * information;
}

Eigen::Matrix3d symmetric(const Eigen::Matrix3d& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace

KeyframeGraph::KeyframeGraph(const LoopOptions& options, const RegistrationOptions& registration)
    : options_(options), registration_(registration) {
  check_options(options_, "localisation.loops");
  registration_.voxel_m = kVoxel_m;
  // Few points may swing between two sets of pairs by less than what they are off.
  registration_.tolerance_m = std::max(registration_.tolerance_m, 5e-4);
  registration_.tolerance_rad = std::max(registration_.tolerance_rad, 2e-4);
}

void KeyframeGraph::begin(const PointCloud& scan_base, const Pose2& T_world_base) {
  expects(poses_.empty(), "the first keyframe");
  poses_.push_back(T_world_base);
  driven_m_.push_back(0.0);
  scans_.push_back(voxel_downsample(scan_base, kVoxel_m));
}

void KeyframeGraph::add(const PointCloud& scan_base, const WheelStep& step) {
  expects(!poses_.empty(), "a first keyframe");
  const std::size_t previous = poses_.size() - 1;
  PoseEdge edge{previous, previous + 1, step.T_previous_now, step.covariance.inverse()};
  scans_.push_back(voxel_downsample(scan_base, kVoxel_m));
  const PointCloud around = seen(back_from(previous, kLocalWay_m), previous, previous);
  const PosePrior prior{step.T_previous_now, edge.information};
  auto found = register_with_prior(scans_.back(), around, prior, registration_, {});
  if (!found.converged) {  // a turn on the spot moves what is far away farther
    RegistrationOptions wide = registration_;
    wide.max_correspondence_m *= 2.0;
    found = register_with_prior(scans_.back(), around, prior, wide, {});
  }
  if (found.converged) {
    edge.T_from_to = found.T_world_base;
    edge.information += limited(found.information, kLeastSigma);
  }
  edge.information = symmetric(edge.information);
  way_.push_back(edge);
  poses_.push_back(compose(poses_.back(), edge.T_from_to));
  driven_m_.push_back(driven_m_.back() + step.driven_m);
}

bool KeyframeGraph::close_loops() {
  if (!options_.close || driven_m_.back() < tried_m_ + kTryEvery_m) return false;
  const auto before = place_of_long_ago();
  if (!before) return false;
  tried_m_ = driven_m_.back();
  const auto found = recognise(*before);
  if (!found) return false;
  const bool recent = !loops_.empty() && driven_m_.back() - driven_m_[loops_.back().to] < kRecent_m;
  if (recent && agree(loops_.back(), *found)) return take({*found});
  if (waiting_ && agree(*waiting_, *found)) {
    const PoseEdge first = *waiting_;
    waiting_.reset();
    return take({first, *found});
  }
  if (waiting_) ++refused_;
  waiting_ = found;
  return false;
}

std::vector<Eigen::Matrix3d> KeyframeGraph::covariances(std::span<const std::size_t> which) const {
  return pose_covariances(poses_, edges(), which);
}

std::vector<PoseEdge> KeyframeGraph::edges() const {
  std::vector<PoseEdge> all = way_;
  all.insert(all.end(), loops_.begin(), loops_.end());
  return all;
}

std::size_t KeyframeGraph::back_from(std::size_t keyframe, double way_m) const {
  std::size_t first = keyframe;
  while (first > 0 && driven_m_[keyframe] - driven_m_[first - 1] <= way_m) --first;
  return first;
}

std::size_t KeyframeGraph::on_from(std::size_t keyframe, double way_m) const {
  std::size_t last = keyframe;
  while (last + 1 < poses_.size() && driven_m_[last + 1] - driven_m_[keyframe] <= way_m) ++last;
  return last;
}

PointCloud KeyframeGraph::seen(std::size_t first, std::size_t last, std::size_t centre) const {
  PointCloud cloud;
  for (std::size_t i = first; i <= last; ++i) {
    append(cloud, transform(scans_[i], to_se3(compose(inverse(poses_[centre]), poses_[i]))));
  }
  return voxel_downsample(cloud, kVoxel_m);
}

/// Of the last keyframe, from `before` on by the way alone; in the frame of `before`.
Eigen::Matrix3d KeyframeGraph::drift_since(std::size_t before) const {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const Pose2& now = poses_.back();
  for (std::size_t i = before; i + 1 < poses_.size(); ++i) {
    // The edge's own length is in its covariance.
    Eigen::Matrix3d lever = Eigen::Matrix3d::Identity();
    lever(0, 2) = poses_[i + 1].y_m - now.y_m;
    lever(1, 2) = now.x_m - poses_[i + 1].x_m;
    const Eigen::Matrix3d of_edge = turned(way_[i].information.inverse(), poses_[i].yaw_rad);
    covariance += lever * of_edge * lever.transpose();
  }
  return turned(covariance, -poses_[before].yaw_rad);
}

/// There is a loop nearby already.
bool KeyframeGraph::is_tied(std::size_t before) const {
  return std::ranges::any_of(loops_, [&](const PoseEdge& loop) {
    return std::abs(driven_m_[loop.from] - driven_m_[before]) +
               std::abs(driven_m_[loop.to] - driven_m_.back()) <
           kTied_m;
  });
}

/// Of those of long ago within reach the keyframe that saw most of what the last one sees, the
/// nearest of several. It need not be the nearest of all: that may be behind a wall.
std::optional<std::size_t> KeyframeGraph::place_of_long_ago() const {
  std::optional<std::size_t> best;
  std::pair<std::size_t, double> most{0, 0.0};  ///< points, and nearness
  std::vector<Eigen::Vector2d> looked_at_m;
  const Pose2& now = poses_.back();
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (driven_m_.back() - driven_m_[i] < options_.min_way_m) break;
    const Eigen::Vector2d place_m(poses_[i].x_m, poses_[i].y_m);
    const auto is_same = [&](const Eigen::Vector2d& other_m) {
      return (other_m - place_m).norm() < kPlaceApart_m;
    };
    if (std::ranges::any_of(looked_at_m, is_same) || !is_within_reach(i)) continue;
    looked_at_m.push_back(place_m);
    const Pose2 T_place_now = compose(inverse(poses_[i]), now);
    const std::pair seen{agreement(scans_.back(), scans_[i], T_place_now).facing,
                         -std::hypot(T_place_now.x_m, T_place_now.y_m)};
    if (seen.first == 0 || (best && seen <= most)) continue;
    most = seen;
    best = i;
  }
  if (best && is_tied(*best)) return std::nullopt;
  return best;
}

bool KeyframeGraph::is_within_reach(std::size_t before) const {
  const double away_m =
      std::hypot(poses_[before].x_m - poses_.back().x_m, poses_[before].y_m - poses_.back().y_m);
  if (away_m >= options_.search_m + kMaxDrift_m) return false;
  const double sigma_m = std::sqrt(drift_since(before).topLeftCorner<2, 2>().trace());
  return away_m <= options_.search_m + 3.0 * sigma_m;
}

std::optional<PoseEdge> KeyframeGraph::recognise(std::size_t before) const {
  const std::size_t now = poses_.size() - 1;
  const PointCloud place =
      seen(back_from(before, kPlaceWay_m), on_from(before, kPlaceWay_m), before);
  const PointCloud scan = seen(back_from(now, kPlaceWay_m), now, now);
  const Eigen::Matrix3d drift = drift_since(before);
  const double sigma_m = std::sqrt(drift.topLeftCorner<2, 2>().trace());
  const SearchWindow window{std::min(0.1 + 3.0 * sigma_m, kMaxDrift_m),
                            std::min(0.02 + 3.0 * std::sqrt(drift(2, 2)), 0.2)};
  const Pose2 guess =
      search_pose(scan, place, compose(inverse(poses_[before]), poses_[now]), window);
  const auto found = register_scan(scan, place, guess, registration_);
  if (!found.converged || found.unconstrained > 1) return std::nullopt;
  const Agreement agreed = agreement(scan, place, found.T_world_base);
  if (agreed.near < kMinPoints || agreed.share < options_.min_agreement) return std::nullopt;
  const PoseEdge loop{before, now, found.T_world_base,
                      symmetric(limited(found.information, kLeastLoopSigma))};
  if (!is_plausible(loop, drift)) return std::nullopt;
  return loop;
}

/// Whether the way may have drifted as far, in the directions that the loop tells of.
bool KeyframeGraph::is_plausible(const PoseEdge& loop, const Eigen::Matrix3d& drift) const {
  const Told told = told_by(loop.information);
  const Eigen::Vector3d error = kScale.cwiseProduct(edge_error(loop, poses_));
  const Eigen::Matrix3d scaled = kScale.asDiagonal() * drift * kScale.asDiagonal();
  Eigen::MatrixXd covariance = told.directions.transpose() * scaled * told.directions;
  covariance.diagonal() += told.variance;
  const Eigen::VectorXd off = told.directions.transpose() * error;
  return off.dot(covariance.ldlt().solve(off)) <= kGate;
}

/// Whether both tell the same of the way between them, in directions that both tell of.
bool KeyframeGraph::agree(const PoseEdge& one, const PoseEdge& other) const {
  const Pose2 driven = compose(inverse(poses_[one.to]), poses_[other.to]);
  const Pose2 between = compose(inverse(poses_[one.from]), poses_[other.from]);
  const Pose2 by_places = compose(inverse(one.T_from_to), compose(between, other.T_from_to));
  const Eigen::Vector3d off_now(by_places.x_m - driven.x_m, by_places.y_m - driven.y_m,
                                wrap_angle(by_places.yaw_rad - driven.yaw_rad));
  Eigen::Vector3d off = kScale.cwiseProduct(turn(poses_[one.to].yaw_rad) * off_now);
  for (const PoseEdge* edge : {&one, &other}) {
    const Told told = told_by(turned(edge->information, poses_[edge->from].yaw_rad));
    if (told.directions.cols() == 0) return false;
    off = told.directions * (told.directions.transpose() * off);
  }
  return off.head<2>().norm() <= options_.agreement_m &&
         std::abs(off.z()) / kArm_m <= options_.agreement_rad;
}

/// Optimises all poses with these loops, unless some loop does not fit then.
bool KeyframeGraph::take(std::vector<PoseEdge> more) {
  std::vector<PoseEdge> loops = loops_;
  loops.insert(loops.end(), more.begin(), more.end());
  std::vector<PoseEdge> all = way_;
  all.insert(all.end(), loops.begin(), loops.end());
  std::vector<Pose2> poses = poses_;
  const bool solved = optimise_pose_graph(poses, all);
  const bool fits = std::ranges::all_of(loops, [&](const PoseEdge& loop) {
    const Told told = told_by(loop.information);
    const Eigen::Vector3d error = kScale.cwiseProduct(edge_error(loop, poses));
    return (told.directions.transpose() * error).norm() <= kMaxMisfit_m;
  });
  if (!solved || !fits) {
    refused_ += more.size();
    return false;
  }
  poses_ = std::move(poses);
  loops_ = std::move(loops);
  return true;
}

}  // namespace vantage
