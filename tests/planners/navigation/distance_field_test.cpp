#include "vantage/planners/navigation/distance_field.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/planners/navigation/ascii_floor.hpp"

namespace vantage {
namespace {

std::vector<double> by_brute_force(const std::vector<std::uint8_t>& source, int nx, int ny) {
  std::vector<double> squared(source.size(), kInfinity);
  for (int i = 0; i < nx * ny; ++i) {
    for (int j = 0; j < nx * ny; ++j) {
      if (source[static_cast<std::size_t>(j)] == 0) continue;
      const int dx = i % nx - j % nx;
      const int dy = i / nx - j / nx;
      double& best = squared[static_cast<std::size_t>(i)];
      best = std::min(best, static_cast<double>(dx * dx + dy * dy));
    }
  }
  return squared;
}

RC_GTEST_PROP(SquaredDistances, AreThoseOfBruteForce, ()) {
  const int nx = *rc::gen::inRange(1, 14);
  const int ny = *rc::gen::inRange(1, 14);
  const int one_in = *rc::gen::inRange(1, 20);
  std::vector<std::uint8_t> source(static_cast<std::size_t>(nx * ny));
  for (auto& cell : source) cell = *rc::gen::inRange(0, one_in) == 0 ? 1 : 0;
  RC_ASSERT(squared_distances_cells(source, nx, ny) == by_brute_force(source, nx, ny));
}

TEST(SquaredDistances, OfNoSourceAreInfinite) {
  const std::vector<std::uint8_t> none(12, 0);
  EXPECT_EQ(squared_distances_cells(none, 4, 3), std::vector<double>(12, kInfinity));
}

TEST(Clearances, CountUnknownSpaceAndTheOutsideAsObstacles) {
  const FloorMap map = floor_of({
      "......#",  //
      ".......",  //
      ".......",  //
      ".......",  //
      ".....?.",  //
  });
  const auto clearance_m = clearances_m(map);
  const auto at = [&](int x, int y) { return clearance_m[map.index({x, y})]; };
  EXPECT_FLOAT_EQ(at(6, 4), 0.0F);
  EXPECT_FLOAT_EQ(at(5, 0), 0.0F);
  EXPECT_FLOAT_EQ(at(0, 0), 1.0F);
  EXPECT_FLOAT_EQ(at(0, 2), 1.0F);
  EXPECT_FLOAT_EQ(at(2, 2), 3.0F);
  EXPECT_FLOAT_EQ(at(4, 2), std::sqrt(5.0F));
}

TEST(Clearances, OfAFreeFloorAreThoseToItsNearestSide) {
  const FloorMap map = floor_of(Drawing(5, "........"));
  const auto clearance_m = clearances_m(map);
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    const Eigen::Array2i at = map.cell(cell);
    const int nearest = std::min({at.x() + 1, 8 - at.x(), at.y() + 1, 5 - at.y()});
    EXPECT_FLOAT_EQ(clearance_m[cell], static_cast<float>(nearest)) << at.transpose();
  }
}

}  // namespace
}  // namespace vantage
