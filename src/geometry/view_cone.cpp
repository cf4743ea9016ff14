#include "vantage/geometry/view_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace vantage {
namespace {

constexpr double kSlack = 1e-6;  // cells: rounding must not lose a cell that contains() accepts

}  // namespace

ViewCone::ViewCone(const Pose& T_world_sensor, const FieldOfView& fov)
    : apex_m_(T_world_sensor.translation()),
      R_sensor_world_(T_world_sensor.linear().transpose()),
      tan_tilt_min_(std::tan(fov.tilt_min_rad)),
      tan_tilt_max_(std::tan(fov.tilt_max_rad)),
      panorama_(fov.panorama),
      behind_(fov.panorama || fov.half_width_rad > 0.5 * std::numbers::pi),
      sin2_half_width_(std::pow(std::sin(fov.half_width_rad), 2)),
      range2_min_m2_(fov.range_min_m * fov.range_min_m),
      range2_max_m2_(fov.range_max_m * fov.range_max_m) {
  // sin(pi) is not 0 in floating point, and would lose what lies right behind.
  if (fov.panorama || fov.half_width_rad > std::numbers::pi - 1e-9) sin2_half_width_ = 0.0;
  normals_ = {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(-tan_tilt_min_, 0.0, -1.0),
              Eigen::Vector3d(tan_tilt_max_, 0.0, 1.0), Eigen::Vector3d(1.0, 0.0, 0.0),
              Eigen::Vector3d(1.0, 0.0, 0.0)};
  if (fov.half_width_rad < 0.5 * std::numbers::pi) {
    // |y| <= tan(w) sqrt(x^2 + z^2) and |z| <= T x bound |y| by a multiple of x.
    const double steepest = std::max(std::abs(tan_tilt_min_), std::abs(tan_tilt_max_));
    const double slope = std::tan(fov.half_width_rad) * std::hypot(1.0, steepest);
    normals_[3] = {slope, 1.0, 0.0};
    normals_[4] = {slope, -1.0, 0.0};
  }
  for (auto& normal : normals_) normal = T_world_sensor.linear() * normal.normalized();
}

bool ViewCone::contains(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p = R_sensor_world_ * (p_world - apex_m_);
  const double range2 = p.squaredNorm();
  if (range2 < range2_min_m2_ || range2 > range2_max_m2_) return false;
  if (panorama_) {
    const double depth = std::hypot(p.x(), p.y());
    return -p.z() >= tan_tilt_min_ * depth && -p.z() <= tan_tilt_max_ * depth;
  }
  const bool in_front = p.x() >= 0.0;
  if (!in_front && !behind_) return false;
  // Behind the sensor the scan plane is the same, and the beams have turned past its y axis.
  const double depth = in_front ? p.x() : -p.x();
  const double drop = in_front ? -p.z() : p.z();
  if (drop < tan_tilt_min_ * depth || drop > tan_tilt_max_ * depth) return false;
  const double y2 = p.y() * p.y();
  if (in_front) return behind_ || y2 <= sin2_half_width_ * range2;
  return y2 >= sin2_half_width_ * range2;
}

RowBounds::RowBounds(const ViewCone& cone, const Eigen::Vector3d& step)
    : apex_m_(cone.apex_m()),
      along_(step / step.squaredNorm()),
      step2_m2_(step.squaredNorm()),
      range2_min_m2_(cone.range2_min_m2()),
      range2_max_m2_(cone.range2_max_m2()),
      count_(cone.normals().size()),
      across_(cone.across()),
      step_(step),
      sin2_half_width_(cone.sin2_half_width()),
      across_per_index_(across_.dot(step)),
      curvature_(across_per_index_ * across_per_index_ - sin2_half_width_ * step2_m2_) {
  for (std::size_t i = 0; i < count_; ++i) {
    const double change = cone.normals()[i].dot(step);
    planes_[i] = {cone.normals()[i], std::abs(change) < 1e-12 ? 0.0 : 1.0 / change};
  }
}

