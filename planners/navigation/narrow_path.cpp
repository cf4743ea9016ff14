#include "vantage/planners/navigation/narrow_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "vantage/belief/map/floor_detail.hpp"

namespace vantage {
namespace {

constexpr double kSample_m = 0.03;

Pose2 pose_at(const Eigen::Vector2d& p_m, double yaw_rad) { return {p_m.x(), p_m.y(), yaw_rad}; }

bool same_heading(double a_rad, double b_rad) { return std::abs(wrap_angle(a_rad - b_rad)) < 1e-9; }

/// A base that cannot go sideways has the heading of its way.
double heading_along(const FootprintSpace& space, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to, double yaw_rad) {
  const Eigen::Vector2d way = to - from;
  if (space.robot().goes_sideways || way.norm() < 1e-6) return yaw_rad;
  return std::atan2(way.y(), way.x());
}

bool fits_along(const FootprintSpace& space, std::span<const Eigen::Vector2d> outline,
                const Eigen::Vector2d& from, const Eigen::Vector2d& to, double yaw_rad) {
  const int samples = 1 + static_cast<int>((to - from).norm() / kSample_m);
  for (int i = 0; i <= samples; ++i) {
    const Eigen::Vector2d p_m = from + static_cast<double>(i) / samples * (to - from);
    if (!space.fits(outline, pose_at(p_m, yaw_rad))) return false;
  }
  return true;
}

class PathBuilder {
 public:
  explicit PathBuilder(const PathField& field)
      : field_(field),
        space_(*field.space),
        outline_(grown(space_.robot().outline, 0.5 * space_.options().margin_m)) {
    path_.waypoints.push_back(field.start);
  }

  void add_open(const std::vector<Eigen::Vector2d>& points, double end_yaw_rad) {
    const std::vector<Eigen::Vector2d> pulled = pull_straight(field_, points);
    PathLeg leg{.waypoints = {path_.waypoints.back()}};
    for (std::size_t i = 1; i < pulled.size(); ++i) {
      const Eigen::Vector2d way = pulled[i] - pulled[i - 1];
      leg.waypoints.push_back(pose_at(pulled[i], std::atan2(way.y(), way.x())));
    }
    if (leg.waypoints.size() == 1) leg.waypoints.push_back(pose_at(points.front(), end_yaw_rad));
    leg.waypoints.back().yaw_rad = end_yaw_rad;
    add(std::move(leg));
  }

  /// At one heading; pulled straight where the outline fits.
  void add_straight(std::span<const Pose2> poses) {
    const double yaw_rad = poses.back().yaw_rad;
    PathLeg leg{.waypoints = {path_.waypoints.back()}, .narrow = true};
    for (std::size_t anchor = 0; anchor + 1 < poses.size();) {
      std::size_t next = anchor + 1;
      const auto fits_to = [&](std::size_t i) {
        const Eigen::Vector2d from = position(poses[anchor]);
        const Eigen::Vector2d to = position(poses[i]);
        return fits_along(space_, outline_, from, to, heading_along(space_, from, to, yaw_rad));
      };
      for (std::size_t i = poses.size() - 1; i > next; --i) {
        if (!fits_to(i)) continue;
        next = i;
        break;
      }
      const Eigen::Vector2d to = position(poses[next]);
      leg.waypoints.push_back(
          pose_at(to, heading_along(space_, position(poses[anchor]), to, yaw_rad)));
      anchor = next;
    }
    add(std::move(leg));
  }

