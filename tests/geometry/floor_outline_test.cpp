#include "vantage/geometry/floor_outline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

const FloorOutline kSquare{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};

double distance_m(const FloorOutline& outline, const Eigen::Vector2d& p) {
  double inside_m = 1e9;
  double nearest_m = 1e9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - a;
    const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (p - a - t * edge).norm());
    inside_m = std::min(inside_m, (edge.x() * (p - a).y() - edge.y() * (p - a).x()) / edge.norm());
  }
  return inside_m >= 0.0 ? 0.0 : nearest_m;
}

TEST(ConvexOutline, HasTheCornersCounterClockwiseAndNothingElse) {
  const std::vector<Eigen::Vector2d> points{{1.0, 1.0}, {3.0, 0.0}, {0.0, 1.0}, {2.0, 1.0},
                                            {4.0, 3.0}, {1.5, 0.5}, {2.0, 2.0}, {1.0, 4.0},
                                            {3.5, 1.5}, {0.5, 2.5}, {0.0, 1.0}};
  const FloorOutline expected{{0.0, 1.0}, {3.0, 0.0}, {4.0, 3.0}, {1.0, 4.0}};
  EXPECT_EQ(convex_outline(points), expected) << "neither within nor on an edge nor twice";
}

TEST(ConvexOutline, RoundingTakesNoCornerAway) {
  Rng rng(7);
  for (int round = 0; round < 100; ++round) {
    std::vector<Eigen::Vector2d> points;
    for (int copy = 0; copy < 5; ++copy) {
      for (const Eigen::Vector2d& p : kSquare) {
        points.emplace_back(0.3 * p.x() + rng.uniform(-1e-15, 1e-15),
                            0.2 * p.y() + rng.uniform(-1e-15, 1e-15));
      }
    }
    const FloorOutline outline = convex_outline(points);
    ASSERT_EQ(outline.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(outline[i].x(), 0.3 * kSquare[i].x(), 1e-12);
      EXPECT_NEAR(outline[i].y(), 0.2 * kSquare[i].y(), 1e-12);
    }
  }
}

TEST(FloorOutline, TurnsAboutTheOriginAndThenMoves) {
  const FloorOutline outline{{1.0, 0.5}, {-2.0, 3.0}};
  const FloorOutline turned = moved(outline, {10.0, 20.0, std::numbers::pi / 2.0});
  ASSERT_EQ(turned.size(), 2U);
  EXPECT_TRUE(turned[0].isApprox(Eigen::Vector2d(9.5, 21.0)));
  EXPECT_TRUE(turned[1].isApprox(Eigen::Vector2d(7.0, 18.0)));
}

TEST(FloorOutline, TheNearestEdgeAndTheFarthestCornerCount) {
  const FloorOutline oblong{{-0.7, -0.4}, {1.1, -0.4}, {1.1, 0.3}, {-0.7, 0.3}};
  EXPECT_NEAR(inscribed_radius_m(oblong), 0.3, 1e-12);
  EXPECT_NEAR(circumscribed_radius_m(oblong), std::hypot(1.1, 0.4), 1e-12);
  EXPECT_NEAR(inscribed_radius_m(moved(oblong, {0.0, 0.9, 0.0})), -0.5, 1e-12);
}

/// Points on the edge are of the outline, those a step further are not.
TEST(FloorOutline, RowsEndOnTheEdge) {
  const FloorOutline oblong{{-1.0, -0.5}, {2.0, -0.5}, {2.0, 1.0}, {-1.0, 1.0}};
  std::vector<std::array<int, 3>> rows;
  for_each_row_inside(oblong, {-0.5, 0.5}, 0.5, [&](int row, int first, int last) {
    rows.push_back({row, first, last});
  });
  const std::vector<std::array<int, 3>> expected{{-2, -1, 5}, {-1, -1, 5}, {0, -1, 5}, {1, -1, 5}};
  EXPECT_EQ(rows, expected);
}

TEST(FloorOutline, RowsBetweenPointsAreNone) {
  const FloorOutline narrow{{0.1, 0.0}, {0.4, 0.0}, {0.4, 2.0}, {0.1, 2.0}};
  int rows = 0;
  for_each_row_inside(narrow, {0.0, 0.0}, 0.5, [&](int, int, int) { ++rows; });
  EXPECT_EQ(rows, 0);
}

TEST(FloorOutline, HasADiscInsideAndOneAround) {
  EXPECT_DOUBLE_EQ(inscribed_radius_m(kSquare), 1.0);
  EXPECT_DOUBLE_EQ(circumscribed_radius_m(kSquare), std::numbers::sqrt2);
  EXPECT_LT(inscribed_radius_m(moved(kSquare, {1.5, 0.0, 0.0})), 0.0) << "the origin is outside";
}

