// What sweeps leave in the belief; a map that is made anew from where loops say that it was seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tests/localisation/plan_world.hpp"
#include "tests/tasks/mapping/standing_robot.hpp"
#include "vantage/tasks/exploration/exploration_belief.hpp"
#include "vantage/tasks/mapping/driving/loop_closing.hpp"
#include "vantage/tasks/mapping/driving/navigator.hpp"

namespace vantage {
namespace {

constexpr int kWidth_px = 64;
constexpr int kHeight_px = 49;

/// Ahead and to the left, a wavy wall in either image.
ExplorationObservation sweep_at(const Pose2& T_world_base, double distance_m) {
  ExplorationObservation observation;
  observation.T_world_base_odometry = T_world_base;
  for (const double pan_rad : {0.0, 1.5}) {
    CameraImages image{.width_px = kWidth_px,
                       .height_px = kHeight_px,
                       .focal_px = 55.0,
                       .range_max_m = 3.5,
                       .rgb = {},
                       .depth_m = {}};
    for (int i = 0; i < kWidth_px * kHeight_px; ++i) {
      image.depth_m.push_back(static_cast<float>(distance_m + 0.1 * std::sin(0.01 * i + pan_rad)));
    }
    Eigen::Matrix3d of_camera;  // from OpenCV's axes to x forward, z up
    of_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    Pose T_base_camera = make_pose({0.0, 0.0, 1.2}, pan_rad);
    T_base_camera.rotate(of_camera);
    observation.views.push_back({std::move(image), T_base_camera});
  }
  return observation;
}

struct Rooms {
  Exploration task;
  EpisodeOptions episode;
  ReferenceMap no_walls{RegistrationOptions{}};

