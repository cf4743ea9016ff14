#include "vantage/planners/swept_gain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "vantage/core/rng.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/views/view_candidates.hpp"

namespace vantage {
namespace {

FieldOfView all_round(double tilt_rad = 1.4) {
  return {.half_width_rad = std::numbers::pi,
          .tilt_min_rad = -tilt_rad,
          .tilt_max_rad = tilt_rad,
          .range_min_m = 0.0,
          .range_max_m = 10.0};
}

FieldOfView sector() {
  return {.half_width_rad = 0.3, .tilt_min_rad = -0.4, .tilt_max_rad = 0.7, .range_max_m = 3.0};
}

OccupancyGrid unobserved_grid() {
  return OccupancyGrid(make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.2, 0.6}, {40, 30, 24}));
}

/// Boxes of occupied cells in space of which half is free.
OccupancyGrid cluttered_grid(std::uint64_t seed) {
  OccupancyGrid grid = unobserved_grid();
  const Eigen::Array3i n = grid.frame.cells;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.frame.cell(i).x() < n.x() / 2) grid.log_odds[i] = -2.0F;
  }
  Rng rng(seed);
  for (int box = 0; box < 12; ++box) {
    Eigen::Array3i from;
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = static_cast<int>(rng.uniform_index(static_cast<std::size_t>(n[axis] - 5)));
    }
    for (int k = 0; k < 125; ++k) {
      const Eigen::Array3i at = from + Eigen::Array3i(k % 5, k / 5 % 5, k / 25);
      grid.log_odds[grid.frame.index(at)] = 3.0F;
    }
  }
  return grid;
}

/// Blocks of very different transmission.
BlockField patchy_field(const Eigen::Array3i& cells) {
  BlockField field{.layout = {.cells = cells, .blocks = {5, 4, 3}}, .per_block = {}};
  Rng rng(7);
  while (field.per_block.size() < field.layout.size()) {
    field.per_block.push_back(rng.uniform(0.94, 1.0));
  }
  return field;
}

/// Free space, a wall with a window of a few cells, and nothing observed behind it.
OccupancyGrid walled_grid(Rng& rng) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {1.6, 1.2, 0.9}, {48, 36, 27}));
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(rng.uniform_index(static_cast<std::size_t>(high - low)));
  };
  const Eigen::Array3i wall(between(15, 21), 0, 0);
  const Eigen::Array3i from = wall + Eigen::Array3i(0, between(0, 36), between(0, 27));
  const Eigen::Array3i end = from + Eigen::Array3i(1, between(2, 8), between(2, 8));
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Array3i at = grid.frame.cell(i);
    const bool window = (at >= from).all() && (at < end).all();
    if (at.x() < wall.x()) grid.log_odds[i] = -2.0F;
    if (at.x() == wall.x() && !window) grid.log_odds[i] = 3.0F;
  }
  return grid;
}

/// Places in front of the wall, each with a view along one of the axes or nearly so.
std::vector<Candidate> views_of_wall(Rng& rng) {
  std::vector<Candidate> views;
  for (int place = 0; place < 8; ++place) {
    const Eigen::Vector3d p_m(rng.uniform(-0.78, -0.32), rng.uniform(-0.5, 0.5),
                              rng.uniform(-0.4, 0.4));
    const auto quarter = static_cast<double>(rng.uniform_index(4));
    Candidate view;
    view.T_world_sensor =
        make_pose(p_m, quarter * std::numbers::pi / 2.0 + rng.uniform(-0.25, 0.25));
    views.push_back(view);
  }
  return views;
}

std::vector<Candidate> ring() {
  return ring_of_views({.positions = 7, .radius_m = 1.3, .height_m = 0.2}, Eigen::Vector3d::Zero());
}

Candidate view_at(const Eigen::Vector3d& p_m, double yaw_rad = 0.0) {
  Candidate view;
  view.T_world_sensor = make_pose(p_m, yaw_rad);
  return view;
}

double swept(const Gain& gain, const GainContext& context, const Candidate& view,
             const FieldOfView& field, int rays = 0) {
  return swept_gains_bits(gain, context, {&view, 1}, field, 1, {.rays_per_view = rays}).front();
}

double exact(const Gain& gain, const GainContext& context, const Candidate& view,
             const FieldOfView& field) {
  return exact_gain_bits(gain, context, view.T_world_sensor, field);
}

