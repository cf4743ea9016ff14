// Which views are taken on the way, and where the camera looks between them.
#include "vantage/planners/trajectory/view_schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

constexpr double kTau = 0.1;

/// Along x, a metre between waypoints.
Eigen::Matrix4Xd along_x(int count) {
  Eigen::Matrix4Xd points = Eigen::Matrix4Xd::Zero(4, count);
  for (int i = 0; i < count; ++i) points.col(i) << i, 0.0, 1.8, 0.0;
  return points;
}

ObservedObject object_to_see_at(double x, double y, double entropy_nats = 2.0) {
  ObservedObject object;
  object.ring = {.p_world_object_m = {x, y, 0.9}, .radius_m = 1.0, .height_m = 1.5};
  object.entropy_nats = entropy_nats;
  object.gain_nats.fill(0.6 * entropy_nats);
  return object;
}

class Schedule : public testing::Test {
 protected:
  [[nodiscard]] std::vector<ScheduledView> views() const {
    return schedule_views(options_, objects_, path_, kTau);
  }
  ViewsOnTheWay options_;
  std::vector<ObservedObject> objects_;
  Eigen::Matrix4Xd path_ = along_x(10);
};

TEST_F(Schedule, TakesAsManyViewsAsTellWhatItIs) {
  objects_ = {object_to_see_at(4.0, 1.0)};
  EXPECT_EQ(views().size(), 2U) << "0.6 of what is unknown each";
  objects_[0].gain_nats.fill(2.0);
  ASSERT_EQ(views().size(), 1U);
  EXPECT_EQ(views()[0].direction, 6) << "the one on the path";
  EXPECT_NEAR(views()[0].at_m, 4.0, 1e-9);
  objects_[0].entropy_nats = 0.05;
  EXPECT_TRUE(views().empty()) << "it is known";
  objects_.push_back(object_to_see_at(4.0, 1.0));
  ASSERT_EQ(views().size(), 2U) << "which says nothing of the next one";
  EXPECT_EQ(views()[0].object, 1U);
  objects_ = {object_to_see_at(4.0, 1.0, kTau)};
  EXPECT_EQ(views().size(), 1U) << "just not known";
}

TEST_F(Schedule, PrefersTheDirectionThatTells) {
  objects_ = {object_to_see_at(4.0, 1.0)};
  objects_[0].gain_nats.fill(0.1);
  objects_[0].gain_nats[5] = 2.0;  // before the path comes by
  ASSERT_EQ(views().size(), 1U);
  EXPECT_EQ(views()[0].direction, 5);
  objects_[0].used[5] = true;
  EXPECT_NE(views()[0].direction, 5);
}

// The path may sink on the way to where a view is taken.
TEST_F(Schedule, ReachIsMeasuredAside) {
  objects_ = {object_to_see_at(4.0, 1.0 + 0.9 * options_.reach_m)};
  const std::vector<ScheduledView> at_one_height = views();
  ASSERT_FALSE(at_one_height.empty());
  for (Eigen::Index i = 0; i < path_.cols(); ++i) path_(2, i) -= 0.15 * static_cast<double>(i);
  const std::vector<ScheduledView> sinking = views();
  ASSERT_EQ(sinking.size(), at_one_height.size());
  EXPECT_EQ(sinking[0].direction, at_one_height[0].direction);
  EXPECT_NEAR(sinking[0].utility, at_one_height[0].utility, 1e-9);
}

TEST_F(Schedule, PassesByWhatIsOutOfReach) {
  objects_ = {object_to_see_at(4.0, 1.0 + options_.reach_m + 0.1)};
  for (const ScheduledView& view : views()) EXPECT_EQ(view.direction, 6);
  objects_ = {object_to_see_at(4.0, 3.0)};
  EXPECT_TRUE(views().empty());
  objects_ = {object_to_see_at(4.0, 1.5)};
  options_.reach_m = 0.5;
  EXPECT_EQ(views().size(), 1U) << "just in reach";
  options_.reach_m = 0.49;
  EXPECT_TRUE(views().empty());
}

