#include "vantage/tasks/mapping/external/external_planner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <utility>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/runtime/process/command_files.hpp"
#include "vantage/tasks/mapping/external/planner_grids.hpp"

namespace vantage {
namespace {

/// To end by itself, write a file, say.
constexpr double kGrace_s = 2.0;

/// Of ours, what programs of any language are found by; nothing secret is among them.
constexpr auto kPassedOn = std::to_array<const char*>(
    {"PATH", "HOME", "LANG", "LC_ALL", "LC_CTYPE", "TZ", "LD_LIBRARY_PATH", "PYTHONPATH",
     "VIRTUAL_ENV", "PYENV_ROOT", "NODE_PATH", "JAVA_HOME", "JULIA_DEPOT_PATH"});

/// The same for the same episode: Python's hashes too.
std::vector<std::string> environment_in(const std::filesystem::path& folder) {
  std::vector<std::string> variables{"TMPDIR=" + folder.string(), "PYTHONHASHSEED=0",
                                     "PYTHONDONTWRITEBYTECODE=1"};
  for (const char* name : kPassedOn) {
    if (const char* value = std::getenv(name))
      variables.push_back(fmt::format("{}={}", name, value));
  }
  return variables;
}

}  // namespace

ExternalPlanner::ExternalPlanner(const ExternalChoice& choice, PlannerIntroduction introduction)
    : choice_(choice),
      introduction_(std::move(introduction)),
      command_(runnable_command(choice.command)) {
  facts_ = {{"command", fmt::format("{}", fmt::join(choice_.command, " "))}};
}

void ExternalPlanner::fail(const std::string& why) {
  conversation_.reset();
  const std::string when = decisions_ > 0 ? fmt::format(", decision {}", decisions_) : "";
  throw EpisodeFailed(
      fmt::format("planner {}{}: {}", printable(facts_.front().second, 200), when, why));
}

template <class Work>
auto ExternalPlanner::or_fail(Work&& work) {
  try {
    return work();
  } catch (const ConversationFailed& error) {
    fail(error.what());
  } catch (const BadDecision& error) {
    fail(error.what());
  } catch (const SpoiltFolder& error) {
    fail(error.what());
  }
}

void ExternalPlanner::greet() {
  or_fail([&] {
    if (!conversation_) start();
  });
}

void ExternalPlanner::start() {
  const ProgramToRun program{.command = command_,
                             .working_directory = scratch_.path(),
                             .environment = environment_in(scratch_.path())};
  try {
    conversation_.emplace(
        program,
        [](std::string_view line) { log_debug(fmt::format("planner: {}", printable(line, 1000))); },
        [] {
          throw_if_interrupted();
          poll_stop();
        });
  } catch (const OutputError& error) {
    fail(error.what());
  }
  const IsolatedProcess& process = conversation_->process();
  facts_.emplace_back("isolation",
                      process.is_isolated()
                          ? std::string("namespaces of its own: no network, no process outlives it")
                          : "none: " + process.refusal());
  if (!process.is_isolated()) {
    log_warning(fmt::format(
        "planner: it has the network: this system gives it no namespaces of its own ({})",
        process.refusal()));
  }
  const std::string answer =
      conversation_->ask(introduction_line(introduction_), choice_.startup_timeout_s);
  facts_.emplace_back("name", read_introduction(answer));
}

OutsideDecision ExternalPlanner::decide(const DecisionRequest& request) {
  ++decisions_;
  return or_fail([&] {
    if (!conversation_) start();
    const auto grids = write_planner_grids(request, scratch_.path());
    const OutsideDecision decision = read_answer(
        conversation_->ask(request_line(request, decisions_, grids), choice_.timeout_s));
    check_decision(decision, request);
    return decision;
  });
}

void ExternalPlanner::part() {
  if (!conversation_) return;
  try {
    conversation_->part(end_line(), kGrace_s);
  } catch (const ConversationFailed&) {
    // Nobody asks it any more.
  }
  conversation_.reset();
}

PlannerFacts ExternalPlanner::facts() const { return facts_; }

OutsideChoice ExternalPlanner::as_outside_choice(std::string method) {
  return {.name = std::move(method),
          .decide = [this](const DecisionRequest& request) { return decide(request); },
          .ended = [this](const MapSituation&, bool) { part(); },
          .facts = [this] { return facts(); }};
}

}  // namespace vantage