TEST(SweptGain, CountsEveryCellInViewOnceWhereNothingIsInTheWay) {
  const OccupancyGrid grid = unobserved_grid();
  const GridFrame& frame = grid.frame;
  const Eigen::Vector3d half_cell = 0.5 * frame.cell_size_m;
  for (const Eigen::Vector3d& p :
       {frame.centre({20, 15, 12}), frame.centre({0, 29, 3}), Eigen::Vector3d(0.013, 0.021, -0.107),
        Eigen::Vector3d(frame.centre({11, 7, 20}) + half_cell)}) {
    const Candidate view = view_at(p);
    EXPECT_EQ(swept(SimpleGain{}, {grid}, view, all_round()),
              exact(SimpleGain{}, {grid}, view, all_round()))
        << p.transpose();
  }
}

TEST(SweptGain, OfAPanoramaInClutterIsCloseToExact) {
  FieldOfView field = all_round();
  field.tilt_min_rad = -0.4;
  field.tilt_max_rad = 1.0;
  field.panorama = true;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OccupancyGrid grid = cluttered_grid(seed);
    const Candidate view = view_at({-0.21, 0.13, 0.05}, 0.7);
    const double expected = exact(SimpleGain{}, {grid}, view, field);
    EXPECT_GT(expected, 1000.0);
    EXPECT_NEAR(swept(SimpleGain{}, {grid}, view, field, 1024), expected, 0.04 * expected) << seed;
  }
}

TEST(SweptGain, OfViewsFromOutsideIsExactInEmptySpace) {
  const OccupancyGrid grid = unobserved_grid();
  for (const Candidate& view : ring()) {
    const double expected = exact(SimpleGain{}, {grid}, view, sector());
    EXPECT_GT(expected, 1000.0);
    EXPECT_NEAR(swept(SimpleGain{}, {grid}, view, sector()), expected, 2.0);
  }
}

TEST(SweptGain, SeesNothingBehindAWall) {
  OccupancyGrid grid = unobserved_grid();
  const GridFrame& frame = grid.frame;
  for (int y = 0; y < frame.cells.y(); ++y) {
    for (int z = 0; z < frame.cells.z(); ++z) grid.log_odds[frame.index({10, y, z})] = 3.0F;
  }
  const Candidate view = view_at({-1.5, 0.0, 0.0});
  const double in_front = 10.0 * 30.0 * 24.0;
  EXPECT_NEAR(swept(SimpleGain{}, {grid}, view, all_round()), in_front, 1e-6 * in_front);
}

/// Layers of cells of 1 m along axis w, and a sensor 3 m before the nearest one that looks at
/// them aslant, from one side along axis v.
struct Aslant {
  int v;
  int w;
  double side_v;
  double side_w;

  [[nodiscard]] int beside() const { return 3 - v - w; }
  [[nodiscard]] OccupancyGrid grid(int cells_v, int layers = 2, int cells_beside = 1) const {
    GridFrame frame;
    frame.cells[v] = cells_v;
    frame.cells[w] = layers;
    frame.cells[beside()] = cells_beside;
    return OccupancyGrid(frame);
  }
  [[nodiscard]] Candidate view(const OccupancyGrid& grid, double aside_m) const {
    Eigen::Vector3d p_m = grid.frame.box().center();
    p_m[v] += side_v * aside_m;
    p_m[w] += side_w * (2.5 + 0.5 * grid.frame.cells[w]);
    return view_at(p_m);
  }
};

std::vector<Aslant> from_all_sides() {
  std::vector<Aslant> all;
  for (int pair = 0; pair < 9; ++pair) {
    if (pair / 3 == pair % 3) continue;
    for (const double side_v : {-1.0, 1.0}) {
      for (const double side_w : {-1.0, 1.0}) all.push_back({pair / 3, pair % 3, side_v, side_w});
    }
  }
  return all;
}

FieldOfView any_direction() {
  FieldOfView field = all_round();
  field.panorama = true;
  field.tilt_min_rad = -0.5 * std::numbers::pi;
  field.tilt_max_rad = 0.5 * std::numbers::pi;
  return field;
}

/// Rays come to the farther of two cells through the nearer one, and before it through nothing.
TEST(SweptGain, FadesInTheCellsOfTheGridAlone) {
  for (const Aslant& aslant : from_all_sides()) {
    const OccupancyGrid grid = aslant.grid(1);
    const Candidate view = aslant.view(grid, 2.4);
    const Gain gain = BeerLambertGain{.a = 0.9};
    EXPECT_NEAR(exact(gain, {grid}, view, any_direction()), 1.9, 1e-6);
    EXPECT_NEAR(swept(gain, {grid}, view, any_direction()), 1.9, 1e-5)
        << aslant.v << aslant.w << ' ' << aslant.side_v << ' ' << aslant.side_w;
  }
}

