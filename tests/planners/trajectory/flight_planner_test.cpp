// From objects that were found to ways on: straight paths in an empty room.
#include "vantage/planners/trajectory/flight_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

/// Along x, a metre between waypoints.
std::vector<Eigen::Vector4d> straight_path(int waypoints) {
  std::vector<Eigen::Vector4d> path;
  for (int i = 0; i < waypoints; ++i) path.emplace_back(i, 0.0, 1.8, 0.0);
  return path;
}

FlightMap unseen_room() {
  return FlightMap(
      Eigen::AlignedBox3d(Eigen::Vector3d(-3.0, -4.0, 0.0), Eigen::Vector3d(22.0, 4.0, 3.0)));
}

/// Of which all has been seen from above, and there is nothing.
FlightMap empty_room() {
  constexpr double kHeight_m = 2.9;
  CameraImages images;
  images.width_px = 260;
  images.height_px = 90;
  images.focal_px = 30.0;
  images.range_max_m = 30.0;
  const auto pixels =
      static_cast<std::size_t>(images.width_px) * static_cast<std::size_t>(images.height_px);
  images.depth_m.assign(pixels, static_cast<float>(kHeight_m));
  images.rgb.assign(3 * pixels, 0);
  Pose T_world_camera = Pose::Identity();
  T_world_camera.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  T_world_camera.translation() = Eigen::Vector3d(9.5, 0.0, kHeight_m);
  FlightMap map = unseen_room();
  map.insert(images, T_world_camera);
  return map;
}

/// How far to the side of the straight path a way leads.
double aside_m(const CandidatePlan& candidate) {
  return candidate.points.row(1).cwiseAbs().maxCoeff();
}

/// Of the spline through a way, from where the straight paths start.
double clearance_m(const FlightPlanner& planner, const CandidatePlan& candidate) {
  std::vector<FlightWaypoint> waypoints;
  for (const auto& q : candidate.points.colwise()) {
    waypoints.push_back({.p_world_m = q.head<3>(), .yaw_rad = q[3]});
  }
  const MinimumJerkTrajectory path({.p_world_m = {0.0, 0.0, 1.8}}, waypoints);
  return planner.clearance_m(path, path.duration_s());
}

/// Without a step of the descent: the cheapest of its starts.
constexpr Chomp kBestStart{.evaluations = 1};

class Planner : public testing::Test {
 protected:
  FlightPlanner planner(const TrajectoryMethod& method) {
    planning_.method = method;
    return {planning_, flight_camera(camera_ahead(0.65), 640, 480, 0.7853981633974483), Rng(1)};
  }
  std::vector<CandidatePlan> propose(FlightPlanner& planner, int at = 0) {
    return planner.propose({.at = at, .nominal = path_, .plan = path_}, objects_, map_);
  }
  /// What a plan so far off from its second point on costs for each unit of the deviation's weight.
  double missing_m(const Eigen::Vector4d& off) {
    const auto cost_of = [&](double weight) {
      std::vector<Eigen::Vector4d> plan = path_;
      for (std::size_t i = 2; i < plan.size(); ++i) plan[i] += off;
      planning_.options.path_deviation_weight = weight;
      FlightPlanner chomp = planner(Chomp{.evaluations = 20});
      const auto candidates =
          chomp.propose({.at = 0, .nominal = path_, .plan = plan}, objects_, map_);
      EXPECT_EQ(candidates[1].planner, "as before");
      return candidates[1].cost;
    };
    return cost_of(3.0) - cost_of(2.0);
  }
  double cost_as_given(int at = 0) {
    FlightPlanner best_start = planner(kBestStart);
    return propose(best_start, at)[2].cost;
  }

  FlightPlanning planning_;
  std::vector<Eigen::Vector4d> path_ = straight_path(20);
  std::vector<PlannableObject> objects_ = {
      {.id = 3, .p_world_m = {2.5, 0.9, 0.9}, .entropy_nats = 2.0}};
  FlightMap map_ = empty_room();
};

