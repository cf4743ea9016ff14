#include "vantage/control/minimum_jerk_trajectory.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Knot = MinimumJerkTrajectory::Knot;
using Knots = std::vector<Knot>;

constexpr double kShortestSegment_s = 0.1;
/// Of the limit of acceleration, for speeding up along the path; corners take the rest.
constexpr double kAlongShare = 0.7;

/// Rows: coefficients of t^3, t^4, t^5, t in [0, 1]; columns: what they are of p1 - p0, v0, v1, a0
/// and a1, derivatives by t.
const Eigen::Matrix<double, 3, 5> kQuintic{
    {10.0, -6.0, -4.0, -1.5, 0.5}, {-15.0, 8.0, 7.0, 1.5, -1.0}, {6.0, -3.0, -3.0, -0.5, 0.5}};
/// Third and fourth derivative by t, at t = 0 and 1, of those coefficients.
const Eigen::RowVector3d kJerk0{6.0, 0.0, 0.0};
const Eigen::RowVector3d kJerk1{6.0, 24.0, 60.0};
const Eigen::RowVector3d kSnap0{0.0, 24.0, 0.0};
const Eigen::RowVector3d kSnap1{0.0, 24.0, 120.0};

using Coefficients = Eigen::Matrix<double, 6, 4>;  ///< of t^0 .. t^5; x, y, z, yaw

Coefficients quintic(const Knot& from, const Knot& to, double h) {
  Eigen::Matrix<double, 5, 4> ends;
  ends << (to.p - from.p).transpose(), h * from.v.transpose(), h * to.v.transpose(),
      h * h * from.a.transpose(), h * h * to.a.transpose();
  Coefficients c;
  c.row(0) = from.p;
  c.row(1) = h * from.v;
  c.row(2) = 0.5 * h * h * from.a;
  c.bottomRows<3>() = kQuintic * ends;
  return c;
}

/// n-th derivative by time.
Eigen::Vector4d derivative(const Coefficients& c, double t, double h, int n) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int power = 5; power >= n; --power) {
    double factor = 1.0;
    for (int k = 0; k < n; ++k) factor *= power - k;
    sum = sum * t + factor * c.row(power).transpose();
  }
  return sum / std::pow(h, n);
}

/// Velocities and accelerations at the inner knots that make jerk and snap continuous there, which
/// is what the least integral of squared jerk asks for.
void smooth_inner_knots(Knots& knots, const std::vector<double>& knot_s) {
  const auto inner = static_cast<Eigen::Index>(knots.size()) - 2;
  if (inner < 1) return;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * inner, 2 * inner);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(2 * inner, 4);
  // Adds the derivative of order 3 or 4, in seconds, on one side of a knot to one row.
  const auto add = [&](Eigen::Index row, Eigen::Index segment, const Eigen::RowVector3d& weights,
                       int order, double sign) {
    const auto from = static_cast<std::size_t>(segment);
    const double h = knot_s[from + 1] - knot_s[from];
    const Eigen::Matrix<double, 1, 5> w = sign / std::pow(h, order) * weights * kQuintic;
    b.row(row) -= w[0] * (knots[from + 1].p - knots[from].p).transpose();
    for (int end = 0; end < 2; ++end) {
      const double of_v = w[1 + end] * h;
      const double of_a = w[3 + end] * h * h;
      const Eigen::Index knot = segment + end;
      if (knot >= 1 && knot <= inner) {
        A(row, 2 * (knot - 1)) += of_v;
        A(row, 2 * (knot - 1) + 1) += of_a;
      } else {
        const Knot& fixed = knots[static_cast<std::size_t>(knot)];
        b.row(row) -= (of_v * fixed.v + of_a * fixed.a).transpose();
      }
    }
  };
  for (Eigen::Index i = 0; i < inner; ++i) {
    add(2 * i, i, kJerk1, 3, 1.0);
    add(2 * i, i + 1, kJerk0, 3, -1.0);
    add(2 * i + 1, i, kSnap1, 4, 1.0);
    add(2 * i + 1, i + 1, kSnap0, 4, -1.0);
  }
  const Eigen::MatrixXd x = A.partialPivLu().solve(b);
  for (Eigen::Index i = 0; i < inner; ++i) {
    knots[static_cast<std::size_t>(i) + 1].v = x.row(2 * i);
    knots[static_cast<std::size_t>(i) + 1].a = x.row(2 * i + 1);
  }
}

