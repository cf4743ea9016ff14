#include "vantage/tasks/recognition/recognition_task.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"
#include "vantage/tasks/object_flight/object_flight_metrics.hpp"
#include "vantage/tasks/object_flight/object_flight_records.hpp"
#include "vantage/tasks/object_flight/object_flight_run.hpp"
#include "vantage/tasks/recognition/recognition_ground_truth.hpp"
#include "vantage/tasks/table_map/table_map.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// @throws InputError if the model file is missing, saying how to make one, or damaged; ConfigError
/// if it neither knows the objects on the table nor can call them unknown, or does not fit.
Recogniser load_recogniser(const RecognitionTask& task, const TableGroundTruth& table) {
  const auto path = find_recognition_model(task.model);
  Recogniser recogniser = load_lean_recogniser(path, task.recogniser);
  for (const ObjectOnTable& target : table.targets) {
    require_answer(recogniser, path, target.object, "stands on the table");
  }
  require_fits(task.decision, recogniser);
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

/// What the target is and what it was taken for.
Json target_json(const ObjectOnTable& truth, const ObjectFlightParts& run, std::size_t target) {
  const auto views = std::ranges::count(run.records(), target, &ObservationRecord::target);
  const TourTarget& known = run.tour().targets()[target];
  Json json = {{"truth", truth.object},
               {"x_m", known.p_world_m.x()},
               {"y_m", known.p_world_m.y()},
               {"views", views},
               {"over", known.over()}};
  const ObservationRecord* last = last_view_of(run, target);
  json["estimate"] = last != nullptr ? Json(last->estimate) : Json(nullptr);
  json["map_probability"] = last != nullptr ? Json(last->map_probability) : Json(nullptr);
  const RightAnswer right = right_answer(run.recogniser().states, truth);
  json["correct"] = last != nullptr && last->estimate == right.object;
  json["category_correct"] = last != nullptr && last->category == right.category;
  return json;
}

Json other_json(const RecognitionTask& task, const ObjectOnTable& other) {
  return {{"object", other.object},
          {"x_m", task.table_m[0] + other.offset_m.x()},
          {"y_m", task.table_m[1] + other.offset_m.y()},
          {"yaw_rad", other.yaw_rad}};
}

void add_metrics(const RecognitionTask& task, const TableGroundTruth& table,
                 const ObjectFlightParts& run, Json& metrics) {
  add_estimate(table.targets.front(), run, metrics);
  metrics["targets"] = metrics["others"] = Json::array();
  for (std::size_t i = 0; i < table.targets.size(); ++i) {
    metrics["targets"].push_back(target_json(table.targets[i], run, i));
  }
  for (const ObjectOnTable& other : table.others) {
    metrics["others"].push_back(other_json(task, other));
  }
  for (const char* key : {"correct", "category_correct"}) {
    metrics[key] =
        std::ranges::all_of(metrics["targets"], [&](const Json& t) { return t[key].get<bool>(); });
  }
  const auto right = std::ranges::count_if(metrics["targets"],
                                           [](const Json& t) { return t["correct"].get<bool>(); });
  metrics["targets_correct"] = static_cast<double>(right) / std::ssize(table.targets);
  add_observations(task, run, metrics);
  if (task.among_others()) {
    metrics["region"] = box_json(TableMap::frame_of(task.p_world_table_m(), task.map).box());
  }
}

FlightGoal goal_of(const RecognitionTask& task, const TableGroundTruth& table) {
  FlightGoal goal{.p_world_m = {},
                  .among_others = {},
                  .time_limit_s = task.time_limit_s,
                  .all_at_once = task.targets_at_once};
  for (const ObjectOnTable& target : table.targets) {
    goal.p_world_m.emplace_back(task.p_world_table_m() +
                                Eigen::Vector3d(target.told_m.x(), target.told_m.y(), 0.0));
  }
  if (task.among_others()) goal.among_others = {task.map, task.separation};
  return goal;
}

/// Those that were not used.
double hidden_views(const MeasuredEpisode& episode) {
  const auto& views = episode.metrics.at("observations");
  return static_cast<double>(std::ranges::count_if(views, [](const Json& view) {
    const auto reason = view.find("not_segmented");
    return reason != view.end() && !reason->get<std::string>().empty();
  }));
}

const auto kScalars = std::to_array<ScalarMeasure>({
    kCorrect,
    {{"category_correct", "recognised the category, share", Better::higher},
     [](const MeasuredEpisode& e) { return number_of(e, "category_correct"); }},
    {{"targets_correct", "recognised, share of the targets", Better::higher},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "targets_correct"); }},
    {{"hidden_views", "views in which the target was hidden", Better::lower},
     [](const MeasuredEpisode& e) -> std::optional<double> { return hidden_views(e); }},
    kViews,
    kSeenShare,
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
  return {setup.scene, setup.robot.mjcf, table_files(*this, draw_table(*this, setup.options.seed))};
}

