// Short flights along waypoints: a small database is rendered and learnt, then flown past.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/dataset/render_dataset.hpp"
#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/recognition/training.hpp"
#include "vantage/report/drawn_scene.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/trajectory/flight_layout.hpp"
#include "vantage/tasks/trajectory/simulated_trajectory_robot.hpp"
#include "vantage/tasks/trajectory/trajectory_parts.hpp"
#include "vantage/tasks/validate.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kFlightSource = VANTAGE_SOURCE_DIR;
const fs::path kFlightEpisode = kFlightSource / "assets/episodes/trajectory.yaml";
const fs::path kArena = kFlightSource / "models/scenes/trajectory_4";
constexpr int kObjects = 4;

void make_small_model(const fs::path& dataset, const fs::path& model) {
  DatasetOptions objects;
  objects.objects = kObjects;
  objects.step_deg = 24.0;
  objects.supersampling = 1;
  render_dataset(objects, {.root = dataset});
  TrainingOptions training;
  training.features = {Colour{}, BoundingBox{}};
  training.transition_prior_moves = 0.0;
  write_recognition_model(train_recognition(index_dataset(dataset), training, {}), model);
}

/// The arena with another path.
fs::path arena_with_path(const fs::path& folder, const std::string& rows) {
  fs::create_directories(folder);
  for (const char* name : {"scene.xml", "objects.xml", "stands.csv"}) {
    fs::copy_file(kArena / name, folder / name);
  }
  write_file(folder / "path.csv", "x_m,y_m,z_m,yaw_rad\n" + rows);
  return folder / "scene.xml";
}

class TrajectoryEpisode : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::quiet);
    folder_.emplace();
    make_small_model(*folder_ / "objects", *folder_ / "model");
    past_a_support_ = arena_with_path(*folder_ / "past",
                                      "-2.67,-1.9,1.8,0\n-2.14,-1.9,1.8,0\n-1.61,-1.9,1.8,0\n"
                                      "-1.08,-1.9,1.8,0\n-0.55,-1.9,1.8,0\n-0.02,-1.9,1.8,0\n");
    first_ = metrics_of("first", past_a_support_, {});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::vector<std::string> overrides(const fs::path& scene,
                                            const std::vector<std::string>& more) {
    std::vector<std::string> all = {fmt::format("scene={}", scene.string()),
                                    fmt::format("model={}", (*folder_ / "model").string()),
                                    fmt::format("database.objects={}", kObjects),
                                    "recogniser.features=[]",
                                    "camera={width_px: 320, height_px: 240}",
                                    "image_rate_hz=5",
                                    "method={name: stomp, iterations: 10}"};
    all = support::overridden(std::move(all), more);
    return all;
  }
  static json metrics_of(const std::string& name, const fs::path& scene,
                         const std::vector<std::string>& more) {
    RunOptions options;
    options.directory = *folder_ / name;
    const RunOutcome outcome = run(load_episode(kFlightEpisode, overrides(scene, more)), options);
    code_ = outcome.code;
    return json::parse(outcome.metrics);
  }

  static inline std::optional<support::TemporaryDirectory> folder_;
  static inline fs::path past_a_support_;
  static inline json first_;
  static inline ExitCode code_ = ExitCode::done;
};

TEST_F(TrajectoryEpisode, SaysWhatTheContractAsksFor) {
  EXPECT_EQ(first_["task"], "trajectory");
  EXPECT_EQ(first_["status"], "completed") << first_["reason"];
  EXPECT_EQ(first_["method"], "stomp iterations=10");
  ASSERT_EQ(first_["objects"].size(), 4U);
  for (const json& object : first_["objects"]) {
    EXPECT_TRUE(object["truth"].is_string());
    EXPECT_EQ(object["correct"], object["estimate"] == object["truth"]);
    EXPECT_GE(object["entropy_nats"], 0.0);
    EXPECT_EQ(object["observations"], object["looks"].size());
  }
  for (const char* key :
       {"flight_time_s", "minimum_clearance_m", "energy_j", "accuracy", "mean_entropy_nats",
        "mean_entropy_observed_nats", "objects_unseen", "observations_total"}) {
    EXPECT_TRUE(first_[key].is_number()) << key;
  }
  EXPECT_LE(first_["tracking_error_m"]["mean"], 0.05);
  EXPECT_GE(first_["tracking_error_m"]["max"], first_["tracking_error_m"]["mean"]);
  EXPECT_GE(first_["plan_time_s"]["p95"], first_["plan_time_s"]["median"]);
  EXPECT_EQ(first_["collisions"], 0);
  EXPECT_EQ(first_["replans"], 5);
  EXPECT_EQ(first_["missed_deadlines"], 0);
  EXPECT_EQ(first_["reason"], "end of the path, 6 waypoints");
}

