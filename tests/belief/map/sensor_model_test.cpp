#include "vantage/belief/map/sensor_model.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

constexpr double kCell = 1.0 / 129.0;

GridFrame small_frame(const Eigen::Vector3d& cell_size_m, int cells = 9) {
  GridFrame frame;
  frame.min_corner_m = {0.3, -0.2, 0.7};
  frame.cell_size_m = cell_size_m;
  frame.cells = {cells, cells, cells};
  return frame;
}

GridFrame small_frame() { return small_frame(Eigen::Vector3d::Constant(kCell)); }

/// A point in `cell`, `offset` in [-0.5, 0.5] cells from its centre.
Eigen::Vector3f point_in(const GridFrame& frame, const Eigen::Array3i& cell,
                         const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) {
  const Eigen::Vector3d p = frame.centre(cell) + offset.cwiseProduct(frame.cell_size_m);
  return p.cast<float>();
}

std::vector<Eigen::Vector3f> random_points(const GridFrame& frame, int count, Rng& rng) {
  const Eigen::AlignedBox3d box = frame.box();
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d u(rng.uniform(), rng.uniform(), rng.uniform());
    points.emplace_back((box.min() + box.sizes().cwiseProduct(u)).cast<float>());
  }
  return points;
}

TEST(SensorModel, PeakIsReachedAtTheCellCentre) {
  OccupancyGrid grid(small_frame());
  const auto point = point_in(grid.frame, {4, 4, 4});
  add_measurements(grid, {&point, 1}, {});
  EXPECT_NEAR(grid.p_occupied(grid.frame.index({4, 4, 4})), 0.8, 1e-4);
}

TEST(SensorModel, DoesNotDependOnThreads) {
  Rng rng(7);
  OccupancyGrid one(small_frame(Eigen::Vector3d(kCell, 2.0 * kCell, 0.5 * kCell), 17));
  const OccupancyGrid empty = one;
  const auto points = random_points(one.frame, 300, rng);
  add_measurements(one, points, {}, 1);
  for (const int threads : {2, 3, 40}) {
    OccupancyGrid shared = empty;
    add_measurements(shared, points, {}, threads);
    EXPECT_EQ(shared.log_odds, one.log_odds) << threads;
  }
}

TEST(SensorModel, EvidenceFallsWithDistanceToNoneAtAll) {
  OccupancyGrid grid(small_frame());
  const auto point = point_in(grid.frame, {4, 4, 4}, {0.2, 0.0, 0.0});
  InverseSensorModel model;
  model.p_occupied_peak = 0.6;  // low enough that no limit plays a part
  add_measurements(grid, {&point, 1}, model);
  // p(m|z) = 0.5 + 0.1 exp(-d^2 / 2 sigma^2), sigma = 0.65 cells (5.04 mm > 5 mm)
  EXPECT_NEAR(grid.p_occupied(grid.frame.index({4, 4, 4})),
              0.5 + 0.1 * std::exp(-0.5 * 0.04 / 0.4225), 1e-5);
  EXPECT_NEAR(grid.p_occupied(grid.frame.index({5, 4, 4})),
              0.5 + 0.1 * std::exp(-0.5 * 0.64 / 0.4225), 1e-5);
  EXPECT_EQ(grid.p_occupied(grid.frame.index({7, 4, 4})), 0.5);
}

RC_GTEST_PROP(SensorModelProperty, OneHitAnywhereInACellMakesItOccupied, (std::uint64_t seed)) {
  Rng rng(seed);
  const Eigen::Vector3d cell_size_m(rng.uniform(0.002, 0.3), rng.uniform(0.002, 0.3),
                                    rng.uniform(0.002, 0.3));
  OccupancyGrid grid(small_frame(cell_size_m));
  const auto offset = [&] { return rng.uniform(-0.499, 0.499); };
  const auto point = point_in(grid.frame, {4, 4, 4}, {offset(), offset(), offset()});
  add_measurements(grid, {&point, 1}, {});
  RC_ASSERT(grid.p_occupied(grid.frame.index({4, 4, 4})) > kOccupiedAbove);
  RC_ASSERT(grid.count(CellState::occupied) == 1U);
}

