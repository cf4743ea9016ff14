#include "vantage/planners/choice/outside_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

void check_index(std::size_t index, std::span<const Candidate> candidates) {
  if (index >= candidates.size()) {
    throw BadDecision(fmt::format("view {} was chosen, there are {}", index, candidates.size()));
  }
  const bool any_open =
      std::ranges::any_of(candidates, [](const Candidate& view) { return !view.exhausted; });
  if (any_open && candidates[index].exhausted) {
    throw BadDecision(
        fmt::format("view {} was chosen, which is exhausted: tried before and out of reach, or "
                    "beyond the budget",
                    index));
  }
}

void check_pose(const Pose2& base, const PathField& paths) {
  if (!std::isfinite(base.x_m) || !std::isfinite(base.y_m) || !std::isfinite(base.yaw_rad)) {
    throw BadDecision(
        fmt::format("the pose ({}, {}, {}) is not finite", base.x_m, base.y_m, base.yaw_rad));
  }
  constexpr double kFar_m = 1e6;
  if (std::abs(base.x_m) > kFar_m || std::abs(base.y_m) > kFar_m ||
      !paths.reachable(Eigen::Vector2d(base.x_m, base.y_m))) {
    throw BadDecision(
        fmt::format("the pose ({:.3f}, {:.3f}) m is not on known free floor in the robot's reach",
                    base.x_m, base.y_m));
  }
}

}  // namespace

void check_decision(const OutsideDecision& decision, const DecisionRequest& request) {
  if (const auto* index = std::get_if<std::size_t>(&decision)) {
    check_index(*index, request.candidates);
  } else {
    check_pose(std::get<Pose2>(decision), request.paths);
  }
}

}  // namespace vantage
