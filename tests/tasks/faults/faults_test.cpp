// Whole short episodes in which something goes wrong: each ends in a recorded status, what it
// believes is finite, and a replay meets the same world.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <ostream>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/mapping/run_request.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

const fs::path kShippedEpisodes = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes";

struct FaultCase {
  std::string name;
  std::vector<std::string> overrides;
  std::string fault;         ///< in metrics.json
  std::string failure = {};  ///< what the reason says; empty: it completes
};
void PrintTo(const FaultCase& fault, std::ostream* out) { *out << fault.name; }
std::string name_of_case(const testing::TestParamInfo<FaultCase>& info) { return info.param.name; }

template <class Numbers>
void expect_finite(const Numbers& numbers, const char* what) {
  EXPECT_TRUE(std::ranges::all_of(numbers, [](auto x) { return std::isfinite(x); })) << what;
}

/// What is written must be as it says; what went wrong is counted.
void expect_recorded(const json& metrics, const RunOutcome& outcome, const FaultCase& fault) {
  const bool failed = !fault.failure.empty();
  EXPECT_EQ(metrics["status"], failed ? "failed" : "completed") << metrics["reason"];
  EXPECT_EQ(outcome.code, failed ? ExitCode::goal_failed : ExitCode::done);
  EXPECT_THAT(metrics["reason"].get<std::string>(), HasSubstr(fault.failure));
  EXPECT_GT(metrics["faults"].at(fault.fault), 0);
  EXPECT_THAT(read_file(outcome.directory / "faults.csv"), HasSubstr("," + fault.fault + "\n"));
}

/// The robot's own view of things, which its task keeps to itself.
struct WatchedParts : TabletopParts {
  using TabletopParts::TabletopParts;
  void expect_sane() {
    expect_finite(navigator_.floor().log_odds, "floor map");
    EXPECT_TRUE(navigator_.uncertainty().covariance().allFinite());
    for (const ScanRecord& scan : scans()) {
      EXPECT_TRUE(scan.T_world_sensor.matrix().allFinite());
      // 300 W at rest; only the laser's motor works while it scans.
      EXPECT_GT(scan.scan_energy_j, 299.0 * scan.scan_time_s);
      EXPECT_LT(scan.scan_energy_j, 450.0 * scan.scan_time_s);
    }
  }
};

class TabletopFaults : public testing::TestWithParam<FaultCase> {
 protected:
  static void SetUpTestSuite() { set_verbosity(Verbosity::quiet); }
};

TEST_P(TabletopFaults, EndRecordedWithASaneBelief) {
  const support::TemporaryDirectory folder;
  const ResolvedEpisode resolved = load_episode(
      kShippedEpisodes / "tabletop.yaml",
      support::overridden({"scans=2", "map.cells=[49,49,25]", "laser.scan_duration_s=3"},
                          GetParam().overrides));
  RunOptions options;
  options.directory = folder / "run";
  const RunRequest request = support::mapping_request(resolved, options);
  TabletopSession<WatchedParts> session(request, std::get<Tabletop>(resolved.task));
  const RunOutcome outcome = session.run_to_end();
  const json metrics = json::parse(outcome.metrics);
  expect_recorded(metrics, outcome, GetParam());
  expect_finite(session.belief.grid().log_odds, "map");
  expect_finite(session.belief.hazard().transmission().per_block, "hazard");
  session.parts.expect_sane();
  EXPECT_EQ(metrics["observability"], session.belief.hazard().global_transmission());
  const Pose2 base = session.robot.estimated_base();
  expect_finite(std::vector<double>{base.x_m, base.y_m, base.yaw_rad}, "pose");
  const ReplayResult replay = support::replayed(folder / "run");
  EXPECT_FALSE(replay.first_difference) << replay.what;
  EXPECT_EQ(hash_text(replay.state_hash), metrics["state_hash"]);
}

