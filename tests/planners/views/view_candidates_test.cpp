#include "vantage/planners/views/view_candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

TEST(RingOfViews, FacesTheCentreFromTheCircle) {
  RingOfViews ring{.positions = 4, .radius_m = 2.0, .height_m = 1.0, .start_angle_rad = 0.3};
  ring.yaw_offsets_rad = {0.0};
  const Eigen::Vector3d centre(1.0, -1.0, 0.7);
  const auto views = ring_of_views(ring, centre);
  ASSERT_EQ(views.size(), 4U);
  for (const Candidate& view : views) {
    const Eigen::Vector3d p = view.T_world_sensor.inverse() * Eigen::Vector3d(1.0, -1.0, 1.0);
    EXPECT_TRUE(p.isApprox(Eigen::Vector3d(2.0, 0.0, 0.0), 1e-12)) << p.transpose();
    EXPECT_DOUBLE_EQ(view.T_world_sensor.translation().z(), 1.0);
    EXPECT_TRUE(view.T_world_sensor.linear().col(2).isApprox(Eigen::Vector3d::UnitZ()));
  }
  EXPECT_NEAR(views[0].T_world_sensor.translation().x(), 1.0 + 2.0 * std::cos(0.3), 1e-12);
}

TEST(RingOfViews, TurnsEachPositionByEveryOffset) {
  const auto views = ring_of_views({}, Eigen::Vector3d::Zero());
  ASSERT_EQ(views.size(), 30U);
  const double fifteen_deg = std::numbers::pi / 12.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].id, static_cast<int>(i));
    const Pose2 ahead = project_to_se2(views[i - i % 3 + 1].T_world_sensor);
    const Pose2 turned = project_to_se2(views[i].T_world_sensor);
    EXPECT_NEAR(wrap_angle(turned.yaw_rad - ahead.yaw_rad),
                (static_cast<double>(i % 3) - 1.0) * fifteen_deg, 1e-12);
    EXPECT_NEAR(turned.x_m, ahead.x_m, 1e-12);
  }
}

TEST(RingOfViews, RejectsOptionsOutOfRange) {
  RingOfViews none;
  none.yaw_offsets_rad.clear();
  EXPECT_THROW(ring_of_views(none, Eigen::Vector3d::Zero()), ConfigError);
  EXPECT_THROW(ring_of_views({.positions = 0}, Eigen::Vector3d::Zero()), ConfigError);
}

/// Five of them, to the left round the centre.
TEST(RingOfViews, StandsEvenlyAllRoundFromTheFirstBearingOn) {
  const RingOfViews ring{.positions = 5,
                         .radius_m = 2.0,
                         .height_m = 1.0,
                         .start_angle_rad = 0.3,
                         .yaw_offsets_rad = {0.1}};
  const auto views = ring_of_views(ring, {1.0, -1.0, 0.7});
  ASSERT_EQ(views.size(), 5U);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double bearing_rad = 0.3 + 0.4 * std::numbers::pi * static_cast<double>(i);
    const Eigen::Vector3d expected(1.0 + 2.0 * std::cos(bearing_rad),
                                   -1.0 + 2.0 * std::sin(bearing_rad), 1.0);
    EXPECT_TRUE(views[i].T_world_sensor.translation().isApprox(expected, 1e-12)) << i;
    const double off_rad =
        project_to_se2(views[i].T_world_sensor).yaw_rad - bearing_rad - std::numbers::pi;
    EXPECT_NEAR(wrap_angle(off_rad), 0.1, 1e-12) << i;
  }
}

}  // namespace
}  // namespace vantage
