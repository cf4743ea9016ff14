#include "vantage/perception/clouds/kd_tree.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

std::vector<Eigen::Vector3f> random_points(std::size_t count, Rng& rng) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
  }
  return points;
}

/// Every point's distance from `p`, nearest first.
std::vector<Neighbour> brute_force(const std::vector<Eigen::Vector3f>& points,
                                   const Eigen::Vector3f& p) {
  std::vector<Neighbour> all;
  for (std::size_t i = 0; i < points.size(); ++i) all.push_back({i, (points[i] - p).squaredNorm()});
  std::ranges::sort(all, {}, &Neighbour::distance2_m2);
  return all;
}

RC_GTEST_PROP(KdTree, FindsWhatExhaustiveSearchFinds, (std::uint64_t seed)) {
  Rng rng(seed);
  const auto points = random_points(1 + rng.uniform_index(150), rng);
  const KdTree tree(points);
  const Eigen::Vector3f p = random_points(1, rng).front();
  const auto expected = brute_force(points, p);

  const auto nearest = tree.nearest(p, 10.0);
  RC_ASSERT(nearest.has_value());
  RC_ASSERT(nearest->index == expected.front().index);

  const std::size_t count = 1 + rng.uniform_index(20);
  const auto some = tree.nearest_k(p, count);
  RC_ASSERT(some.size() == std::min(count, points.size()));
  for (std::size_t i = 0; i < some.size(); ++i) RC_ASSERT(some[i].index == expected[i].index);

  const double radius_m = rng.uniform(0.05, 1.5);
  const auto within = tree.within(p, radius_m);
  const auto nearer = std::ranges::count_if(expected, [&](const Neighbour& n) {
    return n.distance2_m2 < static_cast<float>(radius_m * radius_m);
  });
  RC_ASSERT(static_cast<std::ptrdiff_t>(within.size()) == nearer);
  for (std::size_t i = 0; i < within.size(); ++i) RC_ASSERT(within[i].index == expected[i].index);
}

TEST(KdTree, NothingNearEnough) {
  const KdTree tree({{1, 0, 0}});
  EXPECT_TRUE(tree.nearest({0, 0, 0}, 1.01).has_value());
  EXPECT_FALSE(tree.nearest({0, 0, 0}, 0.99).has_value());
}

TEST(KdTree, EmptyTreeFindsNothing) {
  const KdTree tree({});
  EXPECT_EQ(tree.size(), 0U);
  EXPECT_FALSE(tree.nearest({0, 0, 0}, 1.0).has_value());
  EXPECT_TRUE(tree.nearest_k({0, 0, 0}, 3).empty());
  EXPECT_TRUE(tree.within({0, 0, 0}, 1.0).empty());
}

TEST(KdTree, ManyEqualPoints) {
  const KdTree tree(std::vector<Eigen::Vector3f>(100, Eigen::Vector3f(1, 2, 3)));
  const auto all = tree.within({1, 2, 3}, 0.1);
  ASSERT_EQ(all.size(), 100U);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].index, i);
}

TEST(KdTree, SurvivesAMove) {
  KdTree tree({{0, 0, 0}, {5, 0, 0}});
  KdTree moved = std::move(tree);
  EXPECT_EQ(moved.nearest({4, 0, 0}, 2.0)->index, 1U);
}

TEST(KdTree, ReachesToADistanceOrUpToARadius) {
  const KdTree tree({{1, 0, 0}, {0, 2, 0}, {0, 0, -2}});
  const auto at = tree.nearest({0, 0, 0}, 1.0);
  ASSERT_TRUE(at.has_value());
  EXPECT_EQ(at->index, 0U);
  EXPECT_EQ(at->distance2_m2, 1.0F);
  EXPECT_TRUE(tree.within({0, 0, 0}, 1.0).empty());
  EXPECT_EQ(tree.within({0, 0, 0}, 2.0).size(), 1U);
  const auto all = tree.within({0, 0, 0}, 2.1);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].index, 1U) << "of equal distances the lower index";
  EXPECT_EQ(all[2].distance2_m2, 4.0F);
}

TEST(KdTree, GivesAsManyAsAreAskedForAndThere) {
  const KdTree tree({{3, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(tree.size(), 3U);
  EXPECT_EQ(tree.points()[2], Eigen::Vector3f(2, 0, 0));
  EXPECT_TRUE(tree.nearest_k({0, 0, 0}, 0).empty());
  const auto two = tree.nearest_k({0, 0, 0}, 2);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].index, 1U);
  EXPECT_EQ(two[1].index, 2U);
  EXPECT_EQ(two[1].distance2_m2, 4.0F);
  EXPECT_EQ(tree.nearest_k({0, 0, 0}, 7).size(), 3U);
}

}  // namespace
}  // namespace vantage
