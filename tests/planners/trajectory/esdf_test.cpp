#include "vantage/planners/trajectory/esdf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

/// Every pair of cells.
double brute_force_m(const GridFrame& frame, const std::vector<std::uint8_t>& occupied,
                     std::size_t cell, double reach_m) {
  const double half = 0.5 * frame.cell_size_m.minCoeff();
  double min_m = reach_m + half;
  for (std::size_t other = 0; other < occupied.size(); ++other) {
    if ((occupied[other] != 0) == (occupied[cell] != 0)) continue;
    min_m =
        std::min(min_m, (frame.centre(frame.cell(other)) - frame.centre(frame.cell(cell))).norm());
  }
  return occupied[cell] != 0 ? half - min_m : min_m - half;
}

TEST(Esdf, IsExactBetweenCentres) {
  GridFrame frame = make_grid_frame({1.0, -2.0, 0.5}, {1.3, 1.1, 0.8}, {13, 11, 8});
  for (const double cell_z_m : {0.1, 0.17}) {
    frame.cell_size_m.z() = cell_z_m;
    for (const double reach_m : {0.35, 5.0}) {
      for (const double share : {0.01, 0.2, 0.8}) {
        Rng rng(static_cast<std::uint64_t>(100.0 * share));
        std::vector<std::uint8_t> occupied(frame.size());
        for (auto& cell : occupied) cell = rng.uniform() < share ? 1 : 0;
        occupied[frame.size() / 2] = 0;
        const Esdf surface(frame, occupied, reach_m);
        for (std::size_t cell = 0; cell < frame.size(); ++cell) {
          ASSERT_NEAR(surface.at_centres_m()[cell], brute_force_m(frame, occupied, cell, reach_m),
                      1e-5)
              << cell;
        }
      }
    }
  }
}

class WallTest : public ::testing::Test {  // occupied from x = 1 m on
 protected:
  WallTest() {
    for (std::size_t i = 0; i < occupied_.size(); ++i) {
      occupied_[i] = frame_.centre(frame_.cell(i)).x() > 1.0 ? 1 : 0;
    }
  }
  GridFrame frame_ = make_grid_frame({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0}, {20, 10, 10});
  std::vector<std::uint8_t> occupied_ = std::vector<std::uint8_t>(frame_.size());
};

TEST_F(WallTest, DistanceIsSignedAndTrilinear) {
  const Esdf surface(frame_, occupied_);
  for (const double x : {0.1, 0.333, 0.97, 1.0, 1.04, 1.5}) {
    EXPECT_NEAR(surface.distance_m({x, 0.123, -0.21}), 1.0 - x, 1e-6);
    const auto sample = surface.sample({x, 0.123, -0.21});
    EXPECT_NEAR(sample.distance_m, 1.0 - x, 1e-6);
    EXPECT_LT((sample.gradient + Eigen::Vector3d::UnitX()).norm(), 1e-5);
  }
}

TEST_F(WallTest, DistanceEndsAtTheReach) {
  const Esdf surface(frame_, occupied_, 0.5);
  EXPECT_NEAR(surface.distance_m({0.62, 0.0, 0.0}), 0.38, 1e-6);
  EXPECT_NEAR(surface.distance_m({0.2, 0.0, 0.0}), 0.5, 1e-6);
}

TEST_F(WallTest, OutsideTheGridTheWayThereCountsToo) {
  const Esdf surface(frame_, occupied_);
  EXPECT_NEAR(surface.distance_m({-1.0, 0.0, 0.0}), 0.95 + 1.05, 1e-6);
  EXPECT_NEAR(surface.distance_m({0.5, 0.0, 3.45}), 0.5 + 3.0, 1e-6);
  const auto sample = surface.sample({0.5, 0.0, 3.45});
  EXPECT_NEAR(sample.distance_m, 3.5, 1e-6);
  EXPECT_LT((sample.gradient - Eigen::Vector3d(-1.0, 0.0, 1.0)).norm(), 1e-5);
}

TEST(Esdf, GradientIsThatOfTheValue) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.2, 0.8}, {10, 12, 8});
  Rng rng(4);
  std::vector<std::uint8_t> occupied(frame.size());
  for (auto& cell : occupied) cell = rng.uniform() < 0.1 ? 1 : 0;
  const Esdf surface(frame, occupied);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(rng.uniform(-0.8, 0.8), rng.uniform(-0.8, 0.8), rng.uniform(-0.6, 0.6));
    const auto sample = surface.sample(p);
    EXPECT_NEAR(sample.distance_m, surface.distance_m(p), 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-7;
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const double slope =
          (surface.distance_m(p + step) - surface.distance_m(p - step)) / (2.0 * kStep);
      EXPECT_NEAR(sample.gradient[axis], slope, 1e-5);
    }
  }
}

TEST(Esdf, OfAnEmptyAndOfAFullGrid) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {0.5, 0.5, 0.1}, {5, 5, 1});
  const std::vector<std::uint8_t> empty(frame.size(), 0);
  EXPECT_NEAR(Esdf(frame, empty, 1.5).distance_m({0.1, 0.0, 0.0}), 1.5, 1e-6);
  const std::vector<std::uint8_t> full(frame.size(), 1);
  EXPECT_NEAR(Esdf(frame, full, 1.5).distance_m({0.1, 0.0, 0.0}), -1.5, 1e-6);
}

