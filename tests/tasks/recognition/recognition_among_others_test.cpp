// Whole short episodes of recognition among others on a table.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/small_recognition.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/log.hpp"
#include "vantage/perception/clutter/object_among_others.hpp"
#include "vantage/perception/search/object_search.hpp"
#include "vantage/perception/table_extraction.hpp"
#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/tasks/flight/object_mjcf.hpp"
#include "vantage/tasks/object_flight/object_flight_run.hpp"
#include "vantage/tasks/recognition/recognition_ground_truth.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/table_map/table_map.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kEpisode = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/recognition_clutter.yaml";

class RecognitionAmongOthers : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::quiet);
    folder_.emplace();
    support::make_small_model(folder_->path());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static json metrics_of(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all = support::small_flight(folder_->path());
    all.emplace_back("enough={object_probability: 1, entropy_bits: 0}");
    all.emplace_back("database.objects=4");
    all.emplace_back("clutter={objects: 3, near_duplicates: 1, tall: 1}");
    all.emplace_back("bearings=6");
    all = support::overridden(std::move(all), more);
    RunOptions options;
    options.directory = *folder_ / name;
    const RunOutcome outcome = run(load_episode(kEpisode, all), options);
    return json::parse(outcome.metrics);
  }

  static inline std::optional<support::TemporaryDirectory> folder_;
};

TEST_F(RecognitionAmongOthers, MapsTheTableAndSaysWhatItSees) {
  const json metrics = metrics_of("first", {"max_views=3"});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_EQ(metrics["collisions"], 0);
  EXPECT_EQ(metrics["others"].size(), 3U);
  ASSERT_EQ(metrics["targets"].size(), 1U);
  EXPECT_EQ(metrics["targets"][0]["correct"], metrics["correct"]);
  ASSERT_EQ(metrics["observations"].size(), 3U);
  for (const json& view : metrics["observations"]) {
    EXPECT_GE(view["seen_share"], 0.0);
    EXPECT_LE(view["seen_share"], 1.0);
    EXPECT_GT(view["expected_visible"], 0.0);
  }
  EXPECT_LT(metrics["observations"][1]["expected_visible"], 1.0) << "some of it is not known";
  EXPECT_EQ(test::undescribed(*folder_ / "first", RecognitionTask::records()),
            std::vector<std::string>{});
  const VoxelMap voxels = read_voxels(*folder_ / "first" / "voxels.bin");
  EXPECT_GT(voxels.voxels.size(), 100U);
  const ReplayResult replay = support::replayed(*folder_ / "first");
  EXPECT_FALSE(replay.first_difference) << replay.what;
  EXPECT_EQ(metrics_of("again", {"max_views=3", "threads=1"})["state_hash"], metrics["state_hash"]);
}

TEST_F(RecognitionAmongOthers, EveryChoiceFlies) {
  std::map<std::string, int> second_view;
  for (const char* choice : {"random", "star", "nearest_free"}) {
    const json metrics =
        metrics_of(choice, {std::string("views={weight_per_s: 1, choice: ") + choice + "}"});
    EXPECT_EQ(metrics["status"], "completed") << choice;
    EXPECT_EQ(metrics["collisions"], 0) << choice;
    second_view[choice] = metrics["observations"].at(1)["chosen_view"];
  }
  EXPECT_EQ(second_view["star"], 3) << "of six, the one opposite";
  EXPECT_THAT(second_view["nearest_free"], testing::AnyOf(1, 2, 4, 5));
}

TEST_F(RecognitionAmongOthers, FliesFromTargetToTarget) {
  const json metrics = metrics_of(
      "several",
      {"targets=2", "targets_at_once=false", "clutter={objects: 2, near_duplicates: 0}", "seed=2"});
  EXPECT_EQ(metrics["status"], "completed") << metrics["reason"];
  EXPECT_EQ(metrics["collisions"], 0);
  ASSERT_EQ(metrics["targets"].size(), 2U);
  std::vector<int> order;
  for (const json& view : metrics["observations"]) order.push_back(view["target"]);
  EXPECT_THAT(order, testing::ElementsAre(1, 1, 2, 2)) << "one after the other";
  double right = 0.0;
  for (const json& target : metrics["targets"]) {
    EXPECT_EQ(target["views"], 2);
    EXPECT_THAT(target["over"].get<std::string>(), testing::HasSubstr("limit of 2 views"));
    right += target["correct"].get<bool>() ? 0.5 : 0.0;
  }
  EXPECT_EQ(metrics["targets_correct"], right);
  EXPECT_EQ(metrics["correct"], right == 1.0);
}

