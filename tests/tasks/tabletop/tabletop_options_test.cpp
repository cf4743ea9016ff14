// Which options of a table top go together, and how its map follows a table.
#include <gmock/gmock.h>

#include "vantage/tasks/tabletop/table_region.hpp"
#include "vantage/tasks/tabletop/tabletop.hpp"
#include "vantage/tasks/tabletop/view_check.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string complaint(const Tabletop& task, const EpisodeOptions& episode = {}) {
  try {
    task.check_with(episode);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(TabletopOptions, ScanALinePerTick) {
  Tabletop task;
  EXPECT_EQ(complaint(task), "");
  task.laser.line_rate_hz = 20.0;
  EXPECT_THAT(complaint(task), HasSubstr("laser.line_rate_hz: 20 must be 1 / "
                                         "simulation.control_period_s = 40: a line per tick"));
  EpisodeOptions slow;
  slow.simulation.control_period_s = 0.05;
  EXPECT_EQ(complaint(task, slow), "");
}

TEST(TabletopOptions, StartAtAPositionOfTheRing) {
  EpisodeOptions episode;
  episode.robot.start_view = 9;
  EXPECT_EQ(complaint({}, episode), "");
  episode.robot.start_view = 10;
  EXPECT_THAT(complaint({}, episode),
              HasSubstr("robot.start_view: 10 is not below candidates.positions = 10"));
}

TEST(TabletopOptions, BoundTheCellsOfAllViews) {
  Tabletop task;
  task.map.centre_m = MapOptions::kCentre_m;
  task.map.cells = {512, 512, 256};
  task.candidates.yaw_offsets_rad = {0.0, 0.1};
  task.candidates.positions = 16;
  EXPECT_NO_THROW(task.resolve({}));
  task.candidates.positions = 17;
  EXPECT_THAT([&] { task.resolve({}); },
              testing::ThrowsMessage<ConfigError>(HasSubstr("times 34 views")));
}

TEST(TabletopOptions, FindATableAsTheySay) {
  TableOptions options;
  options.min_height_m = 0.3;
  options.max_height_m = 1.5;
  options.max_tilt_rad = 0.07;
  options.min_area_m2 = 0.11;
  const LevelSurfaceOptions wanted = table_surfaces(options);
  EXPECT_EQ(wanted.min_height_m, 0.3);
  EXPECT_EQ(wanted.max_height_m, 1.5);
  EXPECT_EQ(wanted.max_tilt_rad, 0.07);
  EXPECT_EQ(wanted.min_area_m2, 0.11);
}

/// 516 x 387 x 65 cells of 7.75 mm are three times too many.
TEST(TableRegion, HasCoarserCellsOverALargeTable) {
  const LevelSurface large{
      {Eigen::Vector2d(-1.5, -1.0), Eigen::Vector2d(2.5, 2.0)}, 0.7, 12.0, "t"};
  MapOptions map;
  follow_table(map, large);
  EXPECT_THAT(*map.centre_m, ElementsAre(0.5, 0.5, 0.962));
  EXPECT_THAT(*map.size_m, ElementsAre(4.0, 3.0, 0.504));
  EXPECT_THAT(*map.cells, ElementsAre(354, 266, 45));
}

TEST(TableRegion, IsInWholeMillimetres) {
  const LevelSurface table{
      {Eigen::Vector2d(-0.5004, -0.5), Eigen::Vector2d(0.5, 0.7003)}, 0.7204, 1.2, "t"};
  MapOptions map;
  follow_table(map, table);
  EXPECT_THAT(*map.centre_m, ElementsAre(testing::DoubleNear(0.0, 1e-12), 0.1, 0.982));
  EXPECT_THAT(*map.size_m, ElementsAre(1.0, 1.2, 0.504));
}

Tabletop task_with_region() {
  Tabletop task;
  task.map.centre_m = {1.0, 2.0, 1.0};
  task.map.size_m = {0.6, 0.8, 0.5};
  task.navigation.footprint_radius_m = 0.483;
  return task;
}

TEST(RegionText, SaysWhereTheMapIs) {
  EXPECT_EQ(region_text(task_with_region()),
            "map.centre_m, map.size_m: x 0.7 to 1.3, y 1.6 to 2.4, z 0.750 to 1.250");
}

/// Half a metre to the corner, and the robot: 0.983, in whole centimetres.
TEST(ClearRadius, ClearsTheCornersOfTheMap) {
  EXPECT_NEAR(clear_radius_m(task_with_region()), 0.99, 1e-12);
}

}  // namespace
}  // namespace vantage