/// When a vehicle that speeds up to a cruise and comes to rest at `length_m` passes `arc_m`.
class TrapezoidOfSpeed {
 public:
  TrapezoidOfSpeed(double length_m, double start_m_s, const FlightLimits& limits)
      : a_(kAlongShare * limits.acceleration_m_s2), length_m_(length_m), start_m_s_(start_m_s) {
    const double reachable = std::sqrt(0.5 * start_m_s * start_m_s + a_ * length_m);
    cruise_m_s_ = std::max(start_m_s, std::min(limits.speed_m_s, reachable));
    speeding_m_ = (cruise_m_s_ * cruise_m_s_ - start_m_s * start_m_s) / (2.0 * a_);
    braking_m_ = std::min(length_m - speeding_m_, cruise_m_s_ * cruise_m_s_ / (2.0 * a_));
  }
  [[nodiscard]] double time_s(double arc_m) const {
    const double first_m = std::min(arc_m, speeding_m_);
    const double last_m = std::max(0.0, arc_m - (length_m_ - braking_m_));
    const double even_m = std::max(0.0, arc_m - first_m - last_m);
    const double v = std::sqrt(start_m_s_ * start_m_s_ + 2.0 * a_ * first_m);
    const double w = std::sqrt(std::max(0.0, cruise_m_s_ * cruise_m_s_ - 2.0 * a_ * last_m));
    const double even_s = even_m > 0.0 ? even_m / cruise_m_s_ : 0.0;
    return (v - start_m_s_) / a_ + even_s + (cruise_m_s_ - w) / a_;
  }

 private:
  double a_;
  double length_m_;
  double start_m_s_;
  double cruise_m_s_ = 0.0;
  double speeding_m_ = 0.0;
  double braking_m_ = 0.0;
};

/// Turning counts as the distance flown in its time.
std::vector<double> first_times(const Knots& knots, const FlightLimits& limits) {
  std::vector<double> arc_m{0.0};
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Eigen::Vector4d step = knots[i].p - knots[i - 1].p;
    arc_m.push_back(arc_m.back() +
                    std::max(step.head<3>().norm(),
                             limits.speed_m_s / limits.yaw_rate_rad_s * std::abs(step[3])));
  }
  const double start_m_s = std::min(limits.speed_m_s, knots.front().v.head<3>().norm());
  const TrapezoidOfSpeed trapezoid(arc_m.back(), start_m_s, limits);
  std::vector<double> knot_s{0.0};
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double step_s = trapezoid.time_s(arc_m[i]) - trapezoid.time_s(arc_m[i - 1]);
    knot_s.push_back(knot_s.back() + std::max(step_s, kShortestSegment_s));
  }
  return knot_s;
}

Knots positions(const FlightReference& start, std::span<const FlightWaypoint> waypoints) {
  Knots knots(1);
  knots[0].p << start.p_world_m, start.yaw_rad;
  knots[0].v << start.v_world_m_s, start.yaw_rate_rad_s;
  knots[0].a << start.a_world_m_s2, 0.0;
  for (const FlightWaypoint& waypoint : waypoints) {
    const double before_rad = knots.back().p[3];
    knots.emplace_back().p << waypoint.p_world_m,
        before_rad + wrap_angle(waypoint.yaw_rad - before_rad);
  }
  return knots;
}

}  // namespace