/// Four cells, one behind the other, between free ones. At d cells from the sensor a ray comes from
/// 2.4 / d cells aside, and so much of the light comes in from outside the grid.
TEST(SweptGain, BlendsInTheLightThatPassedBesideTheGrid) {
  constexpr double kA = 0.95;
  const double second = kA;  // from outside, through the column of the cell itself
  const double third = std::lerp(second, 1.0, 0.48) * std::pow(kA, 1.48);
  const double fourth = std::lerp(third, 1.0, 0.4) * std::pow(kA, 1.4);
  for (const Aslant& aslant : from_all_sides()) {
    OccupancyGrid grid = aslant.grid(1, 4, 3);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (grid.frame.cell(i)[aslant.beside()] != 1) grid.log_odds[i] = -3.0F;
    }
    EXPECT_NEAR(swept(BeerLambertGain{.a = kA}, {grid}, aslant.view(grid, 2.4), any_direction()),
                1.0 + second + third + fourth, 1e-5)
        << aslant.v << aslant.w << ' ' << aslant.side_v << ' ' << aslant.side_w;
  }
}

/// Of two by two cells the nearest is occupied: only the one beside it is seen.
TEST(SweptGain, SeesNothingAslantBehindACellAtTheRimOfTheGrid) {
  for (const Aslant& aslant : from_all_sides()) {
    OccupancyGrid grid = aslant.grid(2);
    Eigen::Array3i nearest(0, 0, 0);
    nearest[aslant.v] = aslant.side_v > 0.0 ? 1 : 0;
    nearest[aslant.w] = aslant.side_w > 0.0 ? 1 : 0;
    grid.log_odds[grid.frame.index(nearest)] = 3.0F;
    const Candidate view = aslant.view(grid, 1.9);
    EXPECT_EQ(exact(SimpleGain{}, {grid}, view, any_direction()), 1.0);
    EXPECT_EQ(swept(SimpleGain{}, {grid}, view, any_direction()), 1.0)
        << aslant.v << aslant.w << ' ' << aslant.side_v << ' ' << aslant.side_w;
  }
}

/// Three layers of two cells, of which one in the nearest layer is free. Rays from 0.3 cells beside
/// the nearer ones move 0.3 / 4 and 0.7 / 4 cells across from there to the second layer, and
/// 0.3 / 5 and 0.7 / 5 to the third.
TEST(SweptGain, BlendsTheLightThatReachedTheLayerBefore) {
  constexpr double kA = 0.95;
  for (const Aslant& aslant : from_all_sides()) {
    for (const bool nearer_is_free : {false, true}) {
      OccupancyGrid grid = aslant.grid(2, 3);
      Eigen::Array3i seen(0, 0, 0);
      seen[aslant.v] = (aslant.side_v > 0.0) == nearer_is_free ? 1 : 0;
      seen[aslant.w] = aslant.side_w > 0.0 ? 2 : 0;
      grid.log_odds[grid.frame.index(seen)] = -3.0F;
      const double nearer = nearer_is_free ? 1.0 : std::pow(kA, 1.0 + 0.3 / 4.0);
      const double farther = nearer_is_free ? std::pow(kA, 1.0 + 0.7 / 4.0) : 1.0;
      const double third = std::lerp(nearer, farther, 0.06) * std::pow(kA, 1.06) +
                           std::lerp(nearer, farther, 0.86) * std::pow(kA, 1.14);
      EXPECT_NEAR(swept(BeerLambertGain{.a = kA}, {grid}, aslant.view(grid, 0.2), any_direction()),
                  1.0 + nearer + farther + third, 1e-5)
          << aslant.v << aslant.w << ' ' << aslant.side_v << ' ' << aslant.side_w;
    }
  }
}

/// A ray crosses one cell before the farther one; the sweep takes 1 + 1.4 / 4, the mean of such.
TEST(SweptGain, SendsNoRayToWhatIsPlainlySeen) {
  for (const Aslant& aslant : from_all_sides()) {
    const OccupancyGrid grid = aslant.grid(1);
    const Candidate view = aslant.view(grid, 1.4);
    const auto with_rays = [&](double a) {
      return swept_gains_bits(BeerLambertGain{.a = a}, {grid}, {&view, 1}, any_direction(), 1,
                              kEveryRay)
          .front();
    };
    EXPECT_NEAR(with_rays(0.999), 1.0 + std::pow(0.999, 1.35), 1e-6) << "as it is swept";
    EXPECT_NEAR(with_rays(0.998), 1.0 + 0.998, 1e-6) << "less than 0.998 is seen: by a ray";
  }
}