TEST_F(Planner, GoesOnAsGivenWhereThereIsNothingToSee) {
  objects_.clear();
  FlightPlanner stomp = planner(Stomp{});
  const std::vector<CandidatePlan> candidates = propose(stomp);
  ASSERT_EQ(candidates.front().points.cols(), 10);
  EXPECT_FALSE(stomp.target());
  for (Eigen::Index i = 0; i < 10; ++i) {
    EXPECT_NEAR((candidates.front().points.col(i) - path_[static_cast<std::size_t>(i) + 1]).norm(),
                0.0, 0.05);
  }
}

TEST_F(Planner, LooksAtAnUnknownObjectFromBesideThePath) {
  planning_.options.cost.centre_weight = 5.0;
  for (const ViewPlan& views : {ViewPlan(NearestObject{}), ViewPlan(ViewsOnTheWay{})}) {
    planning_.options.views = views;
    FlightPlanner stomp = planner(Stomp{});
    const Eigen::Matrix4Xd points = propose(stomp).front().points;
    ASSERT_TRUE(stomp.target());
    EXPECT_EQ(stomp.target()->object, 3);
    EXPECT_EQ(points.col(0), path_[1]) << "flown to already";
    EXPECT_EQ(points.col(9).head<3>(), path_[10].head<3>()) << "it comes back to the path";
    const Eigen::Vector2d to_object =
        objects_[0].p_world_m.head<2>() - Eigen::Vector2d(points.col(1).head<2>());
    EXPECT_NEAR(points(3, 1), std::atan2(to_object.y(), to_object.x()), 0.6) << "it turns to it";
    EXPECT_NEAR(stomp.target()->p_world_view_m.z(), 0.9 + 1.05 * std::sin(0.65), 1e-9)
        << "from where the camera has it in its middle";
    EXPECT_LT(points.row(2).minCoeff(), 1.79) << "it goes down for that";
  }
}

TEST_F(Planner, LeavesThePathOnlyThroughWhatWasSeen) {
  planning_.options.cost.recognition_weight = 3.0;
  objects_[0].p_world_m.y() = 1.3;
  FlightPlanner in_the_open = planner(Stomp{});
  const double seen_m = aside_m(propose(in_the_open).front());
  map_ = unseen_room();
  FlightPlanner in_the_dark = planner(Stomp{});
  const double unseen_m = aside_m(propose(in_the_dark).front());
  EXPECT_GT(seen_m, 0.3);
  EXPECT_LT(unseen_m, 0.25);
  EXPECT_TRUE(in_the_open.target());
  EXPECT_FALSE(in_the_dark.target()) << "no view of it keeps off what was not seen";
}

TEST_F(Planner, LooksAheadOnceItIsPast) {
  FlightPlanner stomp = planner(Stomp{});
  const Eigen::Matrix4Xd points = propose(stomp).front().points;
  for (Eigen::Index i = 6; i < 9; ++i) EXPECT_NEAR(points(3, i), 0.0, 0.3) << "point " << i;
}

TEST_F(Planner, AKnownObjectIsNoTarget) {
  objects_[0].entropy_nats = 0.05;
  FlightPlanner stomp = planner(Stomp{});
  propose(stomp);
  EXPECT_FALSE(stomp.target());
  objects_[0].entropy_nats = 2.0;
  objects_[0].used.fill(true);
  propose(stomp);
  EXPECT_FALSE(stomp.target()) << "no direction is left";
}

TEST_F(Planner, TheGivenPathIsFlownWhateverIsInTheWay) {
  FlightPlanner given = planner(GivenPath{});
  const std::vector<CandidatePlan> candidates = propose(given);
  ASSERT_EQ(candidates.size(), 1U);
  EXPECT_EQ(candidates.front().points.col(4), path_[5]);
}

TEST_F(Planner, GoingOnAsFlownIsTheLastResort) {
  FlightPlanner stomp = planner(Stomp{});
  const std::vector<CandidatePlan> candidates = propose(stomp);
  EXPECT_EQ(std::ranges::count(candidates, true, &CandidatePlan::same_spline), 1);
  ASSERT_TRUE(candidates.back().same_spline);
  for (Eigen::Index i = 0; i < candidates.back().points.cols(); ++i) {
    EXPECT_EQ(candidates.back().points.col(i), path_[static_cast<std::size_t>(i) + 1]);
  }
}

