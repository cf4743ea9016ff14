#include "vantage/planners/objects/orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

const Orbit kOrbit{.centre_m = {1.0, 2.0, 0.7}, .radius_m = 1.5, .height_m = 0.9};

TEST(Orbit, PlacesLookAtTheAxis) {
  for (const double bearing : {-3.0, -0.4, 0.0, 1.0, std::numbers::pi}) {
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
  const Orbit orbit = Orbit::at_elevation({0.0, 0.0, 1.0}, 2.0, std::numbers::pi / 6.0);
  EXPECT_NEAR(orbit.radius_m, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(orbit.height_m, 1.0, 1e-12);
}

TEST(OrbitArc, GoesTheShortWayInEvenSteps) {
  const std::vector<Pose> arc = orbit_arc(kOrbit, 3.0, -3.0, 0.1);  // 0.283 rad, across pi
  ASSERT_EQ(arc.size(), 3U);
  const double step_rad = (2.0 * std::numbers::pi - 6.0) / 3.0;
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

TEST(OrbitWay, OnOneOrbitIsItsArc) {
  const std::vector<Pose> way = orbit_way(kOrbit, 0.3, kOrbit, 1.4, 0.2);
  const std::vector<Pose> arc = orbit_arc(kOrbit, 0.3, 1.4, 0.2);
  ASSERT_EQ(way.size(), arc.size());
  for (std::size_t i = 0; i < way.size(); ++i) EXPECT_EQ(way[i].matrix(), arc[i].matrix());
}

TEST(OrbitWay, TheLongWayGoesRoundTheOtherSide) {
  const std::vector<Pose> way = orbit_way(kOrbit, 0.3, kOrbit, 1.3, 0.2, {.long_way = true});
  EXPECT_EQ(way.size(), 27U) << "5.28 rad";
  EXPECT_NEAR(kOrbit.bearing_rad(way.front().translation()),
              0.3 - (2.0 * std::numbers::pi - 1.0) / 27.0, 1e-9);
  EXPECT_TRUE(way.back().isApprox(kOrbit.place(1.3), 1e-9));
  for (const Pose& place : way) {
    const double bearing = kOrbit.bearing_rad(place.translation());
    EXPECT_FALSE(bearing > 0.31 && bearing < 1.29) << bearing;
  }
}

TEST(OrbitWay, RisesInBetweenAndEndsLevel) {
  const std::vector<Pose> way = orbit_way(kOrbit, 0.0, kOrbit, 0.4, 0.1, {.rise_m = 0.5});
  EXPECT_NEAR(way[1].translation().z(), kOrbit.place(0.0).translation().z() + 0.5, 1e-9);
  EXPECT_NEAR(way.back().translation().z(), kOrbit.place(0.0).translation().z(), 1e-9);
}

/// Keeps its distance from both centres and from what lies between them.
TEST(OrbitWay, FromOneOrbitToAnotherKeepsItsDistance) {
  Orbit to = kOrbit;
  to.centre_m += Eigen::Vector3d(0.6, -0.2, 0.0);
  const std::vector<Pose> way = orbit_way(kOrbit, 2.0, to, -1.5, 0.1);
  EXPECT_TRUE(way.back().isApprox(to.place(-1.5), 1e-9));
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double t = static_cast<double>(i + 1) / static_cast<double>(way.size());
    const Eigen::Vector3d centre = (1.0 - t) * kOrbit.centre_m + t * to.centre_m;
    EXPECT_NEAR((way[i].translation() - centre).head<2>().norm(), 1.5, 1e-9);
  }
}

/// 0.4 - 0.1 is a little more than three times 0.1.
TEST(OrbitArc, TakesNoStepForRounding) {
  EXPECT_EQ(orbit_arc(kOrbit, 0.1, 0.4, 0.1).size(), 3U);
  EXPECT_EQ(orbit_arc(kOrbit, 0.1, 0.401, 0.1).size(), 4U);
  EXPECT_DEATH(orbit_arc(kOrbit, 0.1, 0.4, 0.0), "a step along an arc");
}

/// Three metres, which are 1.5 rad as seen from 2 m.
TEST(OrbitWay, StepsAreNoLongerWhereTheCentreMoves) {
  const Orbit to{.centre_m = kOrbit.centre_m + Eigen::Vector3d(1.8, -2.4, 0.0),
                 .radius_m = 2.0,
                 .height_m = 0.4};
  const std::vector<Pose> way = orbit_way(kOrbit, 0.5, to, 0.5, 0.5);
  ASSERT_EQ(way.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = static_cast<double>(i + 1) / 3.0;
    Orbit at = to;
    at.centre_m = kOrbit.centre_m + share * Eigen::Vector3d(1.8, -2.4, 0.0);
    EXPECT_TRUE(way[i].isApprox(at.place(0.5), 1e-9)) << i;
  }
  EXPECT_EQ(orbit_way(kOrbit, 0.5, to, 0.5, 0.49).size(), 4U);
  EXPECT_EQ(orbit_way(kOrbit, 0.5, to, 0.5, 1.5).size(), 1U) << "level, one step is enough";
  EXPECT_DEATH(orbit_way(kOrbit, 0.5, to, 0.5, 0.0), "a step along a way");
}

TEST(OrbitWay, RisesInTwoStepsWhereItStays) {
  const std::vector<Pose> way = orbit_way(kOrbit, 0.5, kOrbit, 0.5, 0.1, {.rise_m = 0.4});
  ASSERT_EQ(way.size(), 2U);
  EXPECT_NEAR(way[0].translation().z(), 0.7 + 0.9 + 0.4, 1e-9);
  EXPECT_TRUE(way[1].isApprox(kOrbit.place(0.5), 1e-9));
}

/// Of a tenth of a radian each.
TEST(OrbitWay, TakesNoStepForABillionthOfOne) {
  for (const double rise_m : {0.0, 0.1}) {
    const auto steps = [&](double turn) {
      return orbit_way(kOrbit, 0.0, kOrbit, 0.1 * turn, 0.1, {.rise_m = rise_m}).size();
    };
    EXPECT_EQ(steps(3.0 + 7e-10), 3U) << rise_m;
    EXPECT_EQ(steps(3.0 + 1.5e-9), 4U) << rise_m;
  }
}

}  // namespace
}  // namespace vantage