void RecognitionTask::check_with(const EpisodeOptions& episode) const {
  ObjectFlight::check_with(episode);
  if (clutter.screens == 0 || clutter.screen_m <= map.height_m) return;
  throw ConfigError(
      fmt::format("clutter.screen_m {} is above map.height_m {}, where the robot is "
                  "told that nothing is",
                  clutter.screen_m, map.height_m));
}

TaskExtent RecognitionTask::extent(const EpisodeSetup& setup) const {
  TaskExtent extent = ObjectFlight::extent(setup);
  extent.count *= static_cast<std::size_t>(targets);
  return extent;
}

WindowContent RecognitionTask::window(const EpisodeSetup&) const {
  WindowContent content = window();
  if (among_others()) content.map = TableMap::frame_of(p_world_table_m(), map);
  return content;
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
  constexpr std::string_view kMetrics = "metrics.json";
  texts.insert(texts.end(),
               {{kMetrics, "category_correct", "the category of the estimate is right"},
                {kMetrics, "targets", "one entry an object that was to be recognised"},
                {kMetrics, "targets[].truth", "what it is"},
                {kMetrics, "targets[].x_m", "where it stands, as the robot was told, world"},
                {kMetrics, "targets[].y_m", "where it stands, as the robot was told, world"},
                {kMetrics, "targets[].views", "taken of it"},
                {kMetrics, "targets[].over", "why no more were taken; empty: it was not over"},
                {kMetrics, "targets[].estimate", "what it was taken for; null: no view was taken"},
                {kMetrics, "targets[].map_probability", "of the estimate; null: no view was taken"},
                {kMetrics, "targets[].correct", "the estimate is right"},
                {kMetrics, "targets[].category_correct", "its category is right"},
                {kMetrics, "targets_correct", "share of the targets that were recognised"},
                {kMetrics, "others", "what else stands on the table, one entry an object"},
                {kMetrics, "others[].object", "what it is"},
                {kMetrics, "others[].x_m", "of its middle, world"},
                {kMetrics, "others[].y_m", "of its middle, world"},
                {kMetrics, "others[].yaw_rad", "its yaw, world"}});
  return texts;
}

std::string RecognitionTask::outcome(const Json& metrics) {
  std::string recognised;
  for (const Json& target : metrics["targets"]) {
    recognised += fmt::format(
        ", recognised {}, which is {} ({})", text_or_nothing(target, "estimate"),
        target["correct"].get<bool>() ? "right" : "wrong", text_or_nothing(target, "truth"));
  }
  return fmt::format(
      "{}: {} after {} views{}\n"
      "entropy {:.2f} bit, path {:.2f} m, {} collisions, {:.1f} x real time\n",
      text_or_nothing(metrics, "method"), text_or_nothing(metrics, "status"),
      metrics["observations"].size(), recognised, metrics["entropy_bits"].get<double>(),
      metrics["path_length_m"].get<double>(), metrics["collisions"].get<int>(),
      metrics["real_time_factor"].get<double>());
}

void RecognitionTask::require_start(const EpisodeSetup& setup) const {
  const TableGroundTruth table = draw_table(*this, setup.options.seed);
  const ModelSource source{setup.scene, setup.robot.mjcf, table_files(*this, table)};
  const SimulatedOrbitRobot robot(setup, source, *this, table.targets);
  load_recogniser(*this, table);
  if (among_others()) TableMap(p_world_table_m(), map);
}

RunOutcome RecognitionTask::run(const RunRequest& request) const {
  const EpisodeSetup& setup = request.setup;
  const TableGroundTruth table = draw_table(*this, setup.options.seed);
  SimulatedOrbitRobot robot(setup, {setup.scene, setup.robot.mjcf, table_files(*this, table)},
                            *this, table.targets);
  const Recogniser recogniser = load_recogniser(*this, table);
  EpisodeRun run(request);
  ObjectFlightRecorder recorder(run, recorded(robot), decision.max_views * targets, false);
  const ObjectFlightEvaluator evaluator(robot);
  ObjectFlightParts parts({setup.options, *this, recogniser, robot, evaluator, recorder},
                          goal_of(*this, table), ObjectInquiry(recogniser, decision),
                          robot.start_bearing_rad());
  return run_object_flight(run, robot, recorder, parts,
                           [&](Json& metrics) { add_metrics(*this, table, parts, metrics); });
}

}  // namespace vantage