RC_GTEST_PROP(SensorModelProperty, NeverLowersACell, (std::uint64_t seed)) {
  Rng rng(seed);
  OccupancyGrid grid(small_frame());
  for (float& cell : grid.log_odds) cell = static_cast<float>(rng.uniform(-6.0, 6.0));
  const OccupancyGrid before = grid;
  add_measurements(grid, random_points(grid.frame, 40, rng), {});
  for (std::size_t i = 0; i < grid.size(); ++i) RC_ASSERT(grid.log_odds[i] >= before.log_odds[i]);
}

RC_GTEST_PROP(SensorModelProperty, OrderOfPointsDoesNotMatter, (std::uint64_t seed)) {
  Rng rng(seed);
  OccupancyGrid forward(small_frame());
  OccupancyGrid backward(small_frame());
  auto points = random_points(forward.frame, 60, rng);
  add_measurements(forward, points, {});
  std::ranges::reverse(points);
  add_measurements(backward, points, {});
  RC_ASSERT(forward.log_odds == backward.log_odds);
}

TEST(SensorModel, UpdatesACellOncePerScan) {
  OccupancyGrid once(small_frame());
  OccupancyGrid many(small_frame());
  const std::vector<Eigen::Vector3f> points(500, point_in(once.frame, {4, 4, 4}));
  add_measurements(once, {points.data(), 1}, {});
  add_measurements(many, points, {});
  EXPECT_EQ(once.log_odds, many.log_odds);
}

TEST(SensorModel, SpreadAloneNeverMakesANeighbourOccupied) {
  OccupancyGrid grid(small_frame());
  // On the very edge of its cell: the neighbour's centre is as near as its own.
  const auto point = point_in(grid.frame, {4, 4, 4}, {0.499, 0.499, 0.499});
  for (int scan = 0; scan < 100; ++scan) add_measurements(grid, {&point, 1}, {});
  EXPECT_EQ(grid.count(CellState::occupied), 1U);
  EXPECT_EQ(grid.state(grid.frame.index({4, 4, 4})), CellState::occupied);
  EXPECT_GT(grid.p_occupied(grid.frame.index({5, 4, 4})), 0.55);
}

TEST(SensorModel, SpreadDoesNotTakeBackFreeCellsButHitsDo) {
  OccupancyGrid grid(small_frame());
  std::ranges::fill(grid.log_odds, -1.0F);
  const auto point = point_in(grid.frame, {4, 4, 4});
  for (int scan = 0; scan < 3; ++scan) add_measurements(grid, {&point, 1}, {});
  EXPECT_EQ(grid.count(CellState::free), grid.size() - 1);
  EXPECT_EQ(grid.state(grid.frame.index({4, 4, 4})), CellState::occupied);
}

TEST(SensorModel, ClampsLogOdds) {
  OccupancyGrid grid(small_frame());
  const auto point = point_in(grid.frame, {4, 4, 4});
  InverseSensorModel model;
  model.max_abs_log_odds = 3.0;
  for (int scan = 0; scan < 20; ++scan) add_measurements(grid, {&point, 1}, model);
  EXPECT_EQ(*std::ranges::max_element(grid.log_odds), 3.0F);
}

TEST(SensorModel, SkipsPointsThatAreNotFiniteOrFarOutside) {
  OccupancyGrid grid(small_frame());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<Eigen::Vector3f> points{{nan, 0.0F, 0.75F},
                                            {infinity, -0.2F, 0.75F},
                                            {-infinity, infinity, 0.75F},
                                            {1e30F, 1e30F, 1e30F},
                                            {0.3F, -0.2F, 2.0F}};
  add_measurements(grid, points, {});
  EXPECT_EQ(grid.count(CellState::unobserved), grid.size());
  EXPECT_EQ(*std::ranges::max_element(grid.log_odds), 0.0F);
}

