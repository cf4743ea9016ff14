// The views that a flight along a path weighs, as those who look on see them.
#include "vantage/tasks/trajectory/flight_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

}  // namespace
}  // namespace vantage
