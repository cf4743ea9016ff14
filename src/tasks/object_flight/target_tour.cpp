#include "vantage/tasks/object_flight/target_tour.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vantage {
namespace {

/// Between a can and a bottle.
constexpr double kUsualRadius_m = 0.05;
constexpr double kUsualHeight_m = 0.14;

}  // namespace

bool TourTarget::visited(int bearing_id) const {
  return std::ranges::find(bearing_ids, bearing_id) != bearing_ids.end();
}

UprightCylinder TourTarget::expected_shape() const {
  return shape.value_or(UprightCylinder{p_world_m, kUsualRadius_m, kUsualHeight_m});
}

std::string TourTarget::over() const {
  std::string reason = looked_at() ? inquiry.over() : "";
  return reason.empty() ? unreachable : reason;
}

TargetTour::TargetTour(const FlightGoal& goal, const ObjectInquiry& inquiry)
    : all_at_once_(goal.all_at_once) {
  expects(!goal.p_world_m.empty(), "something to look at");
  for (const Eigen::Vector3d& p_m : goal.p_world_m) {
    targets_.push_back({.p_world_m = p_m, .inquiry = inquiry});
  }
}

std::vector<std::size_t> TargetTour::open() const {
  if (!all_at_once_ && current().over().empty()) return {current_};
  return not_over();
}

std::vector<std::size_t> TargetTour::not_over() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i].over().empty()) found.push_back(i);
  }
  return found;
}

std::string TargetTour::reason() const {
  if (targets_.size() == 1) return current().over();
  std::string text = fmt::format("{} targets", targets_.size());
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const std::string over = targets_[i].over();
    text += fmt::format("{} {}", i == 0 ? ":" : ";", over.empty() ? "not over" : over);
  }
  return text;
}

NextView next_view(const TargetTour& tour, const Recogniser& recogniser,
                   const RecognitionOptions& decision, std::span<const BearingOption> options,
                   Rng& rng) {
  std::vector<ObjectViewAction> actions;
  for (const BearingOption& option : options) actions.push_back(option.action);
  const bool all_visited = std::ranges::all_of(actions, &ObjectViewAction::visited);
  NextView all;
  auto& scores = all.decision.scores;
  for (std::size_t first = 0; first < options.size(); first = scores.size()) {
    const std::size_t target = options[first].target;
    const auto other =
        std::find_if(options.begin() + static_cast<std::ptrdiff_t>(first), options.end(),
                     [&](const BearingOption& o) { return o.target != target; });
    const auto end = static_cast<std::size_t>(other - options.begin());
    const auto own = std::span<const ObjectViewAction>(actions).subspan(first, end - first);
    NextView next =
        next_view(recogniser, decision, tour.targets()[target].inquiry.recognition(), own, rng);
    if (!all_visited && std::ranges::all_of(own, &ObjectViewAction::visited)) {
      discount_visited(decision.views, own, next.decision.scores);
    }
    const auto best = std::ranges::max_element(next.decision.scores, {}, &ObjectViewScore::score);
    const auto at = static_cast<std::size_t>(best - next.decision.scores.begin());
    scores.insert(scores.end(), next.decision.scores.begin(), next.decision.scores.end());
    if (first == 0 || best->score > scores[all.decision.action].score) {
      all.decision.action = first + at;
    }
    all.time_s += next.time_s;
  }
  return all;
}

}  // namespace vantage