  /// On to where it goes on straight, or as far as it must not be turned the other way: a robot
  /// turns to a heading the shorter way, in which something may stand. It moves evenly from the
  /// first place to the last one then, and has to fit there too: the search has moved each heading
  /// to where it fits.
  [[nodiscard]] std::size_t end_of_turn(std::span<const Pose2> poses, std::size_t from) const {
    constexpr double kLongest_rad = 2.5;
    std::size_t turned = from + 1;
    double turn_rad = wrap_angle(poses[turned].yaw_rad - poses[from].yaw_rad);
    for (; turned + 1 < poses.size(); ++turned) {
      const double more_rad = wrap_angle(poses[turned + 1].yaw_rad - poses[turned].yaw_rad);
      turn_rad += more_rad;
      if (std::abs(more_rad) < 1e-9 || std::abs(turn_rad) > kLongest_rad) break;
      if (!fits_turning(poses.subspan(from, turned - from + 2))) break;
    }
    return turned;
  }

  void add_turn(const Pose2& to) {
    add({.waypoints = {path_.waypoints.back(), to}, .narrow = true});
  }

  PlannedPath take() {
    path_.end = path_.waypoints.back();
    return std::move(path_);
  }

 private:
  [[nodiscard]] bool fits_turning(std::span<const Pose2> poses) const {
    const Eigen::Vector2d from = position(poses.front());
    const Eigen::Vector2d way = position(poses.back()) - from;
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(poses.size() - 1);
      if (!space_.fits(outline_, pose_at(from + share * way, poses[i].yaw_rad))) return false;
    }
    return true;
  }

  void add(PathLeg leg) {
    const double slowness = leg.narrow ? space_.slowness() : 1.0;
    for (std::size_t i = 1; i < leg.waypoints.size(); ++i) {
      const Pose2& from = leg.waypoints[i - 1];
      const Pose2& to = leg.waypoints[i];
      double length_m = (position(to) - position(from)).norm();
      if (leg.narrow) {
        length_m += std::abs(wrap_angle(to.yaw_rad - from.yaw_rad)) * space_.circumscribed_m();
      }
      path_.length_m += slowness * length_m;
      path_.waypoints.push_back(to);
    }
    path_.legs.push_back(std::move(leg));
  }

  const PathField& field_;
  const FootprintSpace& space_;
  FloorOutline outline_;
  PlannedPath path_;
};

/// Poses of one passage, from the open place before it to the one after it, where there are such.
void add_passage(PathBuilder& builder, std::span<const Pose2> poses) {
  for (std::size_t i = 0; i + 1 < poses.size();) {
    std::size_t end = i;
    while (end + 1 < poses.size() && same_heading(poses[end + 1].yaw_rad, poses[i].yaw_rad)) ++end;
    if (end > i) builder.add_straight(poses.subspan(i, end - i + 1));
    if (end + 1 == poses.size()) return;
    const std::size_t turned = builder.end_of_turn(poses, end);
    builder.add_turn(poses[turned]);
    i = turned;
  }
}

/// The clearance, in steps of 1 cm, that the outline keeps on a straight leg.
class Clearance {
 public:
  static constexpr std::size_t kMost = 8;
  explicit Clearance(const FootprintSpace& space) : space_(space) {
    for (std::size_t i = 0; i <= kMost; ++i) {
      outlines_.push_back(grown(space.robot().outline, 0.01 * static_cast<double>(i)));
    }
  }
  [[nodiscard]] bool keeps(std::size_t steps, const Pose2& from, const Pose2& to) const {
    return fits_along(space_, outlines_[steps], position(from), position(to), to.yaw_rad);
  }

