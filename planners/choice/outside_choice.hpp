/// A choice that is none of ours: what it is asked at each decision, and what it may answer. A
/// function of a host language answers, or a program that is asked through a pipe; the episode that
/// asks does not know which.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "vantage/belief/map/block_field.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/error.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// What a robot that maps knows between two scans: its belief, nothing of the truth. What it refers
/// to lasts as long as the call that hands it over.
struct MapSituation {
  const OccupancyGrid& grid;       ///< holes filled: what planning looks at
  const BlockField& transmission;  ///< p(a beam passes an unobserved cell), as learnt so far
  FieldOfView field_of_view;       ///< of one scan
  Pose2 T_world_base;              ///< as the robot believes
  std::size_t scans = 0;           ///< taken so far
  int scans_left = 0;
  double time_s = 0.0;  ///< simulated, from the start
  double energy_j = 0.0;
  Allowance left;       ///< of the budget; infinite without one
  double scan_s = 0.0;  ///< that the last scan took
};

/// Which view next?
struct DecisionRequest {
  MapSituation situation;
  /// With gains, lengths of the ways there, and without any truth. Exhausted ones are not to be
  /// chosen.
  std::span<const Candidate> candidates;
  std::vector<double> travel_s;  ///< of each candidate, by the robot's drives so far; infinite
                                 ///< where out of reach
  /// Low and high end of what the robot holds each candidate's gain for, by its forecasts so far;
  /// empty where the gain forecasts nothing that scans tell.
  std::vector<std::array<double, 2>> interval_cells = {};
  const Gain& gain;        ///< that the candidates were scored by
  const PathField& paths;  ///< the floor as it is known, and the ways over it from here
  /// What the episode's own choice would take. Asked at most once; it may draw random numbers.
  std::function<std::size_t()> own_choice;
};

/// Index of a candidate, or where the base shall stand and look from.
using OutsideDecision = std::variant<std::size_t, Pose2>;

/// What is known of whoever answers, name and value, for the manifest.
using PlannerFacts = std::vector<std::pair<std::string, std::string>>;

struct OutsideChoice {
  std::string name;  ///< of the method, for metrics and tables
  std::function<OutsideDecision(const DecisionRequest&)> decide;
  /// After the last scan, if anybody wants to know what came of it; may be empty.
  /// @param at_limit scans or budget were used up, there was more to be seen
  std::function<void(const MapSituation&, bool at_limit)> ended;
  /// It looks at nothing: it takes what own_choice() says, or a candidate by its number. It alone
  /// may stand in the place of a choice that knows ground truth.
  bool blind = false;
  std::function<PlannerFacts()> facts = {};  ///< may be empty
};

/// An answer that cannot be carried out.
struct BadDecision : Error {
  explicit BadDecision(const std::string& why) : Error(ExitCode::goal_failed, why) {}
};

/// @throws BadDecision if the index is none of a candidate that can be taken, or the pose is not
/// finite or not on known free floor that the robot can reach.
void check_decision(const OutsideDecision& decision, const DecisionRequest& request);

}  // namespace vantage
