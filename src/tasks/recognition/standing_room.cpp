#include "vantage/tasks/recognition/standing_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "vantage/perception/table_extraction.hpp"
#include "vantage/tasks/flight/full_turn.hpp"

namespace vantage {
namespace {

/// From the table's edge.
constexpr double kEdge_m = 0.01;

double distance_to_segment_m(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                             const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double t =
      d.squaredNorm() > 0.0 ? std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}

/// Whether a line along an edge of `a` parts them [Gottschalk1996].
bool parted_by_edge(const Outline& a, const Outline& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d edge = a[(i + 1) % a.size()] - a[i];
    const Eigen::Vector2d out(edge.y(), -edge.x());
    if (std::ranges::all_of(b, [&](const auto& p) { return out.dot(p - a[i]) > 0.0; })) {
      return true;
    }
  }
  return false;
}

double least_distance_m(const Outline& points, const Outline& edges) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& p : points) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      least = std::min(least, distance_to_segment_m(p, edges[i], edges[(i + 1) % edges.size()]));
    }
  }
  return least;
}

}  // namespace

Outline outline_of(const TurntableObject& object) {
  const Eigen::Vector2d middle = object.box_m.center().head<2>();
  std::vector<Eigen::Vector2d> points;
  std::istringstream lines(object.obj);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("v ")) continue;
    std::istringstream numbers(line.substr(2));
    Eigen::Vector2d p;
    numbers >> p.x() >> p.y();
    points.emplace_back(p - middle);
  }
  return convex_hull(std::move(points));
}

Outline round_outline(double radius_m) {
  constexpr int kCorners = 16;
  Outline outline;
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = i * kTurn_rad / kCorners;
    outline.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad));
  }
  return outline;
}

Outline placed(const Outline& outline, double yaw_rad, const Eigen::Vector2d& to_m) {
  Outline result;
  const Eigen::Rotation2Dd turn(yaw_rad);
  for (const Eigen::Vector2d& p : outline) result.emplace_back(turn * p + to_m);
  return result;
}

double gap_m(const Outline& a, const Outline& b) {
  if (!parted_by_edge(a, b) && !parted_by_edge(b, a)) return 0.0;
  return std::min(least_distance_m(a, b), least_distance_m(b, a));
}

bool StandingRoom::free(const Outline& outline) const {
  const Eigen::Array2d half_m = 0.5 * rule_.table_m.array() - kEdge_m;
  const bool on_table = std::ranges::all_of(
      outline, [&](const Eigen::Vector2d& p) { return (p.array().abs() <= half_m).all(); });
  return on_table && std::ranges::all_of(taken_, [&](const Outline& other) {
           return gap_m(outline, other) >= rule_.spacing_m;
         });
}

bool StandingRoom::place(const Outline& outline, Rng& rng, Place& found) {
  constexpr int kAttempts = 4000;
  constexpr double kDoubled = 1000.0;  // attempts after which the reach is twice what it was
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Eigen::Vector2d round_m = rule_.round_m[rng.uniform_index(rule_.round_m.size())];
    const double heading = rng.uniform(0.0, kTurn_rad);
    const double away_m = rule_.reach_m * (1.0 + attempt / kDoubled) * std::sqrt(rng.uniform());
    found = {round_m + away_m * Eigen::Vector2d(std::cos(heading), std::sin(heading)),
             rng.uniform(0.0, kTurn_rad)};
    Outline there = placed(outline, found.yaw_rad, found.p_m);
    if (!free(there)) continue;
    taken_.push_back(std::move(there));
    return true;
  }
  return false;
}

}  // namespace vantage
