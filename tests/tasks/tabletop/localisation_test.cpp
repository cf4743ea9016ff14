// A table top with nothing to localise by but itself: what the run says of its map.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/tasks/mapping/run_request.hpp"
#include "tests/tasks/tabletop/own_scene.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using support::kWalls;
using support::objects_on;
using support::OwnScene;
using support::table_at;
using testing::HasSubstr;

/// One leg in the middle: nothing that a scanner near the floor could tell a heading by.
std::string pedestal_table() {
  return "<geom type='box' size='.5 .5 .02' pos='0 0 .7'/>"
         "<geom type='box' size='.08 .08 .34' pos='0 0 .34'/>" +
         objects_on(0.72);
}

struct Ran {
  ExitCode code;
  json metrics;
};

Ran ran(const OwnScene& scene, std::vector<std::string> more) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  more.insert(more.end(), {scene.set(), "scans=3", "map.cells=[49,49,25]",
                           "laser.scan_duration_s=3", "localisation.tolerance_cells=1"});
  const auto file = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml";
  RunOptions options;
  options.directory = folder.path() / "run";
  options.lean = true;
  const RunOutcome outcome = run(load_episode(file, more), options);
  return {outcome.code, json::parse(outcome.metrics)};
}

TEST(TableTopWithoutWalls, AMapThatOdometryDriftedAwayWithIsNoUnremarkedResult) {
  const OwnScene scene(pedestal_table());
  const auto [code, metrics] = ran(scene, {});
  EXPECT_EQ(code, ExitCode::goal_failed);
  EXPECT_EQ(metrics["status"], "failed");
  EXPECT_THAT(metrics["reason"].get<std::string>(),
              testing::AllOf(HasSubstr("not to be trusted"), HasSubstr("tolerance_cells")));
  EXPECT_FALSE(metrics["localisation"]["trusted"]);
  const json& scans = metrics["scans"];
  ASSERT_EQ(scans.size(), 3U) << "the map is written all the same";
  EXPECT_LT(scans[0]["pose_error_m"], 1e-3) << "no turn at the start that loses the heading";
  EXPECT_LT(std::abs(scans[0]["yaw_error_rad"].get<double>()), 1e-3);
  EXPECT_GT(scans[2]["map_sigma_m"], scans[0]["map_sigma_m"]);

  const auto [accepted_code, accepted] = ran(scene, {"localisation.accept_drift=true"});
  EXPECT_EQ(accepted_code, ExitCode::done);
  EXPECT_EQ(accepted["status"], "completed");
  EXPECT_THAT(accepted["reason"].get<std::string>(),
              testing::EndsWith(metrics["reason"].get<std::string>()));
  EXPECT_EQ(accepted["state_hash"], metrics["state_hash"]);
}

TEST(TableTopWithoutWalls, FourLegsAreEnoughToLocaliseBy) {
  const auto [code, metrics] =
      ran(OwnScene(table_at(0.0, 0.0, 0.72, 0.5, 0.5) + objects_on(0.72)), {});
  EXPECT_EQ(code, ExitCode::done) << metrics["reason"];
  EXPECT_TRUE(metrics["localisation"]["trusted"]);
  for (const json& scan : metrics["scans"]) {
    EXPECT_LT(scan["pose_error_m"], 0.025);
    EXPECT_LT(std::abs(scan["yaw_error_rad"].get<double>()), 0.025);
  }
  EXPECT_GT(metrics["map"]["precision"], 0.85);
}

TEST(TableTopWithoutWalls, AScanThatIsNotRegisteredKeepsTheTrackedPose) {
  testing::internal::CaptureStderr();
  const auto [code, metrics] = ran(OwnScene(pedestal_table()), {});
  const std::string log = testing::internal::GetCapturedStderr();
  int kept = 0;
  for (const json& scan : metrics["scans"]) {
    if (scan["registered"]) continue;
    ++kept;
    EXPECT_EQ(scan["unconstrained"], 3);
    EXPECT_EQ(scan["pose_error_m"], scan["pose_error_tracked_m"]);
  }
  EXPECT_GT(kept, 0);
  EXPECT_THAT(log, HasSubstr("the pose tracked on the way is kept"));
}

