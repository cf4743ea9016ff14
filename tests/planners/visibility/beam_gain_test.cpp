#include "vantage/planners/visibility/beam_gain.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/planners/gains/gain_along.hpp"
#include "vantage/planners/exact_gain.hpp"

namespace vantage {
namespace {

TEST(BeamDirections, OfANarrowSectorAreOneBeamAhead) {
  const auto beams = beam_directions(straight_ahead(), {});
  ASSERT_EQ(beams.size(), 1U);
  EXPECT_TRUE(beams[0].isApprox(Eigen::Vector3d::UnitX()));
}

TEST(BeamDirections, AreTheMiddlesOfEqualParts) {
  const FieldOfView fov{.half_width_rad = 0.3, .tilt_min_rad = -0.1, .tilt_max_rad = 0.3};
  const auto beams = beam_directions(fov, {.step_rad = 0.2});
  ASSERT_EQ(beams.size(), 6U);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const BeamAngles expected{.azimuth_rad = -0.2 + 0.2 * static_cast<double>(i % 3),
                              .tilt_rad = i < 3 ? 0.0 : 0.2};
    EXPECT_TRUE(beams[i].isApprox(beam_direction(expected), 1e-12)) << "beam " << i;
  }
}

TEST(BeamDirections, OfAPlaneAreOneRow) {
  const FieldOfView fov{.half_width_rad = 0.3, .tilt_min_rad = 0.1, .tilt_max_rad = 0.1};
  const auto beams = beam_directions(fov, {.step_rad = 0.2});
  ASSERT_EQ(beams.size(), 3U);
  EXPECT_TRUE(beams[1].isApprox(beam_direction({.azimuth_rad = 0.0, .tilt_rad = 0.1}), 1e-12));
}

TEST(BeamDirections, OfAPanoramaLookDownAlikeAllRound) {
  const FieldOfView fov{
      .half_width_rad = 0.1, .tilt_min_rad = 0.1, .tilt_max_rad = 0.3, .panorama = true};
  const auto beams = beam_directions(fov, {.step_rad = 1.5});
  ASSERT_EQ(beams.size(), 5U);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double yaw_rad = 2.0 * std::numbers::pi / 5.0 * (static_cast<double>(i) - 2.0);
    const Eigen::Vector3d expected(std::cos(0.2) * std::cos(yaw_rad),
                                   std::cos(0.2) * std::sin(yaw_rad), -std::sin(0.2));
    EXPECT_TRUE(beams[i].isApprox(expected, 1e-12)) << "beam " << i;
  }
}

RC_GTEST_PROP(BeamDirections, LieInsideTheFieldOfView, ()) {
  FieldOfView fov;
  fov.half_width_rad = *rc::gen::inRange(1, 315) * 0.01;
  fov.tilt_min_rad = *rc::gen::inRange(-140, 100) * 0.01;
  fov.tilt_max_rad = fov.tilt_min_rad + *rc::gen::inRange(1, 40) * 0.01;
  for (const auto& beam : beam_directions(fov, {.step_rad = 0.1})) {
    RC_ASSERT(std::abs(beam.norm() - 1.0) < 1e-12);
    RC_ASSERT(fov.contains(beam));
  }
}

TEST(BeamDirections, OfAFullTurnGoEvenlyRoundWithoutADoubledBeam) {
  const FieldOfView fov{
      .half_width_rad = std::numbers::pi, .tilt_min_rad = -0.01, .tilt_max_rad = 0.01};
  const auto beams = beam_directions(fov, {.step_rad = 0.1});
  ASSERT_EQ(beams.size(), 63U);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double cosine = beams[i].dot(beams[(i + 1) % beams.size()]);
    EXPECT_NEAR(std::acos(cosine), 2.0 * std::numbers::pi / 63.0, 1e-9);
  }
}

/// A cube of unit cells, all unobserved, the sensor in the middle of it.
OccupancyGrid unknown_cube(int cells) {
  const double size_m = cells;
  return OccupancyGrid(
      make_grid_frame({0.0, 0.0, 0.0}, {size_m, size_m, size_m}, {cells, cells, cells}));
}

FieldOfView level_turn(double range_max_m) {
  return {.half_width_rad = std::numbers::pi,
          .tilt_min_rad = -0.001,
          .tilt_max_rad = 0.001,
          .range_min_m = 0.0,
          .range_max_m = range_max_m};
}

// Five beams from the middle, 72 degrees apart: 5 cells ahead, 7 on either side (6 faces), 8 on
// either side behind.
TEST(SumOverView, GoesAllRoundAndEndsAtTheEdgeOfTheMap) {
  UnobservedVoxelGain gain{.opacity_unobserved = 0.0};
  gain.fan.step_rad = 1.5;
  const OccupancyGrid grid = unknown_cube(9);
  const Pose pose = make_pose({0.1, 0.0, 0.0}, 0.0);
  EXPECT_DOUBLE_EQ(exact_gain_bits(gain, {grid}, pose, level_turn(10.0)), 35.0);
  EXPECT_DOUBLE_EQ(exact_gain_bits(gain, {grid}, pose, level_turn(1e6)), 35.0);
}

TEST(SumOverView, CountsCellsFromTheLeastToTheGreatestRange) {
  const Gain gain = UnobservedVoxelGain{.opacity_unobserved = 0.0};
  FieldOfView fov = straight_ahead();
  fov.range_min_m = 2.25;
  fov.range_max_m = 5.25;
  const OccupancyGrid row = row_of_cells("??????????");
  // From x = -0.5: 1.75 to 4.75, the cells 1 to 4.
  EXPECT_DOUBLE_EQ(exact_gain_bits(gain, {row}, make_pose({-0.5, 0.0, 0.0}, 0.0), fov), 4.0);
}

TEST(SumOverView, OfAFinerFanIsProportionalToTheNumberOfBeams) {
  const OccupancyGrid grid = unknown_cube(21);
  UnobservedVoxelGain coarse;
  coarse.fan.step_rad = 0.04;
  UnobservedVoxelGain fine;
  fine.fan.step_rad = 0.01;
  const FieldOfView fov{.half_width_rad = 0.4, .tilt_min_rad = -0.4, .tilt_max_rad = 0.4};
  const Pose pose = make_pose({-12.0, 0.0, 0.0}, 0.0);
  const double gain = exact_gain_bits(fine, {grid}, pose, fov);
  EXPECT_NEAR(16.0 * exact_gain_bits(coarse, {grid}, pose, fov), gain, 0.02 * gain);
}

}  // namespace
}  // namespace vantage