TEST_F(Planner, OnlyYawFollowsTheObjectOnTheGivenPath) {
  FlightPlanner yaw = planner(GivenPathYaw{});
  const Eigen::Matrix4Xd points = propose(yaw).front().points;
  EXPECT_EQ(points.col(1).head<3>(), path_[2].head<3>());
  EXPECT_NEAR(points(3, 1), std::atan2(0.9, 0.5), 1e-9);
}

TEST_F(Planner, TheLeashHoldsEveryMethodNearThePath) {
  for (const TrajectoryMethod& method : {TrajectoryMethod(Stomp{}), TrajectoryMethod(Mppi{}),
                                         TrajectoryMethod(Cem{}), TrajectoryMethod(Chomp{})}) {
    planning_.options.path_deviation_tolerance_m = 0.5;
    planning_.options.path_deviation_weight = 20.0;
    FlightPlanner optimiser = planner(method);
    const Eigen::Matrix4Xd points = propose(optimiser).front().points;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      EXPECT_LT((points.col(i) - path_[static_cast<std::size_t>(i) + 1]).head<3>().norm(), 0.75)
          << strategy_name_of(method) << ", point " << i;
    }
  }
}

TEST_F(Planner, TheLastWaypointsAreFlownAsGiven) {
  FlightPlanner stomp = planner(Stomp{});
  for (const int at : {17, 18}) {
    const Eigen::Matrix4Xd points = propose(stomp, at).front().points;
    EXPECT_EQ(points.cols(), 19 - at);
    EXPECT_EQ(points.rightCols<1>().topRows<3>(), path_.back().head<3>());
  }
  const auto beside = [&](int at) {
    objects_[0].p_world_m.x() = path_[static_cast<std::size_t>(at)].x() + 1.0;
    propose(stomp, at);
    return stomp.target();
  };
  EXPECT_TRUE(beside(13).has_value());
  EXPECT_FALSE(beside(14).has_value());
  planning_.horizon = 4;
  stomp = planner(Stomp{});
  EXPECT_TRUE(beside(10).has_value()) << "however few are planned at a time";
}

TEST_F(Planner, RulesHaveNoTargetOfThePlanners) {
  for (const TrajectoryMethod& method :
       {TrajectoryMethod(GivenPath{}), TrajectoryMethod(GivenPathYaw{}),
        TrajectoryMethod(DetourPath{})}) {
    FlightPlanner rule = planner(method);
    propose(rule);
    EXPECT_FALSE(rule.target().has_value()) << strategy_name_of(method);
  }
}

TEST_F(Planner, WhatIsBeyondItsWindowIsNotClear) {
  FlightPlanner stomp = planner(Stomp{});
  std::vector<CandidatePlan> candidates = propose(stomp);
  candidates.resize(1);
  ASSERT_TRUE(stomp.clear(clearance_m(stomp, candidates[0])));
  candidates[0].points.row(1).rightCols(3).setConstant(
      -3.8);  // within the map, where a wall may be
  EXPECT_FALSE(stomp.clear(clearance_m(stomp, candidates[0])));
}

TEST_F(Planner, TellsTheClearanceOfASpline) {
  CameraImages wall;
  wall.width_px = 160;
  wall.height_px = 120;
  wall.focal_px = 120.0;
  wall.range_max_m = 6.0;
  wall.depth_m.assign(160 * 120, 3.0F);  // a wall 3 m ahead of the start
  Pose T_world_camera = Pose::Identity();
  T_world_camera.translation() = Eigen::Vector3d(0.0, 0.0, 1.8);
  T_world_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // looks along x
  for (int i = 0; i < 3; ++i) map_.insert(wall, T_world_camera);
  objects_.clear();
  FlightPlanner given = planner(GivenPath{});
  std::vector<CandidatePlan> candidates = propose(given);
  EXPECT_LT(clearance_m(given, candidates.front()), 0.0) << "through the wall";
  map_ = FlightMap(
      Eigen::AlignedBox3d(Eigen::Vector3d(-3.0, -4.0, 0.0), Eigen::Vector3d(22.0, 4.0, 3.0)));
  candidates = propose(given);
  EXPECT_TRUE(given.clear(clearance_m(given, candidates.front())));
}