TEST(TableTopWithWalls, TheTrackedPoseIsBetterThanTheWheelsAlone) {
  const auto [code, metrics] =
      ran(OwnScene(pedestal_table() + kWalls),
          {"odometry.sigma_translation_m=0.05", "odometry.bias_translation_m_per_m=0.1"});
  const json& last = metrics["scans"][2];
  EXPECT_GT(last["pose_error_before_registration_m"], 0.02);
  EXPECT_LT(last["pose_error_tracked_m"].get<double>(),
            0.5 * last["pose_error_before_registration_m"].get<double>());
}

TEST(TableTopWithWalls, AFirstScanThatShowsNoTableIsAFailedRun) {
  const auto [code, metrics] =
      ran(OwnScene(pedestal_table() + kWalls), {"table.max_tilt_rad=1e-9"});
  EXPECT_EQ(code, ExitCode::goal_failed);
  EXPECT_EQ(metrics["status"], "failed");
  EXPECT_THAT(
      metrics["reason"].get<std::string>(),
      testing::AllOf(HasSubstr("scene.xml: the first scan shows no table"), HasSubstr("table.m")));
  EXPECT_TRUE(metrics["scans"].empty());
  EXPECT_GT(metrics["observable_cells"], 0);
}

TEST(TableTopWithWalls, IsTrusted) {
  const auto [code, metrics] = ran(OwnScene(pedestal_table() + kWalls), {});
  EXPECT_EQ(metrics["status"], "completed");
  EXPECT_EQ(metrics["reason"], "limit of 3 scans");
  EXPECT_TRUE(metrics["localisation"]["trusted"]);
  EXPECT_GT(metrics["map"]["precision"], 0.9);
}

/// With what the robot keeps to itself.
struct OpenParts : TabletopParts {
  using TabletopParts::navigator_;
  using TabletopParts::TabletopParts;
};

/// Runs an episode of the scene, then shows what it came to.
void look_into(const OwnScene& scene, std::vector<std::string> more,
               const std::function<void(TabletopSession<OpenParts>&)>& look) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  more.insert(more.end(), {scene.set(), "map.cells=[49,49,25]", "laser.scan_duration_s=3"});
  const ResolvedEpisode episode =
      load_episode(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml", more);
  RunOptions options;
  options.directory = folder / "run";
  options.lean = true;
  const RunRequest request = support::mapping_request(episode, options);
  TabletopSession<OpenParts> session(request, std::get<Tabletop>(episode.task));
  session.run_to_end();
  look(session);
}

/// RMS of how it knows the corners of its map, or what is 2 m away on the way to them.
TEST(TableTopWithoutWalls, AMapIsAsSureAsWhatIsSeenOfItFromThere) {
  look_into(OwnScene(pedestal_table()), {"scans=2"}, [](TabletopSession<OpenParts>& session) {
    const Pose2 base = session.robot.estimated_base();
    const Eigen::Vector2d from_m(base.x_m, base.y_m);
    const Eigen::Matrix3d covariance = session.parts.navigator_.uncertainty().covariance();
    EXPECT_GT(covariance(2, 2), 0.0);
    const Eigen::AlignedBox3d region = session.belief.grid().frame.box();
    double sum_m2 = 0.0;
    for (const double x_m : {region.min().x(), region.max().x()}) {
      for (const double y_m : {region.min().y(), region.max().y()}) {
        Eigen::Vector2d way_m = Eigen::Vector2d(x_m, y_m) - from_m;
        if (way_m.norm() > 2.0) way_m *= 2.0 / way_m.norm();
        sum_m2 += std::pow(mapped_sigma_m(base, covariance, from_m + way_m), 2);
      }
    }
    ASSERT_EQ(session.parts.scans().size(), 2U);
    EXPECT_NEAR(session.parts.scans().back().map_sigma_m, std::sqrt(0.25 * sum_m2), 1e-9);
  });
}

