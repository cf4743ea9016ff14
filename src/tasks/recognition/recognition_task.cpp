#include "vantage/tasks/recognition/recognition_task.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"
#include "vantage/tasks/object_flight/object_flight_metrics.hpp"
#include "vantage/tasks/object_flight/object_flight_records.hpp"
#include "vantage/tasks/object_flight/object_flight_run.hpp"
#include "vantage/tasks/recognition/recognition_ground_truth.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// @throws InputError if the model file is missing, saying how to make one, or damaged; ConfigError
/// if it neither knows the object on the table nor can call it unknown.
Recogniser load_recogniser(const RecognitionTask& task, const ObjectOnTable& object) {
  const auto path = find_recognition_model(task.model);
  Recogniser recogniser = load_lean_recogniser(path, task.recogniser);
  require_answer(recogniser, path, object.object, "stands on the table");
  return recogniser;
}

/// What it is to be held for.
struct RightAnswer {
  std::string object;
  std::string category;
};

RightAnswer right_answer(const ObjectStates& states, const ObjectOnTable& truth) {
  const auto or_unknown = [](const std::vector<std::string>& known, const std::string& name) {
    return std::ranges::find(known, name) != known.end() ? name : std::string(kUnknown);
  };
  return {or_unknown(states.objects, truth.object), or_unknown(states.categories, truth.category)};
}

void add_metrics(const RecognitionTask& task, const ObjectOnTable& truth,
                 const ObjectFlightParts& run, Json& metrics) {
  add_estimate(truth, run, metrics);
  metrics["correct"] = metrics["category_correct"] = false;
  if (!run.records().empty()) {
    const RightAnswer right = right_answer(run.recogniser().states, truth);
    metrics["correct"] = run.records().back().estimate == right.object;
    metrics["category_correct"] = run.records().back().category == right.category;
  }
  add_observations(task, run, metrics);
}

const auto kScalars = std::to_array<ScalarMeasure>({
    kCorrect,
    {{"category_correct", "recognised the category, share", Better::higher},
     [](const MeasuredEpisode& e) { return number_of(e, "category_correct"); }},
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

constexpr auto kHeadlines = std::to_array<std::string_view>(
    {"correct", "map_probability", "entropy_bits", "views", "path_length_m", "simulated_time_s"});

const auto kCurves = std::to_array<CurveMeasure>({kViewEntropy});

}  // namespace

ModelSource RecognitionTask::model_source(const EpisodeSetup& setup) const {
  return {setup.scene, setup.robot.mjcf,
          object_files(*this, draw_object(*this, setup.options.seed))};
}

ReportSections RecognitionTask::report() {
  return {.figures = "recognition",
          .steps = "observations",
          .step_word = "view",
          .scene = true,
          .view_heading = "The flight, view by view"};
}

Measures RecognitionTask::measures() { return {kScalars, kCurves, nullptr, kHeadlines}; }

RecordTexts RecognitionTask::records() {
  RecordTexts texts = object_flight_records();
  texts.push_back({"metrics.json", "category_correct", "the category of the estimate is right"});
  return texts;
}

std::string RecognitionTask::outcome(const Json& metrics) {
  return fmt::format(
      "{}: {} after {} views, recognised {}, which is {} ({})\n"
      "entropy {:.2f} bit, path {:.2f} m, {} collisions, {:.1f} x real time\n",
      text_or_nothing(metrics, "method"), text_or_nothing(metrics, "status"),
      metrics["observations"].size(), text_or_nothing(metrics, "estimate"),
      metrics["correct"].get<bool>() ? "right" : "wrong", text_or_nothing(metrics, "truth"),
      metrics["entropy_bits"].get<double>(), metrics["path_length_m"].get<double>(),
      metrics["collisions"].get<int>(), metrics["real_time_factor"].get<double>());
}

void RecognitionTask::require_start(const EpisodeSetup& setup) const {
  const ObjectOnTable truth = draw_object(*this, setup.options.seed);
  const SimulatedOrbitRobot robot(setup, model_source(setup), *this, truth.yaw_rad);
  load_recogniser(*this, truth);
}

RunOutcome RecognitionTask::run(const RunRequest& request) const {
  const EpisodeOptions& episode = request.setup.options;
  const ObjectOnTable truth = draw_object(*this, episode.seed);
  SimulatedOrbitRobot robot(request.setup, model_source(request.setup), *this, truth.yaw_rad);
  const Recogniser recogniser = load_recogniser(*this, truth);
  EpisodeRun run(request);
  ObjectFlightRecorder recorder(run, recorded(robot), decision.max_views, false);
  const ObjectFlightEvaluator evaluator(robot, truth);
  ObjectFlightParts parts({episode, *this, recogniser, robot, evaluator, recorder},
                          ObjectInquiry(recogniser, decision), robot.start_bearing_rad());
  return run_object_flight(run, robot, recorder, parts,
                           [&](Json& metrics) { add_metrics(*this, truth, parts, metrics); });
}

}  // namespace vantage