TEST(SensorModel, RejectsOptionsOutOfRange) {
  OccupancyGrid grid(small_frame());
  InverseSensorModel model;
  model.p_occupied_peak = 1.0;
  EXPECT_THROW(add_measurements(grid, {}, model), ConfigError);
}

// A wall scanned seven times with 5 mm range noise on 7.75 mm cells.
TEST(SensorModel, NoisySurfaceIsAsThickAsItsPointsAndNoThicker) {
  constexpr int side = 21;
  OccupancyGrid grid(small_frame(Eigen::Vector3d::Constant(kCell), side));
  std::vector<bool> has_point(grid.size(), false);
  Rng rng(7);
  for (int scan = 0; scan < 7; ++scan) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 3 * side * side; ++i) {
      const Eigen::Vector3d p_cells(10.5 + rng.normal(0.0, 0.005) / kCell, rng.uniform(0.0, side),
                                    rng.uniform(0.0, side));
      points.emplace_back((grid.frame.min_corner_m + kCell * p_cells).cast<float>());
      const Eigen::Array3i cell = grid.frame.cell_at(points.back().cast<double>());
      if (grid.frame.contains(cell)) has_point[grid.frame.index(cell)] = true;
    }
    add_measurements(grid, points, {});
  }
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_EQ(grid.state(i) == CellState::occupied, has_point[i]) << i;
  }
}

/// Cell by cell, the rules as the header has them.
double log_odds_by_the_rules(const OccupancyGrid& before, std::size_t cell,
                             const std::vector<Eigen::Vector3f>& points,
                             const InverseSensorModel& model) {
  const GridFrame& frame = before.frame;
  const Eigen::Array3d sigma_m = (0.65 * frame.cell_size_m.array()).max(model.sigma_m);
  double least = std::numeric_limits<double>::infinity();
  bool hit = false;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d p = point.cast<double>();
    const Eigen::Array3d off = (frame.centre(frame.cell(cell)) - p).array() / sigma_m;
    const double d2 = off.square().sum();
    const bool inside = (frame.cell_at(p) == frame.cell(cell)).all();
    hit = hit || inside;
    if (inside || d2 <= model.spread_sigmas * model.spread_sigmas) least = std::min(least, d2);
  }
  const double was = static_cast<double>(before.log_odds[cell]);
  if (std::isinf(least)) return was;
  if (!hit && before.state(cell) == CellState::free) return was;
  const double p = 0.5 + (model.p_occupied_peak - 0.5) * std::exp(-0.5 * least);
  const bool spread = !hit && before.state(cell) == CellState::unobserved;
  const double limit = spread ? std::log(0.59 / 0.41) : model.max_abs_log_odds;
  return std::max(was, std::min(was + log_odds_of(p), limit));
}

TEST(SensorModel, IsTheRulesOfTheHeaderCellByCell) {
  Rng rng(12);
  for (const double sigma_m : {0.001, 0.012}) {
    for (const double spread : {0.0, 1.3, 3.0}) {
      OccupancyGrid grid(small_frame({0.008, 0.013, 0.006}));
      for (float& cell : grid.log_odds) cell = static_cast<float>(rng.uniform(-1.0, 1.0));
      auto points = random_points(grid.frame, 25, rng);
      for (int i = 0; i < 12; ++i) {  // some just outside
        points.emplace_back(
            1.1F * (points[static_cast<std::size_t>(i)] - grid.frame.box().center().cast<float>()) +
            grid.frame.box().center().cast<float>());
      }
      const InverseSensorModel model{.sigma_m = sigma_m, .spread_sigmas = spread};
      OccupancyGrid after = grid;
      add_measurements(after, points, model);
      std::size_t changed = 0;
      for (std::size_t cell = 0; cell < grid.size(); ++cell) {
        EXPECT_NEAR(after.log_odds[cell], log_odds_by_the_rules(grid, cell, points, model), 2e-5)
            << sigma_m << " " << spread << " " << cell;
        changed += after.log_odds[cell] != grid.log_odds[cell] ? 1 : 0;
      }
      EXPECT_GE(changed, spread == 0.0 ? 10U : 20U);
    }
  }
}

