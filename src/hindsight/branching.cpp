#include "vantage/hindsight/branching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <string>

#include "vantage/runtime/manifest.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = line.find(','); comma != line.npos; comma = line.find(',')) {
    fields.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  fields.push_back(line);
  return fields;
}

template <class T>
T number(std::string_view text) {
  T value{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  expects(read.ec == std::errc{}, "a number in a row of steps.csv");
  return value;
}

/// How it is called where methods are compared.
std::string branch_name(const RecordedRun& run, std::size_t scan, std::optional<int> view) {
  if (!view) return run.method;
  return fmt::format("{}, view {} after scan {}", run.method, *view, scan);
}

/// The view of a program that is not asked again.
std::size_t recorded_view(const RecordedRun& run, const DecisionRequest& request) {
  const std::size_t scans = request.situation.scans;
  const int recorded = scans < run.scans.size() ? run.scans[scans].chosen_view : -1;
  const auto found = std::ranges::find(request.candidates, recorded, &Candidate::id);
  if (found == request.candidates.end()) {
    throw ConfigError(
        fmt::format("{}: scan {} was taken from a pose of the planner's own, which cannot be taken "
                    "again",
                    run.directory.string(), scans + 1));
  }
  return static_cast<std::size_t>(found - request.candidates.begin());
}

}  // namespace

bool was_chosen_outside(const RecordedRun& run) {
  const auto of_task = []<class T>(const T& task) {
    if constexpr (std::derived_from<T, MappingOptions>) return asks_outside(task.choice);
    return false;
  };
  // What another planner of the library's own interface chose, a branch say, goes by its name.
  return std::visit(of_task, run.episode.task) || run.method != method_name(run.episode.task);
}

StepRow read_step(std::string_view columns, std::string_view row) {
  const auto names = fields_of(columns);
  const auto values = fields_of(row);
  const auto value = [&](std::string_view name) {
    const auto found = std::ranges::find(names, name);
    expects(found != names.end() && names.size() == values.size(), "a column of steps.csv");
    return values[static_cast<std::size_t>(found - names.begin())];
  };
  return {.scan = number<std::size_t>(value("scan")),
          .time_s = number<double>(value("time_s")),
          .path_length_m = number<double>(value("path_length_m")),
          .cells_left = number<long long>(value("observable_unobserved_cells")),
          .chosen_view = number<int>(value("chosen_view")),
          .fallback = value("fallback") == "true"};
}

void RecordedDecisions::differs(std::size_t scan, const std::string& how) const {
  throw ReplayDiffers(fmt::format(
      "{}: the repetition differs at scan {}: {}; recorded by {}, this is {} (vantage replay tells "
      "whether the scene has changed)",
      run_.directory.string(), scan, how, run_.version, version_text()));
}

std::size_t RecordedDecisions::repeated(const DecisionRequest& request) const {
  if (was_chosen_outside(run_)) return recorded_view(run_, request);
  const std::size_t chosen = request.own_choice();
  const std::size_t scans = request.situation.scans;
  if (scans >= run_.scans.size()) return chosen;
  const int recorded = run_.scans[scans].chosen_view;
  const int id = request.candidates[chosen].id;
  if (id != recorded) differs(scans + 1, fmt::format("view {}, recorded {}", id, recorded));
  return chosen;
}

void RecordedDecisions::check(const StepRow& step) const {
  if (step.scan == 0 || step.scan > run_.scans.size()) return;
  const RecordedScan& recorded = run_.scans[step.scan - 1];
  if (step.time_s != recorded.time_s) {
    differs(step.scan, fmt::format("it ends at {} s, recorded {}", step.time_s, recorded.time_s));
  }
  if (step.cells_left != static_cast<long long>(recorded.cells_left)) {
    differs(step.scan,
            fmt::format("{} cells are left, recorded {}", step.cells_left, recorded.cells_left));
  }
}

void refuse_to_go_on(const RecordedRun& run) {
  throw ConfigError(fmt::format(
      "{}: its views were not chosen by the choice of its configuration but from outside, by a "
      "program or another view of a branch, which does not go on from a branch; --all without "
      "--then says what each view would have shown",
      run.directory.string()));
}

void require_decision(const RecordedRun& run, long long scan) {
  const long long decisions = std::ssize(run.scans) - 1;
  if (scan >= 1 && scan <= decisions) return;
  if (decisions == 0) {
    throw ConfigError(fmt::format("--scan: {}: {} has one scan, after which nothing was decided",
                                  scan, run.directory.string()));
  }
  throw ConfigError(fmt::format("--scan: {}: {} has {} scans, and decisions after scan 1 to {}",
                                scan, run.directory.string(), run.scans.size(), decisions));
}

void require_view(const RecordedRun& run, std::size_t scan, int view) {
  const int views = run.scans[scan].candidates;
  if (view >= 0 && view < views) return;
  throw ConfigError(fmt::format("--view: {}: the decision after scan {} has views 0 to {}", view,
                                scan, views - 1));
}

std::size_t takeable(const DecisionRequest& request, int view) {
  const auto found = std::ranges::find(request.candidates, view, &Candidate::id);
  expects(found != request.candidates.end(), "a view of the decision");
  const auto index = static_cast<std::size_t>(found - request.candidates.begin());
  try {
    check_decision(index, request);
  } catch (const BadDecision& error) {
    throw ConfigError(fmt::format("--view: {}: {}", view, error.what()));
  }
  return index;
}

RunOutcome run_branch(const RecordedRun& run, std::size_t scan, std::optional<int> view,
                      RunOptions options) {
  if (view) require_view(run, scan, *view);
  if (view && was_chosen_outside(run)) refuse_to_go_on(run);
  const RecordedDecisions recorded(run);
  const auto decide = [&](const DecisionRequest& request) -> OutsideDecision {
    const std::size_t scans = request.situation.scans;
    if (!view || scans < scan) return recorded.repeated(request);
    const std::size_t own = request.own_choice();
    return scans == scan ? takeable(request, *view) : own;
  };
  options.outside = {
      .name = branch_name(run, scan, view), .decide = decide, .ended = {}, .blind = true};
  options.spectator.on_step = [&](std::string_view columns, std::string_view row) {
    const StepRow step = read_step(columns, row);
    if (!view || step.scan <= scan) recorded.check(step);
  };
  return vantage::run(run.episode, options);
}

}  // namespace vantage
