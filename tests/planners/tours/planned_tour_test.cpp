#include "vantage/planners/tours/planned_tour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vantage/planners/tours/frontier_tour.hpp"
#include "vantage/planners/tours/rollout.hpp"
#include "vantage/planners/tours/tour.hpp"

namespace vantage {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Views at 10, 20 and 25 m on a line, the robot at 0, a metre a second, scans of 5 s. Each shows 8
/// cells of its own; the second shows half of the first one's too.
PlanningProblem three_views() {
  PlanningProblem problem;
  problem.cells = {8.0F, 8.0F, 8.0F};
  problem.shows = {{{0}, {1.0F}}, {{0, 1}, {0.5F, 1.0F}}, {{2}, {1.0F}}};
  problem.place_m = {{10.0, 0.0}, {20.0, 0.0}, {25.0, 0.0}};
  problem.travel_s.resize(4, 3);
  problem.travel_s << 0, 10, 15, 10, 0, 5, 15, 5, 0, 10, 20, 25;
  problem.scan_s = 5.0;
  return problem;
}

PlanReason reason(const PlanningProblem& problem, const PlannedViews& plan,
                  FormerPlan former = FormerPlan::goes_on) {
  return why_planned(problem, former, plan);
}

TEST(WhyPlanned, TellsWhatThePlanBeforeHasToDoWithIt) {
  PlanningProblem problem = three_views();
  const PlannedViews plan{{0, 2}};
  EXPECT_EQ(reason(problem, plan, FormerPlan::none).change, PlanChange::first);
  EXPECT_EQ(reason(problem, plan, FormerPlan::ended).change, PlanChange::ended);
  EXPECT_EQ(reason(problem, plan).change, PlanChange::gone);
  problem.intended = 0;
  EXPECT_EQ(reason(problem, plan).change, PlanChange::kept);
  problem.intended = 2;
  EXPECT_EQ(reason(problem, plan).change, PlanChange::replanned);
}

TEST(WhyPlanned, TellsWhyTheIntendedViewCannotBeTaken) {
  PlanningProblem problem = three_views();
  problem.intended = 2;
  const PlannedViews plan{{0}, PlanCosts{.taken_s = 20.0}};
  problem.left.time_s = 29.0;  // it takes 30
  EXPECT_EQ(reason(problem, plan).change, PlanChange::unaffordable);
  problem.left.time_s = 30.0;
  EXPECT_EQ(reason(problem, plan).change, PlanChange::replanned);
  problem.home_s = {10.0, 20.0, 25.0, 0.0};
  EXPECT_EQ(reason(problem, plan).change, PlanChange::unaffordable);
  problem.travel_s(3, 2) = kUnbounded;
  EXPECT_EQ(reason(problem, plan).change, PlanChange::unreachable);
}

TEST(WhyPlanned, TellsBySeconds) {
  PlanningProblem problem = three_views();
  problem.intended = 2;
  const PlannedViews plan{{0}, PlanCosts{.taken_s = 20.0, .intended_s = 34.25}};
  const PlanReason cheaper = reason(problem, plan);
  EXPECT_EQ(cheaper.change, PlanChange::cheaper);
  EXPECT_EQ(cheaper.saved_s, 14.25);
  problem.cells[2] = 0.0F;
  EXPECT_EQ(reason(problem, plan).change, PlanChange::exhausted);
  EXPECT_TRUE(std::isnan(reason(problem, plan).saved_s));
  problem.beyond = {0.0, 0.0, 3.0};
  problem.pace_per_s = 1.0;
  EXPECT_EQ(reason(problem, plan).change, PlanChange::cheaper) << "it leads somewhere";
}

TEST(WhyPlanned, IsToldInWords) {
  for (std::size_t i = 0; i < kPlanChanges; ++i) {
    const auto change = static_cast<PlanChange>(i);
    EXPECT_EQ(plan_change_of(name_of(change)), change);
    EXPECT_FALSE(sentence_of({change, 1.0}).empty());
  }
  EXPECT_FALSE(plan_change_of("guessed"));
  EXPECT_EQ(sentence_of({PlanChange::kept}), "goes on as intended");
  EXPECT_EQ(sentence_of({PlanChange::cheaper, 14.25}),
            "another tour costs 14.2 s less than the best that goes on as intended");
}

/// Of the choice itself: what it took against the best that goes on as intended.
TEST(WhyPlanned, AChoiceThatWeighsToursKnowsTheDifference) {
  PlanningProblem problem = three_views();
  problem.draw = [&problem](Rng&) { return ShownBlocks{problem.cells, problem.shows}; };
  problem.intended = 2;
  Rng rng(1);
  TourChoice choice;
  const PlannedViews plan = choice(problem, rng);
  ASSERT_EQ(plan.order.front(), 0U);
  const double intended_s =
      search_tour(problem, choice.objective(), choice.search(), problem.intended).cost_s;
  const double taken_s = tour_cost_s(problem, choice.objective(), plan.order);
  EXPECT_EQ(reason(problem, plan).change, PlanChange::cheaper);
  EXPECT_NEAR(reason(problem, plan).saved_s, intended_s - taken_s, 1e-9);
  EXPECT_GT(reason(problem, plan).saved_s, choice.keep_s);
  // The map is certain: so is what rollout draws.
  EXPECT_NEAR(reason(problem, Rollout{}(problem, rng)).saved_s, intended_s - taken_s, 1e-9);
  choice.keep_s = 1000.0;
  EXPECT_EQ(reason(problem, choice(problem, rng)).change, PlanChange::kept);
  problem.intended = 1;
  EXPECT_EQ(reason(problem, FrontierTour{}(problem, rng)).change, PlanChange::replanned);
}

TEST(PlannedTour, HasTimesAndWhatEachStopAdds) {
  PlanningProblem problem = three_views();
  problem.beyond = {0.0, 12.0, 0.0};
  problem.pace_per_s = 3.0;
  const PlannedTour tour = planned_tour(problem, FormerPlan::none, {{0, 1, 2}, PlanCosts{1.0}});
  ASSERT_EQ(tour.stops.size(), 3U);
  EXPECT_EQ(tour.stops[1].place_m, Eigen::Vector2d(20.0, 0.0));
  EXPECT_EQ(tour.stops[0].arrival_s, 10.0);
  EXPECT_EQ(tour.stops[0].departure_s, 15.0);
  EXPECT_EQ(tour.stops[1].arrival_s, 25.0);
  EXPECT_EQ(tour.stops[1].departure_s, 34.0) << "a scan, and 12 cells beyond at 3 a second";
  EXPECT_EQ(tour.stops[2].arrival_s, 39.0);
  EXPECT_EQ(tour.ends_s(), 44.0);
  EXPECT_EQ(tour.stops[0].gain, 8.0);
  EXPECT_EQ(tour.stops[1].gain, 8.0) << "the first has shown the rest";
  EXPECT_EQ(tour.stops[1].beyond, 12.0);
  const PlannedTour route = planned_tour(problem, FormerPlan::none, {{1, 0}});
  EXPECT_EQ(route.stops[0].departure_s, 25.0) << "it does not count what lies beyond";
  EXPECT_EQ(route.stops[0].beyond, 0.0);
  EXPECT_EQ(route.stops[0].gain, 12.0);
  EXPECT_EQ(route.stops[1].gain, 4.0);
  EXPECT_EQ(PlannedTour{}.ends_s(), 0.0);
}

TEST(PlanningProblem, HasNothingThatItWasNotTold) {
  const PlanningProblem problem{};
  EXPECT_EQ(problem.seen, 0.0);
  EXPECT_EQ(problem.pace_per_s, 0.0);
  EXPECT_EQ(problem.scan_s, 0.0);
  EXPECT_EQ(problem.energy_j(1.0, 1.0), 0.0) << "no power";
  EXPECT_EQ(PlanCosts{}.taken_s, 0.0);
  EXPECT_EQ(PlannedStop{}.id, -1);
  EXPECT_EQ(PlannedStop{}.yaw_rad, 0.0);
  EXPECT_EQ(PlannedStop{}.arrival_s, 0.0);
  EXPECT_EQ(PlannedStop{}.departure_s, 0.0);
  EXPECT_EQ(PlannedStop{}.gain, 0.0);
  EXPECT_EQ(PlannedStop{}.beyond, 0.0);
  EXPECT_EQ(Tour{}.cost_s, 0.0);
}

/// Down to the last second, joule and scan, with the way home where there is one.
TEST(IsAffordable, CountsDrivesScansAndTheWayHome) {
  PlanningProblem problem = three_views();
  problem.driving_w = 100.0;
  problem.scanning_w = 40.0;
  const std::vector<std::size_t> order{0, 2};  // 10 + 15 s of driving, 10 s of scanning
  EXPECT_TRUE(is_affordable(problem, order));
  problem.left.energy_j = 2500.0 + 400.0;
  EXPECT_TRUE(is_affordable(problem, order));
  problem.left.energy_j = 2899.9;
  EXPECT_FALSE(is_affordable(problem, order));
  problem.home_s = {10.0, 20.0, 25.0, 0.0};
  problem.left = {.scans = 2, .time_s = 60.0, .energy_j = 5400.0};
  EXPECT_TRUE(is_affordable(problem, order));
  problem.left.energy_j = 5399.9;
  EXPECT_FALSE(is_affordable(problem, order));
  problem.left = {.scans = 2, .time_s = 59.9};
  EXPECT_FALSE(is_affordable(problem, order));
  problem.left = {.scans = 1};
  EXPECT_FALSE(is_affordable(problem, order));
  EXPECT_TRUE(is_affordable(problem, std::vector<std::size_t>{2}));
  problem.left = {.scans = 0};
  EXPECT_FALSE(is_affordable(problem, std::vector<std::size_t>{2}));
  EXPECT_TRUE(affordable_views(problem).empty());
  problem.left = {};
  EXPECT_TRUE(is_affordable(problem, order));
  problem.home_s[2] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_affordable(problem, order)) << "no way home, with no limit either";
}

