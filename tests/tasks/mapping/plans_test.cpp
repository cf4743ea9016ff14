// plans.csv and the event log of an episode whose choice plans ahead.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/csv_column.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/undescribed.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/report/run_plans.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/tasks/mapping/plans/plan_table.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// A table-top episode of four scans.
void run_episode(const fs::path& folder, const std::string& choice, bool lean = false) {
  set_verbosity(Verbosity::quiet);
  run(load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/tabletop.yaml",
                   {"scans=4", "map.cells=[49,49,25]", "laser.scan_duration_s=3", choice}),
      {folder, false, false, {}, lean});
}

class Plans : public testing::Test {
 protected:
  /// The run folder of one whose choice is `tour`.
  static fs::path tour_run() {
    static const support::TemporaryDirectory folder;
    static const bool made = [] {
      run_episode(folder / "run", "choice=tour");
      return true;
    }();
    return made ? folder / "run" : fs::path();
  }
  static std::string field(const CsvTable& table, std::size_t row, std::string_view name) {
    return table.rows.at(row).at(support::column_index(table, name));
  }

  support::TemporaryDirectory folder_;
};

TEST_F(Plans, BeginWithTheViewThatIsTaken) {
  const auto plans = read_plans(tour_run() / "plans.csv");
  const CsvTable steps = read_csv(tour_run() / "steps.csv");
  ASSERT_EQ(plans.size(), 3U);
  ASSERT_EQ(steps.rows.size(), 4U);
  std::size_t stops = 0;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const RecordedPlan& plan = plans[i];
    EXPECT_EQ(plan.scan, i + 2);
    EXPECT_EQ(plan.gain_unit, "cells");
    EXPECT_EQ(std::to_string(plan.tour.stops.front().id), field(steps, i + 1, "chosen_view"));
    const Eigen::Vector2d taken_m(std::stod(field(steps, i + 1, "x_m")),
                                  std::stod(field(steps, i + 1, "y_m")));
    EXPECT_LT((plan.tour.stops.front().place_m - taken_m).norm(), 0.5) << "of base and sensor";
    EXPECT_GE(plan.time_s, std::stod(field(steps, i, "time_s")));
    EXPECT_LT(plan.time_s, std::stod(field(steps, i + 1, "time_s")));
    EXPECT_EQ(plan.tour.reason.change == PlanChange::first, i == 0);
    stops += plan.tour.stops.size();
    for (std::size_t k = 1; k < plan.tour.stops.size(); ++k) {
      EXPECT_GE(plan.tour.stops[k].arrival_s, plan.tour.stops[k - 1].departure_s);
    }
  }
  EXPECT_GT(stops, plans.size()) << "it looks beyond the next view";
  EXPECT_TRUE(test::undescribed(tour_run(), Tabletop::records()).empty());
}

/// A plan that is kept goes to where the plan before wanted to go.
TEST_F(Plans, AreKeptWhereTheyGoOn) {
  const auto plans = read_plans(tour_run() / "plans.csv");
  for (std::size_t i = 1; i < plans.size(); ++i) {
    const auto& before = plans[i - 1].tour.stops;
    const bool goes_on = before.size() > 1;
    EXPECT_EQ(plans[i].tour.reason.change == PlanChange::ended, !goes_on);
    if (!goes_on) continue;
    const double off_m = (before[1].place_m - plans[i].tour.stops[0].place_m).norm();
    if (plans[i].tour.reason.change == PlanChange::kept) {
      EXPECT_LE(off_m, 1.5);
    } else {
      EXPECT_GT(off_m, 0.0);
    }
  }
}

TEST_F(Plans, AreToldToWhoeverWatches) {
  const auto plans = read_plans(tour_run() / "plans.csv");
  const auto options = std::get<Tabletop>(load_recorded(tour_run()).task);
  const auto events = read_event_log(tour_run() / "story.bin", options.map.frame().size());
  std::vector<PlannedTour> told;
  for (const EpisodeEvent& event : events) {
    if (const auto* tour = std::get_if<PlannedTour>(&event.what)) told.push_back(*tour);
  }
  ASSERT_EQ(told.size(), plans.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    ASSERT_EQ(told[i].stops.size(), plans[i].tour.stops.size());
    EXPECT_EQ(told[i].reason.change, plans[i].tour.reason.change);
    EXPECT_EQ(told[i].stops.back().place_m, plans[i].tour.stops.back().place_m);
    EXPECT_EQ(told[i].ends_s(), plans[i].tour.ends_s());
  }
}