TEST_F(TrajectoryEpisode, KeepsThePlansOfEachDecision) {
  const CsvTable table = read_csv(*folder_ / "first" / "candidates.csv");
  std::map<std::string, int> chosen;
  for (const auto& row : table.rows) chosen[row.front()] += row.back() == "1" ? 1 : 0;
  EXPECT_EQ(chosen.size(), first_["replans"].get<std::size_t>());
  for (const auto& [decision, count] : chosen) EXPECT_EQ(count, 1) << decision;
  const CsvTable steps = read_csv(*folder_ / "first" / "steps.csv");
  EXPECT_EQ(steps.rows.front()[1], "1") << "waypoints count from 1";
  for (const auto& row : steps.rows) {
    if (row[6].empty()) continue;  // no plan has led there
    EXPECT_EQ(row[9], std::stod(row[7]) > std::stod(row[8]) ? "true" : "false") << "late";
  }
}

TEST_F(TrajectoryEpisode, RecordsTheTruthUpToEachWaypoint) {
  const CsvTable steps = read_csv(*folder_ / "first" / "steps.csv");
  ASSERT_EQ(
      std::vector<std::string>(steps.columns.begin() + 19, steps.columns.end()),
      (std::vector<std::string>{"clearance_m", "tracking_error_m", "path_length_m", "collisions"}));
  const auto& last = steps.rows.back();
  EXPECT_NEAR(std::stod(last[19]), first_["minimum_clearance_m"].get<double>(), 1e-4);
  EXPECT_NEAR(std::stod(last[20]), first_["tracking_error_m"]["mean"].get<double>(), 1e-5);
  EXPECT_NEAR(std::stod(last[21]), first_["path_length_m"].get<double>(), 0.1);
  EXPECT_EQ(last[22], "0");
  EXPECT_NEAR(std::stod(last[0]), first_["flight_time_s"].get<double>(), 1e-3);
}

/// Of four objects, or none of them with probability 0.1.
double prior_entropy_nats() {
  constexpr double kUnknown = 0.1;
  return -kUnknown * std::log(kUnknown) - (1.0 - kUnknown) * std::log((1.0 - kUnknown) / 4.0);
}

TEST_F(TrajectoryEpisode, FindsWhatItFliesPastAndLooksAtItOnceADirection) {
  const json& near = first_["objects"][0];
  EXPECT_TRUE(near["found"]);
  EXPECT_LT(near["position_error_m"], 0.1);
  ASSERT_FALSE(near["looks"].empty());
  std::set<int> directions;
  for (const json& look : near["looks"]) {
    EXPECT_LE(look["distance_m"], 2.0);
    EXPECT_TRUE(directions.insert(look["direction"].get<int>()).second)
        << "a direction counts once";
  }
  const json& far = first_["objects"][2];
  EXPECT_FALSE(far["correct"]) << "behind it, all the time";
  EXPECT_NEAR(far["entropy_nats"], prior_entropy_nats(), 1e-9) << "as before the flight";
}