TEST(SweptGain, FollowsBeerLambertInAnEvenMedium) {
  const OccupancyGrid grid = unobserved_grid();
  for (const double a : {0.999, 0.99, 0.95}) {
    const Gain gain = BeerLambertGain{.a = a};
    for (const Candidate& view : ring()) {
      const double expected = exact(gain, {grid}, view, sector());
      const double tolerance = 0.8 * (1.0 - a);
      EXPECT_NEAR(swept(gain, {grid}, view, sector()), expected, tolerance * expected) << a;
    }
  }
}

TEST(SweptGain, IsNearExactRaysInClutter) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const OccupancyGrid grid = cluttered_grid(seed);
    const BlockField transmission = patchy_field(grid.frame.cells);
    for (const Gain& gain : {Gain(SimpleGain{}), Gain(AdaptiveGain{})}) {
      for (const Candidate& view : ring()) {
        const double expected = exact(gain, {grid, &transmission}, view, sector());
        EXPECT_NEAR(swept(gain, {grid, &transmission}, view, sector(), 0), expected,
                    0.25 * expected);
        EXPECT_NEAR(swept(gain, {grid, &transmission}, view, sector(), 1024), expected,
                    0.05 * expected);
      }
    }
  }
}

TEST(SweptGain, ComesCloserToExactWithMoreRays) {
  const OccupancyGrid grid = cluttered_grid(4);
  const auto mean_error = [&](int rays) {
    double sum = 0.0;
    for (const Candidate& view : ring()) {
      sum += std::abs(swept(SimpleGain{}, {grid}, view, sector(), rays) -
                      exact(SimpleGain{}, {grid}, view, sector()));
    }
    return sum;
  };
  EXPECT_LT(mean_error(1 << 20), 0.3 * mean_error(0));
}

/// Errors of views, of which the mean is zero if there is no bias.
struct Errors {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  void add(double error) {
    count += 1.0;
    sum += error;
    squares += error * error;
  }
  [[nodiscard]] double standard_errors_from_zero() const {
    const double mean = sum / count;
    return std::abs(mean) / std::sqrt((squares / count - mean * mean) / count);
  }
};

TEST(SweptGains, AreNeverBelowZeroAndHaveNoBiasHoweverFewTheRays) {
  FieldOfView field = sector();
  field.half_width_rad = 0.45;
  field.range_max_m = 1.4;
  constexpr std::array kRays{16, 256, 4096};
  std::array<Errors, kRays.size()> all;
  std::array<Errors, kRays.size()> near_zero;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    Rng rng(seed);
    const OccupancyGrid grid = walled_grid(rng);
    const auto views = views_of_wall(rng);
    const Gain gain = seed % 2 == 0 ? Gain(SimpleGain{}) : Gain(BeerLambertGain{.a = 0.98});
    const auto expected = exact_gains_bits(gain, {grid}, views, field, 1);
    for (std::size_t k = 0; k < kRays.size(); ++k) {
      const auto swept =
          swept_gains_bits(gain, {grid}, views, field, 1, {.rays_per_view = kRays[k]});
      for (std::size_t i = 0; i < views.size(); ++i) {
        EXPECT_GE(swept[i], 0.0) << "world " << seed << ", view " << i;
        all[k].add(swept[i] - expected[i]);
        if (expected[i] < 30.0) near_zero[k].add(swept[i] - expected[i]);
      }
    }
  }
  for (std::size_t k = 0; k < kRays.size(); ++k) {
    EXPECT_LT(all[k].standard_errors_from_zero(), 3.0) << kRays[k];
    EXPECT_LT(near_zero[k].standard_errors_from_zero(), 3.0) << kRays[k];
  }
}

TEST(SweptGains, OfViewsThatSeeNothingNewAreThoseOfEveryRay) {
  constexpr SweepOptions kAll{.rays_per_view = 1 << 30, .first_share = 1};
  int corrected = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const OccupancyGrid grid = walled_grid(rng);
    const auto views = views_of_wall(rng);
    const auto expected = exact_gains_bits(SimpleGain{}, {grid}, views, sector(), 1);
    const auto swept = swept_gains_bits(SimpleGain{}, {grid}, views, sector(), 1);
    const auto all = swept_gains_bits(SimpleGain{}, {grid}, views, sector(), 1, kAll);
    const auto uncorrected = swept_gains_bits(SimpleGain{}, {grid}, views, sector(), 1, kNoRays);
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (expected[i] > 0.0) continue;
      EXPECT_EQ(swept[i], all[i]) << "world " << seed << ", view " << i;
      if (uncorrected[i] > 0.5) ++corrected;
    }
  }
  EXPECT_GT(corrected, 10);
}