  explicit Rooms(int threads) {
    task.map.centre_m = {0.0, 0.0, 1.0};
    task.map.size_m = {8.0, 8.0, 2.0};
    task.map.cells = {64, 64, 20};
    episode.threads = threads;
  }
};

const std::vector<Pose2> kBelieved{{0.0, 0.0, 0.0}, {1.0, 0.2, 0.3}};
const std::vector<Pose2> kCorrected{{0.0, 0.0, 0.0}, {0.8, -0.1, 0.2}};

/// Driven as believed, then made anew.
OccupancyGrid made_anew(int threads, double* hazard = nullptr) {
  const Rooms rooms(threads);
  ExplorationBelief belief(rooms.episode, rooms.task);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto seen = sweep_at(kBelieved[i], 2.0 + 0.4 * static_cast<double>(i));
    belief.update(seen, rooms.no_walls, {});
    belief.keep(seen, i);
  }
  belief.reintegrate(kCorrected);
  if (hazard != nullptr) *hazard = belief.hazard().global_hazard();
  return belief.grid();
}

TEST(Reintegration, IsAsIfAllHadBeenSeenFromThereAtFirst) {
  Rooms rooms(1);
  const int stride_px = rooms.task.stride_px;
  rooms.task.hazard_stride_px =
      static_cast<int>(std::lround(static_cast<double>(rooms.task.hazard_stride_px) / stride_px));
  rooms.task.stride_px = 1;
  ExplorationBelief fresh(rooms.episode, rooms.task);
  for (std::size_t i = 0; i < 2; ++i) {
    auto seen = sweep_at(kCorrected[i], 2.0 + 0.4 * static_cast<double>(i));
    seen.views = thinned(seen.views, stride_px);
    fresh.update(seen, rooms.no_walls, {});
  }
  double hazard = 0.0;
  EXPECT_EQ(made_anew(1, &hazard).log_odds, fresh.grid().log_odds);
  EXPECT_EQ(hazard, fresh.hazard().global_hazard());
  EXPECT_GT(fresh.grid().count(CellState::occupied), 100U);
}

/// The image was taken half a metre after its keyframe.
TEST(Reintegration, MovesImagesThatWereTakenOnTheWayWithTheKeyframeBeforeThem) {
  Rooms rooms(1);
  rooms.task.stride_px = 1;
  const Pose2 T_keyframe_base{0.5, 0.1, 0.4};
  const HeadView view = sweep_at({}, 2.0).views.front();
  ExplorationBelief belief(rooms.episode, rooms.task);
  belief.update(view, compose(kBelieved[1], T_keyframe_base));
  const OccupancyGrid as_believed = belief.grid();
  belief.keep(view, T_keyframe_base, 1);
  belief.reintegrate(kBelieved);
  EXPECT_EQ(belief.grid().log_odds, as_believed.log_odds);
  belief.reintegrate(kCorrected);
  ExplorationBelief fresh(rooms.episode, rooms.task);
  fresh.update(view, compose(kCorrected[1], T_keyframe_base));
  EXPECT_EQ(belief.grid().log_odds, fresh.grid().log_odds);
  EXPECT_NE(belief.grid().log_odds, as_believed.log_odds);
  EXPECT_GT(belief.grid().count(CellState::occupied), 50U);
}

TEST(ExplorationBelief, FillsHolesOfImagesOnTheWayWhenToldTo) {
  const Rooms rooms(1);
  ExplorationBelief belief(rooms.episode, rooms.task);
  belief.update(sweep_at({}, 2.0).views.front(), kBelieved[0]);
  EXPECT_EQ(belief.filled_grid().count(CellState::occupied), 0U);
  belief.refill();
  EXPECT_GE(belief.filled_grid().count(CellState::occupied),
            belief.grid().count(CellState::occupied));
  EXPECT_GT(belief.grid().count(CellState::occupied), 50U);
}

TEST(Reintegration, DoesNotDependOnThreads) {
  EXPECT_EQ(made_anew(1).log_odds, made_anew(3).log_odds);
}

/// A beam tells of clutter by what was unknown before its scan, not after.
TEST(ExplorationBelief, LearnsTheClutterOfItsSweepsOnTheMapBeforeThem) {
  const Rooms rooms(2);
  ExplorationBelief belief(rooms.episode, rooms.task);
  const auto seen = sweep_at(kBelieved[1], 2.0);
  belief.update(seen, rooms.no_walls, {});

  std::vector<PosedImage> images;
  for (const HeadView& view : seen.views) {
    images.push_back({view.image, to_se3(kBelieved[1]) * view.T_base_camera});
  }
  const OccupancyGrid nothing_known(rooms.task.map.frame());
  ClutterHazard expected(rooms.task.clutter_hazard, nothing_known.frame.cells);
  expected.observe(nothing_known, images, rooms.task.hazard_stride_px, rooms.task.hazard_floor_m);
  EXPECT_EQ(belief.hazard().global_hazard(), expected.global_hazard());
  EXPECT_EQ(belief.hazard().transmission_per_slice(), expected.transmission_per_slice());
  EXPECT_GT(std::abs(expected.global_hazard() / rooms.task.clutter_hazard.prior_hazard - 1.0), 0.1);

  expected.observe(belief.grid(), images, rooms.task.hazard_stride_px, rooms.task.hazard_floor_m);
  belief.update(seen, rooms.no_walls, {});
  EXPECT_EQ(belief.hazard().global_hazard(), expected.global_hazard());
}

/// Three columns of four, of which the first and the last are kept; rows alike.
TEST(Reintegration, ThinnedImagesSeeTheSameDirections) {
  const auto seen = sweep_at({}, 2.0).views;
  const auto kept = thinned(seen, 3);
  ASSERT_EQ(kept.front().image.width_px, 22);
  ASSERT_EQ(kept.front().image.height_px, 17);
  EXPECT_TRUE(kept.front().image.ray(2, 4).isApprox(seen.front().image.ray(6, 12), 1e-12));
  EXPECT_EQ(kept.front().image.depth_at(2, 4), seen.front().image.depth_at(6, 12));
}

TEST(PoseCorrection, MovesWhatWasSeenFromAKeyframeAlong) {
  const PoseCorrection correction{kBelieved, kCorrected};
  const Pose2 same = correction.moved(kBelieved[1], 1);
  EXPECT_NEAR(same.x_m, kCorrected[1].x_m, 1e-12);
  EXPECT_NEAR(same.yaw_rad, kCorrected[1].yaw_rad, 1e-12);
  const Pose2 ahead = compose(kBelieved[1], {2.0, 0.0, 0.0});
  const Eigen::Vector2d moved = correction.moved(Eigen::Vector2d(ahead.x_m, ahead.y_m), 1);
  EXPECT_NEAR(moved.x(), 0.8 + 2.0 * std::cos(0.2), 1e-12);
  EXPECT_NEAR(moved.y(), -0.1 + 2.0 * std::sin(0.2), 1e-12);
}

TEST(WheelCovariance, GrowsWithTheWayAndTheTurn) {
  const OdometryOptions odometry;
  const Eigen::Matrix3d rest = wheel_covariance(odometry, 0.0, 0.0);
  const Eigen::Matrix3d driven = wheel_covariance(odometry, 2.0, 0.0);
  const Eigen::Matrix3d turned = wheel_covariance(odometry, 0.0, 1.0);
  // In the long run a bias of 1 % over 5 m is a walk of variance 2 * 5 m * (1 %)^2 a metre.
  EXPECT_NEAR(driven(0, 0) - rest(0, 0), 2.0 * (1e-4 + 10.0 * 1e-4), 1e-12);
  EXPECT_NEAR(turned(2, 2) - rest(2, 2), 0.02 * 0.02, 1e-12);
  EXPECT_GT(driven(1, 1), driven(0, 0)) << "a heading that is lost moves the end aside";
}

TEST(WheelCovariance, IsThatOfALineWhoseHeadingIsLostEvenly) {
  OdometryOptions odometry;
  odometry.sigma_translation_m = 0.03;
  odometry.bias_translation_m_per_m = 0.02;
  odometry.sigma_yaw_rad = 0.01;
  odometry.bias_yaw_rad_per_m = 0.005;
  odometry.sigma_turn_rad = 0.02;
  odometry.bias_length_m = 4.0;
  const Eigen::Matrix3d covariance = wheel_covariance(odometry, 1.5, 0.7);
  EXPECT_NEAR(covariance(0, 0), 0.006151, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.0066985, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.00073025, 1e-12);
  EXPECT_NEAR(covariance(1, 2), 0.0005475, 1e-12);
  EXPECT_EQ(covariance(2, 1), covariance(1, 2));
  EXPECT_EQ(covariance(0, 1), 0.0);
  EXPECT_EQ(covariance(0, 2), 0.0);
}

PlanarScan flat_wall(double distance_m) {
  PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 10.0};
  for (int i = -50; i <= 50; ++i) {
    scan.azimuth_rad.push_back(0.01 * i);
    scan.range_m.push_back(static_cast<float>(distance_m / std::cos(0.01 * i)));
  }
  return scan;
}

