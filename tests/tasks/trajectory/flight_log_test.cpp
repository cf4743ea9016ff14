// The views that a flight along a path weighs, as those who look on see them.
#include "vantage/tasks/trajectory/flight_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <variant>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

/// 0.3 rad below the horizon, ahead of the body's middle, beside it and below it.
Pose tilted_camera() {
  Pose T_body_camera = Pose::Identity();
  T_body_camera.linear() << 0.0, -std::sin(0.3), std::cos(0.3), -1.0, 0.0, 0.0, 0.0, -std::cos(0.3),
      -std::sin(0.3);
  T_body_camera.translation() = Eigen::Vector3d(0.1, 0.2, -0.05);
  return T_body_camera;
}

std::vector<PlannableObject> two_objects() {
  std::vector<PlannableObject> objects(2);
  objects[0].id = 7;
  objects[0].p_world_m = {1.0, 2.0, 0.5};
  objects[1].id = 4;
  objects[1].p_world_m = {-3.0, 1.0, 1.5};
  for (std::size_t d = 0; d < kObservationDirections; ++d) {
    objects[0].gain_nats[d] = 0.1 * static_cast<double>(d);
    objects[1].gain_nats[d] = 1.0 + 0.1 * static_cast<double>(d);
  }
  objects[1].used[2] = true;
  return objects;
}

constexpr double kDistance_m = 2.0;
constexpr double kHighest_m = 1.8;

/// Along the camera's line of sight the object is that far from the body, level and below.
const double kAside_m = std::hypot(0.1 + kDistance_m * std::cos(0.3), 0.2);
const double kAbove_m = 0.05 + kDistance_m * std::sin(0.3);

TEST(ViewDecision, IsAmongTheRingsOfAllObjects) {
  const auto objects = two_objects();
  const Decision decision =
      view_decision(objects, tilted_camera(), kDistance_m, kHighest_m, std::nullopt);
  ASSERT_EQ(decision.candidates.size(), 16U);
  EXPECT_EQ(decision.chosen, 16U) << "none of them";
  for (std::size_t i = 0; i < 16; ++i) {
    const Candidate& view = decision.candidates[i];
    const PlannableObject& object = objects[i / 8];
    const double bearing_rad = static_cast<double>(i % 8) * std::numbers::pi / 4.0;
    const double height_m = i < 8 ? 0.5 + kAbove_m : kHighest_m;
    const Eigen::Vector3d place_m(object.p_world_m.x() + kAside_m * std::cos(bearing_rad),
                                  object.p_world_m.y() + kAside_m * std::sin(bearing_rad),
                                  height_m);
    EXPECT_EQ(view.id, static_cast<int>(i));
    EXPECT_NEAR((view.T_world_sensor.translation() - place_m).norm(), 0.0, 1e-9) << i;
    EXPECT_EQ(view.gain_bits, object.gain_nats[i % 8]) << i;
    EXPECT_EQ(view.reachable, i != 10) << i;
  }
}

TEST(ViewDecision, LooksAtTheObjectUpright) {
  const Decision decision =
      view_decision(two_objects(), tilted_camera(), kDistance_m, kHighest_m, std::nullopt);
  for (const Candidate& view : decision.candidates) {
    const Eigen::Matrix3d axes = view.T_world_sensor.linear();
    const Eigen::Vector3d to_object_m =
        two_objects()[view.id < 8 ? 0 : 1].p_world_m - view.T_world_sensor.translation();
    EXPECT_NEAR((axes.col(0) - to_object_m.normalized()).norm(), 0.0, 1e-9);
    EXPECT_NEAR(axes.col(1).z(), 0.0, 1e-12);
    EXPECT_GT(axes.col(2).z(), 0.0);
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-9);
  }
}

TEST(ViewDecision, FliesToWhereThePlannerWantsTheView) {
  const ViewTarget target{.object = 4, .direction = 5, .p_world_view_m = {-4.0, 0.5, 1.7}};
  const Decision decision =
      view_decision(two_objects(), tilted_camera(), kDistance_m, kHighest_m, target);
  EXPECT_EQ(decision.chosen, 13U);
  EXPECT_EQ(Eigen::Vector3d(decision.candidates[13].T_world_sensor.translation()),
            Eigen::Vector3d(-4.0, 0.5, 1.7));
  EXPECT_NE(Eigen::Vector3d(decision.candidates[5].T_world_sensor.translation()),
            Eigen::Vector3d(-4.0, 0.5, 1.7));
  const Decision gone = view_decision(two_objects(), tilted_camera(), kDistance_m, kHighest_m,
                                      ViewTarget{.object = 5, .direction = 4});
  EXPECT_EQ(gone.chosen, 16U);
}