TEST_F(TrajectoryEpisode, TellsTheEntropyOfWhatItObservedApart) {
  int unseen = 0;
  double observed_nats = 0.0;
  for (const json& object : first_["objects"]) {
    const bool seen = !object["looks"].empty();
    unseen += seen ? 0 : 1;
    observed_nats += seen ? object["entropy_nats"].get<double>() : 0.0;
  }
  ASSERT_GT(unseen, 0);
  ASSERT_LT(unseen, 4);
  EXPECT_EQ(first_["objects_unseen"], unseen);
  EXPECT_NEAR(first_["mean_entropy_observed_nats"], observed_nats / (4 - unseen), 1e-9);
  EXPECT_NEAR(first_["mean_entropy_nats"], (observed_nats + unseen * prior_entropy_nats()) / 4.0,
              1e-9);
}

TEST_F(TrajectoryEpisode, ASmallerQuadrotorFliesTheSamePath) {
  const json small =
      metrics_of("small", past_a_support_, {"robot.model=models/robots/quadrotor_mini"});
  EXPECT_EQ(small["status"], "completed") << small["reason"];
  EXPECT_EQ(small["collisions"], 0);
  EXPECT_LE(small["tracking_error_m"]["mean"], 0.05);
  EXPECT_GT(small["minimum_clearance_m"], first_["minimum_clearance_m"]) << "it is smaller";
  EXPECT_LT(small["energy_j"], first_["energy_j"]) << "and lighter";
  EXPECT_NE(small["state_hash"], first_["state_hash"]);
}

TEST_F(TrajectoryEpisode, KeepsWhatItsPageShows) {
  const DrawnScene scene = read_drawn_scene(*folder_ / "first/scene.bin");
  EXPECT_GT(scene.triangles[0].size(), 1000U) << "objects, stands, floor";
  for (std::size_t wall = 1; wall <= 4; ++wall) EXPECT_FALSE(scene.triangles[wall].empty());
  const VoxelMap map = read_voxels(*folder_ / "first/voxels.bin");
  EXPECT_GT(map.voxels.size(), 200U);
  const bool later = std::ranges::any_of(map.voxels, [](const auto& v) { return v.step > 2; });
  EXPECT_TRUE(later) << "cells have the waypoint that they were found at";
  const std::string page = read_file(*folder_ / "first/report.html");
  EXPECT_LT(page.size(), 5'000'000U);
  EXPECT_EQ(page.find("\"scene\":null"), page.npos);
  ASSERT_FALSE(first_["found"].empty());
  EXPECT_EQ(first_["found"][0]["object"], 0);
}

TEST_F(TrajectoryEpisode, TellsOfItsMapAndOfTheViewsItWeighs) {
  const ResolvedEpisode recorded = load_recorded(*folder_ / "first");
  const WindowContent content = window(recorded);
  ASSERT_TRUE(content.map);
  const auto events = read_event_log(*folder_ / "first/story.bin", content.map->size());
  EventReplay moment(*content.map);
  moment.go_to(events, events.size());
  EXPECT_EQ(moment.scans(), 6U) << "one a waypoint";
  EXPECT_GT(moment.grid().count(CellState::occupied), 200U);
  ASSERT_TRUE(moment.decision());
  EXPECT_EQ(moment.decision()->candidates.size() % kObservationDirections, 0U);
  EXPECT_FALSE(moment.decision()->candidates.empty());
  ASSERT_FALSE(moment.path_m().empty());
  EXPECT_GT(moment.path_m()[0].z(), 1.0);
}

TEST_F(TrajectoryEpisode, WhatItWritesIsDescribed) {
  EXPECT_EQ(test::undescribed(*folder_ / "first", TrajectoryFlight::records()),
            std::vector<std::string>{});
}

TEST_F(TrajectoryEpisode, ReplaysEveryState) {
  const ReplayResult result = support::replayed(*folder_ / "first");
  EXPECT_FALSE(result.first_difference) << result.what;
  EXPECT_GT(result.ticks, 1000U);
}

TEST_F(TrajectoryEpisode, SameSeedSameFlight) {
  const json again = metrics_of("again", past_a_support_, {"threads=1"});
  EXPECT_EQ(again["state_hash"], first_["state_hash"]);
  EXPECT_EQ(again["mean_entropy_nats"], first_["mean_entropy_nats"]);
}