/// One sweep is enough: what the candidates are said to show is what the plan weighed.
TEST_F(Plans, GiveTheCandidatesTheirGains) {
  const auto plans = read_plans(tour_run() / "plans.csv");
  const auto options = std::get<Tabletop>(load_recorded(tour_run()).task);
  std::size_t i = 0;
  for (const EpisodeEvent& event :
       read_event_log(tour_run() / "story.bin", options.map.frame().size())) {
    const auto* decision = std::get_if<Decision>(&event.what);
    if (decision == nullptr) continue;
    ASSERT_LT(i, plans.size());
    const PlannedStop& first = plans[i++].tour.stops.front();
    EXPECT_EQ(decision->candidates[decision->chosen].id, first.id);
    EXPECT_NEAR(decision->candidates[decision->chosen].gain_bits, first.gain, 1e-3 * first.gain);
    EXPECT_GT(std::ranges::count_if(decision->candidates,
                                    [](const Candidate& view) { return view.gain_bits > 0.0; }),
              20);
  }
  EXPECT_EQ(i, plans.size());
}

/// What the gain in use says, also where the choice knows better.
TEST_F(Plans, OfTheTruthLeaveTheCandidatesTheirForecasts) {
  const auto first_gains = [&](const std::string& choice) {
    run_episode(folder_ / choice, "choice=" + choice);
    const auto options = std::get<Tabletop>(load_recorded(folder_ / choice).task);
    std::vector<double> gains;
    for (const EpisodeEvent& event :
         read_event_log(folder_ / choice / "story.bin", options.map.frame().size())) {
      const auto* decision = std::get_if<Decision>(&event.what);
      if (decision == nullptr || !gains.empty()) continue;
      for (const Candidate& view : decision->candidates) gains.push_back(view.gain_bits);
    }
    return gains;
  };
  const std::vector<double> forecast = first_gains("greedy");
  ASSERT_EQ(forecast.size(), 30U);
  EXPECT_EQ(first_gains("oracle_tour"), forecast);
}