TEST_F(Schedule, IsInTheOrderOfThePathAndApart) {
  objects_ = {object_to_see_at(6.0, -1.0), object_to_see_at(3.0, 1.0), object_to_see_at(3.2, -1.0)};
  const auto all = views();
  ASSERT_GE(all.size(), 3U);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_GE(all[i].at_m - all[i - 1].at_m, options_.apart_m);
  }
  for (std::size_t object = 0; object < 3; ++object) {
    EXPECT_TRUE(std::ranges::any_of(all, [&](const ScheduledView& view) {
      return view.object == object;
    })) << object;
  }
}

TEST_F(Schedule, ViewsAreAsFarApartAsTheyMust) {
  objects_ = {object_to_see_at(4.0, 1.0), object_to_see_at(4.5, 1.0)};
  for (ObservedObject& object : objects_) {
    object.used.fill(true);
    object.used[6] = false;
  }
  options_.apart_m = 0.5;
  EXPECT_EQ(views().size(), 2U);
  options_.apart_m = 0.51;
  EXPECT_EQ(views().size(), 1U);
}

TEST_F(Schedule, LooksAheadBetweenViews) {
  options_.before_m = 1.2;
  options_.after_m = 0.4;
  const std::vector<ScheduledView> two{{.object = 0, .at_m = 2.5}, {.object = 1, .at_m = 7.0}};
  const auto of_point = views_of_points(options_, two, path_);
  ASSERT_EQ(of_point.size(), 10U);
  EXPECT_FALSE(of_point[1]);
  EXPECT_EQ(of_point[2], 0U);
  EXPECT_FALSE(of_point[3]) << "0.5 m beyond it";
  EXPECT_FALSE(of_point[5]);
  EXPECT_EQ(of_point[6], 1U);
  EXPECT_EQ(of_point[7], 1U);
  EXPECT_FALSE(of_point[8]);
}

/// Of what is unknown, and half as much half a metre from the path.
TEST_F(Schedule, AViewIsWorthWhatItTellsLessForItsDistance) {
  objects_ = {object_to_see_at(4.0, 1.2)};
  objects_[0].used.fill(true);
  objects_[0].used[6] = false;  // at (4.0, 0.2)
  objects_[0].gain_nats.fill(1.5);
  ASSERT_EQ(views().size(), 1U);
  EXPECT_NEAR(views()[0].utility, 1.5 * std::exp2(-0.4), 1e-9);
  objects_[0].gain_nats.fill(5.0);
  EXPECT_NEAR(views()[0].utility, 2.0 * std::exp2(-0.4), 1e-9) << "no more than is unknown";
  objects_[0].used[6] = true;
  objects_[0].used[5] = false;
  ASSERT_EQ(views().size(), 1U);
  EXPECT_NEAR(views()[0].at_m, 4.0 - std::sqrt(0.5), 1e-9) << "in metres along the path";
  path_.row(0) *= 2.0;
  EXPECT_NEAR(views()[0].at_m, 4.0 - std::sqrt(0.5), 1e-9) << "whatever waypoints are apart";
}

TEST_F(Schedule, LooksAtAViewForSoLongBeforeAndAfter) {
  const std::vector<ScheduledView> one{{.object = 0, .at_m = 4.0}};
  options_.before_m = 2.0;
  options_.after_m = 1.0;
  const auto of_point = views_of_points(options_, one, path_);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(of_point[i].has_value(), i >= 2 && i <= 5) << i;
  const std::vector<ScheduledView> two{{.object = 0, .at_m = 4.0}, {.object = 1, .at_m = 6.0}};
  const auto nearer = views_of_points(options_, two, path_);
  EXPECT_EQ(nearer[4], 0U);
  EXPECT_EQ(nearer[5], 1U) << "half of the way before the one, all of that after the other";
}

TEST_F(Schedule, WhatLeavesAnObjectJustUnknownIsNotEnough) {
  objects_ = {object_to_see_at(4.0, 1.0, 2.25)};
  objects_[0].gain_nats.fill(2.0);
  EXPECT_EQ(schedule_views(options_, objects_, path_, 0.25).size(), 2U);
  EXPECT_EQ(schedule_views(options_, objects_, path_, 0.3125).size(), 1U);
}

}  // namespace
}  // namespace vantage