TEST_F(TrajectoryEpisode, FliesOnWhileASlowPlannerThinks) {
  const json slow = metrics_of("slow", past_a_support_, {"latency_s=1.5"});
  EXPECT_EQ(slow["status"], "completed");
  EXPECT_GT(slow["missed_deadlines"], 0);
  EXPECT_LT(slow["replans"], first_["replans"]);
  EXPECT_LT(slow["flight_time_s"], first_["flight_time_s"].get<double>() + 3.0)
      << "waiting at each of the waypoints would take 7.5 s";
}

TEST_F(TrajectoryEpisode, ContactEndsItAsAFailure) {
  const fs::path scene = arena_with_path(*folder_ / "into",
                                         "-2.2,-1.25,0.6,0\n-1.6,-1.25,0.6,0\n"
                                         "-0.9,-1.25,0.6,0\n0,-1.25,0.6,0\n");
  const json crash = metrics_of("crash", scene, {"method=initial"});
  EXPECT_EQ(crash["status"], "failed");
  EXPECT_EQ(code_, ExitCode::goal_failed);
  EXPECT_EQ(crash["collisions"], 1);
  EXPECT_EQ(crash["minimum_clearance_m"], 0.0);
  EXPECT_THAT(crash["reason"].get<std::string>(), testing::HasSubstr("stand_0"));
}

TEST_F(TrajectoryEpisode, SeeksViewsOfWhatItFound) {
  std::string rows;
  for (int i = 0; i < 12; ++i) rows += fmt::format("{:.2f},-1.9,1.8,0\n", -2.67 + 0.4 * i);
  const json metrics = metrics_of("seeks", arena_with_path(*folder_ / "longer", rows), {});
  EXPECT_EQ(metrics["status"], "completed") << metrics["reason"];
  EXPECT_EQ(metrics["waypoints_reached"], 12);
  EXPECT_THAT(read_file(*folder_ / "seeks" / "steps.csv"),
              testing::ContainsRegex(",0\\.[0-9]+,[0-9]+,[0-7],"))
      << "clearance, target, direction";
}

TEST_F(TrajectoryEpisode, GoesOnAlongTheSplineItFlies) {
  std::string rows;
  for (int i = 0; i < 12; ++i) rows += fmt::format("{:.2f},-1.9,1.8,0\n", -2.67 + 0.4 * i);
  const ResolvedEpisode episode =
      load_episode(kFlightEpisode, overrides(arena_with_path(*folder_ / "on", rows), {}));
  const auto& task = std::get<TrajectoryFlight>(episode.task);
  const std::vector<FlightWaypoint> path = read_flight_path(episode.setup.scene);
  const Recogniser recogniser = load_lean_recogniser(task.model, task.recogniser);
  SimulatedTrajectoryRobot robot(episode.setup, model_source(episode), task, path.front());
  RunOptions options;
  options.directory = *folder_ / "goes_on";
  options.lean = true;
  const RunRequest request{episode.setup,         "trajectory", task.method_name(),
                           episode_yaml(episode), {},           options};
  const EpisodeRun run(request);
  TrajectoryRecorder recorder(run, robot.quadrotor(), task.camera);
  const TrajectoryEvaluator evaluator(robot);
  TrajectoryParts flight({episode.setup.options, task, recogniser, robot, evaluator, recorder},
                         path);
  const double latency_s = task.latency_s;
  int decisions = 0;
  int went_on = 0;
  while (true) {
    flight.update(flight.observe());
    if (!flight.finished().empty()) break;
    if (decisions++ == 0) {
      EXPECT_TRUE(robot.path_on(0.0)) << "the path as given is what it flies until it has planned";
      const OccupancyGrid& seen = flight.map().grid();
      EXPECT_LT(seen.count(CellState::unobserved), seen.size()) << "it has looked";
    }
    std::vector<CandidatePlan> candidates = flight.propose();
    flight.score(candidates);
    const auto on = robot.path_on(latency_s);
    ASSERT_EQ(candidates.back().same_spline, on.has_value());
    const std::vector<Eigen::Vector4d> plan = flight.plan();
    flight.act(candidates.back());
    EXPECT_EQ(flight.plan(), plan);
    if (!on) continue;
    ++went_on;
    const auto now = robot.path_on(0.0);
    ASSERT_TRUE(now);
    EXPECT_EQ(now->knots_s().size(), on->knots_s().size());
    for (const double t_s : {0.0, 0.5, 1.0}) {
      EXPECT_LT((now->at(t_s).p_world_m - on->at(t_s).p_world_m).norm(), 1e-6);
    }
  }
  EXPECT_GE(went_on, 7) << "of 11; then too little is left of the spline";
}