 private:
  const FootprintSpace& space_;
  std::vector<FloorOutline> outlines_;
};

/// Both ends of a leg moved across it, and turned; smaller changes first.
std::vector<std::array<double, 3>> changes(double heading_step_rad) {
  std::vector<std::array<double, 3>> made;
  for (int a = -4; a <= 4; ++a) {
    for (int b = -4; b <= 4; ++b) {
      for (int turn = -2; turn <= 2; ++turn) {
        made.push_back({0.01 * a, 0.01 * b, 0.25 * turn * heading_step_rad});
      }
    }
  }
  std::ranges::stable_sort(made, {}, [](const auto& change) {
    return std::abs(change[0]) + std::abs(change[1]) + std::abs(change[2]);
  });
  return made;
}

/// The leg from where to where, best in the middle.
std::pair<Pose2, Pose2> centred_leg(const Clearance& clearance, const FootprintSpace& space,
                                    const Pose2& from, const Pose2& to) {
  const Eigen::Vector2d along = (position(to) - position(from)).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  std::pair<Pose2, Pose2> best(from, to);
  std::size_t kept = 0;
  while (kept < Clearance::kMost && clearance.keeps(kept + 1, from, to)) ++kept;
  for (const auto& [a_m, b_m, turn_rad] : changes(2.0 * std::numbers::pi / space.headings())) {
    if (kept == Clearance::kMost) break;
    const Eigen::Vector2d p_from = position(from) + a_m * across;
    const Eigen::Vector2d p_to = position(to) + b_m * across;
    const double yaw_rad = heading_along(space, p_from, p_to, wrap_angle(to.yaw_rad + turn_rad));
    const std::pair moved(pose_at(p_from, yaw_rad), pose_at(p_to, yaw_rad));
    if (!clearance.keeps(kept + 1, moved.first, moved.second)) continue;
    best = moved;
    while (kept < Clearance::kMost && clearance.keeps(kept + 1, moved.first, moved.second)) ++kept;
  }
  return best;
}

}  // namespace

PlannedPath path_through_passages(const PathField& field, const std::vector<PathStep>& steps,
                                  double final_yaw_rad) {
  const FootprintSpace& space = *field.space;
  PathBuilder builder(field);
  for (std::size_t i = 0; i < steps.size();) {
    std::vector<Pose2> passage;
    if (!steps[i].yaw_rad) {
      std::vector<Eigen::Vector2d> points;
      for (; i < steps.size() && !steps[i].yaw_rad; ++i) points.push_back(steps[i].p_m);
      const bool last = i == steps.size();
      const double yaw_rad = last ? final_yaw_rad : *steps[i].yaw_rad;
      builder.add_open(points, yaw_rad);
      if (last) break;
      passage.push_back(pose_at(points.back(), yaw_rad));
    }
    for (; i < steps.size() && steps[i].yaw_rad; ++i) {
      // The robot itself stands between two headings.
      const double yaw_rad =
          i == 0 ? space.heading_rad(space.nearest_heading(*steps[i].yaw_rad)) : *steps[i].yaw_rad;
      passage.push_back(pose_at(steps[i].p_m, yaw_rad));
    }
    if (i < steps.size()) passage.push_back(pose_at(steps[i].p_m, passage.back().yaw_rad));
    add_passage(builder, passage);
  }
  return builder.take();
}

PlannedPath centred(const PathField& field, PlannedPath path) {
  if (path.legs.empty()) return path;
  const Clearance clearance(*field.space);
  for (std::size_t i = 0; i < path.legs.size(); ++i) {
    PathLeg& leg = path.legs[i];
    if (!leg.narrow || leg.waypoints.size() != 2) continue;
    const bool from_open = i > 0 && !path.legs[i - 1].narrow;
    const bool to_open = i + 1 < path.legs.size() && !path.legs[i + 1].narrow;
    if (!from_open || !to_open) continue;
    Pose2 from = leg.waypoints.front();
    from.yaw_rad = leg.waypoints.back().yaw_rad;
    const auto [begin, end] = centred_leg(clearance, *field.space, from, leg.waypoints.back());
    leg.waypoints = {begin, end};
    path.legs[i - 1].waypoints.back() = begin;
    path.legs[i + 1].waypoints.front() = end;
  }
  path.waypoints = {field.start};
  for (const PathLeg& leg : path.legs) {
    path.waypoints.insert(path.waypoints.end(), leg.waypoints.begin() + 1, leg.waypoints.end());
  }
  path.end = path.waypoints.back();
  return path;
}

}  // namespace vantage
