#include "vantage/perception/clouds/posts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/synthetic_room.hpp"

namespace vantage {
namespace {

constexpr PostOptions kOptions;

/// Four legs of 5 cm far from any wall.
support::SyntheticScene four_legs() {
  support::SyntheticScene scene;
  scene.room = {Eigen::Vector3d(-30, -30, 0), Eigen::Vector3d(30, 30, 2.5)};
  for (const double x : {-0.45, 0.45}) {
    for (const double y : {-0.45, 0.45}) {
      scene.boxes.push_back(support::box_at({x, y, 0.34}, {0.05, 0.05, 0.68}));
    }
  }
  return scene;
}

PlanarScan seen_from(const support::SyntheticScene& scene, const Pose2& pose, double sigma_m,
                     Rng& rng) {
  return support::floor_scan(scene, pose, sigma_m, rng);
}

TEST(Posts, AreTheMiddlesOfTheLegs) {
  Rng rng(1);
  const Pose2 pose = support::view_of_table(0.0);
  const auto posts = find_posts(seen_from(four_legs(), pose, 0.01, rng), kOptions);
  ASSERT_EQ(posts.size(), 4U);
  for (const Eigen::Vector2d& p_base : posts) {
    const Pose2 p = compose(pose, {p_base.x(), p_base.y(), 0.0});
    EXPECT_NEAR(std::abs(p.x_m), 0.45, 0.02);
    EXPECT_NEAR(std::abs(p.y_m), 0.45, 0.02);
  }
}

TEST(Posts, AWallIsNone) {
  Rng rng(1);
  EXPECT_TRUE(find_posts(seen_from({}, {}, 0.01, rng), kOptions).empty());
}

/// Once round the table in steps of 10 degrees, each fix the next one's guess but for odometry.
TEST(PostMap, KeepsTheRobotWithinACentimetreOfItsPlace) {
  Rng rng(3);
  const auto scene = four_legs();
  PostMap map(kOptions);
  map.remember(find_posts(seen_from(scene, support::view_of_table(0.0), 0.01, rng), kOptions),
               support::view_of_table(0.0));
  for (int step = 1; step <= 36; ++step) {
    const Pose2 truth = support::view_of_table(step * M_PI / 18.0);
    const Pose2 guess{truth.x_m + rng.uniform(-0.02, 0.02), truth.y_m + rng.uniform(-0.02, 0.02),
                      truth.yaw_rad + rng.uniform(-0.02, 0.02)};
    const auto posts = find_posts(seen_from(scene, truth, 0.01, rng), kOptions);
    const PostFix fix = map.locate(posts, guess);
    if (!fix.found) continue;  // one leg may hide another
    EXPECT_LT(std::hypot(fix.T_world_base.x_m - truth.x_m, fix.T_world_base.y_m - truth.y_m), 0.03)
        << step;
    EXPECT_LT(std::abs(wrap_angle(fix.T_world_base.yaw_rad - truth.yaw_rad)), 0.03) << step;
    EXPECT_NEAR(fix.information(0, 0), static_cast<double>(posts.size()) / 2.25e-4, 5e3);
    map.remember(posts, fix.T_world_base);
  }
  EXPECT_EQ(map.size(), 4U) << "no leg is remembered twice";
}

TEST(PostMap, OnePostFixesNothing) {
  PostMap map(kOptions);
  map.remember({{1.0, 0.0}}, {});
  EXPECT_FALSE(map.locate({{1.0, 0.0}}, {}).found);
  const std::vector<Eigen::Vector2d> close{{1.0, 0.0}, {1.2, 0.0}, {1.0, 0.2}};
  PostMap cluster(kOptions);
  cluster.remember(close, {});
  EXPECT_FALSE(cluster.locate(close, {}).found) << "too near each other for a heading";
}

TEST(PostMap, RefusesPostsThatDoNotFit) {
  const std::vector<Eigen::Vector2d> known{{1.0, 0.5}, {1.0, -0.5}, {2.0, 0.5}, {2.0, -0.5}};
  PostMap map(kOptions);
  map.remember(known, {});
  EXPECT_TRUE(map.locate(known, {0.02, 0.0, 0.01}).found);
  auto moved = known;
  moved[0].x() += 0.1;
  EXPECT_FALSE(map.locate(moved, {}).found);
}

constexpr float kPastPost = std::numeric_limits<float>::infinity();

/// Beams 0.02 rad apart from 0.1 rad on, from a scanner on the base's origin.
PlanarScan line_of_beams(std::vector<float> range_m) {
  PlanarScan scan;
  scan.range_max_m = 10.0;
  for (std::size_t i = 0; i < range_m.size(); ++i) {
    scan.azimuth_rad.push_back(0.1 + 0.02 * static_cast<double>(i));
  }
  scan.range_m = std::move(range_m);
  return scan;
}

std::size_t posts_in(std::vector<float> range_m, const PostOptions& options = {}) {
  return find_posts(line_of_beams(std::move(range_m)), options).size();
}

TEST(FindPosts, TheMiddleIsBehindTheMeanOfTheReturns) {
  PlanarScan scan = line_of_beams({5.0F, 2.0F, 2.0625F, 2.09375F, 5.0F});
  scan.azimuth_rad = {0.10, 0.12, 0.145, 0.16, 0.19};
  scan.T_base_sensor = {0.3, -0.1, 0.5};
  const auto posts = find_posts(scan, {});
  ASSERT_EQ(posts.size(), 1U);
  const double range_m = (2.0 + 2.0625 + 2.09375) / 3.0;
  const double middle_m = range_m + 0.375 * range_m * 0.02 * 3.0;
  const double bearing_rad = 0.5 + (0.12 + 0.145 + 0.16) / 3.0;
  EXPECT_NEAR(posts[0].x(), 0.3 + middle_m * std::cos(bearing_rad), 1e-9);
  EXPECT_NEAR(posts[0].y(), -0.1 + middle_m * std::sin(bearing_rad), 1e-9);
}

TEST(FindPosts, NeedBeamsThatGoPastOnBothSides) {
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F, kPastPost}), 1U);
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 5.0F}), 0U) << "a beam too few";
  EXPECT_EQ(posts_in({2.0F, 2.0F, 2.0F, 5.0F}), 0U) << "the line begins on it";
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F}), 0U) << "the line ends on it";
  EXPECT_EQ(posts_in({1.0F, 2.0F, 2.0F, 2.0F, 5.0F}), 0U) << "hidden on its right";
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F, 1.0F}), 0U) << "hidden on its left";
  EXPECT_EQ(posts_in({NAN, 2.0F, 2.0F, 2.0F, 5.0F}), 0U);
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F, NAN}), 0U);
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F, 5.0F, 5.0F, 1.0F, 1.0F, 1.0F, 5.0F}), 2U);
}

