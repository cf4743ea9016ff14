#include "vantage/planners/exact_gain.hpp"

#include <gtest/gtest.h>

#include "vantage/core/rng.hpp"
#include "vantage/planners/views/view_candidates.hpp"

namespace vantage {
namespace {

OccupancyGrid small_cluttered_grid() {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.2}, {1.0, 1.0, 0.5}, {15, 16, 7}));
  Rng rng(5);
  for (float& cell : grid.log_odds) {
    const double draw = rng.uniform();
    cell = draw < 0.5 ? 0.0F : (draw < 0.95 ? -2.5F : 4.0F);
  }
  return grid;
}

RingOfViews low_ring() { return {.positions = 5, .radius_m = 1.0, .height_m = 0.4}; }

FieldOfView wide_sector() {
  FieldOfView fov;
  fov.half_width_rad = 0.4;
  return fov;
}

TEST(ExactGains, AreTheSameBitsForEveryNumberOfThreads) {
  const OccupancyGrid grid = small_cluttered_grid();
  const BlockField even = uniform_field(grid.frame.cells, 0.9);
  const auto views = ring_of_views(low_ring(), Eigen::Vector3d::Zero());
  for (const auto name : strategy_names<Gain>()) {
    const Gain gain = make_strategy<Gain>(name);
    const auto one = exact_gains_bits(gain, {grid, &even}, views, wide_sector(), 1);
    EXPECT_EQ(exact_gains_bits(gain, {grid, &even}, views, wide_sector(), 3), one) << name;
    EXPECT_EQ(exact_gains_bits(gain, {grid, &even}, views, wide_sector(), 64), one) << name;
    EXPECT_EQ(exact_gain_bits(gain, {grid, &even}, views[4].T_world_sensor, wide_sector()), one[4]);
  }
}

// The definition, cell by cell, without culling and with the walk of src/geometry.
TEST(ExactGain, OfTheSimpleKindCountsCellsInLineOfSight) {
  const OccupancyGrid grid = small_cluttered_grid();
  for (const Candidate& view : ring_of_views(low_ring(), Eigen::Vector3d(0.013, 0.007, 0.0))) {
    const Eigen::Vector3d p_sensor = view.T_world_sensor.translation();
    double expected = 0.0;
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const Eigen::Vector3d centre = grid.frame.centre(grid.frame.cell(cell));
      if (grid.state(cell) != CellState::unobserved) continue;
      if (!wide_sector().contains(view.T_world_sensor.inverse() * centre)) continue;
      const auto not_occupied = [&](std::size_t c) { return grid.state(c) != CellState::occupied; };
      expected += walk_ray(grid.frame, p_sensor, centre, not_occupied) ? 1.0 : 0.0;
    }
    EXPECT_GT(expected, 0.0);
    EXPECT_DOUBLE_EQ(exact_gain_bits(SimpleGain{}, {grid}, view.T_world_sensor, wide_sector()),
                     expected);
  }
}

/// Says that every other cell counts, though all would be worth the same.
struct EveryOtherCell {
  static constexpr bool unobserved_only = false;
  using Ray = AttenuatedRay;
  [[nodiscard]] CellTables prepare(const GainContext& context) const {
    CellTables tables;
    tables.transmission.assign(context.grid.size(), 1.0F);
    tables.utility.assign(context.grid.size(), 1.0F);
    return tables;
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return Ray(tables); }
  [[nodiscard]] bool counts(const CellTables& /*tables*/, std::size_t cell) const {
    return cell % 2 == 0;
  }
};

TEST(ExactGain, SparesTheRaysToCellsThatDoNotCount) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {5, 4, 3}));
  const FieldOfView ahead{.half_width_rad = 0.5, .tilt_min_rad = -0.5, .tilt_max_rad = 0.5};
  Candidate view;
  view.T_world_sensor = make_pose({-3.0, 0.0, 0.0}, 0.0);
  EXPECT_EQ(exact_gains_bits(EveryOtherCell{}, {grid}, {&view, 1}, ahead, 1).front(), 30.0);
}

/// After each view, and once in 16 384 rays.
TEST(ExactGains, AskNowAndThenWhetherToGoOn) {
  const OccupancyGrid small = small_cluttered_grid();
  const OccupancyGrid large(make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {30, 30, 30}));
  const FieldOfView ahead{.half_width_rad = 0.5, .tilt_min_rad = -0.5, .tilt_max_rad = 0.5};
  const auto views = ring_of_views(low_ring(), Eigen::Vector3d::Zero());
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  exact_gains_bits(SimpleGain{}, {small}, views, wide_sector(), 1);
  EXPECT_EQ(asked, 15);
  asked = 0;
  EXPECT_EQ(exact_gain_bits(SimpleGain{}, {large}, make_pose({-3.0, 0.0, 0.0}, 0.0), ahead),
            27000.0);
  EXPECT_EQ(asked, 1 + 1);
  const OccupancyGrid one_less(make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.0, 0.3}, {127, 43, 3}));
  asked = 0;
  EXPECT_EQ(exact_gain_bits(SimpleGain{}, {one_less}, make_pose({-3.0, 0.0, 0.0}, 0.0), ahead),
            16383.0);
  EXPECT_EQ(asked, 1);
}

TEST(ExactGain, OfAViewAwayFromTheMapIsZero) {
  const OccupancyGrid grid = small_cluttered_grid();
  const Pose away = make_pose({2.0, 0.0, 0.4}, 0.0);
  EXPECT_EQ(exact_gain_bits(SimpleGain{}, {grid}, away, wide_sector()), 0.0);
}

TEST(ExactGains, OfNoCandidatesAreNone) {
  const OccupancyGrid grid = small_cluttered_grid();
  EXPECT_TRUE(exact_gains_bits(SimpleGain{}, {grid}, {}, wide_sector(), 2).empty());
}

}  // namespace
}  // namespace vantage
