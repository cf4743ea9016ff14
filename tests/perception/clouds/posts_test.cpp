#include "vantage/perception/clouds/posts.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace vantage
