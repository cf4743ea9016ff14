#include "vantage/models/catalogue/shapes/footprint.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

namespace vantage {
namespace {

using Eigen::Vector2d;

const Outline kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Footprint, HullDropsInnerAndCollinearPoints) {
  const Outline hull =
      convex_outline({{0, 0}, {0.5, 0}, {1, 0}, {0.4, 0.6}, {1, 1}, {0, 1}, {0, 0}});
  EXPECT_EQ(hull.size(), 4U);
}

TEST(Footprint, SquaresApartByAGap) {
  //  +---+ 0.1 +---+
  //  |   |     |   |
  //  +---+     +---+
  const Outline right = moved(kSquare, {1.1, 0.0, 0.0});
  EXPECT_FALSE(too_close(kSquare, right, 0.09));
  EXPECT_TRUE(too_close(kSquare, right, 0.11));
}

TEST(Footprint, OneInsideTheOtherIsTooClose) {
  const Outline inner{{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}};
  EXPECT_TRUE(too_close(kSquare, inner, 0.0));
  EXPECT_TRUE(too_close(inner, kSquare, 0.0));
}

TEST(Footprint, LongBoxesCrossWithoutACornerInEachOther) {
  const Outline flat{{-1, -0.1}, {1, -0.1}, {1, 0.1}, {-1, 0.1}};
  EXPECT_TRUE(too_close(flat, moved(flat, {0.0, 0.0, 0.5 * std::numbers::pi}), 0.0));
}

RC_GTEST_PROP(Footprint, NeverMissesASharedPoint, ()) {
  const auto number = [](double scale) { return scale * 1e-3 * *rc::gen::inRange(-1000, 1001); };
  const Pose2 pose{number(1.5), number(1.5), number(3.0)};
  const Outline other = moved(kSquare, pose);
  const Vector2d p(0.5 + number(0.5), 0.5 + number(0.5));  // a point of the square
  const Outline p_other = moved(Outline{p}, inverse(pose));
  const bool shared = p_other[0].minCoeff() > 0.0 && p_other[0].maxCoeff() < 1.0;
  if (shared) RC_ASSERT(too_close(kSquare, other, 0.0));
}

}  // namespace
}  // namespace vantage