/// A map of 0.6 m on a table of a metre.
TEST(TableTopWithWalls, ATableIsInTheWayBesideItsMapToo) {
  look_into(OwnScene(pedestal_table() + kWalls), {"scans=1", "map.size_m=[0.6,0.6,0.504]"},
            [](TabletopSession<OpenParts>& session) {
              const FloorMap& floor = session.parts.navigator_.floor();
              EXPECT_EQ(floor.state_at({0.22, 0.01}), CellState::occupied);
              EXPECT_EQ(floor.state_at({0.42, 0.01}), CellState::occupied);
              EXPECT_NE(floor.state_at({0.62, 0.01}), CellState::occupied);
            });
}

TEST(TableTopWithWalls, AViewThatCannotBePaidIsNotToBeTaken) {
  look_into(OwnScene(pedestal_table() + kWalls), {"scans=1", "budget.time_s=1000"},
            [](TabletopSession<OpenParts>& session) {
              std::vector<Candidate> views = session.parts.views();
              ASSERT_GT(views.size(), 1U);
              views[0].path_length_m = 1.0;
              views[1].path_length_m = 1e5;
              session.parts.score(views);
              EXPECT_FALSE(views[0].exhausted);
              EXPECT_TRUE(views[1].exhausted);
            });
}

TEST(TableTopWithoutWalls, ScansThatAreNotRegisteredAreNamedByTheirNumber) {
  testing::internal::CaptureStderr();
  const auto [code, metrics] = ran(OwnScene(pedestal_table()), {});
  const std::string log = testing::internal::GetCapturedStderr();
  const json& scans = metrics["scans"];
  ASSERT_EQ(scans.size(), 3U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::string said = fmt::format("scan {}: not registered", i + 1);
    const bool registered = scans[i]["registered"];
    EXPECT_EQ(log.find(said) == std::string::npos, registered) << said;
  }
}

/// The robot starts behind the first position, looking straight ahead: a view within 0.1 m and 0.1
/// rad of there is the one that was taken.
TEST(TableTopWithoutWalls, AViewThatWasTakenIsNoFrontierAnyMore) {
  const auto exhausted_by = [](const std::string& choice, const std::string& behind_m) {
    std::vector<int> exhausted;
    look_into(OwnScene(pedestal_table()),
              {"scans=1", "choice=" + choice, "robot.start_behind_m=" + behind_m,
               "candidates.yaw_offsets_rad=[0,0.09,0.11,-0.11]"},
              [&](TabletopSession<OpenParts>& session) {
                for (const Candidate& view : session.parts.views()) {
                  if (view.exhausted) exhausted.push_back(view.id);
                }
              });
    return exhausted;
  };
  EXPECT_THAT(exhausted_by("nearest_frontier", "0.09"), testing::ElementsAre(0, 1));
  EXPECT_THAT(exhausted_by("nearest_frontier", "0.11"), testing::IsEmpty());
  EXPECT_THAT(exhausted_by("greedy", "0.09"), testing::IsEmpty());
}

/// Its first scan shows no table, which ends it soon.
TEST(TableTopWithoutWalls, ARunBeginsWithWhatItHasToLocaliseBy) {
  testing::internal::CaptureStderr();
  const auto [code, metrics] = ran(OwnScene(pedestal_table()), {"table.max_tilt_rad=1e-9"});
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(code, ExitCode::goal_failed);
  EXPECT_THAT(log, HasSubstr("registration: from the start of "));
  EXPECT_THAT(log, testing::Not(HasSubstr("none of the views sees any of its cells")));
}

}  // namespace
}  // namespace vantage
