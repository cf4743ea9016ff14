#include "vantage/geometry/floor_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

}  // namespace
}  // namespace vantage
