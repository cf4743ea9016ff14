#include "vantage/tasks/mapping/outside_decision.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {
namespace {

std::vector<double> travel_times_s(const TravelTime& time, const std::vector<Candidate>& views) {
  std::vector<double> travel_s;
  for (const Candidate& view : views) {
    travel_s.push_back(std::isfinite(view.path_length_m) ? time.of_m(view.path_length_m)
                                                         : std::numeric_limits<double>::infinity());
  }
  return travel_s;
}

/// Of cells: `adaptive` alone is held against what scans show.
std::vector<std::array<double, 2>> intervals_of(const ForecastInterval* forecast, const Gain& gain,
                                                const std::vector<Candidate>& views) {
  std::vector<std::array<double, 2>> intervals;
  if (forecast == nullptr || !std::holds_alternative<AdaptiveGain>(gain)) return intervals;
  for (const Candidate& view : views) {
    const CellInterval cells = forecast->of(view.gain_bits);
    intervals.push_back({cells.low, cells.high});
  }
  return intervals;
}

/// The view from where the base stands there, as the sensor is mounted.
Candidate view_from(const Pose2& base, std::size_t id, const MobileRobotInterface& robot,
                    const PathField& paths) {
  Candidate view;
  view.id = static_cast<int>(id);
  const Pose T_base_sensor = to_se3(robot.estimated_base()).inverse() * robot.estimated_sensor();
  view.T_world_sensor = to_se3(base) * T_base_sensor;
  view.path_length_m = path_length_m(paths, base);
  return view;
}

}  // namespace

MapSituation map_situation(const OutsideSituation& situation) {
  return {.grid = situation.belief.filled_grid(),
          .transmission = situation.transmission,
          .field_of_view = situation.robot.view_field(),
          .T_world_base = situation.robot.estimated_base(),
          .scans = situation.scans,
          .scans_left = situation.scans_left,
          .time_s = situation.robot.time_s(),
          .energy_j = situation.robot.energy_used_j(),
          .left = situation.budget.left(),
          .scan_s = situation.budget.rates().scan_s()};
}

std::size_t decide_outside(const OutsideChoice& outside, const OutsideSituation& situation,
                           const PathField& paths, const Gain& gain,
                           const std::function<std::size_t()>& own_choice,
                           std::vector<Candidate>& candidates) {
  const DecisionRequest request{
      .situation = map_situation(situation),
      .candidates = candidates,
      .travel_s = travel_times_s(situation.budget.rates().travel_time(), candidates),
      .interval_cells = intervals_of(situation.interval, gain, candidates),
      .gain = gain,
      .paths = paths,
      .own_choice = own_choice};
  const OutsideDecision decision = outside.decide(request);
  try {
    check_decision(decision, request);
  } catch (const BadDecision& error) {
    throw EpisodeFailed(outside.name + ": " + error.what());
  }
  if (const auto* index = std::get_if<std::size_t>(&decision)) return *index;
  std::array<Candidate, 1> own{
      view_from(std::get<Pose2>(decision), candidates.size(), situation.robot, paths)};
  std::vector<Candidate> paid(own.begin(), own.end());
  situation.budget.leave_affordable(paid);
  if (paid.front().exhausted) {
    throw EpisodeFailed(outside.name + ": the budget does not allow the pose that was chosen");
  }
  own[0].gain_bits = view_gains_bits(gain, {request.situation.grid, &situation.transmission}, own,
                                     request.situation.field_of_view, 1)
                         .front();
  candidates.push_back(own[0]);
  return candidates.size() - 1;
}

}  // namespace vantage