TEST_F(TrajectoryEpisode, AMissingModelSaysHowToMakeOne) {
  const Validation found =
      validate_episode(kFlightEpisode, overrides(past_a_support_, {"model=nowhere"}));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_THAT(found.problems[0],
              testing::AllOf(testing::HasSubstr("nowhere"),
                             testing::HasSubstr("assets/episodes/trajectory.yaml")));
}

TEST_F(TrajectoryEpisode, AnUnknownMethodNamesThoseThereAre) {
  const Validation found =
      validate_episode(kFlightEpisode, overrides(past_a_support_, {"method=chomp"}));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_THAT(found.problems[0],
              testing::AllOf(testing::HasSubstr("chomp"), testing::HasSubstr("greedy_detour"),
                             testing::HasSubstr("covariant_gradient")));
}

TEST_F(TrajectoryEpisode, TellsThePathThatItWasGiven) {
  const json& path = first_["path"];
  ASSERT_EQ(path.size(), 6U);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector4d given(-2.67 + 0.53 * static_cast<double>(i), -1.9, 1.8, 0.0);
    ASSERT_EQ(path[i].size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(path[i][k].get<double>(), given[static_cast<Eigen::Index>(k)], 1e-6) << i;
    }
  }
}

/// Of five replans the third and the slowest.
TEST_F(TrajectoryEpisode, TellsHowLongItsReplansTake) {
  const CsvTable steps = read_csv(*folder_ / "first" / "steps.csv");
  std::vector<double> plan_time_s;
  for (const auto& row : steps.rows) {
    if (!row[6].empty()) plan_time_s.push_back(std::stod(row[7]));
  }
  ASSERT_EQ(plan_time_s.size(), 5U);
  std::ranges::sort(plan_time_s);
  EXPECT_DOUBLE_EQ(first_["plan_time_s"]["median"].get<double>(), plan_time_s[2]);
  EXPECT_DOUBLE_EQ(first_["plan_time_s"]["p95"].get<double>(), plan_time_s[4]);
}

/// No view is expected to tell all that there is to know of an object.
TEST_F(TrajectoryEpisode, WeighsViewsByWhatTheyAreExpectedToTell) {
  const WindowContent content = window(load_recorded(*folder_ / "first"));
  ASSERT_TRUE(content.map);
  std::size_t views = 0;
  for (const EpisodeEvent& event :
       read_event_log(*folder_ / "first/story.bin", content.map->size())) {
    const auto* decision = std::get_if<Decision>(&event.what);
    if (decision == nullptr) continue;
    for (const Candidate& view : decision->candidates) {
      EXPECT_LT(view.gain_bits, 0.99 * prior_entropy_nats());
      ++views;
    }
  }
  EXPECT_GT(views, 0U);
}