TEST(SweptGains, AreTheSameBitsForEveryNumberOfThreadsAndCompany) {
  const OccupancyGrid grid = cluttered_grid(5);
  const BlockField transmission = patchy_field(grid.frame.cells);
  const auto views = ring();
  const Gain gain = AdaptiveGain{};
  const auto one = swept_gains_bits(gain, {grid, &transmission}, views, sector(), 1);
  EXPECT_EQ(swept_gains_bits(gain, {grid, &transmission}, views, sector(), 2), one);
  EXPECT_EQ(swept_gains_bits(gain, {grid, &transmission}, views, sector(), 64), one);
}

TEST(SweptGains, OfViewsFromOnePlaceAreThoseOfEachAlone) {
  const OccupancyGrid grid = unobserved_grid();
  const auto views = ring();
  const auto together = swept_gains_bits(SimpleGain{}, {grid}, views, sector(), 1, kNoRays);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(together[i], swept(SimpleGain{}, {grid}, views[i], sector())) << i;
  }
}

TEST(SweptGains, AskOncePerPyramidOfAPlaceWhetherToGoOn) {
  const OccupancyGrid grid = unobserved_grid();
  const auto views = ring();
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  swept_gains_bits(SimpleGain{}, {grid}, views, sector(), 1, kNoRays);
  EXPECT_EQ(asked, 7 * 6) << "three views from each of 7 places";
}

TEST(SweptGain, OfAViewFarAwayIsZero) {
  const OccupancyGrid grid = cluttered_grid(6);
  for (const double distance_m : {5.0, 1e6, 1e12}) {
    EXPECT_EQ(swept(SimpleGain{}, {grid}, view_at({distance_m, 0.0, 0.0}), sector()), 0.0);
  }
}

TEST(SweptGains, OfNoCandidatesAreNone) {
  const OccupancyGrid grid = unobserved_grid();
  EXPECT_TRUE(swept_gains_bits(SimpleGain{}, {grid}, {}, sector(), 2).empty());
}

TEST(CanSweep, TheGainsWhoseLightOnlyFades) {
  EXPECT_TRUE(can_sweep(SimpleGain{}));
  EXPECT_TRUE(can_sweep(BeerLambertGain{}));
  EXPECT_TRUE(can_sweep(AdaptiveGain{}));
  EXPECT_TRUE(can_sweep(UnmappedVolumeGain{}));
  EXPECT_FALSE(can_sweep(PosteriorChainGain{}));
  EXPECT_FALSE(can_sweep(FsmiGain{}));
}

TEST(SweptGain, FadesInTheCellThatTheSensorIsInTheMiddleOf) {
  for (int axis = 0; axis < 2; ++axis) {  // straight up no field of view looks
    for (const int from : {0, 2}) {
      GridFrame frame;
      frame.cells[axis] = 3;
      const OccupancyGrid grid(frame);
      Eigen::Array3i own = Eigen::Array3i::Zero();
      own[axis] = from;
      const Candidate view = view_at(frame.centre(own));
      const Gain gain = BeerLambertGain{.a = 0.9};
      EXPECT_NEAR(exact(gain, {grid}, view, any_direction()), 1.0 + 0.9 + 0.81, 1e-6);
      EXPECT_NEAR(swept(gain, {grid}, view, any_direction()), 1.0 + 0.9 + 0.81, 2e-5)
          << axis << from;
    }
  }
}

/// Three views from each of 7 places. So few rays tell too little of any of them, and all are sent.
TEST(SweptGains, OfAnyViewFromAPlaceAreRightThoughFewRaysTellTooLittle) {
  const OccupancyGrid grid = unobserved_grid();
  const Gain gain = BeerLambertGain{.a = 0.99};
  const auto views = ring();
  const auto expected = exact_gains_bits(gain, {grid}, views, sector(), 1);
  for (const int rays : {1, 2, 4, 8}) {
    const auto swept = swept_gains_bits(gain, {grid}, views, sector(), 1, {.rays_per_view = rays});
    for (std::size_t i = 0; i < views.size(); ++i) {
      EXPECT_NEAR(swept[i], expected[i], 0.2 * expected[i]) << rays << " rays, view " << i;
    }
  }
}

}  // namespace
}  // namespace vantage