TEST(FindPosts, AStepOfTheGapPartsAndAStepBelowItDoesNot) {
  const PostOptions options{.max_width_m = 1.0, .gap_m = 0.125};
  const float behind_m = 2.125F;
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F, 2.0F, behind_m, behind_m, behind_m, behind_m, 5.0F},
                     options),
            0U)
      << "two parts, and no beam goes past the near one on that side";
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F, 2.12F, 2.12F, 2.12F, 5.0F}, options), 1U);
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.1F, 2.2F, 5.0F}, options), 1U) << "neighbours are compared";
  EXPECT_EQ(posts_in({5.0F, 2.0F, 2.0F, 2.0F, 2.126F, 5.0F}, options), 1U);
}

TEST(FindPosts, WidthIsOfAllBeamsAtTheMeanRange) {
  PlanarScan scan = line_of_beams({5.0F, 2.0F, 2.0F, 2.0F, 2.0F, 5.0F});
  for (std::size_t i = 0; i < 6; ++i) {
    scan.azimuth_rad[i] = 0.03125 * static_cast<double>(i);  // the post is 0.25 m wide
  }
  EXPECT_EQ(find_posts(scan, {.max_width_m = 0.25}).size(), 1U);
  EXPECT_EQ(find_posts(scan, {.max_width_m = 0.249}).size(), 0U);
}

TEST(FindPosts, ReturnsReachToTheEndOfTheRange) {
  const PostOptions wide{.max_width_m = 1.0};
  EXPECT_EQ(posts_in({kPastPost, 10.0F, 10.0F, 10.0F, kPastPost}, wide), 1U);
  EXPECT_EQ(posts_in({kPastPost, 10.01F, 10.01F, 10.01F, kPastPost}, wide), 0U);
}

/// Their middle is (1.5, 0.25).
const std::vector<Eigen::Vector2d> kThreePosts{{1.0, 0.5}, {2.0, -0.75}, {1.5, 1.0}};

