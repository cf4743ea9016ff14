// Exploring an office: what the head's sweep sees, and a whole short episode.
#include "vantage/tasks/exploration/exploration.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/exploration/exploration_drive.hpp"
#include "tests/tasks/replayed.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/clouds/reference_map.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/exploration/visited_places.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

TEST(HeadSweep, PansEvenlyAllRound) {
  const auto pans_rad = pan_angles_rad({.pans = 4});
  ASSERT_EQ(pans_rad.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(pans_rad[i], (i - 1.5) * std::numbers::pi / 2.0, 1e-12);
}

/// Whether an image of the sweep, taken from the pan axis, shows that direction.
bool in_some_image(const HeadSweep& sweep, const RgbdOptions& camera, const Eigen::Vector3d& d) {
  const double half_height = std::tan(0.5 * camera.fovy_rad);
  const double half_width = half_height * camera.width_px / camera.height_px;
  for (const double tilt_rad : sweep.tilts_rad) {
    for (const double pan_rad : pan_angles_rad(sweep)) {
      const Eigen::Vector3d p =
          make_pose(Eigen::Vector3d::Zero(), pan_rad, tilt_rad).linear().transpose() * d;
      if (p.x() > 0.0 && std::abs(p.y()) <= half_width * p.x() &&
          std::abs(p.z()) <= half_height * p.x()) {
        return true;
      }
    }
  }
  return false;
}

RC_GTEST_PROP(HeadSweep, ShowsWhateverIsInItsField, (std::uint64_t seed)) {
  Rng rng(seed);
  const Exploration options;
  const FieldOfView field = swept_field(options.sweep, options.camera, 0.0);
  RC_ASSERT(field.panorama);
  for (int i = 0; i < 100; ++i) {
    const double azimuth = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double tilt = rng.uniform(field.tilt_min_rad, field.tilt_max_rad);
    const Eigen::Vector3d d(std::cos(tilt) * std::cos(azimuth), std::cos(tilt) * std::sin(azimuth),
                            -std::sin(tilt));
    RC_ASSERT(in_some_image(options.sweep, options.camera, d));
  }
}

/// The camera goes round the pan axis: what it sees is as much farther from there.
TEST(HeadSweep, ReachesAsMuchFartherAsTheCameraIsAhead) {
  const Exploration options;
  EXPECT_DOUBLE_EQ(swept_field(options.sweep, options.camera, 0.09).range_max_m,
                   options.camera.range_max_m + 0.09);
}

TEST(HeadSweep, GapsAreErrors) {
  const RgbdOptions camera;
  EXPECT_THROW(swept_field({.pans = 6}, camera, 0.0), ConfigError);
  EXPECT_THROW(swept_field({.tilts_rad = {-0.3, 0.7}}, camera, 0.0), ConfigError);
  EXPECT_THROW(swept_field({.tilts_rad = {0.7, 0.1}}, camera, 0.0), ConfigError);
  EXPECT_THROW(swept_field({.tilts_rad = {1.2}}, camera, 0.0), ConfigError);
  EXPECT_NO_THROW(swept_field({.pans = 7, .tilts_rad = {0.0}}, camera, 0.0));
}

/// However the places come, a bounded floor holds only so many that are not near one another.
TEST(VisitedPlaces, RunOut) {
  constexpr double radius_m = 0.3;
  VisitedPlaces visited;
  Rng rng(2);
  int chosen = 0;
  for (int i = 0; i < 200000; ++i) {
    const Eigen::Vector2d p(rng.uniform(0.0, 3.0), rng.uniform(0.0, 3.0));
    if (visited.covers(p)) continue;
    visited.add(p, radius_m);
    ++chosen;
  }
  EXPECT_GT(chosen, 50);
  EXPECT_LE(chosen, 3.3 * 3.3 / (std::numbers::pi * 0.15 * 0.15))
      << "half discs round them do not overlap";
}

PlanarScan wall_ahead(double distance_m) {
  PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 10.0};
  for (double azimuth = -0.5; azimuth <= 0.5; azimuth += 0.01) {
    scan.azimuth_rad.push_back(azimuth);
    scan.range_m.push_back(static_cast<float>(distance_m / std::cos(azimuth)));
  }
  return scan;
}

