#include "vantage/planners/prediction_bands.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/view_cone.hpp"
#include "vantage/planners/swept_gain.hpp"

namespace vantage {
namespace {

GridFrame room() { return make_grid_frame({0.0, 0.0, 1.0}, {6.0, 5.0, 2.0}, {60, 50, 20}); }

FieldOfView all_round_within(double range_m) {
  return {.tilt_min_rad = -0.6,
          .tilt_max_rad = 0.8,
          .range_min_m = 0.0,
          .range_max_m = range_m,
          .panorama = true};
}

OccupancyGrid cluttered(Rng& rng) {
  OccupancyGrid grid(room());
  for (float& log_odds : grid.log_odds) {
    const double u = rng.uniform();
    if (u < 0.02) log_odds = 2.0F;
    if (u > 0.7) log_odds = -2.0F;
  }
  return grid;
}

TEST(PredictionBands, AddUpToTheGainOfTheView) {
  Rng rng(3);
  const OccupancyGrid grid = cluttered(rng);
  const Attenuation attenuation{.transmission = uniform_field(grid.frame.cells, 0.97)};
  const Pose T_world_sensor = make_pose({0.3, -0.2, 1.1}, 0.4);
  const FieldOfView field = all_round_within(2.2);
  const auto bands = predict_by_distance(attenuation, grid, T_world_sensor, field, 0.5, 2);
  Candidate view;
  view.T_world_sensor = T_world_sensor;
  const double all = swept_gains_bits(attenuation, grid, {&view, 1}, field, 1, kNoRays).front();
  double sum = 0.0;
  for (const PredictionBand& band : bands) {
    sum += band.predicted_cells;
    EXPECT_EQ(band.actual_cells, 0U);
    EXPECT_EQ(band.outside_cells, 0U);
  }
  EXPECT_NEAR(sum, all, 1e-6 * all);
  ASSERT_EQ(bands.size(), 4U);  // 0.5 three times, then what is left: 0.7
  EXPECT_DOUBLE_EQ(bands[3].from_m, 1.5);
  EXPECT_DOUBLE_EQ(bands[3].to_m, 2.2);
}

/// Cell by cell, of one sweep: what is looked at and what is not add up to all of it, band by band.
TEST(PredictionBands, OfWhatIsInSightAreTheirPart) {
  Rng rng(3);
  const OccupancyGrid grid = cluttered(rng);
  const Attenuation attenuation{.transmission = uniform_field(grid.frame.cells, 0.97)};
  const Pose T_world_sensor = make_pose({0.3, -0.2, 1.1}, 0.4);
  const auto bands_of = [&](const InSight& in_sight) {
    return predict_by_distance(attenuation, grid, T_world_sensor, all_round_within(2.2), 0.5, 2,
                               in_sight);
  };
  const auto left = [](const Eigen::Vector3d& p) { return p.y() > 0.3; };
  const auto whole = bands_of({});
  const auto in_sight = bands_of(left);
  const auto rest = bands_of([&](const Eigen::Vector3d& p) { return !left(p); });
  ASSERT_EQ(in_sight.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(in_sight[i].from_m, whole[i].from_m);
    EXPECT_EQ(in_sight[i].to_m, whole[i].to_m);
    EXPECT_GT(in_sight[i].predicted_cells, 0.1 * whole[i].predicted_cells);
    EXPECT_LT(in_sight[i].predicted_cells, 0.6 * whole[i].predicted_cells);
    EXPECT_EQ(in_sight[i].actual_cells, 0U);
    EXPECT_EQ(in_sight[i].outside_cells, 0U);
    EXPECT_NEAR(in_sight[i].predicted_cells + rest[i].predicted_cells, whole[i].predicted_cells,
                1e-3 * whole[i].predicted_cells + 1.0);
  }
}

TEST(PredictionBands, NewCellsOutOfSightAreOutside) {
  const OccupancyGrid before(room());
  OccupancyGrid after = before;
  for (const double y_m : {-0.45, 0.35, 0.45}) {
    after.log_odds[after.frame.index(after.frame.cell_at({0.05, y_m, 1.05}))] = 1.0F;
  }
  std::vector<PredictionBand> bands{{0.0, 1.0, 0.0, 0, 0}};
  // The sensor looks along the world's y axis: that is ahead.
  count_new_cells(before, after, make_pose({0.0, 0.0, 1.0}, std::numbers::pi / 2.0),
                  all_round_within(1.0), bands,
                  [](const Eigen::Vector3d& p) { return p.x() > 0.0; });
  EXPECT_EQ(bands[0].actual_cells, 3U);
  EXPECT_EQ(bands[0].outside_cells, 1U);
}

/// Nothing in the way: every unobserved cell of a band is seen.
TEST(PredictionBands, OfAnEmptyRoomAreItsCells) {
  const OccupancyGrid grid(room());
  const Attenuation attenuation{.transmission = uniform_field(grid.frame.cells, 1.0)};
  const Pose T_world_sensor = make_pose({0.02, 0.01, 1.03}, 0.0);
  const FieldOfView field = all_round_within(2.0);
  auto bands = predict_by_distance(attenuation, grid, T_world_sensor, field, 1.0, 1);
  OccupancyGrid after = grid;
  for (float& log_odds : after.log_odds) log_odds = -1.0F;
  count_new_cells(grid, after, T_world_sensor, field, bands);
  ASSERT_EQ(bands.size(), 3U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto inside = bands[i].actual_cells - bands[i].outside_cells;
    EXPECT_NEAR(bands[i].predicted_cells, static_cast<double>(inside),
                0.002 * bands[i].predicted_cells + 2.0);
  }
  EXPECT_EQ(bands[2].to_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(bands[2].outside_cells, bands[2].actual_cells);
  EXPECT_EQ(bands[0].actual_cells + bands[1].actual_cells + bands[2].actual_cells, grid.size());
}

TEST(PredictionBands, CountOnlyWhatIsNew) {
  OccupancyGrid before(room());
  OccupancyGrid after = before;
  const Pose T_world_sensor = make_pose({0.0, 0.0, 1.0}, 0.0);
  std::vector<PredictionBand> bands{{0.0, 1.0, 0.0, 0, 0}, {1.0, 2.0, 0.0, 0, 0}};
  const auto know = [&](OccupancyGrid& grid, const Eigen::Vector3d& p) {
    grid.log_odds[grid.frame.index(grid.frame.cell_at(p))] = -1.0F;
  };
  know(before, {0.55, 0.05, 1.05});  // known before
  know(after, {0.55, 0.05, 1.05});
  know(after, {0.75, 0.05, 1.05});  // in the first band
  know(after, {1.55, 0.05, 1.05});  // in the second
  know(after, {2.55, 0.05, 1.05});  // beyond
  know(after, {0.05, 0.05, 1.95});  // above the field of view
  count_new_cells(before, after, T_world_sensor, all_round_within(2.0), bands);
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands[0].actual_cells, 2U);
  EXPECT_EQ(bands[0].outside_cells, 1U);
  EXPECT_EQ(bands[1].actual_cells, 1U);
  EXPECT_EQ(bands[2].actual_cells, 1U);
}

TEST(PredictionBands, EndWithTheRangeOrTheGridTheLastOneUpToHalfWiderOrNarrower) {
  const OccupancyGrid grid(room());
  const Attenuation attenuation{.transmission = uniform_field(grid.frame.cells, 0.9)};
  const Pose T_world_sensor = make_pose({0.3, -0.2, 1.1}, 0.4);
  const auto edges_m = [&](double range_m, double width_m) {
    std::vector<double> edges;
    const auto bands = predict_by_distance(attenuation, grid, T_world_sensor,
                                           all_round_within(range_m), width_m, 1);
    for (const PredictionBand& band : bands) edges.push_back(band.from_m);
    edges.push_back(bands.back().to_m);
    return edges;
  };
  EXPECT_EQ(edges_m(2.2, 0.5), (std::vector{0.0, 0.5, 1.0, 1.5, 2.2}));
  EXPECT_EQ(edges_m(2.3, 0.5), (std::vector{0.0, 0.5, 1.0, 1.5, 2.0, 2.3}));
  EXPECT_EQ(edges_m(0.375, 1.0), (std::vector{0.0, 0.375}));
  const std::vector<double> to_the_corner = edges_m(50.0, 2.0);
  ASSERT_EQ(to_the_corner.size(), 3U);
  EXPECT_EQ(to_the_corner[1], 2.0);
  EXPECT_NEAR(to_the_corner[2], std::sqrt(3.3 * 3.3 + 2.7 * 2.7 + 1.1 * 1.1), 1e-9);
}

/// The last band is wider than the others.
TEST(PredictionBands, NewCellsAreCountedWhereTheyAre) {
  const OccupancyGrid before(room());
  OccupancyGrid after = before;
  std::vector<PredictionBand> bands{
      {0.0, 0.5, 0.0, 0, 0}, {0.5, 1.0, 0.0, 0, 0}, {1.0, 1.7, 0.0, 0, 0}};
  for (const double x_m : {0.35, 0.45, 0.55, 1.25, 1.35, 1.55, 1.65, 1.75}) {
    after.log_odds[after.frame.index(after.frame.cell_at({x_m, 0.05, 1.05}))] = 1.0F;
  }
  count_new_cells(before, after, make_pose({0.0, 0.0, 1.0}, 0.0), all_round_within(1.7), bands);
  ASSERT_EQ(bands.size(), 4U);
  EXPECT_EQ(bands[0].actual_cells, 2U);
  EXPECT_EQ(bands[1].actual_cells, 1U);
  EXPECT_EQ(bands[2].actual_cells, 4U) << "1.65 m ahead is 1.652 m away";
  EXPECT_EQ(bands[3].actual_cells, 1U);
  EXPECT_EQ(bands[3].outside_cells, 1U);
  EXPECT_EQ(bands[2].outside_cells, 0U);
  EXPECT_EQ(bands[3].from_m, 1.7);
  EXPECT_EQ(bands[3].predicted_cells, 0.0);
  std::vector<PredictionBand> none;
  count_new_cells(before, after, make_pose({0.0, 0.0, 1.0}, 0.0), all_round_within(1.7), none);
  EXPECT_TRUE(none.empty());
}

/// Cells of 2^-3 m make all of it exact.
TEST(PredictionBands, ACellAtTheEndOfABandIsOfTheNextAndTheLastHasItsEnd) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {4.0, 4.0, 4.0}, {32, 32, 32}));
  const Attenuation attenuation{.transmission = uniform_field(grid.frame.cells, 1.0)};
  const Pose T_world_sensor = make_pose({0.0625, 0.0625, 0.0625}, 0.0);  // the middle of a cell
  const FieldOfView field = all_round_within(1.0);
  auto bands = predict_by_distance(attenuation, grid, T_world_sensor, field, 0.5, 1,
                                   [](const Eigen::Vector3d&) { return true; });
  ASSERT_EQ(bands.size(), 2U);
  const ViewCone cone(T_world_sensor, field);
  std::array<double, 2> seen{};
  std::array<std::size_t, 2> there{};
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const Eigen::Vector3d p_m = grid.frame.centre(grid.frame.cell(cell));
    const double away_m = (p_m - T_world_sensor.translation()).norm();
    if (away_m > 1.0) continue;
    const std::size_t band = away_m < 0.5 ? 0 : 1;
    ++there[band];
    seen[band] += cone.contains(p_m) ? 1.0 : 0.0;
  }
  OccupancyGrid after = grid;
  for (float& log_odds : after.log_odds) log_odds = -1.0F;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(bands[i].predicted_cells, seen[i], 1.0) << i;
  count_new_cells(grid, after, T_world_sensor, field, bands);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(bands[i].actual_cells, there[i]) << i;
}

}  // namespace
}  // namespace vantage