TEST(FloorOutline, GrownHoldsAllThatIsSoNear) {
  Rng rng(5);
  const FloorOutline outline = moved(kSquare, {0.3, -0.2, 0.4});
  const FloorOutline wide = grown(outline, 0.25);
  int near = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p(rng.uniform(-2.5, 2.5), rng.uniform(-2.5, 2.5));
    const double off_m = distance_m(outline, p);
    if (off_m <= 0.25) {
      EXPECT_EQ(distance_m(wide, p), 0.0) << p.transpose();
    }
    if (off_m > 0.25 * 1.02) {
      EXPECT_GT(distance_m(wide, p), 0.0) << p.transpose();
    }
    near += off_m > 0.0 && off_m <= 0.25 ? 1 : 0;
  }
  EXPECT_GT(near, 50);
}

/// Against each point of the lattice asked by itself.
TEST(FloorOutline, RowsHoldThePointsInside) {
  Rng rng(6);
  const Eigen::Vector2d origin(0.013, -0.007);
  constexpr double kSpacing_m = 0.11;
  for (int i = 0; i < 50; ++i) {
    const FloorOutline outline =
        moved(kSquare, {rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-3.0, 3.0)});
    int counted = 0;
    for_each_row_inside(outline, origin, kSpacing_m, [&](int row, int first, int last) {
      for (int column = first; column <= last; ++column, ++counted) {
        const Eigen::Vector2d p = origin + kSpacing_m * Eigen::Vector2d(column, row);
        EXPECT_LT(distance_m(outline, p), 1e-12);
      }
    });
    int inside = 0;
    for (int row = -40; row <= 40; ++row) {
      for (int column = -40; column <= 40; ++column) {
        const Eigen::Vector2d p = origin + kSpacing_m * Eigen::Vector2d(column, row);
        inside += distance_m(outline, p) == 0.0 ? 1 : 0;
      }
    }
    EXPECT_EQ(counted, inside);
  }
}

TEST(FloorOutline, GrownGoesOutByTheMarginToAllFourSides) {
  Eigen::Vector2d low(0.0, 0.0);
  Eigen::Vector2d high(0.0, 0.0);
  for (const Eigen::Vector2d& p : grown(kSquare, 0.25)) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_LT((low - Eigen::Vector2d(-1.25, -1.25)).norm(), 1e-12);
  EXPECT_LT((high - Eigen::Vector2d(1.25, 1.25)).norm(), 1e-12);
}

TEST(ConvexOutline, HasEachCornerOfATriangle) {
  const FloorOutline above{{0.0, 0.0}, {4.0, 0.0}, {3.0, 2.0}};
  EXPECT_EQ(convex_outline({{3.0, 2.0}, {0.0, 0.0}, {4.0, 0.0}}), above);
  const FloorOutline below{{0.0, 0.0}, {3.0, -2.0}, {4.0, 0.0}};
  EXPECT_EQ(convex_outline({{4.0, 0.0}, {3.0, -2.0}, {0.0, 0.0}}), below);
}

TEST(FloorOutline, ThatIsSmallHasSmallDiscs) {
  const FloorOutline small{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}};
  EXPECT_NEAR(inscribed_radius_m(small), 0.1, 1e-15);
  EXPECT_NEAR(circumscribed_radius_m(small), 0.1 * std::numbers::sqrt2, 1e-15);
}

using FloorRows = std::vector<std::array<int, 3>>;

FloorRows rows_inside(const FloorOutline& outline, double spacing_m) {
  FloorRows rows;
  for_each_row_inside(outline, {0.0, 0.0}, spacing_m, [&](int row, int first, int last) {
    rows.push_back({row, first, last});
  });
  return rows;
}

TEST(FloorOutline, ACornerIsARowOfOnePoint) {
  const FloorOutline triangle{{0.0, 0.0}, {4.0, 0.0}, {2.0, 2.0}};
  EXPECT_EQ(rows_inside(triangle, 1.0), (FloorRows{{0, 0, 4}, {1, 1, 3}, {2, 2, 2}}));
}

/// By division its upper edge is in row 17, which by multiplication lies a rounding above it; the
/// lower edge of the other in row 9, which lies below it.
TEST(FloorOutline, ARowThatIsRoundedOffItIsNone) {
  constexpr double kHigh_m = 1.7;
  ASSERT_EQ(std::floor(kHigh_m / 0.1), 17.0);
  ASSERT_GT(17 * 0.1, kHigh_m);
  const FloorOutline oblong{{0.05, 1.55}, {0.35, 1.55}, {0.35, kHigh_m}, {0.05, kHigh_m}};
  EXPECT_EQ(rows_inside(oblong, 0.1), (FloorRows{{16, 1, 3}}));
  constexpr double kLow_m = 0.9000000000000001;
  ASSERT_EQ(std::ceil(kLow_m / 0.1), 9.0);
  ASSERT_LT(9 * 0.1, kLow_m);
  const FloorOutline other{{0.05, kLow_m}, {0.35, kLow_m}, {0.35, 1.15}, {0.05, 1.15}};
  EXPECT_EQ(rows_inside(other, 0.1), (FloorRows{{10, 1, 3}, {11, 1, 3}})) << "those above it stay";
}

}  // namespace
}  // namespace vantage