TEST(ReferenceMap, RemembersOnlyWhatIsNew) {
  ReferenceMap all({});
  ReferenceMap novel({}, 0.05);
  for (ReferenceMap* reference_map : {&all, &novel})
    reference_map->remember(wall_ahead(2.0), 0.25, {});
  const std::size_t once = all.cloud().size();
  ASSERT_GT(once, 30U);
  EXPECT_EQ(novel.cloud().size(), once);
  for (ReferenceMap* reference_map : {&all, &novel})
    reference_map->remember(wall_ahead(1.99), 0.25, {0.01, 0.0, 0.0});
  EXPECT_GT(all.cloud().size(), once + 30U);
  EXPECT_LT(novel.cloud().size(), once + 5U);
}

TEST(ReferenceMap, FindsTheDistanceToAWall) {
  ReferenceMap reference_map({});
  EXPECT_FALSE(reference_map.locate(wall_ahead(2.0), 0.25, {}).converged) << "nothing to go by";
  reference_map.remember(wall_ahead(2.0), 0.25, {});
  const auto found = reference_map.locate(wall_ahead(1.9), 0.25, {0.03, 0.0, 0.0});
  EXPECT_TRUE(found.converged) << found.reason;
  EXPECT_NEAR(found.T_world_base.x_m, 0.1, 0.005);
}

nlohmann::json explore(const std::filesystem::path& out, const std::vector<std::string>& more) {
  set_verbosity(Verbosity::quiet);
  std::vector<std::string> overrides = {
      "scans=3",     "map.cells=[100,67,20]",   "camera.width_px=160", "camera.height_px=120",
      "stride_px=1", "metrics.pose_spacing_m=2"};
  overrides = support::overridden(std::move(overrides), more);
  const auto episode =
      std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml";
  return nlohmann::json::parse(
      run(load_episode(episode, overrides), {out, true, false, {}}).metrics);
}

TEST(Exploration, EndsWhenNothingIsWorthAScan) {
  const support::TemporaryDirectory folder;
  const auto all = explore(folder.path() / "all", {"enough.scans=0"});
  EXPECT_EQ(all["scans"].size(), 3U);
  EXPECT_EQ(all["reason"], "limit of 3 scans");
  const auto asked = explore(folder.path() / "asked", {});
  EXPECT_EQ(asked["state_hash"], all["state_hash"]) << "whether to go on is not where to";
  const auto demanding = {std::string("enough.share=1"), std::string("enough.scans=2")};
  for (const std::string method : {"choice=greedy", "choice=random"}) {
    std::vector<std::string> more = demanding;
    more.push_back(method);
    const auto ended = explore(folder.path() / method, more);
    EXPECT_EQ(ended["status"], "completed");
    EXPECT_NE(ended["reason"].get<std::string>().find("no view promised more than 100 %"),
              std::string::npos)
        << ended["reason"];
    EXPECT_EQ(ended["scans"].size(), 2U) << "no view shows as much as all that is known";
  }
}

TEST(Exploration, LearnsTheOfficeWithoutTouchingIt) {
  const support::TemporaryDirectory folder;
  const auto metrics = explore(folder.path() / "run", {});
  ASSERT_EQ(metrics["scans"].size(), 3U);
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_EQ(metrics["collisions"], 0);
  const double observable = metrics["observable_cells"];
  double left = observable;
  double predicted_cells = 0.0;
  double actual_cells = 0.0;
  for (const auto& scan : metrics["scans"]) {
    EXPECT_LT(scan["observable_unobserved_cells"].get<double>(), left - 0.03 * observable);
    EXPECT_LT(scan["pose_error_m"], 0.02);
    const double actual = scan["actual_new_cells"];
    EXPECT_NEAR(scan["predicted"]["simple"].get<double>(), actual, 0.12 * actual);
    predicted_cells += scan["predicted"]["simple"].get<double>();
    actual_cells += actual;
    left = scan["observable_unobserved_cells"];
  }
  EXPECT_NEAR(predicted_cells, actual_cells, 0.05 * actual_cells);
  EXPECT_GT(metrics["path_length_m"], 1.0);
  EXPECT_GT(metrics["map"]["precision"], 0.95);
  EXPECT_EQ(test::undescribed(folder.path() / "run", Exploration::records()),
            std::vector<std::string>{});
  const ReplayResult again = support::replayed(folder.path() / "run");
  EXPECT_FALSE(again.first_difference) << again.what;
}

