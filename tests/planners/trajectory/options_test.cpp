// Defaults and ranges of what trajectories are planned by, by number.
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/option_numbers.hpp"
#include "vantage/planners/trajectory/flight_planner.hpp"
#include "vantage/planners/trajectory/optimisers/noisy_rollouts.hpp"
#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"

namespace vantage {
namespace {

using support::expect_numbers;

constexpr Range kPositiveShareOption{0.0, 1.0, true};
constexpr Range kNotNegativeOption = at_least(0.0);

TEST(TrajectoryOptions, OfTheCost) {
  expect_numbers(FlightCostOptions{}, {{"obstacle_weight", 5.0, kNotNegativeOption},
                                       {"centre_weight", 1.0, kNotNegativeOption},
                                       {"recognition_weight", 0.5, kNotNegativeOption},
                                       {"information", 1},
                                       {"epsilon_m", 0.5, kNotNegativeOption},
                                       {"body_radius_m", 0.5, kNotNegativeOption},
                                       {"speed_floor_m_s", 0.2, kNotNegativeOption},
                                       {"segment_s", 1.0, above(0.0)},
                                       {"bearing_weight", 0.5, kNotNegativeOption},
                                       {"between_waypoints", 1},
                                       {"clearance_m", 0.6, kNotNegativeOption},
                                       {"clearance_weight", 50.0, kNotNegativeOption},
                                       {"delta_m", 2.0, kNotNegativeOption},
                                       {"literal", 0}});
  EXPECT_EQ(FlightCostOptions{}.tau_nats, 0.1);
  EXPECT_NEAR(FlightCamera{}.horizontal_fov_rad, 57.0 * M_PI / 180.0, 1e-12);
  EXPECT_NEAR(FlightCamera{}.vertical_fov_rad, 45.0 * M_PI / 180.0, 1e-12);
}

TEST(TrajectoryOptions, OfTheOptimisers) {
  const support::OptionNumber rollouts{"rollouts", 20, between(2, 10'000)};
  const support::OptionNumber iterations{"iterations", 50, between(1, 100'000)};
  const support::OptionNumber temperature{"inverse_temperature", 10.0, above(0.0)};
  const support::OptionNumber decay{"decay", 0.97, kPositiveShareOption};
  const auto sigma = [](int axis, double value) {
    return support::OptionNumber{"sigma_m[" + std::to_string(axis) + "]", value,
                                 kNotNegativeOption};
  };
  const support::OptionNumber sigma_yaw{"sigma_yaw_rad", 0.5, kNotNegativeOption};
  expect_numbers(Stomp{}, {rollouts, iterations, temperature, sigma(0, 0.5), sigma(1, 0.5),
                           sigma(2, 0.2), sigma_yaw, decay});
  expect_numbers(Mppi{}, {rollouts, iterations, temperature, sigma(0, 0.5), sigma(1, 0.5),
                          sigma(2, 0.2), sigma_yaw, decay});
  expect_numbers(Cem{}, {rollouts,
                         iterations,
                         {"elites", 5, between(2, 10'000)},
                         {"learning", 0.5, kPositiveShareOption},
                         {"min_sigma", 0.1, between(0.0, 1.0)},
                         sigma(0, 1.0),
                         sigma(1, 1.0),
                         sigma(2, 0.4),
                         {"sigma_yaw_rad", 1.0, kNotNegativeOption}});
  expect_numbers(Chomp{}, {{"evaluations", 1001, between(1, 1'000'000)},
                           {"first_step", 0.5, above(0.0)},
                           {"min_step", 1e-4, above(0.0)},
                           {"difference", 1e-4, between(1e-9, 0.1)},
                           {"scale_m[0]", 0.5, kNotNegativeOption},
                           {"scale_m[1]", 0.5, kNotNegativeOption},
                           {"scale_m[2]", 0.2, kNotNegativeOption},
                           {"scale_yaw_rad", 0.5, kNotNegativeOption}});
  EXPECT_EQ(RolloutRounds{}.rollouts, 20);
  EXPECT_EQ(RolloutRounds{}.rounds, 50);
}

TEST(TrajectoryOptions, OfTheMethods) {
  expect_numbers(GivenPathYaw{}, {{"range_m", 3.0, above(0.0)}});
  expect_numbers(DetourPath{}, {{"range_m", 3.0, above(0.0)}, {"views", 2, between(1, 8)}});
  expect_numbers(YawToTarget{},
                 {{"tau_nats", 0.1, kNotNegativeOption}, {"range_m", 3.0, above(0.0)}});
  expect_numbers(GreedyDetour{}, {{"tau_nats", 0.1, kNotNegativeOption},
                                  {"range_m", 3.0, above(0.0)},
                                  {"views", 2, between(1, 8)}});
  expect_numbers(ViewsOnTheWay{}, {{"before_m", 1.0, kNotNegativeOption},
                                   {"after_m", 0.4, kNotNegativeOption},
                                   {"apart_m", 0.5, above(0.0)},
                                   {"off_m", 0.5, above(0.0)},
                                   {"reach_m", 0.7, kNotNegativeOption}});
  expect_numbers(SearchOptions{}, {{"turn_rad", 1.0, between(0.0, 3.0)},
                                   {"below_m", 0.9, kNotNegativeOption},
                                   {"range_m", 2.5, between(0.6, 10.0)},
                                   {"min_area_m2", 0.3, kNotNegativeOption}});
}

TEST(TrajectoryOptions, OfThePlanner) {
  const FlightPlannerOptions options;
  EXPECT_EQ(options.observation_distance_m, 1.05);
  EXPECT_EQ(options.range_m, 3.0);
  EXPECT_EQ(options.path_deviation_tolerance_m, 1.2);
  EXPECT_EQ(options.path_deviation_weight, 2.0);
  EXPECT_EQ(options.clearance_m, 0.55);
  EXPECT_EQ(options.sample_s, 0.05);
  using Member = double FlightPlannerOptions::*;
  const auto is_in_range = [](Member member, double value) {
    FlightPlannerOptions changed;
    changed.*member = value;
    try {
      check_options(changed);
      return true;
    } catch (const ConfigError&) {
      return false;
    }
  };
  const auto expect_range = [&](Member member, double lowest, double highest) {
    constexpr double kBeside = 1e-6;
    EXPECT_TRUE(is_in_range(member, lowest));
    EXPECT_TRUE(is_in_range(member, highest));
    EXPECT_FALSE(is_in_range(member, lowest - kBeside));
    if (highest < 1e6) {
      EXPECT_FALSE(is_in_range(member, highest + kBeside));
    }
  };
  expect_range(&FlightPlannerOptions::observation_distance_m, 0.3, 3.0);
  expect_range(&FlightPlannerOptions::path_deviation_tolerance_m, 0.0, 1e6);
  expect_range(&FlightPlannerOptions::path_deviation_weight, 0.0, 1e6);
  expect_range(&FlightPlannerOptions::clearance_m, 0.0, 3.0);
  expect_range(&FlightPlannerOptions::sample_s, 0.01, 1.0);
  EXPECT_FALSE(is_in_range(&FlightPlannerOptions::range_m, 0.0));
  EXPECT_TRUE(is_in_range(&FlightPlannerOptions::range_m, 1e-6));
  EXPECT_EQ(FlightPlanning{}.horizon, 10);
  EXPECT_EQ(FlightPlanning{}.known_below_nats, 0.1);
  EXPECT_EQ(ObservationRing{}.radius_m, 1.3);
  EXPECT_EQ(ObservationRing{}.height_m, 1.0);
}

TEST(TrajectoryOptions, OfThePlannerAreCheckedWithTheirParts) {
  EXPECT_NO_THROW(check_options(FlightPlannerOptions{}));
  FlightPlannerOptions cost;
  cost.cost.segment_s = 0.0;
  EXPECT_THROW(check_options(cost), ConfigError);
  FlightPlannerOptions views;
  views.views = ViewsOnTheWay{.off_m = 0.0};
  EXPECT_THROW(check_options(views), ConfigError);
  FlightPlannerOptions search;
  search.search.range_m = 0.5;
  EXPECT_THROW(check_options(search), ConfigError);
}

TEST(TrajectoryOptions, OfWhatIsHandedOver) {
  EXPECT_EQ(ViewTarget{}.object, 0);
  EXPECT_EQ(ViewTarget{}.direction, 0);
  EXPECT_EQ(ViewTarget{}.entropy_nats, 0.0);
  EXPECT_EQ(CandidatePlan{}.cost, 0.0);
  EXPECT_EQ(CandidatePlan{}.clearance_m, 0.0);
  EXPECT_EQ(PlannableObject{}.id, 0);
  EXPECT_EQ(PlannableObject{}.entropy_nats, 0.0);
  EXPECT_EQ(ScheduledView{}.object, 0U);
  EXPECT_EQ(ScheduledView{}.direction, 0);
  EXPECT_EQ(ScheduledView{}.at_m, 0.0);
  EXPECT_EQ(ScheduledView{}.utility, 0.0);
  EXPECT_EQ(OnPath{}.distance_m, 0.0);
  EXPECT_EQ(OnPath{}.at, 0.0);
  EXPECT_EQ(OptimisedHorizon{}.cost, 0.0);
  EXPECT_EQ(OptimisedHorizon{}.initial_cost, 0.0);
  EXPECT_EQ(OptimisedHorizon{}.evaluations, 0);
  const std::vector<Eigen::Vector4d> path;
  const PlanState state{.nominal = path, .plan = path};
  EXPECT_EQ(state.at, 0);
}

TEST(PathNoise, HasADeviationOfEachAxisAndOfYaw) {
  const PathNoise noise{.sigma_m = {1.0, 2.0, 3.0}, .sigma_yaw_rad = 4.0};
  EXPECT_EQ(noise.sigma(), Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
}

TEST(TrajectoryMethodName, SaysWhatIsLeftOutOfTheCost) {
  EXPECT_EQ(trajectory_method_name(Stomp{}, {}), "stomp");
  EXPECT_EQ(trajectory_method_name(Stomp{.rollouts = 10}, {.centre_weight = 0.0}),
            "stomp rollouts=10 without c_v");
  EXPECT_EQ(trajectory_method_name(Cem{}, {.information = false}), "cem without c_i");
  EXPECT_EQ(trajectory_method_name(GivenPath{}, {.literal = true}), "initial literal");
  const FlightCostOptions bare{.centre_weight = 0.0, .information = false, .literal = true};
  EXPECT_EQ(trajectory_method_name(GivenPath{}, bare), "initial without c_i without c_v literal");
}

}  // namespace
}  // namespace vantage
