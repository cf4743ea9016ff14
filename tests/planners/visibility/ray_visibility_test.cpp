#include "vantage/planners/visibility/ray_visibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "tests/planners/gains/ascii_ray.hpp"

namespace vantage {
namespace {

using testing::Each;
using testing::Gt;
using testing::Lt;

std::vector<double> visibility(std::string_view ray) {
  return visibility_along_ray(p_occupied_of(ray));
}
std::vector<double> posterior(std::string_view ray) {
  return posterior_along_ray(p_occupied_of(ray));
}

// The four rays of [Potthast2016, Fig. 3.3].
TEST(VisibilityAlongRay, FreeCellsStayVisible) {
  EXPECT_THAT(visibility("........................................"), Each(Gt(0.99)));
}

TEST(VisibilityAlongRay, NothingIsVisibleBehindTheFirstOfManyOccupiedCells) {
  const auto p_visible = visibility("####################");
  EXPECT_EQ(p_visible.front(), 1.0);
  EXPECT_THAT(std::vector(p_visible.begin() + 1, p_visible.end()), Each(Lt(1e-3)));
}

TEST(VisibilityAlongRay, UnobservedCellsHideGraduallyAndStrictly) {
  const auto p_visible = visibility(std::string(100, '?'));
  for (std::size_t m = 1; m < p_visible.size(); ++m) {
    EXPECT_LT(p_visible[m], p_visible[m - 1]) << "cell " << m;
    EXPECT_GT(p_visible[m], p_visible[m - 1] - 0.02) << "cell " << m;
  }
  EXPECT_LT(p_visible.back(), 0.4);
}

TEST(VisibilityAlongRay, FallsAtAnOccupiedCellAndStaysSmallBehindIt) {
  const auto p_visible = visibility("...#???");
  EXPECT_THAT(std::vector(p_visible.begin(), p_visible.begin() + 4), Each(Gt(0.99)));
  EXPECT_THAT(std::vector(p_visible.begin() + 4, p_visible.end()), Each(Lt(0.3)));
}

TEST(VisibilityAlongRay, ReturnsBehindAWallAsTheModelSaysToTheLetter) {
  EXPECT_GT(visibility("#.......").back(), 0.9);
  EXPECT_GT(visibility("#??????????").back(), 0.5);
  const auto hidden = visibility_along_ray(p_occupied_of("#??????????"), {.p_reappear = 0.0});
  EXPECT_LT(hidden.back(), 0.001);
}

TEST(VisibilityAlongRay, FollowsTheEquationsByHand) {
  const VisibilityModel model{.a = 0.9, .p_reappear = 0.1};
  const auto p_visible = visibility_along_ray(std::vector{0.2, 0.7, 0.5}, model);
  // predict 1 -> t = 0.9, then weigh (0.8, 0.2): 0.72 / (0.72 + 0.02)
  const double first = 0.72 / 0.74;
  // predict with t = 0.81, then weigh (0.3, 0.7)
  const double predicted = first * 0.81 + (1.0 - first) * 0.1;
  const double second = 0.3 * predicted / (0.3 * predicted + 0.7 * (1.0 - predicted));
  EXPECT_DOUBLE_EQ(p_visible[0], 1.0);
  EXPECT_NEAR(p_visible[1], first, 1e-14);
  EXPECT_NEAR(p_visible[2], second, 1e-14);
}

TEST(VisibilityAlongRay, SurvivesCertaintyAndLength) {
  EXPECT_EQ(visibility_along_ray(std::vector{1.0, 0.5}, {.a = 1.0}).back(), 0.0);
  std::string long_ray;
  for (int i = 0; i < 500; ++i) long_ray += "#.?";
  EXPECT_THAT(visibility(long_ray), Each(testing::AllOf(testing::Ge(0.0), testing::Le(1.0))));
}

TEST(VisibilityAlongRay, FollowsTheEquationsHoweverLong) {
  double p_visible = 1.0;
  double t = 1.0;
  for (const double of_cell : visibility(std::string(2000, '?'))) {
    EXPECT_NEAR(of_cell, p_visible, 1e-12);
    t *= 0.997;
    p_visible = t * p_visible + 0.1 * (1.0 - p_visible);
  }
}

RC_GTEST_PROP(VisibilityAlongRay, IsAProbability, ()) {
  const auto draws = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 1001));
  std::vector<double> p_occupied;
  for (const int draw : draws) p_occupied.push_back(draw / 1000.0);
  for (const double p : visibility_along_ray(p_occupied)) RC_ASSERT(p >= 0.0 && p <= 1.0);
  for (const double p : posterior_along_ray(p_occupied)) RC_ASSERT(p >= 0.0 && p <= 1.0);
}

// The four rays of [Potthast2016, Fig. 3.5].
TEST(PosteriorAlongRay, FreeCellsComeOutFree) {
  EXPECT_THAT(posterior("...................."), Each(Lt(0.01)));
}

TEST(PosteriorAlongRay, OccupiedCellsComeOutOccupied) {
  EXPECT_THAT(posterior("####################"), Each(Gt(0.99)));
}

TEST(PosteriorAlongRay, UnobservedCellsTendToTheUncertainState) {
  const auto p_occupied = posterior(std::string(80, '?'));
  EXPECT_LT(p_occupied.front(), 0.1);
  for (std::size_t m = 1; m < p_occupied.size(); ++m) EXPECT_GE(p_occupied[m], p_occupied[m - 1]);
  EXPECT_NEAR(p_occupied.back(), 0.5, 1e-3);
}

TEST(PosteriorAlongRay, FollowsAMixedRay) {
  //                               0123456789
  const auto p_occupied = posterior("..#????...");
  EXPECT_THAT(std::vector(p_occupied.begin(), p_occupied.begin() + 2), Each(Lt(0.01)));
  EXPECT_GT(p_occupied[2], 0.98);
  EXPECT_THAT(std::vector(p_occupied.begin() + 3, p_occupied.begin() + 7),
              Each(testing::DoubleNear(0.5, 0.01)));
  EXPECT_THAT(std::vector(p_occupied.begin() + 7, p_occupied.end()), Each(Lt(0.03)));
}

TEST(PosteriorAlongRay, FollowsTheEquationsByHand) {
  const PosteriorModel model{.visibility = {.a = 0.9}, .p_occupied_at_sensor = 0.3};
  const auto q = posterior_along_ray(std::vector{0.2, 0.6}, model);
  const double first = 0.2 * 0.3 / (0.2 * 0.3 + 0.8 * 0.7);  // t = 1
  const double t = 0.5 + 0.5 * (0.72 / 0.74);
  const double predicted = t * first + (1.0 - t) * (1.0 - first);
  const double second = 0.6 * predicted / (0.6 * predicted + 0.4 * (1.0 - predicted));
  EXPECT_NEAR(q[0], first, 1e-14);
  EXPECT_NEAR(q[1], second, 1e-14);
}

TEST(PosteriorAlongRay, SurvivesCertaintyAndLength) {
  const PosteriorModel certain{.visibility = {.a = 1.0}, .p_occupied_at_sensor = 0.0};
  EXPECT_EQ(posterior_along_ray(std::vector{1.0, 0.5}, certain)[0], 0.5) << "a contradiction";
  EXPECT_NEAR(posterior(std::string(2000, '?')).back(), 0.5, 1e-9);
}

}  // namespace
}  // namespace vantage
