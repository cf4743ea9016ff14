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
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i].over().empty()) open.push_back(i);
  }
  return open;
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
  NextView all;
  double best = 0.0;
  for (std::size_t first = 0; first < options.size(); first = all.decision.scores.size()) {
    const std::size_t target = options[first].target;
    std::vector<ObjectViewAction> actions;
    for (std::size_t i = first; i < options.size() && options[i].target == target; ++i) {
      actions.push_back(options[i].action);
    }
    const NextView next =
        next_view(recogniser, decision, tour.targets()[target].inquiry.recognition(), actions, rng);
    const auto& scores = next.decision.scores;
    const double score = scores[next.decision.action].score;
    if (first == 0 || score > best) {
      best = score;
      all.decision.action = first + next.decision.action;
    }
    all.decision.scores.insert(all.decision.scores.end(), scores.begin(), scores.end());
    all.time_s += next.time_s;
  }
  return all;
}

}  // namespace vantage
