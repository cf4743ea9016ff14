// What an exploration's belief makes of a sweep, step by step, and what it keeps of it.
#include "vantage/tasks/exploration/exploration_belief.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/localisation/plan_world.hpp"
#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

/// A wavy wall about 2 m before a camera of 1.2 m, which looks along `yaw_rad` of the base.
HeadView wavy_wall_view(double yaw_rad) {
  HeadView view;
  view.image.width_px = 64;
  view.image.height_px = 49;
  view.image.focal_px = 55.0;
  view.image.range_max_m = 3.5;
  for (int i = 0; i < 64 * 49; ++i) {
    view.image.depth_m.push_back(static_cast<float>(2.0 + 0.1 * std::sin(0.01 * i + yaw_rad)));
  }
  Eigen::Matrix3d of_camera;  // from OpenCV's axes to x forward, z up
  of_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  view.T_base_camera = make_pose({0.0, 0.0, 1.2}, yaw_rad);
  view.T_base_camera.rotate(of_camera);
  return view;
}

/// A map of 8 x 8 x 2 m; its cells are longest along y.
struct BelievedRooms {
  Exploration task;
  EpisodeOptions episode;
  ReferenceMap no_walls{RegistrationOptions{}};

  BelievedRooms() {
    task.map.centre_m = {0.0, 0.0, 1.0};
    task.map.size_m = {8.0, 8.0, 2.0};
    task.map.cells = {80, 64, 20};
    episode.threads = 1;
  }
};

const Pose2 kBelievedBase{1.0, 0.2, 0.3};

ExplorationObservation observed_walls(const Pose2& T_world_base) {
  ExplorationObservation seen;
  seen.views = {wavy_wall_view(0.0), wavy_wall_view(1.5)};
  seen.T_world_base_odometry = T_world_base;
  return seen;
}

/// Step by step: surfaces, free space, holes; in the cloud a point a cell.
TEST(ExplorationBelief, TakesInWhatItsImagesShowAndSaysHowMuchThatWas) {
  const BelievedRooms rooms;
  const ExplorationObservation seen = observed_walls(kBelievedBase);
  ExplorationBelief belief(rooms.episode, rooms.task);
  const BeliefUpdate update = belief.update(seen, rooms.no_walls, {});

  PointCloud points;
  std::vector<PosedImage> images;
  for (const HeadView& view : seen.views) {
    const Pose T_world_camera = to_se3(kBelievedBase) * view.T_base_camera;
    images.push_back({view.image, T_world_camera});
    append(points, transform(to_cloud(view.image, rooms.task.stride_px), T_world_camera));
  }
  OccupancyGrid expected(rooms.task.map.frame());
  add_measurements(expected, points.points, rooms.task.sensor_model);
  EXPECT_EQ(update.freed_cells, carve_free_space(expected, images, rooms.task.free_space));
  EXPECT_EQ(belief.grid().log_odds, expected.log_odds);
  EXPECT_GT(update.freed_cells, 1000U);
  const auto filled = fill_holes(expected, rooms.task.hole_filling);
  EXPECT_EQ(update.filled_cells, filled.filled_cells);
  EXPECT_EQ(belief.filled_grid().log_odds, filled.grid.log_odds);
  const double longest_m = expected.frame.cell_size_m.y();
  EXPECT_EQ(belief.cloud().size(), voxel_downsample(points, longest_m).size());
  EXPECT_LT(belief.cloud().size(), points.size());
}