TEST_F(Plans, AreNoneOfAChoiceThatDoesNotPlanAheadNorOfALeanRun) {
  run_episode(folder_ / "greedy", "choice=greedy");
  run_episode(folder_ / "lean", "choice=tour", true);
  EXPECT_FALSE(fs::exists(folder_ / "greedy" / "plans.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "lean" / "plans.csv"));
}

TEST_F(Plans, AreWrittenStopByStop) {
  PlanTable table(folder_.path());
  PlannedTour tour;
  tour.stops = {{.id = 7,
                 .place_m = {1.5, -2.25},
                 .yaw_rad = 0.75,
                 .arrival_s = 3.5,
                 .departure_s = 13.5,
                 .gain = 900.5,
                 .beyond = 12.25},
                {.id = -1,
                 .place_m = {4.5, 5.25},
                 .yaw_rad = -0.5,
                 .arrival_s = 20.5,
                 .departure_s = 31.25,
                 .gain = 80.5,
                 .beyond = 0.125}};
  tour.reason = {PlanChange::cheaper, 14.25};
  table.add(tour, {.scan = 3, .time_s = 60.5, .gain_unit = "cells"});
  tour.stops.resize(1);
  tour.stops[0].id = 0;
  tour.reason = {};
  table.add(tour, {.scan = 4, .time_s = 70.5, .gain_unit = "bits"});
  table.commit();
  EXPECT_EQ(read_file(folder_ / "plans.csv"),
            "scan,time_s,change,saved_s,stop,candidate,x_m,y_m,yaw_rad,arrival_s,departure_s,gain,"
            "beyond,gain_unit\n"
            "3,60.5,cheaper,14.25,1,7,1.5,-2.25,0.75,3.5,13.5,900.5,12.25,cells\n"
            "3,60.5,cheaper,14.25,2,,4.5,5.25,-0.5,20.5,31.25,80.5,0.125,cells\n"
            "4,70.5,first,,1,0,1.5,-2.25,0.75,3.5,13.5,900.5,12.25,bits\n");
}

// The reader.

constexpr const char* kHeader =
    "scan,time_s,change,saved_s,stop,candidate,x_m,y_m,yaw_rad,arrival_s,departure_s,gain,beyond,"
    "gain_unit\n";

TEST_F(Plans, AreReadAsTheyAreWritten) {
  write_file(folder_ / "plans.csv", std::string(kHeader) +
                                        "2,14.5,first,,1,7,1,2,0.5,3,13,900,0,cells\n" +
                                        "2,14.5,first,,2,,4,5,0.25,20,31,80,12.5,cells\n" +
                                        "3,60,cheaper,14.25,1,9,1,2,0,3,13,900,0,cells\n");
  const auto plans = read_plans(folder_ / "plans.csv");
  ASSERT_EQ(plans.size(), 2U);
  ASSERT_EQ(plans[0].tour.stops.size(), 2U);
  EXPECT_EQ(plans[0].tour.stops[1].id, -1);
  EXPECT_EQ(plans[0].tour.stops[1].place_m, Eigen::Vector2d(4.0, 5.0));
  EXPECT_EQ(plans[0].tour.stops[1].beyond, 12.5);
  EXPECT_TRUE(std::isnan(plans[0].tour.reason.saved_s));
  EXPECT_EQ(plans[1].tour.reason.saved_s, 14.25);
  const auto page = plans_json(folder_ / "plans.csv");
  EXPECT_EQ(page[0]["ends_s"], 31.0);
  EXPECT_EQ(page[0]["why"], "the first plan");
  EXPECT_EQ(page[1]["change"], "cheaper");
}

TEST_F(Plans, AreNotBelievedDamaged) {
  const std::string first = "2,14.5,first,,1,7,1,2,0.5,3,13,900,0,cells\n";
  for (const std::string& rows : std::vector<std::string>{
           "2,14.5,guessed,,1,7,1,2,0.5,3,13,900,0,cells\n",
           "2,14.5,first,,2,7,1,2,0.5,3,13,900,0,cells\n",
           "2,14.5,first,,1,7,nan,2,0.5,3,13,900,0,cells\n",
           "2,14.5,first,,1,7.5,1,2,0.5,3,13,900,0,cells\n",
           "0,14.5,first,,1,7,1,2,0.5,3,13,900,0,cells\n", "2,14.5,first,,1,7,1,2\n", first + first,
           first + "3,14.5,first,,2,7,1,2,0.5,3,13,900,0,cells\n"}) {
    write_file(folder_ / "plans.csv", kHeader + rows);
    try {
      read_plans(folder_ / "plans.csv");
      ADD_FAILURE() << rows;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("plans.csv:"), std::string::npos) << error.what();
    }
  }
}

/// The laser looks straight ahead from the base.
TEST_F(Plans, FaceWhereTheirViewsLook) {
  const auto options = std::get<Tabletop>(load_recorded(tour_run()).task);
  const auto events = read_event_log(tour_run() / "story.bin", options.map.frame().size());
  const Decision* decision = nullptr;
  int stops = 0;
  for (const EpisodeEvent& event : events) {
    if (const auto* made = std::get_if<Decision>(&event.what)) decision = made;
    const auto* tour = std::get_if<PlannedTour>(&event.what);
    if (tour == nullptr) continue;
    ASSERT_NE(decision, nullptr);
    for (const PlannedStop& stop : tour->stops) {
      const Candidate& view = decision->candidates.at(static_cast<std::size_t>(stop.id));
      const double view_rad = project_to_se2(view.T_world_sensor).yaw_rad;
      EXPECT_NEAR(wrap_angle(stop.yaw_rad - view_rad), 0.0, 1e-6);
      ++stops;
    }
  }
  EXPECT_GT(stops, 3);
}

}  // namespace
}  // namespace vantage