/// Eight of ten points are off: the first is flown to already, the last is that of the given path.
TEST_F(Planner, LeavingThePathCostsByWhatIsBeyondTheTolerance) {
  objects_.clear();
  EXPECT_NEAR(missing_m({0.0, 1.5, 0.0, 0.0}), 8.0 * (1.5 - 1.2), 1e-6);
  EXPECT_NEAR(missing_m({0.0, -1.2, 0.0, 0.0}), 0.0, 1e-6);
  EXPECT_NEAR(missing_m({0.0, 0.0, 0.4, 0.0}), 8.0 * (4.0 * 0.4 - 1.2), 1e-6) << "up counts more";
  EXPECT_NEAR(missing_m({0.0, 0.0, -0.4, 0.0}), 8.0 * (4.0 * 0.4 - 1.2), 1e-6) << "and down";
  path_[1].z() = 1.4;  // so low it may be anywhere
  EXPECT_NEAR(missing_m({0.0, 0.0, -0.38, 0.0}), 0.0, 1e-6);
  EXPECT_NEAR(missing_m({0.0, 0.0, 0.38, 0.0}), 8.0 * (4.0 * 0.38 - 1.2), 1e-6);
}

/// Views are where the camera has objects in its middle; the lowest of them counts, not the first.
TEST_F(Planner, WhatIsLookedAtSaysHowLowAPlanMayGo) {
  const double up_m = 1.05 * std::sin(0.65);
  objects_.push_back({.id = 4, .p_world_m = {6.5, 0.9, 0.4}, .entropy_nats = 2.0});
  EXPECT_NEAR(missing_m({0.0, 0.0, -0.7, 0.0}), 0.0, 1e-6);
  const double lower_m = 0.4 + up_m - 0.6;
  EXPECT_NEAR(missing_m({0.0, 0.0, -1.2, 0.0}), 8.0 * (4.0 * lower_m - 1.2), 1e-6);
  planning_.options.views = NearestObject{};
  EXPECT_NEAR(missing_m({0.0, 0.0, -0.7, 0.0}), 8.0 * (4.0 * (0.9 + up_m - 1.1) - 1.2), 1e-6);
  objects_.erase(objects_.begin());
  objects_[0].p_world_m.x() = 2.5;
  EXPECT_NEAR(missing_m({0.0, 0.0, -0.7, 0.0}), 0.0, 1e-6);
}

TEST_F(Planner, ViewsAreNoHigherThanThePath) {
  objects_[0].p_world_m.z() = 1.6;
  FlightPlanner best_start = planner(kBestStart);
  propose(best_start);
  ASSERT_TRUE(best_start.target());
  EXPECT_EQ(best_start.target()->p_world_view_m.z(), 1.8);
}

TEST_F(Planner, AViewDrawsAsLongAsItsObjectIsUnknown) {
  objects_[0].entropy_nats = 0.05;
  planning_.known_below_nats = 0.01;
  planning_.options.cost.recognition_weight = 0.0;
  const double without = cost_as_given();
  planning_.options.cost.recognition_weight = 1.0;
  const Eigen::Vector3d view_m(2.5, 0.9 - 1.05 * std::cos(0.65), 0.9 + 1.05 * std::sin(0.65));
  const ObservationTarget target{objects_[0].p_world_m, view_m, 2.0};
  const double of_one_point = recognition_cost({}, target, {2.0, 0.0, 1.8});
  EXPECT_NEAR(cost_as_given() - without, of_one_point, 1e-9);
}

TEST_F(Planner, AsPrintedObjectsAreWhatIsInTheWay) {
  objects_[0].p_world_m = Eigen::Vector3d(2.0, 0.3, 1.8);
  planning_.options.cost.literal = true;
  planning_.options.cost.obstacle_weight = 0.0;
  const double without = cost_as_given();
  planning_.options.cost.obstacle_weight = 1.0;
  EXPECT_NEAR(cost_as_given() - without, 0.5 + 0.5 - 0.3, 1e-9) << "at a metre a second";
}

TEST_F(Planner, StartsHeadedForWhatEachPointLooksAt) {
  planning_.options.cost.centre_weight = 5.0;
  for (const bool nearest : {false, true}) {
    planning_.options.views = nearest ? ViewPlan(NearestObject{}) : ViewPlan(ViewsOnTheWay{});
    FlightPlanner best_start = planner(kBestStart);
    const Eigen::Matrix4Xd points = propose(best_start).front().points;
    for (Eigen::Index i = 0; i < 10; ++i) {
      const double x_m = static_cast<double>(i + 1);
      // The one point within a metre of its view, or all but the first within three of the object.
      const bool looks = nearest ? i >= 1 && i <= 4 : i == 1;
      EXPECT_NEAR(points(3, i), looks ? std::atan2(0.9, 2.5 - x_m) : 0.0, 1e-9) << i;
    }
  }
}