TEST(PostMap, FindsThePoseThatPostsWereSeenFrom) {
  const Pose2 truth{1.0, -2.0, 0.7};
  PostMap map(kOptions);
  map.remember(kThreePosts, truth);
  ASSERT_EQ(map.size(), 3U);
  const PostFix fix = map.locate(kThreePosts, {1.02, -2.03, 0.71});
  ASSERT_TRUE(fix.found);
  EXPECT_NEAR(fix.T_world_base.x_m, 1.0, 1e-12);
  EXPECT_NEAR(fix.T_world_base.y_m, -2.0, 1e-12);
  EXPECT_NEAR(fix.T_world_base.yaw_rad, 0.7, 1e-12);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (const auto& p : kThreePosts) {
    const double x = std::cos(0.7) * p.x() - std::sin(0.7) * p.y();
    const double y = std::sin(0.7) * p.x() + std::cos(0.7) * p.y();
    expected += Eigen::Matrix3d{{1.0, 0.0, -y}, {0.0, 1.0, x}, {-y, x, x * x + y * y}};
  }
  EXPECT_LT((fix.information - expected / (0.015 * 0.015)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(PostMap, APostIsTheMeanOfWhereItWasSeen) {
  PostMap map(kOptions);
  for (const double x_m : {0.0, 0.06, 0.09}) map.remember(kThreePosts, {x_m, 0.5 * x_m, 0.0});
  ASSERT_EQ(map.size(), 3U);
  const PostFix fix = map.locate(kThreePosts, {});
  ASSERT_TRUE(fix.found);
  EXPECT_NEAR(fix.T_world_base.x_m, 0.05, 1e-12);
  EXPECT_NEAR(fix.T_world_base.y_m, 0.025, 1e-12);
  EXPECT_NEAR(fix.T_world_base.yaw_rad, 0.0, 1e-12);
}

TEST(PostMap, APostIsAnotherFromTheDistanceOn) {
  const PostOptions options{.same_m = 0.125};
  PostMap map(options);
  map.remember({{1.0, 0.5}}, {});
  map.remember({{1.124, 0.5}}, {});
  EXPECT_EQ(map.size(), 1U);
  PostMap apart(options);
  apart.remember({{1.0, 0.5}}, {});
  apart.remember({{1.125, 0.5}}, {});
  EXPECT_EQ(apart.size(), 2U);
}

TEST(PostMap, PairsPostsWithinTheDistance) {
  PostMap map({.same_m = 0.125});
  map.remember(kThreePosts, {});
  EXPECT_TRUE(map.locate(kThreePosts, {0.125, 0.0, 0.0}).found);
  const PostFix lost = map.locate(kThreePosts, {0.126, 0.0, 0.0});
  EXPECT_FALSE(lost.found);
  EXPECT_EQ(lost.T_world_base.x_m, 0.126) << "the guess";
  auto more = kThreePosts;
  more.insert(more.begin(), {9.0, 9.0});
  EXPECT_TRUE(map.locate(more, {}).found) << "one that is not known does no harm";
  EXPECT_FALSE(PostMap(kOptions).locate(kThreePosts, {}).found);
}

TEST(PostMap, SpreadAndMisfitHaveLimits) {
  const auto cross = [](double arm_m) {
    return std::vector<Eigen::Vector2d>{
        {2.0 + arm_m, 1.0}, {2.0 - arm_m, 1.0}, {2.0, 1.0 + arm_m}, {2.0, 1.0 - arm_m}};
  };
  PostMap narrow({.min_spread_m = 0.25});
  narrow.remember(cross(0.25), {});
  EXPECT_TRUE(narrow.locate(cross(0.25), {}).found);
  PostMap narrower({.min_spread_m = 0.25});
  narrower.remember(cross(0.24), {});
  EXPECT_FALSE(narrower.locate(cross(0.24), {}).found);
  PostMap map(kOptions);
  map.remember(cross(0.5), {});
  EXPECT_TRUE(map.locate(cross(0.555), {}).found) << "each 5.5 cm off, of 6 cm";
  EXPECT_FALSE(map.locate(cross(0.565), {}).found);
  PostMap sixteenths({.sigma_m = 0.015625});
  sixteenths.remember(cross(0.5), {});
  EXPECT_TRUE(sixteenths.locate(cross(0.5625), {}).found) << "just four standard deviations";
}

}  // namespace
}  // namespace vantage