/// Cells of its own, and half of those that the first view shows too.
TEST(GainOf, IsTheShareOfEachBlock) {
  const PlanningProblem problem = three_views();
  EXPECT_EQ(gain_of(problem, 0), 8.0);
  EXPECT_EQ(gain_of(problem, 1), 12.0);
}

TEST(ViewNear, ReachesAsFarAsItIsSaidTo) {
  const PlanningProblem problem = three_views();
  EXPECT_EQ(view_near(problem, {26.5, 0.0}, 1.5), 2U);
  EXPECT_EQ(view_near(problem, {26.51, 0.0}, 1.5), std::nullopt);
  EXPECT_EQ(view_near(problem, {10.0, -1.5}, 1.5), 0U);
  EXPECT_EQ(view_near(problem, {10.0, -1.51}, 1.5), std::nullopt);
  EXPECT_EQ(view_near(problem, {20.9, 1.2}, 1.5), 1U);
}

TEST(PlanningProblemDeathTest, NamesWhatDoesNotFit) {
  const auto check = [](const auto& change) {
    PlanningProblem problem = three_views();
    change(problem);
    problem.check();
  };
  check([](PlanningProblem& p) { p.intended = 2; });
  check([](PlanningProblem& p) { p.shows[1].block.back() = 2; });
  check([](PlanningProblem& p) { p.home_s.resize(4); });
  check([](PlanningProblem& p) { p.shows[1] = {}; });
  EXPECT_DEATH(check([](PlanningProblem& p) { p.travel_s.resize(3, 3); }), "a travel time");
  EXPECT_DEATH(check([](PlanningProblem& p) { p.travel_s.resize(4, 4); }), "a travel time");
  EXPECT_DEATH(check([](PlanningProblem& p) { p.place_m.pop_back(); }), "a place of each view");
  EXPECT_DEATH(check([](PlanningProblem& p) { p.beyond.resize(2); }), "what lies beyond");
  EXPECT_DEATH(check([](PlanningProblem& p) { p.intended = 3; }), "is intended");
  EXPECT_DEATH(check([](PlanningProblem& p) { p.home_s.resize(3); }), "a way home");
  EXPECT_DEATH(check([](PlanningProblem& p) { p.shows[1].share.pop_back(); }), "a share of each");
  EXPECT_DEATH(check([](PlanningProblem& p) { p.shows[1].block.back() = 3; }), "blocks of the");
}