MinimumJerkTrajectory::MinimumJerkTrajectory(const FlightReference& start,
                                             std::span<const FlightWaypoint> waypoints,
                                             const FlightLimits& limits) {
  check_options(limits, "limits");
  expects(!waypoints.empty(), "a path leads somewhere");
  constexpr int kMaxStretches = 12;
  constexpr double kMaxAtOnce = 1.5;
  knots_ = positions(start, waypoints);
  knot_s_ = first_times(knots_, limits);
  smooth_inner_knots(knots_, knot_s_);
  double least = stretch_needed(limits);
  MinimumJerkTrajectory tried = *this;
  for (int i = 0; i < kMaxStretches && least > 1.0 + 1e-6; ++i) {
    const double factor = std::min(kMaxAtOnce, tried.stretch_needed(limits));
    for (double& time_s : tried.knot_s_) time_s *= std::max(1.0 + 1e-9, factor);
    smooth_inner_knots(tried.knots_, tried.knot_s_);
    const double needed = tried.stretch_needed(limits);
    if (needed >= least) continue;
    least = needed;
    *this = tried;
  }
}

MinimumJerkTrajectory::Segment MinimumJerkTrajectory::segment_at(double time_s) const {
  const auto after = std::upper_bound(knot_s_.begin() + 1, knot_s_.end() - 1, time_s);
  const auto to = static_cast<std::size_t>(after - knot_s_.begin());
  const double h = knot_s_[to] - knot_s_[to - 1];
  return {to, h, (time_s - knot_s_[to - 1]) / h};
}

FlightReference MinimumJerkTrajectory::at(double time_s) const {
  const auto [to, h, t] = segment_at(std::clamp(time_s, 0.0, duration_s()));
  const Coefficients c = quintic(knots_[to - 1], knots_[to], h);
  const Eigen::Vector4d p = derivative(c, t, h, 0);
  FlightReference reference{.p_world_m = p.head<3>(), .yaw_rad = wrap_angle(p[3])};
  if (time_s > duration_s()) return reference;
  const Eigen::Vector4d v = derivative(c, t, h, 1);
  reference.v_world_m_s = v.head<3>();
  reference.a_world_m_s2 = derivative(c, t, h, 2).head<3>();
  reference.j_world_m_s3 = derivative(c, t, h, 3).head<3>();
  reference.yaw_rate_rad_s = v[3];
  return reference;
}

MinimumJerkTrajectory MinimumJerkTrajectory::from(double time_s) const {
  expects(time_s >= 0.0 && time_s < duration_s(), "something is left of the path");
  const auto [to, h, t] = segment_at(time_s);
  const Coefficients c = quintic(knots_[to - 1], knots_[to], h);
  MinimumJerkTrajectory rest;
  rest.knot_s_.push_back(0.0);
  rest.knots_.push_back({derivative(c, t, h, 0), derivative(c, t, h, 1), derivative(c, t, h, 2)});
  for (std::size_t i = to; i < knots_.size(); ++i) {
    rest.knot_s_.push_back(knot_s_[i] - time_s);
    rest.knots_.push_back(knots_[i]);
  }
  return rest;
}

FlightWaypoint MinimumJerkTrajectory::goal() const {
  const Eigen::Vector4d& p = knots_.back().p;
  return {.p_world_m = p.head<3>(), .yaw_rad = wrap_angle(p[3])};
}

double MinimumJerkTrajectory::stretch_needed(const FlightLimits& limits) const {
  constexpr int kSamples = 16;  // of each segment
  double worst = 0.0;
  for (std::size_t i = 1; i < knots_.size(); ++i) {
    const double h = knot_s_[i] - knot_s_[i - 1];
    const Coefficients c = quintic(knots_[i - 1], knots_[i], h);
    for (int sample = 0; sample <= kSamples; ++sample) {
      const double t = static_cast<double>(sample) / kSamples;
      const Eigen::Vector4d v = derivative(c, t, h, 1);
      const double a_m_s2 = derivative(c, t, h, 2).head<3>().norm();
      worst = std::max({worst, v.head<3>().norm() / limits.speed_m_s,
                        std::abs(v[3]) / limits.yaw_rate_rad_s,
                        std::sqrt(a_m_s2 / limits.acceleration_m_s2)});
    }
  }
  return worst;
}

}  // namespace vantage
