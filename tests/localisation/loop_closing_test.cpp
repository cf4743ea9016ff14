// When a place is one of long ago, which loops wait, are taken or refused: of a robot that stands
// in a room whose points it sees without noise, while its wheels count as it is told.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/localisation/room_of_points.hpp"
#include "vantage/core/error.hpp"
#include "vantage/localisation/keyframe_graph.hpp"

namespace vantage {
namespace {

using test_room::InARoom;
using test_room::kSureWheels_m;
using test_room::room_and_pillar;
using test_room::tall;

TEST(LoopClosing, WaitsForASecondLoopThatAgrees) {
  InARoom room(test_room::walls());
  EXPECT_FALSE(room.stay(12.0));
  EXPECT_EQ(room.graph().loops(), 0U);
  EXPECT_TRUE(room.stay(1.0));
  EXPECT_EQ(room.graph().loops(), 2U);
  EXPECT_EQ(room.graph().refused(), 0U);
  EXPECT_EQ(room.graph().size(), 3U);
  EXPECT_NEAR(room.moved_m(), 0.0, 1e-3);
}

TEST(LoopClosing, IsLeftToTheOptions) {
  InARoom room(test_room::walls(), {.close = false});
  EXPECT_FALSE(room.stay(12.0));
  EXPECT_FALSE(room.stay(1.0));
  EXPECT_EQ(room.graph().loops(), 0U);
}

TEST(LoopClosing, IsOfPlacesThatManyMetresWereDrivenSince) {
  InARoom room(test_room::walls());
  room.stay(11.875);
  EXPECT_FALSE(room.stay(1.0)) << "the first that may be one";
  EXPECT_TRUE(room.stay(1.0));
  InARoom sooner(test_room::walls(), {.close = true, .min_way_m = 11.5});
  sooner.stay(11.5);
  EXPECT_TRUE(sooner.stay(1.0));
}

TEST(LoopClosing, IsTriedEveryMetre) {
  InARoom room(test_room::walls());
  room.stay(12.0);
  EXPECT_FALSE(room.stay(0.875));
  EXPECT_TRUE(room.stay(0.125));
}

TEST(LoopClosing, IsDoneOnceWithinThreeMetres) {
  for (const double driven_m : {2.875, 3.0}) {
    InARoom room(test_room::walls());
    room.stay(12.0);
    room.stay(1.0);
    EXPECT_EQ(room.stay(driven_m), driven_m == 3.0) << driven_m;
    EXPECT_EQ(room.graph().loops(), driven_m == 3.0 ? 3U : 2U);
  }
}

/// Its second place is 1.5 m from the first one, by the way, and another: 2.1 m away.
TEST(LoopClosing, IsDoneOnceWithinThreeMetresOfBothWaysTogether) {
  for (const double driven_m : {1.375, 1.5}) {
    InARoom room(test_room::walls());
    room.go(test_room::walls(2.1F), 1.5, 2.1);
    room.go(test_room::walls(), 10.5, -2.1);
    EXPECT_TRUE(room.stay(1.0));
    EXPECT_EQ(room.go(test_room::walls(2.1F), driven_m, 2.1), driven_m == 1.5) << driven_m;
    EXPECT_EQ(room.graph().loops(), driven_m == 1.5 ? 3U : 2U);
  }
}

TEST(LoopClosing, NeedsNoSecondOneSoonAfterALoop) {
  for (const double driven_m : {7.875, 8.0}) {
    InARoom room(test_room::walls());
    room.stay(12.0);
    room.stay(1.0);
    EXPECT_EQ(room.stay(driven_m), driven_m < 8.0);
    EXPECT_EQ(room.graph().loops(), driven_m < 8.0 ? 3U : 2U);
    EXPECT_EQ(room.graph().refused(), 0U);
    if (driven_m < 8.0) continue;
    EXPECT_TRUE(room.stay(1.0)) << "the next one agrees with it";
    EXPECT_EQ(room.graph().loops(), 4U);
  }
}

TEST(LoopClosing, IsOfPlacesWithinTheSearchDistance) {
  for (const float away_m : {0.48F, 0.54F}) {
    InARoom room(test_room::walls(), {.close = true, .search_m = 0.5});
    room.go(test_room::walls(away_m), 12.0, static_cast<double>(away_m));
    EXPECT_EQ(room.go(test_room::walls(away_m), 1.0), away_m < 0.5F) << away_m;
  }
}

/// The nearest place of long ago is behind a wall, and saw the other side of it.
TEST(LoopClosing, IsOfThePlaceWhoseSurfacesAreSeenAgain) {
  InARoom room(test_room::walls());
  test_room::Room behind{{}, 2.4F};
  behind.across_y(1.935F, 1.0F, 0, 12);
  room.go(behind.seen, 4.0, 2.4);
  EXPECT_FALSE(room.go(test_room::walls(2.4F), 12.0));
  EXPECT_TRUE(room.go(test_room::walls(2.4F), 1.0));
  EXPECT_NEAR(room.moved_m(), 2.4, 1e-3);
}

TEST(LoopClosing, IsOfAHundredPointsAtLeast) {
  test_room::Room few;
  few.across_x(2.985F, -1.0F, -12, 13);
  few.across_x(-2.985F, 1.0F, -12, 13);
  few.across_y(1.935F, -1.0F, -12, 13);
  few.across_y(-1.935F, 1.0F, -12, 13);
  ASSERT_EQ(few.seen.size(), 100U);
  for (const bool enough : {true, false}) {
    if (!enough) {
      few.seen.points.pop_back();
      few.seen.normals.pop_back();
    }
    InARoom room(few.seen);
    room.go(few.seen, 12.0);
    EXPECT_EQ(room.go(few.seen, 3.5), enough);
  }
}

/// Of 120 points on the walls and some that are 30 cm before one.
TEST(LoopClosing, IsOfPlacesThatEnoughPointsAgreeWith) {
  for (const int more : {21, 22}) {
    test_room::Room changed;
    add_front(changed);
    add_back(changed);
    changed.across_x(2.685F, -1.0F, -12, more - 12);
    InARoom room(test_room::walls());
    room.go(changed.seen, 12.0);
    EXPECT_EQ(room.go(changed.seen, 3.5), more == 21) << 120.0 / (120.0 + more);
  }
}

/// Keyframes that see 60 points each, two walls or the others in turn.
TEST(LoopClosing, GoesByWhatWasSeenOnThreeMetresOfTheWay) {
  for (const double apart_m : {3.0, 3.125}) {
    InARoom room(test_room::walls());
    EXPECT_FALSE(room.go(test_room::front(), 12.0));
    EXPECT_FALSE(room.go(test_room::back(), apart_m));
    EXPECT_EQ(room.go(test_room::front(), apart_m), apart_m == 3.0) << apart_m;
  }
}

TEST(LoopClosing, KnowsPlacesByThreeMetresOfTheWay) {
  for (const double apart_m : {3.0, 3.125}) {
    InARoom room(test_room::front());
    room.go(test_room::back(), apart_m);
    EXPECT_FALSE(room.stay(20.0));
    EXPECT_EQ(room.stay(3.5), apart_m == 3.0) << apart_m;
  }
}

/// The front of the room tells how far it went, the wheels that it did not.
TEST(KeyframeGraph, RegistersWithFiveMetresOfTheWay) {
  for (const double driven_m : {5.0, 5.125}) {
    InARoom room(test_room::front());
    room.go(test_room::back(), driven_m);
    test_room::Room ahead{{}, 0.06F};
    add_front(ahead);
    room.go(ahead.seen, 1.0, 0.0, 0.05);
    EXPECT_NEAR(room.moved_m(), driven_m == 5.0 ? 0.06 : 0.0, 0.005) << driven_m;
  }
}

/// By the wheels alone it comes to the pillar, which is all that it sees then, good to 5 cm. What
/// it sees of the room afterwards says that it went 21 cm, or 24.
TEST(LoopClosing, IsOfNoPlaceFartherThanTheWayMayHaveDrifted) {
  for (const float off_m : {0.21F, 0.24F}) {
    InARoom room(test_room::walls());
    room.go(test_room::pillar(off_m), 5.5, 0.0, 0.05);
    room.go(room_and_pillar(off_m, off_m), 8.0);
    const bool is_plausible = off_m < 0.225F;
    EXPECT_EQ(room.go(room_and_pillar(off_m, off_m), 3.5), is_plausible) << off_m;
    EXPECT_EQ(room.graph().loops(), is_plausible ? 2U : 0U);
    EXPECT_EQ(room.graph().refused(), 0U);
    EXPECT_NEAR(room.moved_m(), is_plausible ? 0.21 : 0.0, 0.01);
  }
}

/// Between two loops the wheels say that it stood, and the places that it went 3 cm, or 9.
TEST(LoopClosing, IsRefusedWhereTheNextOneDoesNotAgree) {
  for (const float off_m : {0.03F, 0.09F}) {
    InARoom room(test_room::walls());
    room.stay(12.0);
    room.go(test_room::pillar(), 5.5, 0.0, 0.05);
    const bool agrees = off_m < 0.06F;
    EXPECT_EQ(room.go(room_and_pillar(off_m, 0.0F), 5.5), agrees) << off_m;
    EXPECT_EQ(room.graph().loops(), agrees ? 2U : 0U);
    EXPECT_EQ(room.graph().refused(), agrees ? 0U : 1U);
  }
}

/// The same where the places say that it turned by 0.015 rad, or by 0.025.
TEST(LoopClosing, IsRefusedWhereTheNextOneHeadsElsewhere) {
  for (const double turned_rad : {0.015, 0.025}) {
    PointCloud seen = transform(test_room::walls(), to_se3(Pose2{0.0, 0.0, -turned_rad}));
    append(seen, test_room::pillar());
    InARoom room(test_room::walls());
    room.stay(12.0);
    room.go(test_room::pillar(), 5.5, 0.0, kSureWheels_m, 0.02);
    const bool agrees = turned_rad < 0.02;
    EXPECT_EQ(room.go(seen, 5.5), agrees) << turned_rad;
    EXPECT_EQ(room.graph().loops(), agrees ? 2U : 0U);
    EXPECT_EQ(room.graph().refused(), agrees ? 0U : 1U);
    EXPECT_NEAR(room.graph().T_world_bases().back().yaw_rad, agrees ? 0.415 : 0.4, 2e-3);
  }
}

TEST(LoopOptions, HaveTheirDefaults) {
  const LoopOptions options;
  EXPECT_TRUE(options.close);
  EXPECT_EQ(options.min_way_m, 12.0);
  EXPECT_EQ(options.search_m, 10.0);
  EXPECT_EQ(options.min_agreement, 0.85);
  EXPECT_EQ(options.agreement_m, 0.06);
  EXPECT_EQ(options.agreement_rad, 0.02);
  EXPECT_EQ(options.correct_m, 0.04);
}

TEST(LoopOptions, AreAboveZeroAndSharesAreNoMoreThanOne) {
  for (double LoopOptions::*option :
       {&LoopOptions::min_way_m, &LoopOptions::search_m, &LoopOptions::agreement_m,
        &LoopOptions::agreement_rad, &LoopOptions::correct_m}) {
    LoopOptions options;
    options.*option = 0.0;
    EXPECT_THROW(KeyframeGraph(options, {}), ConfigError);
    options.*option = 1e-6;
    EXPECT_NO_THROW(KeyframeGraph(options, {}));
  }
  for (const double share : {-1e-6, 1.000001}) {
    EXPECT_THROW(KeyframeGraph({.min_agreement = share}, {}), ConfigError) << share;
  }
  for (const double share : {0.0, 1.0}) {
    EXPECT_NO_THROW(KeyframeGraph({.min_agreement = share}, {})) << share;
  }
}

/// Within 0.5 m and three times what the pose is unsure by, 7 cm; and never more than 2 m farther.
TEST(LoopClosing, IsLookedForFartherWhereThePoseIsUnsure) {
  const auto is_found = [](float away_m, double sigma_m) {
    InARoom room(test_room::walls(), {.close = true, .search_m = 0.5});
    room.go(test_room::pillar(away_m), 5.5, static_cast<double>(away_m), sigma_m);
    room.go(room_and_pillar(away_m, away_m), 8.0);
    return room.go(room_and_pillar(away_m, away_m), 3.5);
  };
  EXPECT_TRUE(is_found(0.66F, 0.05));
  EXPECT_FALSE(is_found(0.78F, 0.05));
  EXPECT_TRUE(is_found(2.4F, 1.0));
  EXPECT_FALSE(is_found(2.61F, 1.0));
}

TEST(LoopClosing, IsAsPlausibleWhereverTheWorldBegins) {
  for (const float off_m : {0.21F, 0.24F}) {
    KeyframeGraph graph({.close = true}, {});
    graph.begin(test_room::walls(), {1000.0, -1000.0, 0.8});
    const auto go = [&](const PointCloud& seen, double driven_m, double sigma_m) {
      WheelStep step;
      step.covariance = Eigen::Vector3d(sigma_m, sigma_m, 0.001).cwiseAbs2().asDiagonal();
      step.driven_m = driven_m;
      graph.add(seen, step);
      return graph.close_loops();
    };
    go(test_room::pillar(off_m), 5.5, 0.05);
    go(room_and_pillar(off_m, off_m), 8.0, kSureWheels_m);
    EXPECT_EQ(go(room_and_pillar(off_m, off_m), 3.5, kSureWheels_m), off_m < 0.225F) << off_m;
  }
}

/// A weak step lies between the first keyframe and the others, so the way may have drifted. Two
/// loops say that it has not, two more that it has, by `off_m`; between them the way is sure. Each
/// then is off by half of it.
TEST(LoopClosing, IsRefusedWhereItDoesNotFitWithEarlierOnes) {
  for (const float off_m : {0.15F, 0.30F}) {
    InARoom room(test_room::walls());
    room.go(test_room::pillar(), 5.5, 0.0, 0.1);
    room.go(room_and_pillar(0.0F, 0.0F), 8.0);
    EXPECT_TRUE(room.go(room_and_pillar(0.0F, 0.0F), 1.0));
    room.go(test_room::pillar(), 5.5);
    EXPECT_FALSE(room.go(room_and_pillar(off_m, 0.0F), 5.5)) << "it waits";
    const bool fits = off_m < 0.2F;
    EXPECT_EQ(room.go(room_and_pillar(off_m, 0.0F), 3.5), fits) << off_m;
    EXPECT_EQ(room.graph().loops(), fits ? 4U : 2U);
    EXPECT_EQ(room.graph().refused(), fits ? 0U : 2U);
    EXPECT_NEAR(room.moved_m(), fits ? 0.075 : 0.0, 0.015);
  }
}

TEST(LoopClosing, PassesOverWhereNothingWasInRange) {
  InARoom nowhere({});
  nowhere.go({}, 12.0);
  EXPECT_FALSE(nowhere.go({}, 1.0));
  EXPECT_EQ(nowhere.graph().size(), 3U);
  InARoom room(test_room::walls());
  EXPECT_FALSE(room.go({}, 12.0));
  EXPECT_FALSE(room.stay(1.0));
  EXPECT_TRUE(room.stay(1.0));
}

/// A metre driven, which the wheels tell nothing of but how unsure they are.
WheelStep step_of_unsure_wheels(const Eigen::Vector3d& sigma) {
  WheelStep step;
  step.covariance = sigma.cwiseAbs2().asDiagonal();
  step.driven_m = 1.0;
  return step;
}

/// 300 points on walls across either axis, of which a tenth may be trimmed, say 1 cm each; scans of
/// the way share 1.5 mm and 0.4 mrad.
TEST(KeyframeGraph, IsNoSurerOfAStepThanItsScansAreWithoutNoise) {
  const PointCloud seen = tall(test_room::walls());
  KeyframeGraph graph({.close = true}, {});
  graph.begin(seen, {});
  graph.add(seen, step_of_unsure_wheels({1.0, 1.0, 1.0}));
  const Eigen::Matrix3d covariance = graph.covariances(std::array<std::size_t, 1>{1}).front();
  EXPECT_NEAR(covariance(0, 0), 0.0015 * 0.0015 + 1e-4 / 270.0, 2e-7);
  EXPECT_NEAR(covariance(1, 1), 0.0015 * 0.0015 + 1e-4 / 270.0, 2e-7);
  EXPECT_NEAR(covariance(2, 2), 0.0004 * 0.0004 + 1e-4 / 600.0, 6e-8);
}

/// 24 cm are beyond the 20 cm within which partners are looked for at first.
TEST(KeyframeGraph, LooksForPartnersTwiceAsFarWhereThereAreNone) {
  test_room::Room wall;
  wall.across_x(2.985F, -1.0F, -15, 15);
  test_room::Room nearer{{}, 0.24F};
  nearer.across_x(2.985F, -1.0F, -15, 15);
  KeyframeGraph graph({.close = true}, {});
  graph.begin(tall(wall.seen), {});
  graph.add(tall(nearer.seen), step_of_unsure_wheels({0.3, 0.001, 0.001}));
  EXPECT_NEAR(graph.T_world_bases().back().x_m, 0.24, 0.005);
  EXPECT_NEAR(graph.T_world_bases().back().y_m, 0.0, 1e-3);
}

/// It turns and goes aside between the two, in the world's frame to no axis's direction.
TEST(LoopClosing, AgreesWhereverItWentBetweenTheTwo) {
  const Pose2 start{1.5, -2.5, 0.4};
  KeyframeGraph graph({.close = true}, {});
  graph.begin(test_room::walls(), start);
  const auto go = [&](const Pose2& T_room_base, const Pose2& T_previous_now, double driven_m) {
    WheelStep step;
    step.T_previous_now = T_previous_now;
    step.covariance = 1e-6 * Eigen::Matrix3d::Identity();
    step.driven_m = driven_m;
    graph.add(transform(test_room::walls(), to_se3(inverse(T_room_base))), step);
    return graph.close_loops();
  };
  const Pose2 aside{0.9, 0.6, 0.3};
  EXPECT_FALSE(go({}, {}, 12.0)) << "it waits";
  EXPECT_TRUE(go(aside, aside, 3.5));
  EXPECT_EQ(graph.loops(), 2U);
  EXPECT_EQ(graph.refused(), 0U);
  const Pose2 there = compose(start, aside);
  EXPECT_NEAR(graph.T_world_bases().back().x_m, there.x_m, 3e-3);
  EXPECT_NEAR(graph.T_world_bases().back().y_m, there.y_m, 3e-3);
  EXPECT_NEAR(graph.T_world_bases().back().yaw_rad, there.yaw_rad, 2e-3);
}

/// Where it is now it saw two walls at first, 60 points of the 120. The world's axes are not its
/// own.
TEST(LoopClosing, IsOfThePlaceThatSawMostNotOfTheNearestOrTheLast) {
  InARoom room(test_room::walls());
  test_room::Room two_walls{{}, 2.4F};
  add_front(two_walls);
  room.go(two_walls.seen, 4.0, 2.4);
  EXPECT_FALSE(room.go(test_room::walls(2.4F), 12.0));
  EXPECT_TRUE(room.go(test_room::walls(2.4F), 1.0));
  EXPECT_EQ(room.graph().loops(), 2U);
  EXPECT_NEAR(room.moved_m(), 2.4, 1e-3);
}

/// The first place saw too little to be known again.
TEST(LoopClosing, LooksAtPlacesTwoMetresApart) {
  for (const float away_m : {1.98F, 2.01F}) {
    InARoom room(test_room::front());
    room.go(test_room::walls(away_m), 4.0, static_cast<double>(away_m));
    EXPECT_FALSE(room.go(test_room::walls(away_m), 12.0));
    EXPECT_EQ(room.go(test_room::walls(away_m), 1.0), away_m > 2.0F) << away_m;
  }
}

}  // namespace
}  // namespace vantage