/// Arrivals at 10 and 25 s of whole scans; half of the first one saves 2.5 s.
TEST(PlannedTour, LeavesAPartialScanSooner) {
  PlanningProblem problem = three_views();
  problem.scan_share = {0.5, 1.0, 0.2};
  const PlannedTour tour = planned_tour(problem, FormerPlan::none, {{0, 1, 2}});
  EXPECT_EQ(tour.stops[0].departure_s, 12.5);
  EXPECT_EQ(tour.stops[1].arrival_s, 22.5);
  EXPECT_EQ(tour.stops[1].departure_s, 27.5);
  EXPECT_EQ(tour.stops[2].departure_s, 33.5);
}

TEST(PartialScans, AreAffordableSooner) {
  PlanningProblem problem = three_views();
  problem.scan_share = {0.5, 1.0, 0.2};
  problem.scanning_w = 10.0;
  problem.left.time_s = 27.5;
  EXPECT_TRUE(is_affordable(problem, std::vector<std::size_t>{0, 1}));
  problem.left.time_s = 27.4;
  EXPECT_FALSE(is_affordable(problem, std::vector<std::size_t>{0, 1}));
  problem.left = {};
  problem.left.energy_j = 75.0;
  EXPECT_TRUE(is_affordable(problem, std::vector<std::size_t>{0, 1}));
  problem.left.energy_j = 74.0;
  EXPECT_FALSE(is_affordable(problem, std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace vantage