TEST(ExplorationBelief, SaysWhereItIsPutAndWhetherAnythingSaysSo) {
  const BelievedRooms rooms;
  std::vector<test_plan::Segment> walls;
  test_plan::add_box(walls, -4.0, -3.0, 4.0, 3.0);
  Rng rng(7);
  const auto scan_from = [&](const Pose2& T_world_base) {
    PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 30.0};
    for (int i = -540; i <= 540; ++i) {
      scan.azimuth_rad.push_back(0.00436 * i);
      const double yaw_rad = T_world_base.yaw_rad + scan.azimuth_rad.back();
      const double range_m =
          test_plan::range_m(walls, position(T_world_base), {std::cos(yaw_rad), std::sin(yaw_rad)});
      scan.range_m.push_back(static_cast<float>(range_m + 0.01 * rng.normal()));
    }
    return scan;
  };
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  ReferenceMap room(registration);
  room.remember(scan_from({}), 0.25, {});
  ExplorationObservation seen = observed_walls({0.13, 0.02, 0.0});
  seen.base_scan = scan_from({0.1, 0.05, 0.02});
  seen.base_scan_height_m = 0.25;

  const BeliefUpdate put = ExplorationBelief(rooms.episode, rooms.task).update(seen, room, {});
  EXPECT_TRUE(put.registered) << put.registration_note;
  EXPECT_NEAR(put.T_world_base.x_m, 0.1, 0.01);
  EXPECT_NEAR(put.T_world_base.y_m, 0.05, 0.01);
  EXPECT_NEAR(put.T_world_base.yaw_rad, 0.02, 0.005);
  EXPECT_EQ(put.unconstrained, 0);
  EXPECT_GT(put.information.trace(), 0.0);

  const BeliefUpdate kept =
      ExplorationBelief(rooms.episode, rooms.task).update(seen, rooms.no_walls, {});
  EXPECT_FALSE(kept.registered);
  EXPECT_FALSE(kept.registration_note.empty());
  EXPECT_EQ(kept.T_world_base.x_m, 0.13) << "where the wheels say";
  EXPECT_EQ(kept.unconstrained, 3);
}

/// Of 9 columns the 2nd, 5th and 8th, of 6 rows the 2nd and 5th.
TEST(Reintegration, KeepsTheMiddleRowsAndColumnsOfImages) {
  CameraImages image{.width_px = 9,
                     .height_px = 6,
                     .focal_px = 60.0,
                     .range_max_m = 3.25,
                     .rgb = {},
                     .depth_m = {}};
  for (int i = 0; i < 9 * 6; ++i) image.depth_m.push_back(1.0F + 0.01F * static_cast<float>(i));
  const Pose T_base_camera = make_pose({0.1, 0.2, 1.2}, 0.3);
  const std::vector<HeadView> views{{image, T_base_camera}, {image, Pose::Identity()}};
  const std::vector<HeadView> kept = thinned(views, 3);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].T_base_camera.matrix(), T_base_camera.matrix());
  const CameraImages& thin = kept[0].image;
  ASSERT_EQ(thin.width_px, 3);
  ASSERT_EQ(thin.height_px, 2);
  EXPECT_EQ(thin.focal_px, 20.0);
  EXPECT_EQ(thin.range_max_m, 3.25);
  ASSERT_EQ(thin.depth_m.size(), 6U);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_EQ(thin.depth_at(row, column), image.depth_at(1 + 3 * row, 1 + 3 * column));
    }
  }
  EXPECT_TRUE(thin.ray(0, 2).isApprox(image.ray(1, 7), 1e-12));
}

/// Where every third pixel is kept.
TEST(Reintegration, CountsClutterAtTheStrideThatComesNearestToThatAtFirst) {
  const ExplorationObservation seen = observed_walls(kBelievedBase);
  const auto of_kept = [&](int stride_px) {
    BelievedRooms rooms;
    rooms.task.stride_px = 1;
    rooms.task.hazard_stride_px = stride_px;
    ExplorationObservation thin = seen;
    thin.views = thinned(seen.views, 3);
    ExplorationBelief belief(rooms.episode, rooms.task);
    belief.update(thin, rooms.no_walls, {});
    return belief.hazard().global_hazard();
  };
  const auto made_anew = [&](int hazard_stride_px) {
    BelievedRooms rooms;
    rooms.task.stride_px = 3;
    rooms.task.hazard_stride_px = hazard_stride_px;
    ExplorationBelief belief(rooms.episode, rooms.task);
    belief.keep(seen, 1);
    belief.reintegrate(std::vector<Pose2>{{0.0, 0.0, 0.0}, kBelievedBase});
    return belief.hazard().global_hazard();
  };
  EXPECT_EQ(made_anew(1), of_kept(1));
  EXPECT_EQ(made_anew(7), of_kept(2));
  EXPECT_EQ(made_anew(11), of_kept(4));
  EXPECT_NE(of_kept(1), of_kept(2));
  EXPECT_NE(of_kept(2), of_kept(3));
  EXPECT_NE(of_kept(3), of_kept(4));
}

}  // namespace
}  // namespace vantage
