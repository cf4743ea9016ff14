/// The options of a choice that a program of the user's makes. The program is run by whoever runs
/// the episode.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/strategy.hpp"

namespace vantage {

/// No function of candidates: the episode asks the program, see OutsideChoice.
struct ExternalChoice {
  static constexpr std::string_view name = "external";
  static constexpr StrategyText text{
      .summary =
          "Asks a program of your own, in any language, one line of JSON a decision over its "
          "standard input and output: docs/protocol. It is told what the robot believes, never the "
          "truth. A program that is late, breaks off or answers what cannot be carried out fails "
          "the run."};
  static constexpr bool weighs_gain = true;
  std::vector<std::string> command;
  double timeout_s = 10.0;
  double startup_timeout_s = 30.0;
  void fields(auto&& f) {
    f("command", command,
      "program and its arguments; those that name a file are looked for beside the episode, in the "
      "working directory and among what comes with Vantage");
    f("timeout_s", timeout_s,
      "wall time that the program may take for a decision; higher waits longer before the run "
      "fails",
      between(0.01, 86400.0));
    f("startup_timeout_s", startup_timeout_s,
      "wall time that the program may take from its start to its first line; higher waits longer "
      "before the run fails",
      between(0.01, 86400.0));
  }
  void check() const {
    if (command.empty() || command.front().empty()) {
      throw ConfigError(
          "command: names no program; choice: {name: external, command: [python3, "
          "my_planner.py]}");
    }
  }
};

}  // namespace vantage