TEST(Esdf, OfOneLayerHasNoSlopeAcrossIt) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {0.5, 0.5, 0.1}, {5, 5, 1});
  std::vector<std::uint8_t> occupied(frame.size());
  for (std::size_t i = 0; i < occupied.size(); ++i) occupied[i] = i % 5 == 4 ? 1 : 0;
  const auto sample = Esdf(frame, occupied).sample({0.03, 0.02, 0.0});  // a wall at x = 0.15
  EXPECT_NEAR(sample.distance_m, 0.12, 1e-6);
  EXPECT_LT((sample.gradient + Eigen::Vector3d::UnitX()).norm(), 1e-5);
}

TEST(Esdf, OfAWindowOfAMap) {
  OccupancyGrid map(make_grid_frame({0.0, 0.0, 0.5}, {4.0, 4.0, 1.0}, {40, 40, 10}));
  const auto set = [&](const Eigen::Vector3d& p, float log_odds) {
    map.log_odds[map.frame.index(map.frame.cell_at(p))] = log_odds;
  };
  set({0.55, 0.05, 0.55}, 3.0F);   // occupied
  set({0.05, 0.55, 0.55}, 0.2F);   // not known well enough
  set({-1.55, 0.05, 0.55}, 3.0F);  // outside the window
  const Eigen::AlignedBox3d window(Eigen::Vector3d(-1.0, -1.0, -9.0),
                                   Eigen::Vector3d(1.0, 1.0, 9.0));
  const Esdf surface = make_esdf(map, window, 3.0);
  EXPECT_LT(surface.frame().size(), map.size() / 3);
  EXPECT_NEAR(surface.distance_m({-0.45, 0.05, 0.55}), 0.95, 1e-5);
  EXPECT_NEAR(surface.distance_m({0.05, 0.55, 0.55}), std::sqrt(0.5) - 0.05, 1e-5);
}

TEST(Esdf, OfAWindowHasTheFirstCellOfAMapAndTheLast) {
  OccupancyGrid map(make_grid_frame({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0}, {10, 10, 10}));
  map.log_odds.front() = map.log_odds.back() = 3.0F;
  const Eigen::AlignedBox3d window(Eigen::Vector3d::Constant(-9.0), Eigen::Vector3d::Constant(9.0));
  const Esdf surface = make_esdf(map, window, 3.0);
  ASSERT_EQ(surface.frame().size(), map.size());
  EXPECT_NEAR(surface.at_centres_m().front(), -0.05, 1e-6);
  EXPECT_NEAR(surface.at_centres_m().back(), -0.05, 1e-6);
  EXPECT_NEAR(surface.at_centres_m()[1], 0.05, 1e-6);
}

TEST(Esdf, AtTheOuterCentresHasTheSlopeOfTheLastCells) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {4.0, 4.0, 4.0}, {4, 4, 4});
  std::vector<std::uint8_t> occupied(frame.size());
  for (std::size_t i = 0; i < occupied.size(); ++i) occupied[i] = i % 4 == 3 ? 1 : 0;
  const Esdf surface(frame, occupied, 5.0);  // a wall from x = 1 m on
  for (const double at : {-1.5, 1.5}) {
    const auto sample = surface.sample({at, at, at});
    EXPECT_NEAR(sample.distance_m, 1.0 - at, 1e-6);
    EXPECT_LT((sample.gradient + Eigen::Vector3d::UnitX()).norm(), 1e-6) << at;
  }
}

TEST(Esdf, NeedsAFlagForEachCell) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2, 2, 2});
  EXPECT_DEATH(Esdf(frame, std::vector<std::uint8_t>(7)), "flag for each cell");
}

TEST(Esdf, OfTwoCellsIsLinearBetweenThem) {
  for (int axis = 0; axis < 3; ++axis) {
    GridFrame frame;
    frame.cell_size_m = Eigen::Vector3d::Ones();
    frame.cells = Eigen::Array3i::Ones();
    frame.cells[axis] = 2;
    frame.min_corner_m = -0.5 * frame.cells.cast<double>().matrix();
    const Esdf surface(frame, std::vector<std::uint8_t>{0, 1});
    for (const double at : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
      EXPECT_NEAR(surface.distance_m(at * Eigen::Vector3d::Unit(axis)), -at, 1e-6) << axis;
    }
  }
}

TEST(Esdf, ReachesAMetreAndAHalfUnlessItIsSaid) {
  OccupancyGrid map(make_grid_frame({2.5, 0.05, 0.05}, {5.0, 0.1, 0.1}, {50, 1, 1}));
  map.log_odds[0] = 3.0F;
  std::vector<std::uint8_t> occupied(map.size(), 0);
  occupied[0] = 1;
  const Eigen::AlignedBox3d window = map.frame.box();
  const GridFrame& frame = map.frame;
  for (const Esdf& surface :
       {Esdf(frame, occupied), make_esdf(map, window), make_esdf(frame, occupied, window)}) {
    EXPECT_NEAR(surface.distance_m({1.05, 0.05, 0.05}), 0.95, 1e-6);
    EXPECT_NEAR(surface.distance_m({4.05, 0.05, 0.05}), 1.5, 1e-6);
  }
}

}  // namespace
}  // namespace vantage