/// The first cell of the grid and the last one.
TEST(FlightLog, KeepsSinceWhichWaypointEachCellIsOccupied) {
  const support::TemporaryDirectory folder;
  write_file(folder / "scene.xml",
             "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  const ModelSource source{folder / "scene.xml", {}};
  World world(source);
  const auto at_origin = [] { return make_pose({0.0, 0.0, 1.0}, 0.0); };
  RunLog run({.world = world, .T_world_body = at_origin, .T_world_estimated = at_origin}, {},
             folder.path(), false, true, {});
  FlightLog log(run, folder.path(), true);
  OccupancyGrid grid(make_grid_frame({0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {2, 2, 1}));
  grid.log_odds[0] = 5.0F;
  log.map(grid, 3);
  grid.log_odds[3] = 5.0F;
  log.map(grid, 4);
  log.commit();
  const VoxelMap map = read_voxels(folder / "voxels.bin");
  ASSERT_EQ(map.voxels.size(), 2U);
  EXPECT_EQ(map.voxels[0].x, 0.25F);
  EXPECT_EQ(map.voxels[0].step, 3);
  EXPECT_EQ(map.voxels[1].x, 0.75F);
  EXPECT_EQ(map.voxels[1].step, 4);
}

/// The log of a flight over a bare floor.
struct LoggedFlight {
  explicit LoggedFlight(bool keep, const Spectator& spectator = {})
      : run({.world = world, .T_world_body = at_origin, .T_world_estimated = at_origin}, {},
            folder.path(), false, true, spectator),
        log(run, folder.path(), keep) {}
  static Pose at_origin() { return make_pose({0.0, 0.0, 1.0}, 0.0); }
  static ModelSource floor_in(const support::TemporaryDirectory& folder) {
    write_file(folder / "scene.xml",
               "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
    return {folder / "scene.xml", {}};
  }
  support::TemporaryDirectory folder;
  const ModelSource source = floor_in(folder);
  World world{source};
  RunLog run;
  FlightLog log;
};

/// One is freed in between, in a grid of unlike edges.
TEST(FlightLog, SaysWhereACellIsAndSinceWhenItIsOccupiedAnew) {
  LoggedFlight flight(true);
  OccupancyGrid grid(make_grid_frame({1.0, 2.0, 3.0}, {2.0, 1.2, 0.8}, {2, 3, 4}));
  const std::size_t cell = grid.frame.index(Eigen::Array3i(1, 2, 0));
  const std::size_t later = grid.frame.index(Eigen::Array3i(0, 0, 3));
  grid.log_odds[cell] = 5.0F;
  flight.log.map(grid, 3);
  grid.log_odds[cell] = -5.0F;
  flight.log.map(grid, 4);
  grid.log_odds[cell] = 5.0F;
  flight.log.map(grid, 6);
  grid.log_odds[later] = 5.0F;
  flight.log.map(grid, 7);
  flight.log.commit();
  const VoxelMap map = read_voxels(flight.folder / "voxels.bin");
  ASSERT_EQ(map.voxels.size(), 2U);
  EXPECT_NEAR(map.voxels[0].x, 1.5, 1e-6);
  EXPECT_NEAR(map.voxels[0].y, 2.4, 1e-6);
  EXPECT_NEAR(map.voxels[0].z, 2.7, 1e-6);
  EXPECT_EQ(map.voxels[0].step, 6);
  EXPECT_EQ(map.voxels[0].kind, kVoxelOccupied);
  EXPECT_NEAR(map.voxels[1].z, 3.3, 1e-6);
  EXPECT_EQ(map.voxels[1].step, 7);
  EXPECT_NEAR((map.cell_size_m - Eigen::Vector3d(1.0, 0.4, 0.2)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((map.box_m.min() - Eigen::Vector3d(0.0, 1.4, 2.6)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((map.box_m.max() - Eigen::Vector3d(2.0, 2.6, 3.4)).norm(), 0.0, 1e-9);
}

TEST(FlightLog, TellsThoseWhoLookOnAndKeepsNothingForThem) {
  std::vector<EpisodeEvent> told;
  Spectator spectator;
  spectator.on_event = [&](const EpisodeEvent& event) { told.push_back(event); };
  LoggedFlight flight(false, spectator);
  EXPECT_TRUE(flight.log.wanted());
  OccupancyGrid grid(make_grid_frame({0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {2, 2, 1}));
  grid.log_odds[2] = 5.0F;
  flight.log.map(grid, 0);
  Decision decision;
  decision.candidates.resize(3);
  decision.chosen = 1;
  flight.log.decision(decision);
  std::vector<Eigen::Vector4d> plan;
  for (const double k : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
    plan.emplace_back(k, 10.0 + k, 20.0 + k, 0.5);
  }
  flight.log.plan(plan, 1, 3);
  flight.log.plan(plan, 4, 9);
  flight.log.commit();
  ASSERT_EQ(told.size(), 4U);
  const std::vector<CellRun>& runs = std::get<MapChange>(told[0].what).runs;
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].first, 2U);
  EXPECT_EQ(runs[0].state, CellState::occupied);
  EXPECT_EQ(std::get<Decision>(told[1].what).chosen, 1U);
  const std::vector<Eigen::Vector3d>& path_m = std::get<PlannedFlight>(told[2].what).path_m;
  ASSERT_EQ(path_m.size(), 3U);
  for (std::size_t i = 0; i < path_m.size(); ++i) {
    EXPECT_EQ(path_m[i], Eigen::Vector3d(plan[i + 1].head<3>())) << i;
  }
  EXPECT_EQ(std::get<PlannedFlight>(told[3].what).path_m.size(), 2U) << "no more is planned";
  EXPECT_FALSE(std::filesystem::exists(flight.folder / "voxels.bin"));
  EXPECT_FALSE(std::filesystem::exists(flight.folder / "story.bin"));
  EXPECT_FALSE(LoggedFlight(false).log.wanted());
  EXPECT_TRUE(LoggedFlight(true).log.wanted());
}

}  // namespace
}  // namespace vantage
