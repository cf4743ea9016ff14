#include "vantage/tasks/wait/wait.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>

#include "vantage/core/error.hpp"
#include "vantage/tasks/wait/simulated_turning_robot.hpp"
#include "vantage/tasks/wait/wait_parts.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

void add_metrics(const WaitParts& parts, Json& metrics) {
  metrics["returns"] = 0;
  metrics["scans"] = Json::array();
  for (const WaitRecord& record : parts.records()) {
    metrics["scans"].push_back({{"time_s", record.time_s}, {"returns", record.returns}});
    metrics["returns"] = metrics["returns"].get<std::size_t>() + record.returns;
  }
}

const auto kScalars = std::to_array<ScalarMeasure>({
    {{"returns", "returns of all scans"},
     [](const MeasuredEpisode& e) { return number_of(e, "returns"); }},
    kCollisions,
    kSimulatedTime,
});

constexpr auto kCurves = std::to_array<CurveMeasure>(
    {{{"scan_returns", "returns of a scan"},
      [](const MeasuredEpisode& e) { return step_values(e, "scans", "returns"); }}});

}  // namespace

void Wait::check_with(const EpisodeOptions& episode) const {
  if (turning_time_s >= episode.simulation.control_period_s) return;
  throw ConfigError(fmt::format("turning_time_s: {} is below simulation.control_period_s = {}",
                                turning_time_s, episode.simulation.control_period_s));
}

ModelSource Wait::model_source(const EpisodeSetup& setup) const {
  return {setup.scene, setup.robot.mjcf};
}

TaskExtent Wait::extent(const EpisodeSetup&) const {
  return {"scans", "scans", static_cast<std::size_t>(scans)};
}

WindowContent Wait::window() const { return {.scans = static_cast<std::size_t>(scans)}; }

ReportSections Wait::report() {
  return {.steps = "scans", .step_word = "scan", .view_heading = "Where the robot waits"};
}

Measures Wait::measures() { return {kScalars, kCurves}; }

RecordTexts Wait::records() { return {}; }

std::string Wait::outcome(const Json& metrics) {
  return fmt::format("wait: {}, {} returns in {} scans\n", metrics["status"].get<std::string>(),
                     metrics["returns"].get<std::size_t>(), metrics["scans"].size());
}

void Wait::require_start(const EpisodeSetup& setup) const {
  const SimulatedTurningRobot robot(setup, *this);
}

RunOutcome Wait::run(const RunRequest& request) const {
  SimulatedTurningRobot robot(request.setup, *this);
  EpisodeRun run(request);
  WaitRecorder recorder(run, robot.recorded(), scans);
  WaitParts parts(*this, request.setup.options.seed, robot, recorder);
  run.begin();
  const Ending ending = ending_of([&] { return run_episode(parts); });
  return run.finish(ending, {robot.time_s(), robot.collisions()}, recorder,
                    [&](Json& metrics) { add_metrics(parts, metrics); });
}

}  // namespace vantage