/// A wall that is seen twice from the origin, and one behind it if that is seen from there too.
TEST(LoopClosing, TellsWhichBeamsGoThroughWalls) {
  const auto share = [](double third_x_m) {
    LoopClosing loops({}, {}, {}, {});
    loops.remember(flat_wall(2.02), 0.25, {});
    loops.remember(flat_wall(2.02), 0.25, {});
    loops.remember(flat_wall(4.02), 0.25, {third_x_m, 0.0, 0.0});
    return loops.contradicted_share();
  };
  EXPECT_GT(share(0.0), 0.2);
  EXPECT_LT(share(0.0), 0.6) << "those of the third scan";
  EXPECT_EQ(share(-2.0), 0.0);
}

/// By the wheels, from where the base was last put: what registration turns is no turn of theirs.
TEST(LoopClosing, AddsUpTheTurnsOfTheWheels) {
  LoopClosing loops({}, {}, {}, {0.0, 0.0, 0.1});
  EXPECT_EQ(loops.turned_rad(), 0.0);
  loops.moved_to({1.0, 0.0, 0.4}, {1.0, 0.0, 0.9});
  EXPECT_NEAR(loops.turned_rad(), 0.3, 1e-12);
  loops.moved_to({1.0, 0.5, 0.7}, {1.0, 0.5, 0.7});
  EXPECT_NEAR(loops.turned_rad(), 0.5, 1e-12);
  EXPECT_EQ(loops.corrections(), 0U);
  EXPECT_FALSE(loops.wants_correction());
}

/// As the PR2's: 270 deg in steps of a quarter, 30 m.
PlanarScan planar_scan(const std::vector<test_plan::Segment>& walls, const Pose2& T_world_base,
                       Rng& rng) {
  PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 30.0};
  for (int i = -540; i <= 540; ++i) {
    scan.azimuth_rad.push_back(0.00436 * i);
    const double yaw_rad = T_world_base.yaw_rad + scan.azimuth_rad.back();
    const double range_m = test_plan::range_m(walls, {T_world_base.x_m, T_world_base.y_m},
                                              {std::cos(yaw_rad), std::sin(yaw_rad)});
    scan.range_m.push_back(static_cast<float>(range_m + 0.01 * rng.normal()));
  }
  return scan;
}

