#include "vantage/planners/objects/orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

constexpr double kPi = std::numbers::pi;
const Orbit kOrbit{.centre_m = {1.0, 2.0, 0.7}, .radius_m = 1.5, .height_m = 0.9};

TEST(Orbit, PlacesLookAtTheAxis) {
  for (const double bearing : {-3.0, -0.4, 0.0, 1.0, kPi}) {
    const Pose place = kOrbit.place(bearing);
    const Eigen::Vector3d to_centre = kOrbit.centre_m - place.translation();
    EXPECT_NEAR(to_centre.head<2>().norm(), 1.5, 1e-12);
    EXPECT_NEAR(to_centre.z(), -0.9, 1e-12);
    EXPECT_NEAR(place.linear().col(0).dot(to_centre), 1.5, 1e-12) << "x axis towards the axis";
    EXPECT_NEAR(place.linear()(2, 2), 1.0, 1e-12);
    EXPECT_NEAR(wrap_angle(kOrbit.bearing_rad(place.translation()) - bearing), 0.0, 1e-12);
  }
}

TEST(Orbit, AtAnElevation) {
  const Orbit orbit = Orbit::at_elevation({0.0, 0.0, 1.0}, 2.0, kPi / 6.0);
  EXPECT_NEAR(orbit.radius_m, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(orbit.height_m, 1.0, 1e-12);
}

TEST(OrbitArc, GoesTheShortWayInEvenSteps) {
  const std::vector<Pose> arc = orbit_arc(kOrbit, 3.0, -3.0, 0.1);  // 0.283 rad, across pi
  ASSERT_EQ(arc.size(), 3U);
  const double step_rad = (2.0 * kPi - 6.0) / 3.0;
  for (std::size_t i = 0; i < arc.size(); ++i) {
    const double bearing = 3.0 + step_rad * static_cast<double>(i + 1);
    EXPECT_TRUE(arc[i].isApprox(kOrbit.place(bearing), 1e-9)) << i;
  }
}

TEST(OrbitArc, EndsEvenWhereItBegins) {
  const std::vector<Pose> arc = orbit_arc(kOrbit, 0.5, 0.5, 0.1);
  ASSERT_EQ(arc.size(), 1U);
  EXPECT_TRUE(arc[0].isApprox(kOrbit.place(0.5), 1e-12));
}

}  // namespace
}  // namespace vantage
