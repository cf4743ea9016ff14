// Maps of rooms of boxes, from depth images drawn ray by ray.
#include "vantage/belief/map/flight_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/drawn_room.hpp"

namespace vantage {
namespace {

using Eigen::Vector3d;
using support::box_on;
using support::draw_room;
using support::drawn_camera;
using support::DrawnBox;

constexpr double kPitch_rad = 0.7853981633974483;
const Eigen::AlignedBox3d kRegion_m(Vector3d(-1.0, -3.0, 0.0), Vector3d(5.0, 3.0, 2.6));

/// Flies along x at 1.75 m and looks ahead.
FlightMap flown(const std::vector<DrawnBox>& boxes, double to_m, bool noise = true) {
  FlightMap map(kRegion_m);
  for (double x_m = 0.0; x_m <= to_m + 1e-9; x_m += 0.25) {
    const Pose T_world_camera = drawn_camera({x_m, 0.0, 1.75}, 0.0, kPitch_rad);
    map.insert(draw_room(boxes, T_world_camera, noise, 320), T_world_camera);
  }
  return map;
}

CellState state_at(const FlightMap& map, const Vector3d& p_world_m) {
  return map.grid().state(map.grid().frame.index(map.grid().frame.cell_at(p_world_m)));
}

bool blocked_at(const FlightMap& map, const Vector3d& p_world_m) {
  return map.obstacles()[map.grid().frame.index(map.grid().frame.cell_at(p_world_m))] != 0;
}

TEST(FlightMap, KnowsNothingAtFirst) {
  const FlightMap map(kRegion_m);
  EXPECT_EQ(map.grid().count(CellState::unobserved), map.grid().size());
  EXPECT_EQ(std::ranges::count(map.obstacles(), 1), 0);
  EXPECT_EQ(std::ranges::count(map.unseen_places(), 0), 0);
  EXPECT_EQ(map.grid().size(), 60U * 60U * 26U);
}

TEST(FlightMap, SurfacesAreOccupiedWhatWasSeenThroughIsFree) {
  const FlightMap map = flown({box_on(0.0, 1.5, 0.0, {0.5, 0.5, 0.78})}, 0.0);
  EXPECT_EQ(state_at(map, {1.5, 0.0, 0.75}), CellState::occupied) << "top";
  EXPECT_EQ(state_at(map, {1.3, 0.0, 1.05}), CellState::free) << "over it";
  EXPECT_EQ(state_at(map, {1.65, 0.0, 0.45}), CellState::unobserved) << "inside";
  EXPECT_EQ(state_at(map, {1.0, 1.4, 0.05}), CellState::unobserved) << "out of the frame";
  EXPECT_EQ(state_at(map, {1.0, 0.4, 0.05}), CellState::occupied) << "floor";
  EXPECT_EQ(state_at(map, {3.0, 0.0, 1.75}), CellState::unobserved) << "above the frame";
}

TEST(FlightMap, AColumnGoesOnAboveWhatWasSeenOfItAStandDoesNot) {
  const DrawnBox column = box_on(0.0, 2.0, 0.4, {0.25, 0.25, 2.5});
  const DrawnBox support_surface = box_on(0.0, 2.0, -0.5, {0.5, 0.5, 0.78});
  const FlightMap map = flown({column, support_surface}, 1.0);
  EXPECT_EQ(state_at(map, {1.85, 0.4, 1.75}), CellState::unobserved);
  EXPECT_TRUE(blocked_at(map, {1.85, 0.4, 1.75}));
  EXPECT_TRUE(blocked_at(map, {1.85, 0.4, 2.45}));
  EXPECT_TRUE(blocked_at(map, {2.0, -0.5, 0.75}));
  EXPECT_FALSE(blocked_at(map, {2.0, -0.5, 1.75}));
  EXPECT_FALSE(blocked_at(map, {1.85, -0.5, 1.75}));
}

/// Columns of cells side by side, an odd number, seen level from 10 m away. Of each cell, from the
/// floor up: '#' a surface, '.' nothing up to the range, '?' no reading. Of the middle one 'x' is
/// blocked.
std::string blocked_of_middle(const std::vector<std::string>& columns, float beside_m = 10.15F,
                              double rise_m = 0.3) {
  const auto count = static_cast<int>(columns.size());
  CameraImages image;
  image.width_px = 64;
  image.height_px = 120;
  image.focal_px = 1000.0;
  image.range_max_m = 20.0;
  for (int i = 0; i < image.width_px * image.height_px; ++i) {
    const Vector3d ray = image.ray(i / image.width_px, i % image.width_px);
    const auto side = static_cast<int>(std::floor(0.5 * count - 101.5 * ray.x()));
    const auto z = static_cast<int>(std::floor(5.0 - 101.5 * ray.y()));
    const bool inside = side >= 0 && side < count && z >= 0 && z < 10;
    const char seen =
        inside ? columns[static_cast<std::size_t>(side)][static_cast<std::size_t>(z)] : '?';
    const float surface_m = side == count / 2 ? 10.15F : beside_m;
    image.depth_m.push_back(seen == '#'   ? surface_m
                            : seen == '.' ? std::numeric_limits<float>::infinity()
                                          : 0.0F);
  }
  const Eigen::AlignedBox3d region_m(Vector3d(0.0, -count / 20.0, 0.0),
                                     Vector3d(0.3, count / 20.0, 1.0));
  FlightMap map(region_m, {.rise_m = rise_m});
  map.insert(image, drawn_camera({-10.0, 0.0, 0.5}, 0.0, 0.0));
  std::string drawn;
  for (int z = 0; z < 10; ++z) drawn += blocked_at(map, {0.15, 0.0, 0.1 * z + 0.05}) ? 'x' : '.';
  return drawn;
}

TEST(FlightMap, WhatRisesHighEnoughGoesOnUnlessItIsSeenToEnd) {
  const std::string nothing(10, '?');
  const auto alone = [&](const std::string& column) {
    return blocked_of_middle({nothing, column, nothing});
  };
  EXPECT_EQ(alone("#####?????"), "xxxxxxxxxx");
  EXPECT_EQ(alone("###???????"), "xxxxxxxxxx");
  EXPECT_EQ(alone("##????????"), "xx........") << "lower than 0.3 m";
  EXPECT_EQ(alone("#####.????"), "xxxxx.....");
  for (const float beside_m : {10.05F, 10.15F, 10.25F}) {
    const std::string ends = "#####.....";
    EXPECT_EQ(blocked_of_middle({nothing, "#####?????", ends}, beside_m), "xxxxx.....");
    EXPECT_EQ(blocked_of_middle({ends, "#####?????", nothing}, beside_m), "xxxxx.....");
  }
  for (const std::string elsewhere : {"####......", "######...."}) {
    EXPECT_EQ(blocked_of_middle({nothing, "#####?????", elsewhere}), "xxxxxxxxxx");
  }
  EXPECT_EQ(blocked_of_middle({nothing, "??#???????", nothing}, 10.15F, 0.0), "..xxxxxxxx");
}

TEST(FlightMap, PlacesAreUnseenWhereNothingIsKnownAtAnyHeight) {
  const FlightMap map = flown({box_on(0.0, 1.5, 0.0, {0.5, 0.5, 0.78})}, 0.0);
  const GridFrame& frame = map.grid().frame;
  const std::vector<std::uint8_t> unseen = map.unseen_places();
  ASSERT_EQ(unseen.size(), map.grid().size());
  for (int y = 0; y < frame.cells.y(); ++y) {
    for (int x = 0; x < frame.cells.x(); ++x) {
      bool known = false;
      for (int z = 0; z < frame.cells.z(); ++z) {
        known = known || map.grid().state(frame.index({x, y, z})) != CellState::unobserved;
      }
      for (int z = 0; z < frame.cells.z(); ++z) {
        ASSERT_EQ(unseen[frame.index({x, y, z})], known ? 0 : 1) << x << " " << y << " " << z;
      }
    }
  }
  EXPECT_EQ(unseen[frame.index(frame.cell_at({1.05, 0.45, 2.55}))], 0) << "above the floor seen";
  EXPECT_EQ(unseen[frame.index(frame.cell_at({-0.45, 0.05, 0.05}))], 1) << "behind the camera";
}

TEST(FlightMap, IsPreciseInNoise) {
  const std::vector<DrawnBox> room{box_on(0.0, 1.5, 0.3, {0.5, 0.5, 0.78}),
                                   box_on(0.0, 4.0, 0.0, {0.2, 6.0, 2.5})};
  const FlightMap map = flown(room, 2.0);
  const FlightMap exact = flown(room, 2.0, false);
  const GridFrame& frame = map.grid().frame;
  int occupied = 0;
  int near_truth = 0;
  for (std::size_t cell = 0; cell < map.grid().size(); ++cell) {
    if (map.grid().state(cell) != CellState::occupied) continue;
    ++occupied;
    bool near = false;
    const Eigen::Array3i at = frame.cell(cell);
    for (int k = 0; k < 27 && !near; ++k) {
      const Eigen::Array3i next = at + Eigen::Array3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      near = frame.contains(next) && exact.grid().state(frame.index(next)) == CellState::occupied;
    }
    near_truth += near ? 1 : 0;
  }
  EXPECT_GT(occupied, 400);
  EXPECT_GT(near_truth, 0.995 * occupied);
}

TEST(FlightMap, ImagesOfNothingChangeNothing) {
  FlightMap map(kRegion_m);
  const Pose up = drawn_camera({0.0, 0.0, 1.75}, 0.0, -1.0);
  map.insert(draw_room({}, up, true, 320), up);
  EXPECT_EQ(map.grid().count(CellState::unobserved), map.grid().size());
}

TEST(FlightMap, RejectsOptionsOutOfRange) {
  EXPECT_THROW(FlightMap(kRegion_m, {.cell_m = 0.0}), ConfigError);
  const Eigen::AlignedBox3d huge(Vector3d::Zero(), Vector3d::Constant(1000.0));
  EXPECT_THROW(FlightMap(huge, {.cell_m = 0.1}), ConfigError);
}

/// Cells marked by a square image, one pixel of which has a reading.
std::size_t marked_by(int side_px, int row, int column) {
  CameraImages image;
  image.width_px = side_px;
  image.height_px = side_px;
  image.focal_px = 100.0;
  image.range_max_m = 20.0;
  image.depth_m.assign(static_cast<std::size_t>(side_px * side_px), 0.0F);
  image.depth_m[static_cast<std::size_t>(row * side_px + column)] = 2.05F;
  FlightMap map({Vector3d(0.0, -1.0, 0.0), Vector3d(3.0, 1.0, 1.0)}, {.columns = 8});
  map.insert(image, drawn_camera({-0.5, 0.0, 0.5}, 0.0, 0.0));
  return map.grid().count(CellState::occupied);
}

TEST(FlightMap, EveryNthColumnAndRowIsMarkedFromTheMiddleOfTheFirstOnes) {
  for (const int row : {1, 15}) {
    for (const int column : {1, 15}) EXPECT_EQ(marked_by(16, row, column), 1U);
  }
  EXPECT_EQ(marked_by(16, 0, 1), 0U);
  EXPECT_EQ(marked_by(16, 1, 2), 0U);
  EXPECT_EQ(marked_by(8, 0, 0), 1U) << "no wider than the columns: all of them";
  EXPECT_EQ(marked_by(8, 7, 7), 1U);
}

TEST(FlightMap, HasACellAtLeastAndTwoToThe26AtMost) {
  const FlightMap flat({Vector3d::Zero(), Vector3d(1.0, 1.0, 0.0)});
  EXPECT_EQ(flat.grid().frame.cells.z(), 1);
  const FlightMap thin({Vector3d::Zero(), Vector3d(1.0, 1.0, 0.05)});
  EXPECT_EQ(thin.grid().frame.cells.z(), 1);
  EXPECT_THROW(FlightMap({Vector3d::Zero(), Vector3d(4096.0, 4096.0, 5.0)}, {.cell_m = 1.0}),
               ConfigError);
}

/// Of what is straight ahead.
CameraImages one_pixel(float depth_m) {
  CameraImages image;
  image.width_px = 1;
  image.height_px = 1;
  image.focal_px = 100.0;
  image.range_max_m = 20.0;
  image.depth_m = {depth_m};
  return image;
}

TEST(FlightMap, AReadingSpeaksForItsOwnCellAlone) {
  const CameraImages image = one_pixel(2.05F);
  FlightMap map({Vector3d(0.0, -1.0, 0.0), Vector3d(3.0, 1.0, 1.0)});
  map.insert(image, drawn_camera({-0.5, 0.05, 0.55}, 0.0, 0.0));
  EXPECT_EQ(state_at(map, {1.55, 0.05, 0.55}), CellState::occupied);
  const auto raised = [](float log_odds) { return log_odds > 0.0F; };
  EXPECT_EQ(std::ranges::count_if(map.grid().log_odds, raised), 1);
}

/// Of a camera within the region.
TEST(FlightMap, AReadingOfNothingMarksNothingOneOfHalfAMetreDoes) {
  FlightMap map({Vector3d(0.0, -1.0, 0.0), Vector3d(3.0, 1.0, 1.0)});
  map.insert(one_pixel(0.0F), drawn_camera({0.5, 0.05, 0.55}, 0.0, 0.0));
  EXPECT_EQ(map.grid().count(CellState::occupied), 0U);
  map.insert(one_pixel(0.55F), drawn_camera({0.5, 0.05, 0.55}, 0.0, 0.0));
  EXPECT_EQ(state_at(map, {1.05, 0.05, 0.55}), CellState::occupied);
}

TEST(FlightMap, SaysHowManyCellsOfWhatSizeAreTooMany) {
  const Eigen::AlignedBox3d huge(Vector3d::Zero(), Vector3d::Constant(1024.0));
  try {
    const FlightMap map(huge, {.cell_m = 0.5});
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("map: 8589934592"), std::string::npos) << message;
    EXPECT_NE(message.find("cell_m = 0.5,"), std::string::npos) << message;
  }
}

/// Of a stand that is two columns away it says nothing.
TEST(FlightMap, WhatEndsTwoColumnsAwayEndsNothing) {
  const std::string nothing(10, '?');
  const std::string goes_on = "#####?????";
  const std::string ends = "#####.....";
  for (const float beside_m : {10.05F, 10.15F, 10.25F}) {
    EXPECT_EQ(blocked_of_middle({nothing, nothing, goes_on, nothing, ends}, beside_m),
              "xxxxxxxxxx");
    EXPECT_EQ(blocked_of_middle({ends, nothing, goes_on, nothing, nothing}, beside_m),
              "xxxxxxxxxx");
    EXPECT_EQ(blocked_of_middle({nothing, nothing, goes_on, ends, nothing}, beside_m),
              "xxxxx.....");
  }
}

/// 1.5 cm from the middle of a cell of 4 cm, whose next one has its middle 2.5 cm away.
TEST(FlightMap, AReadingOffTheMiddleOfItsCellCountsByTheNoise) {
  const CameraImages image = one_pixel(2.025F);
  for (const double noise_m : {0.03, 0.06}) {
    FlightMapOptions options;
    options.cell_m = 0.04;
    options.noise_m = noise_m;
    FlightMap map({Vector3d(0.0, -1.0, 0.0), Vector3d(3.0, 1.0, 1.0)}, options);
    map.insert(image, drawn_camera({-0.5, 0.02, 0.54}, 0.0, 0.0));
    const GridFrame& frame = map.grid().frame;
    const std::size_t cell = frame.index(frame.cell_at({1.525, 0.02, 0.54}));
    const double off = 0.015 / noise_m;
    EXPECT_NEAR(map.grid().p_occupied(cell), 0.5 + 0.3 * std::exp(-0.5 * off * off), 1e-3);
    const auto raised = [](float log_odds) { return log_odds > 0.0F; };
    EXPECT_EQ(std::ranges::count_if(map.grid().log_odds, raised), 1) << noise_m;
  }
}

TEST(FlightMap, MayHaveTwoToThe26Cells) {
  const FlightMap large({Vector3d::Zero(), Vector3d(4096.0, 4096.0, 4.0)}, {.cell_m = 1.0});
  EXPECT_EQ(large.grid().size(), std::size_t{1} << 26);
}

}  // namespace
}  // namespace vantage