TEST_F(Planner, PlansAfreshEachTime) {
  FlightPlanner used = planner(Chomp{.evaluations = 100});
  propose(used);
  objects_[0].p_world_m = Eigen::Vector3d(5.5, -0.9, 0.9);
  FlightPlanner fresh = planner(Chomp{.evaluations = 100});
  EXPECT_EQ(propose(used).front().points, propose(fresh).front().points);
}

TEST_F(Planner, EveryCandidateGoesFromWhereItIsFlownToBackToThePath) {
  std::vector<Eigen::Vector4d> plan = path_;
  plan[1].y() = 0.3;
  plan[10].y() = 0.2;
  for (const TrajectoryMethod& method :
       {TrajectoryMethod(GivenPathYaw{}), TrajectoryMethod(DetourPath{}),
        TrajectoryMethod(kBestStart)}) {
    FlightPlanner any = planner(method);
    for (const CandidatePlan& candidate :
         any.propose({.at = 0, .nominal = path_, .plan = plan}, objects_, map_)) {
      EXPECT_EQ(candidate.points.col(0), plan[1]) << candidate.planner;
      EXPECT_EQ(candidate.points.col(9).head<3>(), path_[10].head<3>()) << candidate.planner;
    }
  }
}

TEST_F(Planner, StandsWhereThePathEnds) {
  objects_.clear();
  EXPECT_NEAR(cost_as_given(15), 0.5, 1e-9) << "half of the square of stopping within a metre";
  EXPECT_NEAR(cost_as_given(17), 0.5, 1e-9);
  EXPECT_EQ(cost_as_given(18), 0.0) << "there is nothing left to choose";
}

/// Though the camera looks aside, and ahead there is something to see.
TEST_F(Planner, TheLastHeadingsAreThoseGiven) {
  for (Eigen::Vector4d& waypoint : path_) waypoint[3] = 1.5;
  objects_[0].p_world_m = Eigen::Vector3d(20.5, 0.0, 0.9);
  planning_.options.range_m = 8.0;
  planning_.options.cost.centre_weight = 5.0;
  FlightPlanner best_start = planner(kBestStart);
  const Eigen::Matrix4Xd points = propose(best_start, 15).front().points;
  EXPECT_LT((points.row(3).array() - 1.5).abs().maxCoeff(), 1e-9);
}

TEST_F(Planner, WhatIsJustClearEnoughIsClear) {
  planning_.options.clearance_m = 0.5;
  const FlightPlanner given = planner(GivenPath{});
  EXPECT_TRUE(given.clear(0.5));
  EXPECT_FALSE(given.clear(0.4999));
}

/// Over a floor 1.8 m below; what is farther than 1.5 m is that far.
TEST_F(Planner, ClearanceIsToSurfacesAndToTheEndOfWhatWasLookedAt) {
  objects_.clear();
  FlightPlanner given = planner(GivenPath{});
  propose(given);
  const auto clearance = [&](double y_m, double until_share) {
    const std::vector<FlightWaypoint> aside{{.p_world_m = {2.0, y_m, 1.8}, .yaw_rad = 0.0}};
    const MinimumJerkTrajectory path({.p_world_m = {2.0, 0.0, 1.8}}, aside);
    return given.clearance_m(path, until_share * path.duration_s());
  };
  EXPECT_NEAR(clearance(0.1, 1.0), 1.5, 0.02);
  EXPECT_NEAR(clearance(2.3, 1.0), 2.5 - 2.3, 0.02) << "two and a half metres beside the path";
  EXPECT_NEAR(clearance(-2.3, 1.0), 2.5 - 2.3, 0.02);
  EXPECT_GT(clearance(2.3, 0.3), 1.0) << "until then";
}