/// What is not known at all tells more than a second view.
TEST_F(RecognitionAmongOthers, AtOnceItLooksAtEachBeforeItLooksAgain) {
  const json metrics =
      metrics_of("at_once", {"targets=2", "clutter={objects: 2, near_duplicates: 0}", "seed=2",
                             "views={choice: mutual_information, weight_per_s: 0}"});
  EXPECT_EQ(metrics["status"], "completed") << metrics["reason"];
  EXPECT_EQ(metrics["collisions"], 0);
  std::vector<int> order;
  for (const json& view : metrics["observations"]) order.push_back(view["target"]);
  ASSERT_EQ(order.size(), 4U);
  EXPECT_EQ(order[1], 2);
}

TEST_F(RecognitionAmongOthers, NoViewIsTakenAfterTheLimit) {
  const json metrics = metrics_of("limited", {"max_views=6", "time_limit_s=5"});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_THAT(metrics["reason"].get<std::string>(), testing::HasSubstr("time_limit_s"));
  EXPECT_GE(metrics["observations"].size(), 2U);
  EXPECT_LT(metrics["observations"].size(), 6U);
  EXPECT_LT(metrics["simulated_time_s"], 7.0) << "it settles a little later than planned";
}

TEST_F(RecognitionAmongOthers, ItsMapHoldsWhatStandsOnTheTable) {
  metrics_of("mapped", {"max_views=1"});
  const VoxelMap map = read_voxels(*folder_ / "mapped" / "voxels.bin");
  EXPECT_GT(std::ranges::count(map.voxels, kVoxelOccupied, &VoxelRecord::kind), 20);
}

/// The parts of a flight round a cereal box, which map the table though nothing else stands there.
struct FlightRoundABox {
  explicit FlightRoundABox(const fs::path& folder, const Spectator& spectator = {})
      : resolved(episode_in(folder)),
        task(std::get<RecognitionTask>(resolved.task)),
        table(draw_table(task, resolved.setup.options.seed)),
        robot(resolved.setup, model_source(resolved), task, table.targets),
        recogniser(load_lean_recogniser(folder / "model", task.recogniser)),
        request{resolved.setup, "recognition", "star", "a: 1\n", {}, options_in(folder, spectator)},
        episode_run(request),
        recorder(episode_run, recorded(robot), task.decision.max_views, false),
        evaluator(robot),
        parts({resolved.setup.options, task, recogniser, robot, evaluator, recorder},
              {.p_world_m = std::vector{task.p_world_table_m()},
               .among_others = AmongOthers{task.map, task.separation}},
              ObjectInquiry(recogniser, task.decision), robot.start_bearing_rad()) {}

  static ResolvedEpisode episode_in(const fs::path& folder) {
    std::vector<std::string> overrides = support::small_flight(folder);
    overrides.insert(overrides.end(), {"object=cereal_box_1", "clutter={objects: 0}"});
    return load_episode(kEpisode, overrides);
  }
  static RunOptions options_in(const fs::path& folder, const Spectator& spectator) {
    RunOptions options;
    options.directory = folder / "parts";
    options.overwrite = true;
    options.lean = true;
    options.spectator = spectator;
    return options;
  }

  ResolvedEpisode resolved;
  RecognitionTask task;
  TableGroundTruth table;
  SimulatedOrbitRobot robot;
  Recogniser recogniser;
  RunRequest request;
  EpisodeRun episode_run;
  ObjectFlightRecorder recorder;
  ObjectFlightEvaluator evaluator;
  ObjectFlightParts parts;
};

TEST_F(RecognitionAmongOthers, AViewShowsHowHighItsTargetIs) {
  FlightRoundABox flight(folder_->path());
  flight.parts.update(flight.parts.observe());
  const std::optional<UprightCylinder>& shape = flight.parts.tour().current().shape;
  ASSERT_TRUE(shape);
  const TurntableObject box =
      make_turntable_object(dataset_of(flight.task.database), {"cereal_box", "cereal_box_1"});
  EXPECT_NEAR(shape->height_m, box.box_m.sizes().z(), 0.03);
}

