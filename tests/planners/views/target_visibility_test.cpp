// What a map says will be seen of a thing, where the answer is known.
#include "vantage/planners/views/target_visibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

/// 1 x 1 x 0.5 m of cells of 2 cm over a table at z = 0, all free.
struct Table {
  GridFrame frame{{-0.5, -0.5, 0.0}, Eigen::Vector3d::Constant(0.02), {50, 50, 25}};
  std::vector<float> transmission = std::vector<float>(frame.size(), 1.0F);
  UprightCylinder target{{0.0, 0.0, 0.0}, 0.05, 0.15};
  std::vector<std::uint8_t> own = {};

  /// Sets the cells whose middles are in a box.
  void set(const Eigen::Vector3d& low, const Eigen::Vector3d& high, float t) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const Eigen::Vector3d p = frame.centre(frame.cell(i));
      if ((p.array() > low.array()).all() && (p.array() < high.array()).all()) transmission[i] = t;
    }
  }
  [[nodiscard]] double seen(const Eigen::Vector3d& eye_m, double margin_m = 0.0) const {
    return visible_share(frame, transmission, target, own, eye_m, margin_m);
  }
};

const Eigen::Vector3d kEye(1.2, 0.0, 0.7);

TEST(TargetVisibility, AllIsSeenOnAFreeTable) { EXPECT_NEAR(Table().seen(kEye), 1.0, 1e-12); }

TEST(TargetVisibility, AWallHidesItFromOneSideAndNotFromTheOther) {
  Table table;
  table.set({0.2, -0.5, 0.0}, {0.24, 0.5, 0.5}, 0.0F);
  EXPECT_EQ(table.seen(kEye), 0.0);
  EXPECT_NEAR(table.seen({-1.2, 0.0, 0.7}), 1.0, 1e-12);
}

TEST(TargetVisibility, HalfAWallHidesHalf) {
  Table table;
  table.set({0.2, 0.0, 0.0}, {0.24, 0.5, 0.5}, 0.0F);
  EXPECT_NEAR(table.seen(kEye), 0.5, 0.04);
}

/// Through n cells of unobserved space each ray keeps t^n.
TEST(TargetVisibility, UnknownSpaceAttenuatesByItsHazard) {
  Table table;
  table.set({0.2, -0.5, 0.0}, {0.4, 0.5, 0.5}, 0.9F);
  const double seen = table.seen({1.2, 0.0, 0.075});  // level: ten cells along x, few across
  EXPECT_LT(seen, std::pow(0.9, 10) + 1e-6);
  EXPECT_GT(seen, std::pow(0.9, 14));
}

TEST(TargetVisibility, ItDoesNotHideItself) {
  Table table;
  table.set({-0.06, -0.06, 0.0}, {0.06, 0.06, 0.16}, 0.0F);
  EXPECT_LT(table.seen(kEye), 0.9) << "corners of its cells, at no margin";
  EXPECT_NEAR(table.seen(kEye, 0.04), 1.0, 1e-12);
}

/// A long thing lies in a wide cylinder: what stands beside it there is another.
TEST(TargetVisibility, WhatStandsInItsCylinderAndIsNotItsOwnHidesIt) {
  Table table;
  table.target = {{0.0, 0.0, 0.0}, 0.15, 0.05};
  table.set({0.06, -0.1, 0.0}, {0.1, 0.1, 0.14}, 0.0F);
  constexpr double kMargin_m = 0.1;
  EXPECT_NEAR(table.seen(kEye, kMargin_m), 1.0, 1e-12) << "taken for its own";
  table.own.assign(table.frame.size(), 0);
  EXPECT_LT(table.seen(kEye, kMargin_m), 0.9);
  std::ranges::fill(table.own, std::uint8_t{1});
  EXPECT_NEAR(table.seen(kEye), 1.0, 1e-12) << "all of it is its own";
}

}  // namespace
}  // namespace vantage
