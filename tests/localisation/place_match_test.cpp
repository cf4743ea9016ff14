// Whether a scan is of a place, and from where.
#include "vantage/localisation/place_match.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/localisation/plan_world.hpp"

namespace vantage {
namespace {

using namespace test_plan;

RegistrationOptions options() {
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  return registration;
}

TEST(PlaceMatch, FindsACornerFromFarOff) {
  Rng rng(1);
  const auto walls = ring(15.0, 28.0, 2.0);
  const Pose2 truth{-6.5, -12.0, 1.2};
  const PointCloud place = scan(walls, {-6.3, -12.6, 1.0}, 0.01, rng, options());
  const PointCloud now = scan(walls, truth, 0.01, rng, options());
  const Pose2 T_place_now = compose(inverse(Pose2{-6.3, -12.6, 1.0}), truth);
  const Pose2 off{T_place_now.x_m + 0.55, T_place_now.y_m - 0.35, T_place_now.yaw_rad + 0.06};
  const Pose2 found = search_pose(now, place, off, {0.8, 0.1});
  EXPECT_NEAR(found.x_m, T_place_now.x_m, 0.1);
  EXPECT_NEAR(found.y_m, T_place_now.y_m, 0.1);
  EXPECT_NEAR(found.yaw_rad, T_place_now.yaw_rad, 0.025);
  EXPECT_GT(agreement(now, place, T_place_now).share, 0.95);
  EXPECT_LT(agreement(now, place, off).share, 0.1);
}

/// Between plain walls all places along them fit alike, but for the ends of what is known of them:
/// none is much better than the guess.
TEST(PlaceMatch, AlongPlainWallsTheGuessStays) {
  Rng rng(2);
  std::vector<Segment> walls;
  add_box(walls, -50.0, -1.0, 50.0, 1.0);
  const PointCloud place = scan(walls, {0.0, 0.0, 0.0}, 0.01, rng, options());
  const PointCloud now = scan(walls, {0.0, 0.0, 0.0}, 0.01, rng, options());
  const Pose2 found = search_pose(now, place, {0.4, 0.3, 0.0}, {0.6, 0.05});
  EXPECT_NEAR(found.x_m, 0.4, 0.21) << "along";
  EXPECT_NEAR(found.y_m, 0.0, 0.06) << "across";
}

TEST(PlaceMatch, AnotherPlaceDoesNotAgree) {
  Rng rng(3);
  const auto walls = ring(15.0, 28.0, 2.0);
  const PointCloud corner = scan(walls, {-6.5, -12.6, 0.0}, 0.01, rng, options());
  const PointCloud other = scan(walls, {6.5, -12.6, 0.0}, 0.01, rng, options());
  const Pose2 best = search_pose(other, corner, {}, {1.0, 0.1});
  EXPECT_LT(agreement(other, corner, best).share, 0.72);
}

/// Points on walls along x, and two that are on none and say how far the place is known.
struct Points {
  PointCloud cloud;

  void add(double x, double y, double normal_x = 0.0, double normal_y = 1.0) {
    cloud.points.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.25F);
    cloud.normals.emplace_back(static_cast<float>(normal_x), static_cast<float>(normal_y), 0.0F);
  }
  void add_times(int count, double x, double y) {
    for (int i = 0; i < count; ++i) add(x, y);
  }
  static Points known_around() {
    Points points;
    points.add(-1.025, -1.025, 0.0, 0.0);
    points.add(5.025, 1.025, 0.0, 0.0);
    return points;
  }
};

TEST(PlaceMatch, APointStandsForAWallToBothSides) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  Points now;
  now.add(0.0, 0.0);
  const auto found_x_m = [&](double guess_x_m) {
    const Pose2 found = search_pose(now.cloud, place.cloud, {guess_x_m, 0.0, 0.0}, {0.05, 0.0});
    EXPECT_NEAR(found.y_m, 0.0, 1e-9);
    return found.x_m;
  };
  EXPECT_NEAR(found_x_m(0.2), 0.2, 1e-9);
  EXPECT_NEAR(found_x_m(0.25), 0.2, 1e-9);
  EXPECT_NEAR(found_x_m(-0.2), -0.2, 1e-9);
  EXPECT_NEAR(found_x_m(-0.25), -0.2, 1e-9);
}

/// Of a hundred points so many would rather be 5 cm to the left, and no other minds: each wins a
/// third of a hit.
TEST(PlaceMatch, TheGuessIsLeftForWhatIsWorthIt) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  place.add(0.0, 0.5);
  const auto found_x_m = [&](int rather, double window_m) {
    Points now;
    now.add_times(100 - rather, 0.0, 0.0);
    now.add_times(rather, 0.25, 0.5);
    return search_pose(now.cloud, place.cloud, {}, {window_m, 0.0}).x_m;
  };
  EXPECT_NEAR(found_x_m(17, 0.05), 0.0, 1e-9);
  EXPECT_NEAR(found_x_m(19, 0.05), -0.05, 1e-9);
  EXPECT_NEAR(found_x_m(4, 0.1), 0.0, 1e-9) << "a quarter of that, halfway to the edge";
  EXPECT_NEAR(found_x_m(5, 0.1), -0.05, 1e-9);
}

