#include "vantage/tasks/change_detection/change_detection_task.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/tasks/change_detection/change_ground_truth.hpp"
#include "vantage/tasks/flight/full_turn.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"
#include "vantage/tasks/object_flight/object_flight_metrics.hpp"
#include "vantage/tasks/object_flight/object_flight_records.hpp"
#include "vantage/tasks/object_flight/object_flight_run.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// @throws InputError if the model file is missing, saying how to make one, or damaged; ConfigError
/// if it does not know what is or what is expected there, or does not fit the task.
Recogniser load_recogniser(const ChangeDetectionTask& task, const ObjectOnTable& truth,
                           const ObjectOnTable& expected) {
  const auto path = find_recognition_model(task.model);
  Recogniser recogniser = load_lean_recogniser(path, task.recogniser);
  require_answer(recogniser, path, truth.object, "stands on the table");
  require_known(recogniser, path, expected.object, "is expected there");
  require_fits(task.decision, recogniser);
  return recogniser;
}

/// The nearest bearing from which what is expected is in the middle of a yaw bin: from there a turn
/// by more than half a bin shows.
double first_bearing_rad(double expected_yaw_rad, double start_rad, double bin_rad) {
  return wrap_turn(start_rad + std::remainder(expected_yaw_rad - start_rad, bin_rad));
}

/// Whether the model can tell what is there from what is expected. A table that is as expected,
/// empty, or has what the model does not know, can be told from any.
bool is_detectable(const Recogniser& recogniser, const ObjectOnTable& truth,
                   const ObjectOnTable& expected, double first_rad) {
  const bool unchanged = truth.object == expected.object && truth.yaw_rad == expected.yaw_rad;
  const auto& known = recogniser.states.objects;
  if (unchanged || std::ranges::find(known, truth.object) == known.end()) return true;
  const auto seen_at_first = [&](const ObjectOnTable& object) {
    return state_seen(recogniser.states, object.object, object.yaw_rad - first_rad);
  };
  return distinguishable(recogniser, seen_at_first(truth), seen_at_first(expected));
}

/// What was decided of the change, beside what has changed.
void add_change(const ChangeDetectionTask& task, const ObjectOnTable& expected, bool detectable,
                const ObjectFlightParts& run, Json& metrics) {
  metrics["scenario"] = task.scenario;
  metrics["decision"] = metrics["change_probability"] = nullptr;
  metrics["correct"] = metrics["changed_correct"] = false;
  if (!run.records().empty()) {
    const SuspectedChange& change = run.records().back().change.value();
    metrics["decision"] = to_string(change.verdict);
    metrics["correct"] = to_string(change.verdict) == task.scenario;
    metrics["changed_correct"] =
        (change.verdict == Change::none) == (task.scenario == to_string(Change::none));
    metrics["change_probability"] = change.probability;
  }
  metrics["detectable"] = detectable;
  metrics["detectable_correct"] = detectable && metrics["changed_correct"].get<bool>();
  metrics["expected"] = {{"object", expected.object}, {"yaw_rad", expected.yaw_rad}};
}

const auto kScalars = std::to_array<ScalarMeasure>({
    kCorrect,
    {{"changed_correct", "told changed from unchanged, share", Better::higher},
     [](const MeasuredEpisode& e) { return number_of(e, "changed_correct"); }},
    {{"detectable", "the model can tell it, share"},
     [](const MeasuredEpisode& e) { return number_of(e, "detectable"); }},
    {{"detectable_correct", "told what the model can tell, share of all", Better::higher},
     [](const MeasuredEpisode& e) { return number_of(e, "detectable_correct"); }},
    {{"change_probability", "probability of a change at the end"},
     [](const MeasuredEpisode& e) { return number_of(e, "change_probability"); }},
    kViews,
    kStateEntropy,
    kMapProbability,
    kBinError,
    kViewPositionError,
    kViewAngleError,
    kPathLength,
    kCollisions,
    kSimulatedTime,
});

constexpr auto kHeadlines =
    std::to_array<std::string_view>({"correct", "change_probability", "entropy_bits", "views",
                                     "path_length_m", "simulated_time_s"});

const auto kCurves = std::to_array<CurveMeasure>({kViewEntropy});

/// It would not be read.
void refuse_enough(const EnoughViews& enough) {
  const EnoughViews otherwise;
  if (enough.object_probability == otherwise.object_probability &&
      enough.entropy_bits == otherwise.entropy_bits) {
    return;
  }
  throw ConfigError(
      "enough: ends a recognition; change detection ends by unchanged_below and changed_above");
}

void require_turn(double turned_rad) {
  constexpr double kSameYaw_rad = 1e-6;
  if (std::abs(std::remainder(turned_rad, kTurn_rad)) >= kSameYaw_rad) return;
  throw ConfigError(fmt::format(
      "turned_rad: {:g} turns nothing, so that scenario pose changes nothing", turned_rad));
}

}  // namespace

