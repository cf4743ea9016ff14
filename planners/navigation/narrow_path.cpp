#include "vantage/planners/navigation/narrow_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "vantage/belief/map/floor_detail.hpp"

namespace vantage {
namespace {

Pose2 pose_at(const Eigen::Vector2d& p_m, double yaw_rad) { return {p_m.x(), p_m.y(), yaw_rad}; }

bool same_heading(double a_rad, double b_rad) { return std::abs(wrap_angle(a_rad - b_rad)) < 1e-9; }

/// Outlines of the robot with less and less about it: what is made straight keeps no less than what
/// it is made from did. The last is for what has come to lie between cells.
class KeptMargins {
 public:
  explicit KeptMargins(const FootprintSpace& space) : space_(space) {
    const FloorOutline& outline = space.robot().outline;
    outlines_ = {grown(outline, space.margin_m(Margin::preferred)),
                 grown(outline, space.margin_m(Margin::least)),
                 grown(outline, 0.5 * space.margin_m(Margin::least))};
  }
  /// Of them, the first that fits all along, or the last.
  [[nodiscard]] std::size_t along(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                  double yaw_rad) const {
    return first([&](std::size_t i) { return fit_along(i, from, to, yaw_rad); });
  }
  /// The same where it turns from one pose to another, moving evenly.
  [[nodiscard]] std::size_t turning(const Pose2& from, const Pose2& to) const {
    return first([&](std::size_t i) { return fit_turning(i, from, to); });
  }
  [[nodiscard]] bool fit_along(std::size_t i, const Eigen::Vector2d& from,
                               const Eigen::Vector2d& to, double yaw_rad) const {
    return space_.fits_along(outlines_[i], from, to, yaw_rad);
  }
  [[nodiscard]] bool fit_turning(std::size_t i, const Pose2& from, const Pose2& to) const {
    constexpr double kSample_rad = 0.02;
    const double turn_rad = wrap_angle(to.yaw_rad - from.yaw_rad);
    const Eigen::Vector2d way = position(to) - position(from);
    const int samples = 1 + static_cast<int>(std::abs(turn_rad) / kSample_rad);
    for (int k = 0; k <= samples; ++k) {
      const double share = static_cast<double>(k) / samples;
      const Eigen::Vector2d p_m = position(from) + share * way;
      if (!space_.fits(outlines_[i], pose_at(p_m, from.yaw_rad + share * turn_rad))) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t first(auto&& fits) const {
    std::size_t i = 0;
    while (i + 1 < outlines_.size() && !fits(i)) ++i;
    return i;
  }
  const FootprintSpace& space_;
  std::array<FloorOutline, 3> outlines_;
};

class PathBuilder {
 public:
  explicit PathBuilder(const PathField& field)
      : field_(field), space_(*field.space), margins_(space_) {
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
    const std::vector<std::size_t> kept_by_step = kept_by_steps(poses, yaw_rad);
    const std::span kept(kept_by_step);
    for (std::size_t anchor = 0; anchor + 1 < poses.size();) {
      const std::size_t next =
          anchor + straight_to(poses.subspan(anchor), kept.subspan(anchor), yaw_rad);
      const Eigen::Vector2d to = position(poses[next]);
      leg.waypoints.push_back(
          pose_at(to, heading_along(space_.robot(), position(poses[anchor]), to, yaw_rad)));
      anchor = next;
    }
    add(std::move(leg));
  }

  /// On to where it goes on straight, or as far as it must not be turned the other way: a robot
  /// turns to a heading the shorter way, in which something may stand. It moves evenly from the
  /// first place to the last one then, and has to keep there what it would by the turns that this
  /// one is made of: the search has moved each heading to where it fits.
  [[nodiscard]] std::size_t end_of_turn(std::span<const Pose2> poses, std::size_t from) const {
    constexpr double kLongest_rad = 2.5;
    std::size_t turned = from + 1;
    double turn_rad = wrap_angle(poses[turned].yaw_rad - poses[from].yaw_rad);
    std::size_t kept = margins_.turning(poses[from], poses[turned]);
    for (; turned + 1 < poses.size(); ++turned) {
      const double more_rad = wrap_angle(poses[turned + 1].yaw_rad - poses[turned].yaw_rad);
      turn_rad += more_rad;
      if (std::abs(more_rad) < 1e-9 || std::abs(turn_rad) > kLongest_rad) break;
      kept = std::max(kept, margins_.turning(poses[turned], poses[turned + 1]));
      if (!margins_.fit_turning(kept, poses[from], poses[turned + 1])) break;
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
  /// What the outline keeps from each of the poses to the next.
  [[nodiscard]] std::vector<std::size_t> kept_by_steps(std::span<const Pose2> poses,
                                                       double yaw_rad) const {
    std::vector<std::size_t> kept;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const Eigen::Vector2d from = position(poses[i - 1]);
      const Eigen::Vector2d to = position(poses[i]);
      kept.push_back(margins_.along(from, to, heading_along(space_.robot(), from, to, yaw_rad)));
    }
    return kept;
  }

  /// The last of the poses that it gets to straight from the first, keeping what it would by way of
  /// those between.
  [[nodiscard]] std::size_t straight_to(std::span<const Pose2> poses,
                                        std::span<const std::size_t> kept_by_step,
                                        double yaw_rad) const {
    const Eigen::Vector2d from = position(poses.front());
    for (std::size_t i = poses.size() - 1; i > 1; --i) {
      const Eigen::Vector2d to = position(poses[i]);
      const std::size_t kept = std::ranges::max(kept_by_step.first(i));
      if (margins_.fit_along(kept, from, to, heading_along(space_.robot(), from, to, yaw_rad))) {
        return i;
      }
    }
    return 1;
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
  KeptMargins margins_;
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

}  // namespace vantage