RowBounds::Reals RowBounds::clip(const Eigen::Vector3d& p, Reals row, std::size_t planes) const {
  auto& [low, high] = row;
  for (const Plane& plane : std::span(planes_).first(planes)) {
    const double inside = plane.normal.dot(p);
    if (plane.per_index > 0.0) {
      low = std::max(low, -inside * plane.per_index - kSlack);
    } else if (plane.per_index < 0.0) {
      high = std::min(high, -inside * plane.per_index + kSlack);
    } else if (inside < -1e-9) {
      return {};
    }
    if (low > high) return {};
  }
  const double nearest = -along_.dot(p);
  const double off2 = p.squaredNorm() - nearest * nearest * step2_m2_;
  if (off2 > range2_max_m2_ * (1.0 + kSlack)) return {};
  const double reach = std::sqrt(std::max(0.0, range2_max_m2_ - off2) / step2_m2_) + kSlack;
  return {std::max(low, nearest - reach), std::min(high, nearest + reach)};
}

RowBounds::Interval RowBounds::of_row(const Eigen::Vector3d& p_world, int count) const {
  return clip(p_world - apex_m_, {0.0, count - 1.0}, count_).whole();
}

RowBounds::Runs RowBounds::runs_of_row(const Eigen::Vector3d& p_world, int begin, int end) const {
  const Eigen::Vector3d p = p_world - apex_m_;
  const Reals row{static_cast<double>(begin), end - 1.0};
  const double nearest = -along_.dot(p);
  const bool far = p.squaredNorm() - nearest * nearest * step2_m2_ > range2_min_m2_;
  if (count_ == 0 || !far) return {{clip(p, row, count_).whole()}, false};
  return inside_sector(p, clip(p, row, 3));
}

/// The part of the row where across^2 <= sin^2(half width) range^2.
RowBounds::Runs RowBounds::inside_sector(const Eigen::Vector3d& p, const Reals& row) const {
  if (row.empty()) return {{}, true};
  const double across = across_.dot(p);
  const double half_slope = across * across_per_index_ - sin2_half_width_ * p.dot(step_);
  const double at_0 = across * across - sin2_half_width_ * p.squaredNorm();
  const double discriminant = half_slope * half_slope - curvature_ * at_0;
  if (std::abs(curvature_) < 1e-9 * step2_m2_) return {{row.whole()}, false};
  if (discriminant <= 0.0) return {{curvature_ > 0.0 ? Interval{} : row.whole()}, true};
  const double root = std::sqrt(discriminant) / std::abs(curvature_);
  const double middle = -half_slope / curvature_;
  const double first = middle - root;
  const double second = middle + root;
  if (curvature_ > 0.0) {
    const Reals between{std::max(row.low, first), std::min(row.high, second)};
    return {{between.whole()}, true};
  }
  const Reals before{row.low, std::min(row.high, first)};
  const Reals after{std::max(row.low, second), row.high};
  return {{before.whole(), after.whole()}, true};
}

ConeRow ViewCone::row(const Eigen::Vector3d& p_world, const Eigen::Vector3d& step) const {
  constexpr float kAny = std::numeric_limits<float>::max();
  const Eigen::Vector3f origin = (R_sensor_world_ * (p_world - apex_m_)).cast<float>();
  const Eigen::Vector3f along = (R_sensor_world_ * step).cast<float>();
  return {.origin_m = {origin.x(), origin.y(), origin.z()},
          .step_m = {along.x(), along.y(), along.z()},
          .tan_tilt_min = static_cast<float>(tan_tilt_min_),
          .tan_tilt_max = static_cast<float>(tan_tilt_max_),
          .sin2_half_width = static_cast<float>(sin2_half_width_),
          .max_excess_ahead_m2 = behind_ ? kAny : 0.0F,
          .min_excess_behind_m2 = behind_ ? 0.0F : kAny,
          .range2_min_m2 = static_cast<float>(range2_min_m2_),
          .range2_max_m2 = static_cast<float>(range2_max_m2_),
          .all_round = panorama_ ? 1.0F : 0.0F};
}

}  // namespace vantage