TEST(PlaceMatch, TheGuessIsTurnedForWhatIsWorthIt) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  place.add(4.0, 0.0);
  const auto found_rad = [&](int rather, double window_rad) {
    Points now;
    now.add_times(100 - rather, 0.0, 0.0);
    now.add_times(rather, 4.0, -0.05);
    return search_pose(now.cloud, place.cloud, {}, {0.0, window_rad}).yaw_rad;
  };
  EXPECT_NEAR(found_rad(17, 0.0125), 0.0, 1e-9);
  EXPECT_NEAR(found_rad(19, 0.0125), 0.0125, 1e-9);
  EXPECT_NEAR(found_rad(4, 0.025), 0.0, 1e-9) << "a quarter of that, halfway to the edge";
  EXPECT_NEAR(found_rad(5, 0.025), 0.0125, 1e-9);
}

/// A step to either side the point is in the row beside a wall.
TEST(PlaceMatch, OfTwoTurnsThatFitAlikeTheClockwiseOneIsFound) {
  Points place = Points::known_around();
  place.add(4.0, 0.1);
  place.add(4.0, -0.1);
  Points now;
  now.add(4.0, 0.0);
  EXPECT_NEAR(search_pose(now.cloud, place.cloud, {}, {0.0, 0.0125}).yaw_rad, -0.0125, 1e-9);
}

/// Every second point would rather be to the left. Of more than 300 only the others are asked.
TEST(PlaceMatch, ThreeHundredPointsAreEnough) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  place.add(0.0, 0.5);
  for (const int count : {300, 301}) {
    Points now;
    for (int i = 0; i < count; ++i) now.add(i % 2 == 0 ? 0.0 : 0.25, i % 2 == 0 ? 0.0 : 0.5);
    const Pose2 found = search_pose(now.cloud, place.cloud, {}, {0.05, 0.0});
    EXPECT_NEAR(found.x_m, count == 300 ? -0.05 : 0.0, 1e-9) << count;
  }
}

TEST(PlaceMatch, AgreementIsOfPointsOnTheSurfaceThatFaceAsItDoes) {
  Points place;
  place.add(0.0, 0.0);
  place.add(3.0, 0.0, 0.0, 0.0);
  Points there;
  there.add(0.0, 0.07);
  there.add(0.0, -0.07);
  there.add(0.0, 0.09);   // off
  there.add(0.0, -0.09);  // off
  there.add(0.45, 0.0);
  there.add(0.55, 0.0);  // too far to be told
  there.add(0.0, 0.0, std::sqrt(1.0 - 0.75 * 0.75), 0.75);
  there.add(0.0, 0.0, std::sqrt(1.0 - 0.65 * 0.65), 0.65);  // faces elsewhere
  there.add(0.0, 0.0, 0.0, 0.0);                            // on no surface
  there.add(3.0, 0.0);                                      // where none is known
  const Pose2 T_place_scan{1.0, -2.0, 0.5};
  const PointCloud now = transform(there.cloud, to_se3(inverse(T_place_scan)));
  const Agreement agreed = agreement(now, place.cloud, T_place_scan);
  EXPECT_EQ(agreed.near, 7U);
  EXPECT_NEAR(agreed.share, 4.0 / 7.0, 1e-12);
}

TEST(LocalisationDefaults, AreOfNothing) {
  EXPECT_EQ(WheelStep{}.driven_m, 0.0);
  EXPECT_EQ(SearchWindow{}.shift_m, 0.0);
  EXPECT_EQ(SearchWindow{}.turn_rad, 0.0);
  EXPECT_EQ(Agreement{}.near, 0U);
  EXPECT_EQ(Agreement{}.share, 0.0);
  EXPECT_EQ(PoseEdge{}.from, 0U);
  EXPECT_EQ(PoseEdge{}.to, 0U);
}

TEST(PlaceMatch, AgreementCountsWhatFacesTheSameWay) {
  EXPECT_EQ(Agreement{}.facing, 0U);
  Points place;
  place.add(0.0, 0.0);
  Points now;
  now.add(0.0, 0.02);
  Agreement agreed = agreement(now.cloud, place.cloud, {});
  EXPECT_EQ(agreed.near, 1U);
  EXPECT_EQ(agreed.facing, 1U);
  EXPECT_EQ(agreed.share, 1.0);
  now.add(0.0, 0.3);             // faces so, and is off
  now.add(0.0, 0.0, 0.0, -1.0);  // from behind
  agreed = agreement(now.cloud, place.cloud, {});
  EXPECT_EQ(agreed.near, 3U);
  EXPECT_EQ(agreed.facing, 2U);
  EXPECT_NEAR(agreed.share, 1.0 / 3.0, 1e-12);
  agreed = agreement(now.cloud, place.cloud, {10.0, 0.0, 0.0});
  EXPECT_EQ(agreed.near, 0U);
  EXPECT_EQ(agreed.facing, 0U);
  EXPECT_EQ(agreed.share, 0.0);
}