/// After an image without depth the box may be anything still.
TEST_F(RecognitionAmongOthers, WhoLooksOnIsToldWhatViewsPromise) {
  std::optional<Decision> told;
  Spectator spectator;
  spectator.on_event = [&](const EpisodeEvent& event) {
    if (const auto* decision = std::get_if<Decision>(&event.what)) told = *decision;
  };
  FlightRoundABox flight(folder_->path(), spectator);
  FlightObservation observation = flight.parts.observe();
  std::ranges::fill(observation.images.depth_m, 0.0F);
  flight.parts.update(observation);
  flight.parts.record();
  ASSERT_EQ(flight.parts.finished(), "");
  std::vector<BearingOption> options = flight.parts.propose();
  flight.parts.score(options);
  const std::size_t chosen = flight.parts.choose(options);
  Rng rng(1);  // mutual information draws nothing
  const NextView next =
      next_view(flight.parts.tour(), flight.recogniser, flight.task.decision, options, rng);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->chosen, chosen);
  ASSERT_EQ(told->candidates.size(), options.size());
  for (std::size_t i = 0; i < options.size(); ++i) {
    EXPECT_EQ(told->candidates[i].gain_bits, next.decision.scores[i].gain.bits) << i;
  }
  EXPECT_GT(told->candidates[chosen].gain_bits, 0.0);
}

TEST_F(RecognitionAmongOthers, AnImageWithoutDepthShowsNothingOfItsTarget) {
  FlightRoundABox flight(folder_->path());
  FlightObservation observation = flight.parts.observe();
  std::ranges::fill(observation.images.depth_m, 0.0F);
  flight.parts.update(observation);
  testing::internal::CaptureStderr();
  flight.parts.record();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("view 1: "));
  EXPECT_EQ(flight.parts.records().back().seen_share, 0.0);
}

/// By a pose that is 4 cm too high its table stands in the lowest layer of the map.
TEST_F(RecognitionAmongOthers, ItsMapBeginsAboveTheTableThatItSees) {
  std::optional<MapChange> told;
  Spectator spectator;
  spectator.on_event = [&](const EpisodeEvent& event) {
    if (const auto* change = std::get_if<MapChange>(&event.what)) told = *change;
  };
  FlightRoundABox flight(folder_->path(), spectator);
  FlightObservation observation = flight.parts.observe();
  SimulatedQuadrotor& quadrotor = flight.robot.quadrotor();
  observation.T_world_camera = quadrotor.true_body() * quadrotor.T_body_camera();
  observation.T_world_camera.translation().z() += 0.04;
  flight.parts.update(observation);
  flight.parts.record();
  ASSERT_TRUE(told);
  const GridFrame frame = TableMap::frame_of(flight.task.p_world_table_m(), flight.task.map);
  const auto layer =
      static_cast<std::size_t>(frame.cells.x()) * static_cast<std::size_t>(frame.cells.y());
  std::size_t standing = 0;
  for (const CellRun& run : told->runs) {
    if (run.state != CellState::occupied) continue;
    for (std::size_t i = 0; i < run.count; ++i) standing += run.first + i < layer ? 1 : 0;
  }
  EXPECT_GT(standing, 0U) << "the box";
  EXPECT_LT(standing, layer / 10) << "and no table";
}

/// One view of each is enough; the last of them is far off.
TEST_F(RecognitionAmongOthers, FliesOnToTheNearestOfItsTargets) {
  FlightRoundABox flight(folder_->path());
  const Eigen::Vector3d box_m = flight.task.p_world_table_m();
  const FlightGoal goal{.p_world_m = {box_m, box_m + Eigen::Vector3d(0.05, 0.0, 0.0),
                                      box_m + Eigen::Vector3d(0.0, 0.4, 0.0)},
                        .among_others = {}};
  RecognitionOptions once = flight.task.decision;
  once.max_views = 1;
  ObjectFlightParts parts({flight.resolved.setup.options, flight.task, flight.recogniser,
                           flight.robot, flight.evaluator, flight.recorder},
                          goal, ObjectInquiry(flight.recogniser, once),
                          flight.robot.start_bearing_rad());
  parts.update(parts.observe());
  parts.record();
  ASSERT_EQ(parts.finished(), "");
  const std::vector<BearingOption> options = parts.propose();
  ASSERT_FALSE(options.empty());
  for (const BearingOption& option : options) EXPECT_EQ(option.target, 1U) << option.id;
}