INSTANTIATE_TEST_SUITE_P(
    Mapping, TabletopFaults,
    testing::Values(
        FaultCase{"DroppedFrames", {"faults.dropped_frames=0.3"}, "dropped_frames"},
        FaultCase{"NoFrameAtAll",
                  {"faults.dropped_frames=1"},
                  "dropped_frames",
                  "scan 1 shows nothing at"},
        FaultCase{"FrozenFrames", {"faults.frozen_frames=0.3"}, "frozen_frames"},
        FaultCase{"FrozenForGood",
                  {"faults.frozen_frames=1"},
                  "frozen_frames",
                  "the first scan shows no table"},
        FaultCase{"NaNs", {"faults.nan_depth=0.2"}, "nan_depth"},
        FaultCase{"NothingButNaNs", {"faults.nan_depth=1"}, "nan_depth", "shows nothing"},
        FaultCase{"Saturation", {"faults.saturated_depth=0.2"}, "saturated_depth"},
        FaultCase{"LaserBias", {"faults.laser_bias_m=0.05"}, "laser_bias"},
        FaultCase{"OdometryScale", {"faults.odometry_scale=0.1"}, "odometry_scale"},
        FaultCase{"OdometrySlip",  // it looks past the table: nothing corrects the wheels before
                  {"faults={odometry_slip: 0.2, stretch_s: 1}"},
                  "odometry_slip",
                  "the first scan shows no table"},
        FaultCase{"LateCommands", {"faults.late_commands_ticks=8"}, "late_commands"},
        FaultCase{"MovedObject",
                  {"faults={moved_object_m: 0.15, moved_object_at_s: 12}"},
                  "moved_object"}),
    name_of_case);

class FlightFaults : public testing::TestWithParam<FaultCase> {
 protected:
  static void SetUpTestSuite() { set_verbosity(Verbosity::quiet); }
};

TEST_P(FlightFaults, EndRecordedWithASaneBelief) {
  const support::TemporaryDirectory folder;
  const ResolvedEpisode resolved = load_episode(
      kShippedEpisodes / "recognition.yaml",
      support::overridden({"max_views=2", "settle_s=0.1", "object=mug_1",
                           "enough={object_probability: 1, entropy_bits: 0}",
                           "camera={width_px: 320, height_px: 240}", "segmentation.min_pixels=40"},
                          GetParam().overrides));
  RunOptions options;
  options.directory = folder / "run";
  const RunOutcome outcome = run(resolved, options);
  const json metrics = json::parse(outcome.metrics);
  expect_recorded(metrics, outcome, GetParam());
  for (const json& view : metrics["observations"]) {
    for (const char* key : {"entropy_bits", "map_probability", "position_error_m"}) {
      EXPECT_TRUE(view.at(key).is_number()) << key;  // JSON has no NaN: it would be null
    }
  }
  const bool touched = metrics["reason"].get<std::string>().find("touched") != std::string::npos;
  EXPECT_EQ(metrics["collisions"] > 0, touched);
  if (metrics["faults"].contains("lights_out")) {
    for (const json& view : metrics["observations"]) {
      EXPECT_EQ(view["features"], json::parse(R"(["standing_box"])")) << "by depth alone";
    }
  }
  EXPECT_THAT(test::undescribed(folder / "run", RecognitionTask::records()), testing::IsEmpty());
  const ReplayResult replay = support::replayed(folder / "run");
  EXPECT_FALSE(replay.first_difference) << replay.what;
}

INSTANTIATE_TEST_SUITE_P(
    Recognition, FlightFaults,
    testing::Values(
        FaultCase{"DroppedFrames",
                  {"faults.dropped_frames=1"},
                  "dropped_frames",
                  "the robot is blind: the last 4 images"},
        FaultCase{
            "FrozenFrames", {"faults.frozen_frames=0.5", "max_views=3", "seed=2"}, "frozen_frames"},
        FaultCase{"BadDepth", {"faults={nan_depth: 0.2, saturated_depth: 0.2}"}, "saturated_depth"},
        FaultCase{"WeakRotor", {"faults.weak_rotor=0.3"}, "weak_rotor"},
        FaultCase{"Gusts", {"faults={gust_N: 8, gust_every_s: 1.5}"}, "gust"},
        FaultCase{"LightsOut", {"faults.lights_out=1"}, "lights_out"},
        FaultCase{"MovedObject",
                  {"faults={moved_object_m: 0.05, moved_object_at_s: 1, moved_object: object}"},
                  "moved_object"}),
    name_of_case);

/// Gusts of `tracking` are met again by a replay, too.
TEST(Replay, MeetsTheGustsOfTheTask) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  RunOptions options;
  options.directory = folder / "run";
  run(load_episode(kShippedEpisodes / "recognition.yaml",
                   {"max_views=1", "object=mug_1", "camera={width_px: 320, height_px: 240}",
                    "tracking.gusts=[{force_N: 3, start_s: 0.1}]"}),
      options);
  const ReplayResult replay = support::replayed(folder / "run");
  EXPECT_FALSE(replay.first_difference) << replay.what;
}

