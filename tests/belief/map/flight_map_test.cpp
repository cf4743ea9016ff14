// Maps of rooms of boxes, from depth images drawn ray by ray.
#include "vantage/belief/map/flight_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace vantage