/// Tracked by what was seen last a map bends a little from place to place, and fits all the same:
/// here the corridor is 0.3 % longer by the tracked poses.
TEST(LoopClosing, CorrectsWhatFitsWellButIsBent) {
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  const auto walls = test_plan::ring(15.0, 28.0, 2.0);
  auto truth = test_plan::way_round(15.0, 28.0, 2.0, 2);
  truth.resize(truth.size() / 2 + 20);
  Rng rng(3);
  const auto tracked = [&](std::size_t i) {
    return Pose2{truth[i].x_m, truth[0].y_m + 1.003 * (truth[i].y_m - truth[0].y_m),
                 truth[i].yaw_rad};
  };
  LoopClosing loops({.close = true}, registration, {}, tracked(0));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) {
      const Pose2 step = test_plan::wheels(truth[i - 1], truth[i], rng).T_previous_now;
      loops.moved_to(compose(tracked(i - 1), step), tracked(i));
    }
    loops.remember(planar_scan(walls, truth[i], rng), 0.25, tracked(i));
  }
  ASSERT_GT(loops.disagreement_m(), 0.05);
  EXPECT_LT(loops.contradicted_share(), 0.02) << "it fits";
  ASSERT_TRUE(loops.wants_correction());
  const PoseCorrection correction = loops.correct();
  EXPECT_GT(test_plan::worst_m(correction.T_world_before, truth), 0.07);
  EXPECT_LT(test_plan::worst_m(correction.T_world_after, truth), 0.05);
  EXPECT_FALSE(loops.wants_correction()) << "it has been corrected";
  loops.remember({}, 0.25, compose(correction.T_world_after.back(), {0.3, 0.0, 0.0}));
  EXPECT_GT(loops.disagreement_m(), 0.2);
  EXPECT_FALSE(loops.wants_correction()) << "no loop is closed since then";
}

/// Nothing is in sight, so that the poses of the loops are those of the wheels: the second one is
/// 0.2 m and 0.2 rad off what the map has, the third is as the map has it.
TEST(LoopClosing, DisagreesByWhatAPoseMovesAndWhatIsSeenThreeMetresOff) {
  const PlanarScan nothing{};
  LoopClosing loops({}, {}, {}, {});
  loops.remember(nothing, 0.25, {});
  EXPECT_EQ(loops.disagreement_m(), 0.0);
  loops.moved_to({1.0, 0.0, 0.1}, {1.2, 0.0, 0.3});
  EXPECT_NEAR(loops.turned_rad(), 0.1, 1e-12);
  loops.remember(nothing, 0.25, {1.2, 0.0, 0.3});
  EXPECT_EQ(loops.turned_rad(), 0.0);
  EXPECT_NEAR(loops.disagreement_m(), 0.2 + 3.0 * 0.2, 1e-9);
  const Pose2 ahead{0.5, 0.0, 0.0};
  const Pose2 third = compose(Pose2{1.0, 0.0, 0.1}, ahead);
  loops.moved_to(compose(Pose2{1.2, 0.0, 0.3}, ahead), third);
  loops.remember(nothing, 0.25, third);
  EXPECT_NEAR(loops.disagreement_m(), 0.8, 1e-9);
  EXPECT_EQ(loops.remembered().size(), 3U);
}

/// Seen 37 degrees down, 2 m away, where five standard deviations of its height are 21 mm. The map
/// begins 5 mm above the floor.
TEST(ExplorationBelief, TakesForTheFloorWhatIsNoHigherThanItsError) {
  Rooms rooms(1);
  rooms.task.map.centre_m = {0.0, 0.0, 1.005};
  rooms.task.stride_px = 1;
  for (const double height_m : {0.019, 0.023}) {
    CameraImages image{.width_px = 3,
                       .height_px = 3,
                       .focal_px = 100.0,
                       .range_max_m = 3.5,
                       .rgb = {},
                       .depth_m = std::vector<float>(9, 0.0F)};
    image.depth_m[4] = 2.0F;
    Pose T_base_camera = Pose::Identity();
    T_base_camera.translation() = Eigen::Vector3d(-0.0375, 0.0625, 1.2 + height_m);
    T_base_camera.linear() << 0.0, -0.6, 0.8, -1.0, 0.0, 0.0, 0.0, -0.8, -0.6;
    ExplorationBelief belief(rooms.episode, rooms.task);
    belief.update({image, T_base_camera}, Pose2{});
    EXPECT_EQ(belief.grid().count(CellState::occupied), height_m > 0.021 ? 1U : 0U) << height_m;
  }
}