/// The standard deviation is 0.65 cells: the next cell is within two of them, the one after is not.
TEST(SensorModel, EvidenceReachesAsManyCellsHoweverLargeTheyAre) {
  for (const double cell_m : {kCell, 0.5, 4.0}) {
    OccupancyGrid grid(small_frame(Eigen::Vector3d::Constant(cell_m)));
    const auto point = point_in(grid.frame, {4, 4, 4});
    add_measurements(grid, {&point, 1}, {.p_occupied_peak = 0.6});
    for (const int side : {-1, 1}) {
      EXPECT_NEAR(grid.p_occupied(grid.frame.index({4 + side, 4, 4})),
                  0.5 + 0.1 * std::exp(-0.5 / 0.4225), 1e-4)
          << cell_m;
      EXPECT_EQ(grid.p_occupied(grid.frame.index({4 + 2 * side, 4, 4})), 0.5) << cell_m;
    }
  }
}

/// The middles of the next cells are as far as the evidence reaches, to the bit.
TEST(SensorModel, EvidenceReachesCellsJustAtItsEnd) {
  GridFrame frame;
  frame.cells = {5, 5, 5};
  OccupancyGrid grid(frame);
  const Eigen::Vector3f point(2.5F, 2.5F, 2.5F);
  add_measurements(grid, {&point, 1}, {.p_occupied_peak = 0.6, .spread_sigmas = 1.0 / 0.65});
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Array3i beside(2, 2, 2);
    beside[axis] += 1;
    EXPECT_GT(grid.log_odds[frame.index(beside)], 0.0F) << axis;
  }
  EXPECT_EQ(grid.log_odds[frame.index({3, 3, 2})], 0.0F);
}

/// The neighbours of the only point, along every axis, above all points and below.
TEST(SensorModel, EvidenceReachesAsFarAlongEveryAxis) {
  OccupancyGrid grid(small_frame());
  const auto point = point_in(grid.frame, {4, 4, 4});
  add_measurements(grid, {&point, 1}, {.p_occupied_peak = 0.6}, 1);
  const double expected = 0.5 + 0.1 * std::exp(-0.5 / 0.4225);
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      Eigen::Array3i beside(4, 4, 4);
      beside[axis] += side;
      EXPECT_NEAR(grid.p_occupied(grid.frame.index(beside)), expected, 1e-4) << axis << side;
    }
  }
}

TEST(SensorModel, OfNoPointsChangesNothing) {
  OccupancyGrid grid(small_frame());
  const OccupancyGrid before = grid;
  add_measurements(grid, {}, {}, 2);
  EXPECT_EQ(grid.log_odds, before.log_odds);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> none{{nan, nan, nan}, {0.3F, nan, 0.7F}};
  add_measurements(grid, none, {}, 2);
  EXPECT_EQ(grid.log_odds, before.log_odds);
}

/// Half a cell above the middle of the highest one, and so in none.
TEST(SensorModel, APointOnTheUpperFaceOfTheGridOnlySpreads) {
  GridFrame frame;
  frame.cells = {5, 5, 4};
  OccupancyGrid grid(frame);
  const Eigen::Vector3f point(2.5F, 2.5F, 4.0F);
  for (const int threads : {1, 3}) {
    std::ranges::fill(grid.log_odds, 0.0F);
    add_measurements(grid, {&point, 1}, {.p_occupied_peak = 0.6}, threads);
    EXPECT_NEAR(grid.p_occupied(frame.index({2, 2, 3})), 0.5 + 0.1 * std::exp(-0.5 * 0.25 / 0.4225),
                1e-5);
    EXPECT_EQ(grid.count(CellState::occupied), 0U);
  }
}

}  // namespace
}  // namespace vantage
