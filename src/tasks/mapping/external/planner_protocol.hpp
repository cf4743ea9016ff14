/// What a planner of the user's is told, and what it may answer: lines of JSON, docs/protocol.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <string_view>

#include "vantage/planners/choice/outside_choice.hpp"

namespace vantage {

inline constexpr int kPlannerProtocol = 1;

/// What is said once, before the first decision.
struct PlannerIntroduction {
  std::string task = {};
  std::uint32_t seed = 0;  ///< for random numbers of its own; tells nothing of the episode's
  int scans = 0;           ///< at most
  std::string gain = {};
  std::string gain_unit = {};
  Allowance budget = {};
};
std::string introduction_line(const PlannerIntroduction& introduction);

/// The name that the planner gives itself, which may be empty.
/// @throws BadDecision if it does not speak this protocol
std::string read_introduction(std::string_view line);

/// No wall time, no path of this machine: the same situation is the same line.
/// @param number of the decision, the first is 1 @param grids files and what they hold
std::string request_line(const DecisionRequest& request, std::size_t number,
                         const nlohmann::ordered_json& grids);

/// {"view": 3} or {"pose": [x, y, yaw]}; other keys beside it are let be.
/// @throws BadDecision saying what is wrong with it. Whether it can be carried out is another
/// question, see check_decision().
OutsideDecision read_answer(std::string_view line);

/// That nothing more is asked.
std::string end_line();

}  // namespace vantage
