/// The choice `external`: a program of the user's in place of a choice of ours.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "vantage/planners/choice/external_choice.hpp"
#include "vantage/planners/choice/outside_choice.hpp"
#include "vantage/runtime/process/conversation.hpp"
#include "vantage/runtime/scratch_folder.hpp"
#include "vantage/tasks/mapping/external/planner_protocol.hpp"

namespace vantage {

/// Starts the program at the first decision, in a folder of its own, with an environment of few
/// variables, and ends it with the episode. Whatever it does wrong fails the episode.
class ExternalPlanner {
 public:
  /// @throws ConfigError if there is no such program
  ExternalPlanner(const ExternalChoice& choice, PlannerIntroduction introduction);
  ExternalPlanner(const ExternalPlanner&) = delete;
  ExternalPlanner& operator=(const ExternalPlanner&) = delete;

  /// Starts it and hears its first line; decide() does so if nobody has.
  /// @throws EpisodeFailed with the reason, Interrupted
  void greet();
  /// @throws EpisodeFailed with the reason, Interrupted; OutputError if the disk refuses the grids
  OutsideDecision decide(const DecisionRequest& request);
  /// Nothing more is asked: it may end by itself.
  void part();
  /// What the manifest says of it.
  [[nodiscard]] PlannerFacts facts() const;

  /// @param method its name in metrics @pre this outlives what is returned
  OutsideChoice as_outside_choice(std::string method);

 private:
  void start();
  template <class Work>
  auto or_fail(Work&& work);
  [[noreturn]] void fail(const std::string& why);

  ExternalChoice choice_;
  PlannerIntroduction introduction_;
  std::vector<std::string> command_;
  ScratchFolder scratch_;
  std::optional<Conversation> conversation_;
  PlannerFacts facts_;
  std::size_t decisions_ = 0;
};

}  // namespace vantage