/// What stands on the table is what is expected there, unless it is another object.
void ChangeDetectionTask::check_with(const EpisodeOptions& episode) const {
  ObjectFlight::check_with(episode);
  if (!change_named(scenario)) {
    throw ConfigError(fmt::format(
        "scenario: unknown scenario '{}'; known: none, object, pose, removed", scenario));
  }
  change.check();
  refuse_enough(decision.enough);
  if (turned_rad && scenario == to_string(Change::pose)) require_turn(*turned_rad);
  if (object.empty()) return;
  if (scenario != to_string(Change::object)) {
    throw ConfigError(
        fmt::format("object: '{}' is another object, which scenario: {} has not; what should stand "
                    "there is expected_object",
                    object, scenario));
  }
  if (object == expected_object) {
    throw ConfigError(fmt::format(
        "object: '{}' is what expected_object says, so that scenario object changes nothing",
        object));
  }
}

ObjectOnTable draw_expected_object(const ChangeDetectionTask& task, std::uint64_t seed) {
  const std::vector<ObjectName> names = known_objects(task);
  const ObjectName& name =
      named_or_drawn(names, task.expected_object, "expected_object", Rng::stream(seed, "object"));
  const double yaw_rad = task.expected_yaw_rad.value_or(drawn_yaw_rad(seed, "object yaw"));
  return {name.object, name.category, wrap_turn(yaw_rad)};
}

ModelSource ChangeDetectionTask::model_source(const EpisodeSetup& setup) const {
  return {setup.scene, setup.robot.mjcf,
          object_files(*this, draw_object(*this, setup.options.seed))};
}

ReportSections ChangeDetectionTask::report() {
  return {.figures = "change",
          .steps = "observations",
          .step_word = "view",
          .scene = true,
          .view_heading = "The flight, view by view"};
}

Measures ChangeDetectionTask::measures() { return {kScalars, kCurves, nullptr, kHeadlines}; }

RecordTexts ChangeDetectionTask::records() {
  constexpr auto kOfChange = std::to_array<RecordText>({
      {"steps.csv", "change_probability", "that something has changed"},
      {"steps.csv", "decision", "none, object, pose or removed"},
      {"metrics.json", "scenario", "what has changed: none, object, pose or removed"},
      {"metrics.json", "decision", "what was decided at the end; null: no view was taken"},
      {"metrics.json", "change_probability", "that something has changed, at the end"},
      {"metrics.json", "changed_correct", "changed was told from unchanged"},
      {"metrics.json", "detectable",
       "by the model alone at most 5 % of decisions between what is there and what is expected "
       "would be wrong, of views from all sides; true if both are the same, if nothing is there, "
       "or something that the model does not know"},
      {"metrics.json", "detectable_correct", "detectable, and changed was told from unchanged"},
      {"metrics.json", "expected.object", "what the robot was told stands there"},
      {"metrics.json", "expected.yaw_rad", "the yaw that it was told"},
  });
  return joined(object_flight_records(), kOfChange);
}

std::string ChangeDetectionTask::outcome(const Json& metrics) {
  const auto& probability = metrics["change_probability"];
  return fmt::format(
      "{}: {} after {} views, changed: {}, which is {} ({})\n"
      "probability of a change {}, path {:.2f} m, {} collisions, {:.1f} x real time\n",
      text_or_nothing(metrics, "method"), text_or_nothing(metrics, "status"),
      metrics["observations"].size(), text_or_nothing(metrics, "decision"),
      metrics["correct"].get<bool>() ? "right" : "wrong", text_or_nothing(metrics, "scenario"),
      probability.is_number() ? fmt::format("{:.3f}", probability.get<double>()) : "unknown",
      metrics["path_length_m"].get<double>(), metrics["collisions"].get<int>(),
      metrics["real_time_factor"].get<double>());
}

void ChangeDetectionTask::require_start(const EpisodeSetup& setup) const {
  const std::uint64_t seed = setup.options.seed;
  const ObjectOnTable truth = draw_object(*this, seed);
  const SimulatedOrbitRobot robot(setup, model_source(setup), *this, {&truth, 1});
  load_recogniser(*this, truth, draw_expected_object(*this, seed));
}

RunOutcome ChangeDetectionTask::run(const RunRequest& request) const {
  const EpisodeOptions& episode = request.setup.options;
  const ObjectOnTable truth = draw_object(*this, episode.seed);
  const ObjectOnTable expected = draw_expected_object(*this, episode.seed);
  SimulatedOrbitRobot robot(request.setup, model_source(request.setup), *this, {&truth, 1});
  const Recogniser recogniser = load_recogniser(*this, truth, expected);
  EpisodeRun run(request);
  ObjectFlightRecorder recorder(run, recorded(robot), decision.max_views, true);
  const ObjectFlightEvaluator evaluator(robot);
  const double first_rad =
      first_bearing_rad(expected.yaw_rad, robot.start_bearing_rad(), recogniser.states.bin_rad());
  const bool detectable = is_detectable(recogniser, truth, expected, first_rad);
  ChangeOptions options = change;
  options.recognition = decision;
  ObjectFlightParts parts(
      {episode, *this, recogniser, robot, evaluator, recorder},
      {.p_world_m = {p_world_table_m()}, .among_others = {}},
      ObjectInquiry(recogniser, options, expected.object, expected.yaw_rad - first_rad), first_rad,
      {expected.object, change.threshold});
  return run_object_flight(run, robot, recorder, parts, [&](Json& metrics) {
    add_change(*this, expected, detectable, parts, metrics);
    add_estimate(truth, parts, metrics);
    add_observations(*this, parts, metrics);
  });
}

}  // namespace vantage