/// Tracked far apart the places contradict nothing. By the loops they are one room, and the last
/// scan sees through its walls.
TEST(LoopClosing, LeavesOutLoopsByWhichBeamsGoThroughWalls) {
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  std::vector<test_plan::Segment> room;
  test_plan::add_box(room, -4.0, -3.0, 4.0, 3.0);
  std::vector<test_plan::Segment> hall;
  test_plan::add_box(hall, -9.0, -8.0, 9.0, 8.0);
  Rng rng(5);
  const auto tracked = [](int i) { return Pose2{100.0 * i, 0.0, 0.0}; };
  LoopClosing loops({.close = true, .min_way_m = 0.9}, registration, {}, tracked(0));
  for (int i = 0; i < 5; ++i) {
    if (i > 0) loops.moved_to(compose(tracked(i - 1), {0.6, 0.0, 0.0}), tracked(i));
    loops.remember(planar_scan(room, {0.6 * i - 1.2, 0.0, 0.0}, rng), 0.25, tracked(i));
  }
  ASSERT_GT(loops.graph().loops(), 0U);
  EXPECT_TRUE(loops.wants_correction());
  loops.moved_to(tracked(4), tracked(5));
  loops.remember(planar_scan(hall, {1.2, 0.0, 0.0}, rng), 0.25, tracked(5));
  EXPECT_GT(loops.disagreement_m(), 1.0);
  EXPECT_FALSE(loops.wants_correction());
}

/// Nothing is in sight: the second pose of the loops is that of the wheels.
TEST(LoopClosing, AgreesOnceItIsCorrected) {
  const PlanarScan nothing{};
  LoopClosing loops({}, {}, {}, {});
  loops.remember(nothing, 0.25, {});
  loops.moved_to({1.0, 0.0, 0.1}, {1.2, 0.0, 0.3});
  loops.remember(nothing, 0.25, {1.2, 0.0, 0.3});
  ASSERT_GT(loops.disagreement_m(), 0.5);
  const PoseCorrection correction = loops.correct();
  ASSERT_EQ(correction.T_world_before.size(), 2U);
  EXPECT_EQ(correction.T_world_before[1].x_m, 1.2);
  EXPECT_NEAR(correction.T_world_after[1].x_m, 1.0, 1e-9);
  EXPECT_NEAR(loops.remembered()[1].T_world_base.x_m, 1.0, 1e-9);
  EXPECT_NEAR(loops.remembered()[1].T_world_base.yaw_rad, 0.1, 1e-9);
  EXPECT_NEAR(loops.disagreement_m(), 0.0, 1e-9);
  EXPECT_EQ(loops.corrections(), 1U);
}

TEST(Reintegration, MakesTheCloudAnewToo) {
  Rooms rooms(1);
  rooms.task.stride_px = 1;
  const HeadView view = sweep_at({}, 2.0).views.front();
  ExplorationBelief belief(rooms.episode, rooms.task);
  belief.update(view, kBelieved[0]);
  const std::size_t once = belief.cloud().size();
  ASSERT_GT(once, 50U);
  belief.keep(view, kBelieved[0], 0);
  belief.reintegrate(kBelieved);
  EXPECT_EQ(belief.cloud().size(), once) << "and nothing twice";
}

/// In a room of 8 x 6 m, where its scanner sees the walls from where it believes to be.
struct RoomRobot : support::JumpingRobot {
  RoomRobot() { test_plan::add_box(walls, -4.0, -3.0, 4.0, 3.0); }
  PlanarScan read_base_scanner() override { return planar_scan(walls, T_world_base, rng); }

  std::vector<test_plan::Segment> walls;
  Rng rng{5};
};

RegistrationOptions room_registration() {
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  return registration;
}