TEST(Exploration, TheOracleKnowsWhatAViewShows) {
  const support::TemporaryDirectory folder;
  const auto metrics = explore(folder.path() / "run", {"choice=oracle", "scans=2", "threads=1"});
  EXPECT_EQ(metrics["method"], "oracle");
  const auto of_forecast = explore(folder.path() / "greedy", {"choice=greedy", "scans=2"});
  EXPECT_GE(metrics["scans"][1]["actual_new_cells"].get<double>(),
            0.98 * of_forecast["scans"][1]["actual_new_cells"].get<double>())
      << "from one and the same first scan, but for noise";
}

/// The places that it could choose from after the first scan.
std::vector<Eigen::Vector3d> first_places(const std::filesystem::path& out,
                                          const std::string& choice) {
  explore(out, {"scans=2", choice});
  const auto task = std::get<Exploration>(load_recorded(out).task);
  for (const EpisodeEvent& event : read_event_log(out / "story.bin", task.map.frame().size())) {
    const auto* decision = std::get_if<Decision>(&event.what);
    if (decision == nullptr) continue;
    std::vector<Eigen::Vector3d> places_m;
    for (const Candidate& view : decision->candidates) {
      EXPECT_EQ(view.id, static_cast<int>(places_m.size()));
      places_m.emplace_back(view.T_world_sensor.translation());
    }
    return places_m;
  }
  return {};
}

TEST(Exploration, TheOracleOfAllPlacesLooksFromFrontiersToo) {
  const support::TemporaryDirectory folder;
  const auto frontiers_m = first_places(folder.path() / "tour", "choice=tour");
  const auto all_m = first_places(folder.path() / "oracle", "choice=oracle_tour");
  ASSERT_GT(frontiers_m.size(), 2U);
  EXPECT_GT(all_m.size(), frontiers_m.size());
  for (const Eigen::Vector3d& p_m : frontiers_m) {
    EXPECT_TRUE(std::ranges::any_of(
        all_m, [&](const Eigen::Vector3d& other_m) { return (p_m - other_m).norm() < 1e-6; }));
  }
}

/// The episode says start_site.
TEST(Exploration, AStartThatIsSetTakesThePlaceOfTheEpisodes) {
  const auto start = [](const std::vector<std::string>& overrides) {
    const auto file =
        std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml";
    return load_episode(file, overrides).setup.options.robot;
  };
  EXPECT_EQ(start({}).start_site, "start_0");
  EXPECT_FALSE(start({}).start_pose);
  EXPECT_EQ(start({"robot.start_pose=[1,2,0.5]"}).start_site, "");
  EXPECT_DOUBLE_EQ(start({"robot.start_pose=[1,2,0.5]"}).posed_start().y_m, 2.0);
  EXPECT_EQ(start({"robot.start_site=start_1"}).start_site, "start_1");
  EXPECT_EQ(start({"robot.start_pose=null"}).start_site, "start_0");
  EXPECT_EQ(start({"robot.start_site=", "robot.start_pose=[1,2,0.5]"}).start_site, "");
  EXPECT_THROW(start({"robot.start_site=start_1", "robot.start_pose=[1,2,0.5]"}), ConfigError);
  const support::TemporaryDirectory folder;
  write_file(folder.path() / "both.yaml",
             "task: exploration\nrobot: {start_site: start_1, start_pose: [1, 2, 0]}\n");
  EXPECT_THROW(load_episode(folder.path() / "both.yaml", {}), ConfigError);
  write_file(folder.path() / "posed.yaml", "task: exploration\nrobot: {start_pose: [1, 2, 0]}\n");
  EXPECT_EQ(load_episode(folder.path() / "posed.yaml", {"robot.start_site=start_3"})
                .setup.options.robot.start_site,
            "start_3");
}

