#include "vantage/planners/navigation/centred_legs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace vantage {
namespace {

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
    return space_.fits_along(outlines_[steps], position(from), position(to), to.yaw_rad);
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
    const double yaw_rad =
        heading_along(space.robot(), p_from, p_to, wrap_angle(to.yaw_rad + turn_rad));
    const std::pair moved(Pose2{p_from.x(), p_from.y(), yaw_rad},
                          Pose2{p_to.x(), p_to.y(), yaw_rad});
    if (!clearance.keeps(kept + 1, moved.first, moved.second)) continue;
    best = moved;
    while (kept < Clearance::kMost && clearance.keeps(kept + 1, moved.first, moved.second)) ++kept;
  }
  return best;
}

}  // namespace

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