/// (50 - 50) + f is f, (f + 50) - 50 is not: forces that add up in another order are others.
TEST(Replay, MeetsAllGustsInTheirOrder) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  RunOptions options;
  options.directory = folder / "run";
  run(load_episode(kShippedEpisodes / "recognition.yaml",
                   {"max_views=1", "object=mug_1", "camera={width_px: 320, height_px: 240}",
                    "faults={gust_N: 4, gust_every_s: 0.5, gust_duration_s: 0.2}",
                    ("tracking.gusts=[{force_N: 50, duration_s: 60}, "
                     "{force_N: 50, direction: [0, -1, 0], duration_s: 60}]")}),
      options);
  const ReplayResult replay = support::replayed(folder / "run");
  EXPECT_FALSE(replay.first_difference) << replay.what;
}

TEST(FaultKeys, ThatMakeNoSenseAreErrorsOfTheConfiguration) {
  const auto refused = [](const char* episode, const std::string& override) -> std::string {
    try {
      load_episode(kShippedEpisodes / episode, {override});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refused("tabletop.yaml", "faults.weak_rotor=0.3"), HasSubstr("faults.weak_rotor"));
  EXPECT_THAT(refused("office_small.yaml", "faults.gust_N=3"), HasSubstr("faults.gust_N"));
  EXPECT_THAT(refused("recognition.yaml", "faults.laser_bias_m=0.1"),
              HasSubstr("faults.laser_bias_m"));
  EXPECT_THAT(refused("trajectory.yaml", "faults.odometry_slip=0.1"),
              HasSubstr("faults.odometry_slip"));
  EXPECT_THAT(refused("change_detection.yaml", "faults.laser_bias_m=0.1"),
              HasSubstr("faults.laser_bias_m"));
  EXPECT_THAT(refused("change_detection.yaml", "faults.gust_N=9"), HasSubstr("faults.gust_N"));
  EXPECT_THAT(refused("tabletop.yaml", "faults.dropped_frame=0.3"),
              HasSubstr("faults.dropped_frame"));
}

/// By the same noise.
TEST(LaserBias, IsInWhatTheBaseScannerReads) {
  set_verbosity(Verbosity::quiet);
  const auto ranges_m = [](const std::string& bias_m) {
    const ResolvedEpisode resolved =
        load_episode(kShippedEpisodes / "tabletop.yaml", {"faults.laser_bias_m=" + bias_m});
    SimulatedTabletopRobot robot(resolved.setup, std::get<Tabletop>(resolved.task));
    return robot.read_base_scanner().range_m;
  };
  const std::vector<float> right_m = ranges_m("0");
  const std::vector<float> biased_m = ranges_m("0.05");
  ASSERT_EQ(biased_m.size(), right_m.size());
  int returns = 0;
  for (std::size_t i = 0; i < right_m.size(); ++i) {
    if (!std::isfinite(right_m[i])) continue;
    EXPECT_NEAR(biased_m[i] - right_m[i], 0.05, 1e-5) << i;
    ++returns;
  }
  EXPECT_GT(returns, 20);
}

/// Keeps the scan that it took last.
struct KeepingParts : TabletopParts {
  using TabletopParts::TabletopParts;
  TabletopObservation observe() {
    taken = TabletopParts::observe();
    return taken;
  }
  TabletopObservation taken;
};

/// Where a scanner saturates, it saw no surface.
TEST(TabletopReadings, AtTheEndOfTheRangeSayNothing) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  const ResolvedEpisode resolved = load_episode(
      kShippedEpisodes / "tabletop.yaml",
      {"scans=1", "map.cells=[49,49,25]", "laser.scan_duration_s=3", "faults.saturated_depth=0.2"});
  RunOptions options;
  options.directory = folder / "run";
  options.lean = true;
  const RunRequest request = support::mapping_request(resolved, options);
  TabletopSession<KeepingParts> session(request, std::get<Tabletop>(resolved.task));
  session.run_to_end();
  const auto expect_discarded = [](const std::vector<float>& range_m, double range_max_m) {
    EXPECT_EQ(std::ranges::count(range_m, static_cast<float>(range_max_m)), 0);
    EXPECT_GT(std::ranges::count_if(range_m, [](float range) { return std::isnan(range); }), 0);
  };
  const TabletopObservation& taken = session.parts.taken;
  expect_discarded(taken.scan.range_m, taken.scan.field_of_view.range_max_m);
  expect_discarded(taken.base_scan.range_m, taken.base_scan.range_max_m);
}

}  // namespace
}  // namespace vantage