TEST(Exploration, NamesTheSitesItCouldStartFrom) {
  const support::TemporaryDirectory folder;
  try {
    explore(folder.path() / "run", {"robot.start_site=start_9"});
    FAIL() << "expected an error";
  } catch (const ConfigError& error) {
    const std::string what = error.what();
    for (const char* part : {"robot.start_site", "start_9", "start_0", "start_4"}) {
      EXPECT_NE(what.find(part), std::string::npos) << what;
    }
    EXPECT_EQ(what.find("robot/", what.find("known:")), std::string::npos) << what;
  }
  EXPECT_THROW(explore(folder.path() / "run", {"robot.start_pose=[0.6,2,0]"}), ConfigError)
      << "inside a wall";
  EXPECT_THROW(explore(folder.path() / "run", {"frontiers.height_m=3"}), ConfigError);
}

/// No pose is known to a millionth of a cell.
TEST(Exploration, SaysWhyItsMapIsInDoubt) {
  const support::TemporaryDirectory folder;
  const auto metrics =
      explore(folder.path() / "run",
              {"scans=2", "localisation.loops={close: true}", "localisation.accept_drift=true",
               "localisation.tolerance_cells=1e-6"});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_EQ(metrics["localisation"]["map_in_doubt"], true);
  ASSERT_TRUE(metrics["localisation"]["doubt"].is_string());
  const auto doubt = metrics["localisation"]["doubt"].get<std::string>();
  EXPECT_TRUE(metrics["reason"].get<std::string>().ends_with("; " + doubt)) << metrics["reason"];
}

/// Ends with its first plan.
struct PlannedOnce : ExplorationParts {
  using ExplorationParts::ExplorationParts;
  void act(const Candidate& /*candidate*/) {
    plan = tour_;
    throw EpisodeFailed("it has planned");
  }
  PlannedTour plan;
};

TEST(Exploration, TheOracleOfAllPlacesPlansOnToThoseThatItCannotReachYet) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  const ResolvedEpisode episode =
      load_episode(std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml",
                   {"choice=oracle_tour", "map.cells=[100,67,20]", "camera.width_px=160",
                    "camera.height_px=120", "stride_px=1", "metrics.pose_spacing_m=2"});
  const RunRequest request = support::exploration_request(episode, folder.path() / "run");
  ExplorationSession<PlannedOnce> session(request, std::get<Exploration>(episode.task));
  session.run_to_end();
  const PlannedTour& plan = session.parts.plan;
  ASSERT_FALSE(plan.stops.empty());
  EXPECT_GE(plan.stops.front().id, 0);
  EXPECT_TRUE(std::ranges::any_of(plan.stops, [](const PlannedStop& stop) { return stop.id < 0; }));
  EXPECT_TRUE(std::isfinite(plan.ends_s()));
}

/// Notes when its last scan was recorded, and when the decision after it is said to have begun.
struct TimedDecisions : ExplorationParts {
  using ExplorationParts::ExplorationParts;
  void record() {
    recorded_s = wall_s();
    ExplorationParts::record();
    begun_s = decision_start_s_;
  }
  double recorded_s = 0.0;
  double begun_s = 0.0;
};

/// One poor promise is enough for it, at its first scan; what is left is judged there, too.
TEST(Exploration, JudgesWhatIsLeftBeforeItsDecisionBegins) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  const ResolvedEpisode episode =
      load_episode(std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml",
                   {"scans=2", "map.cells=[100,67,20]", "camera.width_px=160",
                    "camera.height_px=120", "stride_px=1", "metrics.pose_spacing_m=2",
                    "stop.share=0.99", "enough.share=1", "enough.scans=1"});
  const RunRequest request = support::exploration_request(episode, folder.path() / "run");
  ExplorationSession<TimedDecisions> session(request, std::get<Exploration>(episode.task));
  const auto metrics = nlohmann::json::parse(session.run_to_end().metrics);
  EXPECT_EQ(metrics["scans"].size(), 1U);
  EXPECT_NE(metrics["reason"].get<std::string>().find("1 in a row"), std::string::npos)
      << metrics["reason"];
  EXPECT_TRUE(session.parts.scans().back().left);
  EXPECT_GE(session.parts.begun_s, session.parts.recorded_s);
}

}  // namespace
}  // namespace vantage