/// The second flight leads through a stand, and has no other plan.
TEST_F(TrajectoryEpisode, TellsWhichPlansKeepClear) {
  const fs::path scene = arena_with_path(*folder_ / "through",
                                         "-2.2,-1.25,0.6,0\n-1.6,-1.25,0.6,0\n"
                                         "-0.9,-1.25,0.6,0\n0,-1.25,0.6,0\n");
  metrics_of("through_a_stand", scene, {"method=initial"});
  const auto task = std::get<TrajectoryFlight>(load_recorded(*folder_ / "first").task);
  int hindered = 0;
  for (const char* flight : {"first", "through_a_stand"}) {
    const CsvTable table = read_csv(*folder_ / flight / "candidates.csv");
    ASSERT_EQ(table.columns.at(9), "clearance_m");
    ASSERT_EQ(table.columns.at(10), "clear");
    for (const auto& row : table.rows) {
      EXPECT_EQ(row[10], std::stod(row[9]) >= task.planner.clearance_m ? "1" : "0") << flight;
      hindered += row[10] == "0" ? 1 : 0;
    }
  }
  EXPECT_GT(hindered, 0);
}

TEST_F(TrajectoryEpisode, TakesAnObjectForWhatItsLastLookSays) {
  int correct = 0;
  for (const json& object : first_["objects"]) {
    correct += object["correct"].get<bool>() ? 1 : 0;
    if (object["looks"].empty()) continue;
    for (const char* key : {"estimate", "entropy_nats", "unknown_probability"}) {
      EXPECT_EQ(object[key], object["looks"].back()[key]) << key;
    }
  }
  EXPECT_EQ(first_["accuracy"], 0.25 * correct);
}

TEST_F(TrajectoryEpisode, TellsWhereAPlanEnds) {
  const CsvTable table = read_csv(*folder_ / "first" / "candidates.csv");
  int plans = 0;
  for (const auto& row : table.rows) {
    if (row[2] != "as given") continue;
    ++plans;
    EXPECT_NEAR(std::stod(row[3]), -0.02, 1e-3);
    EXPECT_NEAR(std::stod(row[4]), -1.9, 1e-3);
    EXPECT_NEAR(std::stod(row[5]), 1.8, 1e-3);
  }
  EXPECT_EQ(plans, 5);
}

/// It comes by the second of the scene's objects first.
TEST_F(TrajectoryEpisode, WhatTellsTooLittleIsNoView) {
  std::string rows;
  for (int i = 0; i < 4; ++i) rows += fmt::format("{:.2f},-1.9,1.8,3.1416\n", 2.5 - 0.53 * i);
  const json metrics = metrics_of("little", arena_with_path(*folder_ / "west", rows),
                                  {"method=initial", "observations.min_gain_nats=10"});
  ASSERT_FALSE(metrics["found"].empty());
  EXPECT_EQ(metrics["found"][0]["object"], 1);
  const CsvTable steps = read_csv(*folder_ / "little" / "steps.csv");
  const auto& last = steps.rows.back();
  EXPECT_EQ(last[13] + last[14] + last[17], "-1-10") << "neither target nor direction nor look";
  EXPECT_NEAR(std::stod(last[18]), prior_entropy_nats(), 1e-5);
  const WindowContent content = window(load_recorded(*folder_ / "little"));
  std::size_t views = 0;
  for (const EpisodeEvent& event :
       read_event_log(*folder_ / "little/story.bin", content.map.value().size())) {
    const auto* decision = std::get_if<Decision>(&event.what);
    if (decision == nullptr) continue;
    for (const Candidate& view : decision->candidates) EXPECT_FALSE(view.reachable);
    views += decision->candidates.size();
  }
  EXPECT_GT(views, 0U);
}

/// None is near enough to be taken before, and one look of an object is enough.
TEST_F(TrajectoryEpisode, TakesAtTheEndWhatItHasOfEachObject) {
  std::string rows;
  for (const double x_m : {-2.67, -2.14, -1.61, -1.2, -0.8}) {
    rows += fmt::format("{:.2f},-1.9,1.8,0\n", x_m);
  }
  const json metrics =
      metrics_of("at_the_end", arena_with_path(*folder_ / "ends_early", rows),
                 {"method=initial", "camera={width_px: 640, height_px: 480}",
                  "observations={near_m: 0, left_after_s: 100, apart_rad: 3, range_m: 3}"});
  for (const std::size_t i : {0, 1}) EXPECT_EQ(metrics["objects"][i]["looks"].size(), 1U) << i;
}

}  // namespace
}  // namespace vantage