/// The cells over what was seen of it from above, as high as it is, keep on being its own.
TEST_F(RecognitionAmongOthers, AViewShowsWhichCellsAreItsTargets) {
  FlightRoundABox flight(folder_->path());
  const FlightObservation observation = flight.parts.observe();
  flight.parts.update(observation);
  flight.parts.record();
  const Eigen::Vector3d box_m = flight.task.p_world_table_m();
  Rng rng = Rng::stream(flight.resolved.setup.options.seed, "segmentation");
  const double distance_m = (observation.T_world_camera.translation() - box_m).norm();
  const ObjectAmongOthers found = find_among_others(
      observation.images, observation.T_world_camera, box_m,
      cut_at({.cut = flight.task.segmentation}, distance_m), flight.task.separation, {}, rng);
  ASSERT_TRUE(found.object.view);
  const TourTarget& target = flight.parts.tour().current();
  EXPECT_EQ(target.outline, convex_hull(found.outline));
  const TableMap unseen(box_m, flight.task.map);
  EXPECT_EQ(target.own_cells, unseen.cells_over(target.outline, found.shape->height_m));
  EXPECT_GT(std::ranges::count(target.own_cells, 1), 0);
  const ObservationRecord& record = flight.parts.records().back();
  EXPECT_EQ(record.seen_share, found.seen_share);
  int pixels = 0;
  for (const std::uint8_t value : found.object.view->mask) pixels += value != 0 ? 1 : 0;
  EXPECT_EQ(record.object_px, pixels);
  EXPECT_EQ(record.not_segmented, "");
  EXPECT_FALSE(record.report.features.empty());
}

/// The table's middle is told to be a little off the world's.
TEST_F(RecognitionAmongOthers, SaysWhatStoodWhere) {
  const json metrics =
      metrics_of("stood", {"targets=2", "clutter={objects: 2, near_duplicates: 0}", "seed=2",
                           "max_views=1", "table_m=[0.03, -0.02, 0.72]"});
  const ResolvedEpisode recorded = load_recorded(*folder_ / "stood");
  const auto task = std::get<RecognitionTask>(recorded.task);
  const TableGroundTruth table = draw_table(task, recorded.setup.options.seed);
  ASSERT_EQ(metrics["others"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const json& other = metrics["others"][i];
    const ObjectOnTable& truth = table.others.at(i);
    EXPECT_EQ(other["object"], truth.object);
    EXPECT_NEAR(other["x_m"].get<double>(), 0.03 + truth.offset_m.x(), 1e-9);
    EXPECT_NEAR(other["y_m"].get<double>(), -0.02 + truth.offset_m.y(), 1e-9);
    EXPECT_NEAR(other["yaw_rad"].get<double>(), truth.yaw_rad, 1e-9);
  }
  ASSERT_EQ(metrics["targets"].size(), 2U);
  ASSERT_EQ(metrics["observations"].size(), 2U) << "one of each";
  bool all = true;
  bool all_categories = true;
  for (const json& view : metrics["observations"]) {
    const auto i = view["target"].get<std::size_t>() - 1;
    const json& target = metrics["targets"].at(i);
    const ObjectOnTable& truth = table.targets.at(i);
    EXPECT_EQ(target["truth"], truth.object);
    EXPECT_NEAR(target["x_m"].get<double>(), 0.03 + truth.told_m.x(), 1e-9);
    EXPECT_NEAR(target["y_m"].get<double>(), -0.02 + truth.told_m.y(), 1e-9);
    EXPECT_EQ(target["views"], 1);
    EXPECT_EQ(target["estimate"], view["estimate"]);
    EXPECT_EQ(target["map_probability"], view["map_probability"]);
    EXPECT_EQ(target["correct"].get<bool>(), view["estimate"] == truth.object);
    all = all && target["correct"].get<bool>();
    all_categories = all_categories && target["category_correct"].get<bool>();
  }
  EXPECT_EQ(metrics["targets"][0]["category_correct"].get<bool>(),
            metrics["estimated_category"] == table.targets[0].category);
  EXPECT_EQ(metrics["correct"].get<bool>(), all);
  EXPECT_EQ(metrics["category_correct"].get<bool>(), all_categories);
  const Eigen::AlignedBox3d box = TableMap::frame_of(task.p_world_table_m(), task.map).box();
  const auto low_m = metrics["region"]["min_m"].get<std::vector<double>>();
  const auto high_m = metrics["region"]["max_m"].get<std::vector<double>>();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(low_m.at(i), box.min()[static_cast<Eigen::Index>(i)], 1e-9);
    EXPECT_NEAR(high_m.at(i), box.max()[static_cast<Eigen::Index>(i)], 1e-9);
  }
}

}  // namespace
}  // namespace vantage
