// The map that a robot keeps of a table, from images drawn ray by ray.
#include "vantage/tasks/table_map/table_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/perception/drawn_boxes.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/planners/views/target_visibility.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/tasks/table_map/table_map_log.hpp"

namespace vantage {
namespace {

using namespace test;

/// A target in the middle of the table, a wide box before it as the camera at bearing 0 sees it.
const Box kTarget = box_at(0.0, 0.0, {0.08, 0.08, 0.15});
const Box kScreen = box_at(0.18, 0.0, {0.04, 0.30, 0.30});
const UprightCylinder kShape{kTable_m, 0.055, 0.15};

TableMap map_after(const std::vector<double>& bearings_rad, const TableMapOptions& options = {}) {
  TableMap map(kTable_m, options);
  for (const double bearing_rad : bearings_rad) {
    const Pose T_world_camera = camera_at(bearing_rad);
    map.insert(draw({{kTarget, kScreen}}, T_world_camera, 0.002).images, T_world_camera);
  }
  return map;
}

Eigen::Vector3d eye(double bearing_rad) { return camera_at(bearing_rad).translation(); }

TEST(TableMap, BeforeAnyImageAllViewsAreAlike) {
  const TableMap map = map_after({});
  const double seen = map.visible_share(kShape, {}, eye(0.0));
  EXPECT_GT(seen, 0.5) << "the prior hazard is low";
  EXPECT_LT(seen, 1.0);
  EXPECT_NEAR(map.visible_share(kShape, {}, eye(std::numbers::pi)), seen, 0.05);
}

TEST(TableMap, AScreenHidesFromItsSideAndNotFromOthers) {
  const TableMap map = map_after({1.2, -1.2, 2.8});  // from beside and behind
  EXPECT_LT(map.visible_share(kShape, {}, eye(0.0)), 0.35);
  EXPECT_GT(map.visible_share(kShape, {}, eye(std::numbers::pi)), 0.85);
  EXPECT_GT(map.visible_share(kShape, {}, eye(1.57)), 0.8);
}

/// The robot that has only seen the screen expects to see the target from elsewhere.
TEST(TableMap, FromTheScreensSideOtherViewsPromiseMore) {
  const TableMap map = map_after({0.0});
  EXPECT_LT(map.visible_share(kShape, {}, eye(0.0)), 0.3);
  EXPECT_GT(map.visible_share(kShape, {}, eye(1.57)),
            map.visible_share(kShape, {}, eye(0.2)) + 0.2);
}

TEST(TableMap, KnowsTheCellsOverAnOutline) {
  TableMapOptions options;
  options.margin_m = 0.0;
  const TableMap map = map_after({}, options);
  const Eigen::Vector2d middle = kTable_m.head<2>();
  const std::vector<Eigen::Vector2d> outline{
      middle + Eigen::Vector2d(-0.1, -0.05), middle + Eigen::Vector2d(0.1, -0.05),
      middle + Eigen::Vector2d(0.1, 0.05), middle + Eigen::Vector2d(-0.1, 0.05)};
  const std::vector<std::uint8_t> over = map.cells_over(outline, 0.15);
  // 0.2 x 0.1 m of cells of 2 cm, in six layers from 3 cm above the table up.
  EXPECT_NEAR(static_cast<double>(std::ranges::count(over, 1)), 10 * 5 * 6, 40);
  const GridFrame& frame = map.grid().frame;
  EXPECT_EQ(over[frame.index(frame.cell_at(kTable_m + Eigen::Vector3d(0.08, 0.03, 0.1)))], 1);
  EXPECT_EQ(over[frame.index(frame.cell_at(kTable_m + Eigen::Vector3d(0.08, 0.09, 0.1)))], 0);
  EXPECT_EQ(over[frame.index(frame.cell_at(kTable_m + Eigen::Vector3d(0.08, 0.03, 0.3)))], 0);
}

TEST(TableMap, LearnsItsHazardFromWhatItMeets) {
  EXPECT_NE(map_after({0.0, 1.5}).hazard(), map_after({}).hazard());
  const Pose T_world_camera = camera_at(0.0);
  const CameraImages images = draw({{kTarget, kScreen}}, T_world_camera, 0.002).images;
  const PosedImage posed{images, T_world_camera};
  TableMapOptions options;
  for (const auto& [columns, stride] : {std::pair{160, 2}, std::pair{100, 3}, std::pair{400, 1}}) {
    options.columns = columns;
    const OccupancyGrid unknown(TableMap::frame_of(kTable_m, options));
    ClutterHazard expected(options.hazard, unknown.frame.cells);
    expected.observe(unknown, std::span(&posed, 1), stride, unknown.frame.min_corner_m.z());
    EXPECT_EQ(map_after({0.0}, options).hazard(), expected.global_hazard()) << columns;
  }
}

TEST(TableMap, FlightsKeepClearOfWhatStandsThere) {
  TableMapOptions options;
  options.height_m = 0.5;
  const TableMap map = map_after({0.0, 1.0, 2.0, 3.0, 4.0, 5.0}, options);
  const Eigen::Vector3d over = kTable_m + Eigen::Vector3d(0.18, 0.0, 0.0);
  const auto across = [&](double height_m) {
    const Eigen::Vector3d up(0.0, 0.0, height_m);
    const Eigen::Vector3d aside(0.0, 0.9, 0.0);
    return std::vector<Eigen::Vector3d>{over - aside + up, over + aside + up};
  };
  EXPECT_FALSE(map.is_clear(across(0.4))) << "0.1 m over the screen";
  EXPECT_TRUE(map.is_clear(across(1.0)));
  const std::vector<Eigen::Vector3d> beside{kTable_m + Eigen::Vector3d(-1.0, 0.95, 0.4),
                                            kTable_m + Eigen::Vector3d(1.0, 0.95, 0.4)};
  EXPECT_TRUE(map.is_clear(beside)) << "nothing stands beside the table";
}

TEST(TableMap, FlightsKeepClearOfWhatWasNotSeenOverTheTable) {
  const std::vector<Eigen::Vector3d> low{kTable_m + Eigen::Vector3d(-0.3, 0.0, 0.5),
                                         kTable_m + Eigen::Vector3d(-0.3, 0.3, 0.5)};
  EXPECT_FALSE(map_after({}).is_clear(low));
}

/// However much of it was not seen: it ends at the table's edge.
TEST(TableMap, BesideATableThatWasNotSeenFlightsAreClear) {
  const TableMap map = map_after({});
  const auto beside = [&](double off_m) {
    return std::vector<Eigen::Vector3d>{kTable_m + Eigen::Vector3d(-0.9, 0.5 + off_m, 0.3),
                                        kTable_m + Eigen::Vector3d(0.9, 0.5 + off_m, 0.3)};
  };
  EXPECT_TRUE(map.is_clear(beside(0.37)));
  EXPECT_FALSE(map.is_clear(beside(0.33)));
}

TEST(TableMapLog, KeepsSinceWhenWhatStandsThere) {
  const support::TemporaryDirectory folder;
  TableMapLog log;
  TableMap map(kTable_m, {});
  for (int view = 0; view < 2; ++view) {
    const Pose T_world_camera = camera_at(2.0 * view);
    map.insert(draw({{kTarget, kScreen}}, T_world_camera, 0.002).images, T_world_camera);
    EXPECT_FALSE(log.change(map.grid(), view).runs.empty());
  }
  log.commit(folder.path());
  const VoxelMap voxels = read_voxels(folder / "voxels.bin");
  EXPECT_EQ(voxels.cell_size_m, map.grid().frame.cell_size_m);
  EXPECT_EQ(voxels.box_m.min(), map.grid().frame.box().min());
  EXPECT_EQ(voxels.box_m.max(), map.grid().frame.box().max());
  std::array<int, 2> occupied{};
  int unobserved = 0;
  for (const VoxelRecord& voxel : voxels.voxels) {
    if (voxel.kind == kVoxelOccupied) ++occupied.at(voxel.step);
    if (voxel.kind == kVoxelUnobserved) ++unobserved;
  }
  EXPECT_GT(occupied[0], 50);
  EXPECT_GT(occupied[1], 20);
  EXPECT_GT(unobserved, 100);
}

TEST(TableMap, FillsTheRoomOverTheTable) {
  TableMapOptions options;
  options.size_m = {1.25, 0.75};
  options.height_m = 0.5;
  options.foot_m = 0.125;
  options.cell_m = 1.0 / 64.0;
  const GridFrame frame = TableMap::frame_of({1.0, 2.0, 0.75}, options);
  EXPECT_EQ(frame.min_corner_m, Eigen::Vector3d(0.375, 1.625, 0.875));
  EXPECT_EQ(frame.cell_size_m, Eigen::Vector3d::Constant(1.0 / 64.0));
  EXPECT_TRUE((frame.cells == Eigen::Array3i(80, 48, 24)).all());
  options.height_m = 0.05;
  EXPECT_EQ(TableMap::frame_of({1.0, 2.0, 0.75}, options).cells.z(), 1) << "a layer at least";
}

/// An outline of 0.2 x 0.1 m and something 0.15 m high in it: 4 cm more to all sides.
TEST(TableMap, CellsOverAnOutlineAreWiderByTheMargin) {
  TableMapOptions options;
  options.margin_m = 0.04;
  const TableMap map = map_after({}, options);
  std::vector<Eigen::Vector2d> outline;
  for (const auto& [x_m, y_m] : {std::pair{-0.1, -0.05}, std::pair{0.1, -0.05},
                                 std::pair{0.1, 0.05}, std::pair{-0.1, 0.05}}) {
    outline.emplace_back(kTable_m.x() + x_m, kTable_m.y() + y_m);
  }
  const std::vector<std::uint8_t> over = map.cells_over(outline, 0.15);
  const auto is_over = [&](double x_m, double y_m, double z_m) {
    const GridFrame& frame = map.grid().frame;
    return over[frame.index(frame.cell_at(kTable_m + Eigen::Vector3d(x_m, y_m, z_m)))] == 1;
  };
  EXPECT_TRUE(is_over(0.01, 0.01, 0.18));
  EXPECT_FALSE(is_over(0.01, 0.01, 0.20));
  EXPECT_TRUE(is_over(0.01, 0.07, 0.1));
  EXPECT_FALSE(is_over(0.01, 0.11, 0.1));
  EXPECT_TRUE(is_over(-0.13, 0.01, 0.1));
  EXPECT_FALSE(is_over(-0.15, 0.01, 0.1));
}

TEST(TableMap, TakesPointsToBeOffByHalfACell) {
  FlightMapOptions options;
  options.cell_m = 0.02;
  options.columns = 160;
  options.noise_m = 0.01;
  FlightMap expected(
      {kTable_m + Eigen::Vector3d(-0.5, -0.5, 0.03), kTable_m + Eigen::Vector3d(0.5, 0.5, 0.5)},
      options);
  const Pose T_world_camera = camera_at(0.0);
  expected.insert(draw({{kTarget, kScreen}}, T_world_camera, 0.002).images, T_world_camera);
  EXPECT_EQ(map_after({0.0}).grid().log_odds, expected.grid().log_odds);
}

/// Nothing stands on it, and what was not seen is more than a quarter of a metre away.
TEST(TableMap, OverAFreeTableFlightsAreClear) {
  TableMapOptions options;
  options.height_m = 0.3;
  options.clearance_m = 0.2;
  TableMap map(kTable_m, options);
  for (const double bearing_rad : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
    const Pose T_world_camera = camera_at(bearing_rad);
    map.insert(draw({}, T_world_camera, 0.002).images, T_world_camera);
  }
  const std::vector<Eigen::Vector3d> over{kTable_m + Eigen::Vector3d(-0.02, 0.0, 0.27),
                                          kTable_m + Eigen::Vector3d(0.02, 0.0, 0.27)};
  EXPECT_TRUE(map.is_clear(over));
}

TEST(TableMap, RefusesOptionsThatAreOutOfRange) {
  TableMapOptions options;
  options.margin_m = 0.25;
  EXPECT_THROW(TableMap(kTable_m, options), ConfigError);
}

/// Free cells let all pass, what stands there nothing, and the rest what its hazard leaves.
TEST(TableMap, AViewSeesWhatItsCellsLetPass) {
  TableMapOptions options;
  options.margin_m = 0.05;
  const TableMap map = map_after({0.0}, options);
  const GridFrame& frame = map.grid().frame;
  const Pose T_world_camera = camera_at(0.0);
  const CameraImages images = draw({{kTarget, kScreen}}, T_world_camera, 0.002).images;
  const PosedImage posed{images, T_world_camera};
  ClutterHazard hazard(options.hazard, frame.cells);
  hazard.observe(OccupancyGrid(frame), std::span(&posed, 1), 2, frame.min_corner_m.z());
  const BlockField left = hazard.transmission();
  std::vector<float> passes;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    passes.push_back(map.grid().state(i) == CellState::free ? 1.0F : 0.0F);
    if (map.grid().state(i) != CellState::unobserved) continue;
    passes.back() = static_cast<float>(left.at_cell(frame.cell(i)));
  }
  const Eigen::Vector2d middle = kTable_m.head<2>();
  const std::vector<std::uint8_t> over =
      map.cells_over({middle - Eigen::Vector2d(0.04, 0.04), middle + Eigen::Vector2d(0.04, -0.04),
                      middle + Eigen::Vector2d(0.04, 0.04), middle + Eigen::Vector2d(-0.04, 0.04)},
                     0.1);
  for (const double bearing_rad : {0.2, 1.2, 2.9}) {
    const Eigen::Vector3d from_m = eye(bearing_rad);
    EXPECT_NEAR(map.visible_share(kShape, {}, from_m),
                vantage::visible_share(frame, passes, kShape, {}, from_m, 0.05), 1e-6);
    EXPECT_NEAR(map.visible_share(kShape, over, from_m),
                vantage::visible_share(frame, passes, kShape, over, from_m, 0.05), 1e-6);
  }
}

/// Past a corner of a table that was not seen, by distances to that corner: 0.35 m is clear.
TEST(TableMap, OnePlaceThatIsTooNearIsEnough) {
  const TableMap map = map_after({});
  const Eigen::Vector3d corner_m = map.grid().frame.box().max() - Eigen::Vector3d(0.0, 0.0, 0.2);
  const Eigen::Vector3d off = Eigen::Vector3d(1.0, 1.0, 0.0).normalized();
  const Eigen::Vector3d past = Eigen::Vector3d(1.0, -1.0, 0.0).normalized();
  const auto is_clear = [&](const std::vector<Eigen::Vector3d>& way_m) {
    return map.is_clear(way_m);
  };
  EXPECT_TRUE(is_clear({corner_m + 0.355 * off}));
  EXPECT_FALSE(is_clear({corner_m + 0.345 * off}));
  EXPECT_FALSE(is_clear({corner_m - 0.4 * off})) << "amid what was not seen";
  EXPECT_TRUE(is_clear({corner_m + 1.0 * off, corner_m + 0.355 * off}));
  EXPECT_FALSE(is_clear({corner_m + 1.0 * off, corner_m + 0.345 * off}));
  // Too near for 5 cm of it alone.
  const auto passing = [&](double off_m) {
    return std::vector<Eigen::Vector3d>{corner_m + off_m * off - 0.329 * past,
                                        corner_m + off_m * off + 0.27 * past};
  };
  EXPECT_TRUE(is_clear(passing(0.3505)));
  EXPECT_FALSE(is_clear(passing(0.3491)));
}

/// Cells 1 and 2 come to be occupied, 6 is so, free, and occupied again.
TEST(TableMapLog, KeepsEachCellInItsPlace) {
  const support::TemporaryDirectory folder;
  TableMapLog log;
  log.commit(folder.path());
  EXPECT_TRUE(folder.is_empty()) << "there was no map";
  OccupancyGrid grid(make_grid_frame({1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}, {4, 2, 1}));
  grid.log_odds = {0.0F, 2.0F, -2.0F, 0.0F, 0.0F, 0.0F, 2.0F, 0.0F};
  EXPECT_EQ(log.change(grid, 0).runs.size(), 3U);
  grid.log_odds[2] = 2.0F;
  grid.log_odds[6] = -2.0F;
  EXPECT_EQ(log.change(grid, 3).runs.size(), 2U);
  grid.log_odds[6] = 2.0F;
  grid.log_odds[7] = -2.0F;
  const MapChange last = log.change(grid, 5);
  ASSERT_EQ(last.runs.size(), 2U);
  EXPECT_EQ(last.runs[0].first, 6U);
  EXPECT_EQ(last.runs[0].state, CellState::occupied);
  EXPECT_EQ(last.runs[1].state, CellState::free);
  log.commit(folder.path());
  const VoxelMap map = read_voxels(folder / "voxels.bin");
  EXPECT_EQ(map.cell_size_m, Eigen::Vector3d(0.25, 0.5, 1.0));
  const std::vector<std::uint8_t> kinds{1, 0, 0, 1, 1, 1, 0};  // cell 7 is free
  const std::vector<std::uint16_t> since{0, 0, 3, 0, 0, 0, 5};
  ASSERT_EQ(map.voxels.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    const VoxelRecord& voxel = map.voxels[i];
    EXPECT_EQ(voxel.kind, kinds[i]) << i;
    EXPECT_EQ(voxel.step, since[i]) << i;
    EXPECT_EQ(voxel.x, 0.625F + 0.25F * static_cast<float>(i % 4)) << i;
    EXPECT_EQ(voxel.y, i < 4 ? 1.75F : 2.25F) << i;
    EXPECT_EQ(voxel.z, 3.0F) << i;
  }
}

}  // namespace
}  // namespace vantage