/// A scanner that sees nothing in range leaves a keyframe without points.
TEST(PlaceMatch, NothingAgreesWithNothing) {
  Points place;
  place.add(0.0, 0.0);
  EXPECT_EQ(agreement({}, place.cloud, {}).near, 0U);
  EXPECT_EQ(agreement(place.cloud, {}, {}).near, 0U);
  EXPECT_EQ(agreement({}, {}, {}).facing, 0U);
}

/// As TheGuessIsLeftForWhatIsWorthIt, a quarter turned.
TEST(PlaceMatch, TheGuessIsLeftToEitherAxisForWhatIsWorthIt) {
  Points place = Points::known_around();
  place.add(0.0, 0.0, 1.0, 0.0);
  place.add(0.5, 0.0, 1.0, 0.0);
  const auto found_y_m = [&](int rather, double window_m) {
    Points now;
    now.add_times(100 - rather, 0.0, 0.0);
    now.add_times(rather, 0.5, 0.25);
    return search_pose(now.cloud, place.cloud, {}, {window_m, 0.0}).y_m;
  };
  EXPECT_NEAR(found_y_m(17, 0.05), 0.0, 1e-9);
  EXPECT_NEAR(found_y_m(19, 0.05), -0.05, 1e-9);
  EXPECT_NEAR(found_y_m(4, 0.1), 0.0, 1e-9);
  EXPECT_NEAR(found_y_m(5, 0.1), -0.05, 1e-9);
}

/// A surface at the rim of what is known counts beside it too, on either side.
TEST(PlaceMatch, SurfacesAtTheRimOfAPlaceAreDrawnWhole) {
  Points place;
  place.add(0.0, 0.0);
  const auto found_y_m = [&](double y_m) {
    Points now;
    now.add(0.0, y_m);
    return search_pose(now.cloud, place.cloud, {}, {0.05, 0.0}).y_m;
  };
  EXPECT_NEAR(found_y_m(0.11), -0.05, 1e-9);
  EXPECT_NEAR(found_y_m(-0.06), 0.05, 1e-9);
}

TEST(PlaceMatch, TheSearchGoesBeyondItsWindowRatherThanShortOfIt) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  place.add(4.0, 0.0);
  Points beside;
  beside.add(0.0, 0.1);
  EXPECT_NEAR(search_pose(beside.cloud, place.cloud, {}, {0.07, 0.0}).y_m, -0.1, 1e-9)
      << "in steps of 5 cm";
  Points turned_off;
  turned_off.add(4.0, -0.1);
  EXPECT_NEAR(search_pose(turned_off.cloud, place.cloud, {}, {0.0, 0.02}).yaw_rad, 0.025, 1e-9)
      << "in steps of 12.5 mrad";
}

/// A row beside a wall is worth two thirds of it, the next one nothing.
TEST(PlaceMatch, AWallIsThreeCellsWide) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  const auto found = [&](double x_m, double y_m) {
    Points now;
    now.add(x_m, y_m);
    return search_pose(now.cloud, place.cloud, {}, {0.05, 0.0});
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(found(0.0, 0.1 * side).y_m, -0.05 * side, 1e-9);
    EXPECT_NEAR(found(0.3 * side, 0.0).x_m, -0.05 * side, 1e-9);
    EXPECT_NEAR(found(0.0, 0.2 * side).y_m, 0.0, 1e-9);
  }
}

TEST(PlaceMatch, BeyondTheRimOfAPlaceNothingIsKnown) {
  Points place;
  place.add(0.0, 0.0);
  const auto found_x_m = [&](double x_m, double window_m) {
    Points now;
    now.add(x_m, 0.0);
    return search_pose(now.cloud, place.cloud, {}, {window_m, 0.0}).x_m;
  };
  EXPECT_NEAR(found_x_m(0.13, 0.05), -0.05, 1e-9) << "though a wall goes on for 20 cm";
  EXPECT_NEAR(found_x_m(0.18, 0.05), 0.0, 1e-9);
}

TEST(PlaceMatch, NoPlaceWithoutASurfaceIsBetterThanAnother) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  for (const double x_m : {5.05, 5.15}) {
    Points now;
    now.add(x_m, 0.5);
    EXPECT_NEAR(search_pose(now.cloud, place.cloud, {}, {0.1, 0.0}).x_m, 0.0, 1e-9) << x_m;
  }
}

TEST(PlaceMatch, OfAScanWithoutSurfacesTheGuessStays) {
  Points place = Points::known_around();
  place.add(0.0, 0.0);
  Points now;
  now.add(0.0, 0.05, 0.0, 0.0);
  const Pose2 found = search_pose(now.cloud, place.cloud, {0.5, -0.5, 0.25}, {0.1, 0.05});
  EXPECT_EQ(found.x_m, 0.5);
  EXPECT_EQ(found.y_m, -0.5);
  EXPECT_EQ(found.yaw_rad, 0.25);
}

}  // namespace
}  // namespace vantage