TEST_F(Planner, ClearanceIsAlsoThatOfTheBeginning) {
  objects_.clear();
  FlightPlanner given = planner(GivenPath{});
  propose(given);
  const std::vector<FlightWaypoint> back{{.p_world_m = {2.0, 0.0, 1.8}, .yaw_rad = 0.0}};
  const MinimumJerkTrajectory path({.p_world_m = {2.0, 2.3, 1.8}}, back);
  EXPECT_NEAR(given.clearance_m(path, path.duration_s()), 2.5 - 2.3, 1e-6);
}

TEST_F(Planner, ClearanceIsAlsoThatOfTheEndBetweenTwoSamples) {
  objects_.clear();
  const std::vector<FlightWaypoint> aside{{.p_world_m = {2.0, 2.3, 1.8}, .yaw_rad = 0.0}};
  const MinimumJerkTrajectory path({.p_world_m = {2.0, 0.0, 1.8}}, aside);
  const auto clearance_m = [&](double sample_s, double until_s) {
    planning_.options.sample_s = sample_s;
    FlightPlanner given = planner(GivenPath{});
    propose(given);
    return given.clearance_m(path, until_s);
  };
  const double until_s = std::floor(path.duration_s()) - 0.05;
  EXPECT_NEAR(clearance_m(1.0, until_s), clearance_m(0.01, until_s), 1e-6);
  EXPECT_LT(clearance_m(1.0, until_s), clearance_m(1.0, std::floor(until_s)) - 0.01);
}

TEST(SafestOfBest, IsTheFirstThatIsClearElseWhatKeepsOffFarthest) {
  std::vector<CandidatePlan> plans(3);
  plans[0].clearance_m = 0.1;
  plans[1].clearance_m = 0.4;
  plans[2].clearance_m = 0.2;
  EXPECT_EQ(safest_of_best(plans), 0U) << "clear unless they are found not to be";
  for (CandidatePlan& plan : plans) plan.clear = false;
  EXPECT_EQ(safest_of_best(plans), 1U);
  plans[2].clear = true;
  EXPECT_EQ(safest_of_best(plans), 2U);
  plans[0].clear = true;
  EXPECT_EQ(safest_of_best(plans), 0U);
}

TEST_F(Planner, WhatIsKnownIsThatOfThePlanning) {
  for (const TrajectoryMethod& method :
       {TrajectoryMethod(GivenPathYaw{}), TrajectoryMethod(DetourPath{})}) {
    const auto turned_rad = [&](double entropy_nats, double known_below_nats) {
      objects_[0].entropy_nats = entropy_nats;
      planning_.known_below_nats = known_below_nats;
      FlightPlanner rule = planner(method);
      return propose(rule).front().points.row(3).maxCoeff();
    };
    EXPECT_EQ(turned_rad(2.0, 2.5), 0.0) << strategy_name_of(method);
    EXPECT_GT(turned_rad(0.05, 0.01), 1.0) << strategy_name_of(method);
  }
}

TEST_F(Planner, TheTargetIsTheFirstViewOnTheWay) {
  objects_.insert(objects_.begin(),
                  PlannableObject{.id = 4, .p_world_m = {6.5, 0.9, 0.9}, .entropy_nats = 2.0});
  FlightPlanner best_start = planner(kBestStart);
  propose(best_start);
  ASSERT_TRUE(best_start.target());
  EXPECT_EQ(best_start.target()->object, 3);
  EXPECT_NEAR(best_start.target()->p_world_view_m.x(), 2.5, 1e-9);
}

/// From the last two waypoints on nothing is left to choose.
TEST_F(Planner, WhatIsFlownToIsThatOfThePlanTheEndThatOfThePath) {
  std::vector<Eigen::Vector4d> plan = path_;
  plan[18].y() = 0.3;
  plan[19].y() = 0.2;
  FlightPlanner best_start = planner(kBestStart);
  for (const CandidatePlan& candidate :
       best_start.propose({.at = 17, .nominal = path_, .plan = plan}, objects_, map_)) {
    EXPECT_EQ(candidate.points.col(0), plan[18]) << candidate.planner;
    EXPECT_EQ(candidate.points.col(1), path_[19]) << candidate.planner;
  }
  for (const CandidatePlan& candidate :
       best_start.propose({.at = 18, .nominal = path_, .plan = plan}, objects_, map_)) {
    EXPECT_EQ(candidate.points.col(0), plan[19]) << candidate.planner;
  }
}

}  // namespace
}  // namespace vantage