/// After half a radian; it stays where it is.
TEST(Navigator, RemembersForLoopsHowThingsLookOnceItHasTurnedFarEnough) {
  const RegistrationOptions registration = room_registration();
  RoomRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(registration), 1);
  std::ranges::fill(navigator.floor().log_odds, -2.0F);
  navigator.close_loops({.close = true}, registration, {});
  navigator.remember(robot.read_base_scanner(), {});
  ASSERT_EQ(navigator.loops()->remembered().size(), 1U);
  ASSERT_TRUE(navigator.approach({0.0, 0.0, 0.35}, std::nullopt).reached);
  EXPECT_EQ(navigator.loops()->remembered().size(), 1U);
  ASSERT_TRUE(navigator.approach({0.0, 0.0, 0.7}, std::nullopt).reached);
  EXPECT_EQ(navigator.loops()->remembered().size(), 2U);
}

/// Tracked 0.7 m apart, places that are 0.6 m apart by the wheels and by what is seen.
TEST(Navigator, PutsTheRobotWhereLoopsSayThatItIs) {
  const RegistrationOptions registration = room_registration();
  const auto tracked = [](int i) { return Pose2{0.7 * i, 0.0, 0.0}; };
  RoomRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(registration), 1);
  navigator.close_loops({.close = true, .min_way_m = 0.9}, registration, {});
  for (int i = 0; i < 5; ++i) {
    if (i > 0) {
      robot.T_world_base = compose(tracked(i - 1), {0.6, 0.0, 0.0});
      navigator.correct_pose(tracked(i), Eigen::Matrix3d::Zero());
    }
    const Pose2 truth{0.6 * i - 1.2, 0.0, 0.0};
    navigator.remember(planar_scan(robot.walls, truth, robot.rng), tracked(i));
  }
  ASSERT_NEAR(robot.T_world_base.x_m, 2.8, 1e-9);
  ASSERT_TRUE(navigator.correct_over_loops());
  EXPECT_NEAR(robot.T_world_base.x_m, 2.4, 0.05);
  EXPECT_NEAR(robot.T_world_base.y_m, 0.0, 0.05);
}

/// Notes where it drives.
struct NotedRoomRobot : RoomRobot {
  DriveResult drive_along(std::span<const Pose2> path, double max_speed_m_s,
                          const std::function<bool()>& go_on) override {
    driven.insert(driven.end(), path.begin(), path.end());
    return RoomRobot::drive_along(path, max_speed_m_s, go_on);
  }
  std::vector<Pose2> driven;
};

TEST(Navigator, TurnsByThreeThirdsWhereWallsFixThePose) {
  NotedRoomRobot robot;
  robot.T_world_base = {0.5, -0.25, 0.3};
  Navigator navigator({}, {}, {}, robot, ReferenceMap(room_registration()), 1);
  navigator.turn_in_place();
  ASSERT_EQ(robot.driven.size(), 3U);
  for (int third = 1; third <= 3; ++third) {
    const Pose2& pose = robot.driven[static_cast<std::size_t>(third - 1)];
    const double turned_rad = third * 2.0943951023931953;
    EXPECT_NEAR(wrap_angle(pose.yaw_rad - 0.3 - turned_rad), 0.0, 1e-9);
    EXPECT_NEAR(pose.x_m, 0.5, 1e-9);
    EXPECT_NEAR(pose.y_m, -0.25, 1e-9);
  }
  EXPECT_EQ(navigator.floor().state_at({-3.5, -0.5}), CellState::free) << "behind it at first";
}

/// After half a metre, along x.
TEST(Navigator, RemembersForLoopsHowThingsLookOnceItHasGoneFarEnough) {
  RoomRobot robot;
  robot.T_world_base = {-2.0, 0.5, 0.0};
  Navigator navigator({}, {}, {}, robot, ReferenceMap(room_registration()), 1, 0.5);
  std::ranges::fill(navigator.floor().log_odds, -2.0F);
  navigator.close_loops({.close = true}, room_registration(), {});
  navigator.remember(robot.read_base_scanner(), robot.T_world_base);
  const auto remembered_at = [&](double x_m) {
    EXPECT_TRUE(navigator.approach({x_m, 0.5, 0.0}, std::nullopt).reached);
    return navigator.loops()->remembered().size();
  };
  EXPECT_EQ(remembered_at(-1.6), 1U);
  EXPECT_EQ(remembered_at(-1.4), 2U);
}

}  // namespace
}  // namespace vantage
