#include "vantage/runtime/log/event_log.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

GridFrame small_frame() { return make_grid_frame({0.5, 0.5, 0.5}, {1, 1, 1}, {7, 5, 3}); }

OccupancyGrid grid_of(const std::vector<float>& log_odds) {
  OccupancyGrid grid(small_frame());
  grid.log_odds = log_odds;
  return grid;
}

OccupancyGrid any_grid() {
  return grid_of(*rc::gen::container<std::vector<float>>(
      small_frame().size(), rc::gen::element(-2.0F, -0.1F, 0.0F, 0.3F, 2.0F)));
}

std::vector<EpisodeEvent> sample_event_log() {
  Decision decision;
  for (int id = 0; id < 3; ++id) {
    Candidate view;
    view.id = id;
    view.T_world_sensor = make_pose({0.1 * id, 1.0 / 3.0, 1.2}, 0.7 * id, 0.1);
    view.gain_bits = 1000.0 / (id + 1.0);
    view.reachable = id != 1;
    decision.candidates.push_back(view);
  }
  decision.chosen = 2;
  return {{40, MapChange{{{0, 7, CellState::free}, {30, 2, CellState::occupied}}}},
          {40, decision},
          {40, PlannedRoute{{{0.0, 0.1}, {0.5, -1.0 / 7.0}}}},
          {95, MapChange{{{30, 1, CellState::free}, {3, 1, CellState::unobserved}}}},
          {95, MapChange{}}};
}

RC_GTEST_PROP(EventLogFile, MomentsAreTheMapsTheyWereToldOf, ()) {
  std::vector<CellState> known;
  std::vector<EpisodeEvent> events;
  std::vector<OccupancyGrid> grids{OccupancyGrid(small_frame())};
  for (std::uint64_t scan = 0; scan < 4; ++scan) {
    grids.push_back(any_grid());
    events.push_back({scan, map_change(known, grids.back())});
  }
  EventReplay moment(small_frame());
  for (const std::size_t count : {4U, 1U, 3U, 0U, 2U}) {
    moment.go_to(events, count);
    RC_ASSERT(moment.scans() == count);
    for (std::size_t cell = 0; cell < small_frame().size(); ++cell) {
      RC_ASSERT(moment.grid().state(cell) == grids[count].state(cell));
    }
  }
}

TEST(EventLogFile, NothingNewIsNoRun) {
  std::vector<CellState> known;
  EXPECT_TRUE(map_change(known, OccupancyGrid(small_frame())).runs.empty());
}

/// Cells of one state beside each other are one run.
TEST(EventLogFile, ARunIsOfCellsOfOneStateInARow) {
  std::vector<CellState> known;
  OccupancyGrid grid(small_frame());
  for (const std::size_t cell : {3U, 4U, 5U, 9U}) grid.log_odds[cell] = -2.0F;
  for (const std::size_t cell : {6U, 7U, 104U}) grid.log_odds[cell] = 2.0F;
  const auto expect_runs = [&](const std::vector<CellRun>& expected) {
    const std::vector<CellRun> runs = map_change(known, grid).runs;
    ASSERT_EQ(runs.size(), expected.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      EXPECT_EQ(runs[i].first, expected[i].first) << i;
      EXPECT_EQ(runs[i].count, expected[i].count) << i;
      EXPECT_EQ(runs[i].state, expected[i].state) << i;
    }
  };
  expect_runs({{3, 3, CellState::free},
               {6, 2, CellState::occupied},
               {9, 1, CellState::free},
               {104, 1, CellState::occupied}});
  expect_runs({});
  grid.log_odds[4] = 2.0F;
  expect_runs({{4, 1, CellState::occupied}});
}

TEST(EventLogFile, IsReadAsItWasWritten) {
  const support::TemporaryDirectory folder;
  const auto event_log = sample_event_log();
  EventLog log(folder.path());
  for (const EpisodeEvent& event : event_log) log.add(event);
  EXPECT_FALSE(std::filesystem::exists(folder / "story.bin"));
  log.commit();
  const auto read = read_event_log(folder / "story.bin", small_frame().size());
  ASSERT_EQ(read.size(), event_log.size());
  for (std::size_t i = 0; i < event_log.size(); ++i) {
    EXPECT_EQ(read[i].tick, event_log[i].tick);
    EXPECT_EQ(read[i].what.index(), event_log[i].what.index());
  }
  const auto& runs = std::get<MapChange>(read[0].what).runs;
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[1].first, 30U);
  EXPECT_EQ(runs[1].count, 2U);
  EXPECT_EQ(runs[1].state, CellState::occupied);
  const auto& before = std::get<Decision>(event_log[1].what);
  const auto& after = std::get<Decision>(read[1].what);
  EXPECT_EQ(after.chosen, 2U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after.candidates[i].id, before.candidates[i].id);
    EXPECT_EQ(after.candidates[i].T_world_sensor.matrix(),
              before.candidates[i].T_world_sensor.matrix());
    EXPECT_EQ(after.candidates[i].gain_bits, before.candidates[i].gain_bits);
    EXPECT_EQ(after.candidates[i].reachable, before.candidates[i].reachable);
  }
  EXPECT_EQ(std::get<PlannedRoute>(read[2].what).path_m,
            std::get<PlannedRoute>(event_log[2].what).path_m);
}

TEST(EventLogFile, AFlightHasAHeightAndADecisionMayWantNothing) {
  const support::TemporaryDirectory folder;
  const std::vector<EpisodeEvent> told{
      {3, Decision{}}, {3, PlannedFlight{{{0.0, 0.1, 1.8}, {0.5, -1.0 / 7.0, 1.7}}}}};
  EventLog log(folder.path());
  for (const EpisodeEvent& event : told) log.add(event);
  log.commit();
  const auto read = read_event_log(folder / "story.bin", small_frame().size());
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(std::get<PlannedFlight>(read[1].what).path_m,
            std::get<PlannedFlight>(told[1].what).path_m);
  EventReplay moment(small_frame());
  moment.go_to(read, 2);
  EXPECT_TRUE(moment.decision()->candidates.empty());
  EXPECT_EQ(moment.path_m().back().z(), 1.7);
}

std::vector<EpisodeEvent> planned_event_log() {
  PlannedTour tour;
  tour.reason = {PlanChange::cheaper, 1.0 / 3.0};
  tour.stops.push_back({7, {1.0, -1.0 / 7.0}, 0.3, 12.0, 20.0, 900.0, 0.0});
  tour.stops.push_back({-1, {2.0, 0.5}, -0.3, 30.0, 44.5, 80.25, 1e4});
  return {{40, Decision{}}, {40, tour}, {95, MapChange{}}};
}

TEST(EventLogFile, ATourIsThatOfItsDecisionUntilItsScan) {
  const support::TemporaryDirectory folder;
  EventLog log(folder.path());
  for (const EpisodeEvent& event : planned_event_log()) log.add(event);
  log.commit();
  const auto read = read_event_log(folder / "story.bin", small_frame().size());
  ASSERT_EQ(read.size(), 3U);
  EventReplay moment(small_frame());
  moment.go_to(read, 1);
  EXPECT_TRUE(moment.tour().stops.empty());
  moment.go_to(read, 2);
  const PlannedTour& tour = moment.tour();
  EXPECT_EQ(tour.reason.change, PlanChange::cheaper);
  EXPECT_EQ(tour.reason.saved_s, 1.0 / 3.0);
  ASSERT_EQ(tour.stops.size(), 2U);
  EXPECT_EQ(tour.stops[0].id, 7);
  EXPECT_EQ(tour.stops[0].place_m, Eigen::Vector2d(1.0, -1.0 / 7.0));
  EXPECT_EQ(tour.stops[1].id, -1);
  EXPECT_EQ(tour.stops[1].yaw_rad, -0.3);
  EXPECT_EQ(tour.stops[1].arrival_s, 30.0);
  EXPECT_EQ(tour.stops[1].departure_s, 44.5);
  EXPECT_EQ(tour.stops[1].gain, 80.25);
  EXPECT_EQ(tour.stops[1].beyond, 1e4);
  moment.go_to(read, 3);
  EXPECT_TRUE(moment.tour().stops.empty()) << "there is no plan until the next decision";
}

TEST(EventLogFile, RefusesADamagedTour) {
  const support::TemporaryDirectory folder;
  const std::size_t cells = small_frame().size();
  EventLog log(folder.path());
  for (const EpisodeEvent& event : planned_event_log()) log.add(event);
  log.commit();
  const std::string good = read_file(folder / "story.bin");
  const std::size_t tour = 16 + 24;  // behind the decision; its head, what it saves, then 64 a stop
  std::string bad = good;
  bad[tour + 16] = '\x09';
  write_file(folder / "story.bin", bad);
  EXPECT_THROW(read_event_log(folder / "story.bin", cells), InputError) << "no such change";
  // Its id, x, y, yaw, arrival and departure.
  for (std::size_t value = 0; value < 6; ++value) {
    bad = good;
    const std::size_t high = tour + 24 + 8 + 8 * value + 6;  // an exponent of ones: infinite
    bad[high] = '\xf0';
    bad[high + 1] = '\x7f';
    write_file(folder / "story.bin", bad);
    EXPECT_THROW(read_event_log(folder / "story.bin", cells), InputError) << value;
  }
}

TEST(EventLogFile, EveryDecisionBeginsWithoutAWay) {
  auto event_log = sample_event_log();
  event_log.push_back(event_log[1]);
  EventReplay moment(small_frame());
  moment.go_to(event_log, 1);
  EXPECT_FALSE(moment.decision());
  moment.go_to(event_log, 5);
  EXPECT_EQ(moment.decision()->chosen, 2U);
  EXPECT_EQ(moment.path_m().size(), 2U);
  moment.go_to(event_log, 6);
  EXPECT_TRUE(moment.path_m().empty());
}

TEST(EventLogFile, RefusesWhatIsDamaged) {
  const support::TemporaryDirectory folder;
  const auto path = folder / "story.bin";
  const std::size_t cells = small_frame().size();
  EventLog log(folder.path());
  for (const EpisodeEvent& event : sample_event_log()) log.add(event);
  log.commit();
  const std::string good = read_file(path);
  EXPECT_THROW(read_event_log(path, 31), InputError) << "cells outside the grid";
  // Cut inside an event: 24 bytes of head, two runs of 12, then the next head.
  for (const std::size_t size : {std::size_t{3}, std::size_t{20}, std::size_t{16 + 30},
                                 std::size_t{16 + 48 + 25}, good.size() - 1}) {
    write_file(path, good.substr(0, size));
    EXPECT_THROW(read_event_log(path, cells), InputError) << size;
  }
  for (const std::size_t more : {1U, 23U}) {
    write_file(path, good + std::string(more, '\0'));
    EXPECT_THROW(read_event_log(path, cells), InputError) << more << " bytes behind the last event";
  }
  for (const auto& [at, byte] : {std::pair{16 + 8, '\x05'},
                                 {16 + 48 + 16, '\x04'},  // one beyond "none of the three"
                                 {16 + 24 + 8, '\x03'},
                                 {16, '\x60'},
                                 {16 + 14, '\x01'}}) {
    std::string bad = good;
    bad[static_cast<std::size_t>(at)] = byte;
    write_file(path, bad);
    EXPECT_THROW(read_event_log(path, cells), InputError) << at;
  }
  EXPECT_THROW(read_event_log(folder / "none.bin", cells), InputError);
}

TEST(EventLogFile, RefusesPlacesThatAreNowhere) {
  const support::TemporaryDirectory folder;
  const auto path = folder / "story.bin";
  const std::size_t cells = small_frame().size();
  EventLog log(folder.path());
  for (const EpisodeEvent& event : sample_event_log()) log.add(event);
  log.add({96, PlannedFlight{{{0.0, 0.1, 1.8}}}});
  log.commit();
  const std::string good = read_file(path);
  EXPECT_NO_THROW(read_event_log(path, cells));
  // A change of two runs, then a decision among three, a way of two places, changes of two runs and
  // of none, and a flight of one; a head is 24 bytes.
  const std::size_t decision = 16 + 24 + 2 * 12;
  const std::size_t way = decision + 24 + 3 * 14 * 8;
  const std::size_t flight = way + 24 + 2 * 16 + 24 + 2 * 12 + 24;
  ASSERT_EQ(good.size(), flight + 24 + 24);
  for (const std::size_t number : {decision + 24, decision + 24 + 2 * 14 * 8 + 11 * 8, way + 24,
                                   way + 24 + 3 * 8, flight + 24, flight + 24 + 2 * 8}) {
    std::string bad = good;
    bad[number + 6] = '\xf0';  // an exponent of ones: infinite
    bad[number + 7] = '\x7f';
    write_file(path, bad);
    EXPECT_THROW(read_event_log(path, cells), InputError) << number;
  }
}

TEST(EventLogFile, MayEndWithAnythingThatCanBeTold) {
  Candidate view;
  view.T_world_sensor = make_pose({1.0, 2.0, 3.0}, 0.5);
  PlannedTour tour;
  tour.stops.resize(2);
  const std::vector<EpisodeEvent> events{{1, MapChange{{{0, 2, CellState::free}}}},
                                         {1, Decision{{view, view}, 1}},
                                         {1, PlannedRoute{{{0.5, 1.5}, {2.5, 3.5}}}},
                                         {1, PlannedFlight{{{0.5, 1.5, 2.5}}}},
                                         {1, tour}};
  for (const EpisodeEvent& event : events) {
    const support::TemporaryDirectory folder;
    EventLog log(folder.path());
    log.add(event);
    log.commit();
    const auto read = read_event_log(folder / "story.bin", small_frame().size());
    ASSERT_EQ(read.size(), 1U);
    EXPECT_EQ(read[0].what.index(), event.what.index());
  }
}

TEST(EventLogFile, IsOfTheseBytes) {
  const support::TemporaryDirectory folder;
  Candidate view;
  view.T_world_sensor = make_pose({1.0, 2.0, 3.0}, 0.5);
  view.gain_bits = 7.5;
  view.reachable = true;
  EventLog log(folder.path());
  log.add({40, MapChange{{{3, 2, CellState::occupied}}}});
  log.add({41, Decision{{view}, 1}});
  log.commit();
  std::string bytes = "VANTAGE STORY 1\n";
  const auto put_number = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  put_number(std::uint64_t{40});
  for (const std::uint32_t number : {0U, 1U}) put_number(number);
  put_number(std::uint64_t{0});
  for (const std::uint32_t number : {3U, 2U, 2U}) put_number(number);
  put_number(std::uint64_t{41});
  for (const std::uint32_t number : {1U, 1U}) put_number(number);
  put_number(std::uint64_t{1});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) put_number(view.T_world_sensor(row, column));
  }
  for (const double number : {7.5, 1.0}) put_number(number);
  EXPECT_EQ(read_file(folder / "story.bin"), bytes);
}

TEST(EventLogFile, RefusesAStopOfNoCandidate) {
  const auto is_read = [](int id) {
    const support::TemporaryDirectory folder;
    PlannedTour tour;
    tour.stops.resize(1);
    tour.stops[0].id = id;
    EventLog log(folder.path());
    log.add({1, tour});
    log.commit();
    try {
      return std::get<PlannedTour>(read_event_log(folder / "story.bin", 1)[0].what).stops[0].id ==
             id;
    } catch (const InputError&) {
      return false;
    }
  };
  EXPECT_TRUE(is_read(-1));
  EXPECT_TRUE(is_read(1'000'000'000));
  EXPECT_TRUE(is_read(700'000'000));
  EXPECT_FALSE(is_read(-2));
  EXPECT_FALSE(is_read(1'500'000'000));
}

TEST(EventLogFile, IsInOrderAndEndsWithTheGrid) {
  const support::TemporaryDirectory folder;
  const auto path = folder / "story.bin";
  EventLog log(folder.path());
  for (const std::uint64_t tick : {40U, 95U, 95U}) {
    log.add({tick, MapChange{{{30, 2, CellState::free}}}});
  }
  log.commit();
  EXPECT_NO_THROW(read_event_log(path, 32)) << "up to its last cell";
  EXPECT_THROW(read_event_log(path, 31), InputError);
  std::string bad = read_file(path);
  bad[16 + 2 * 36] = 50;
  write_file(path, bad);
  EXPECT_THROW(read_event_log(path, 32), InputError) << "later than the first, not than the second";
  bad[16 + 2 * 36] = 95;
  bad[0] = 'v';
  write_file(path, bad);
  EXPECT_THROW(read_event_log(path, 32), InputError) << "not ours";
}

TEST(EventLogFile, WhatIsPlannedReplacesWhatWas) {
  const std::vector<EpisodeEvent> events{{1, Decision{}},
                                         {1, std::get<PlannedTour>(planned_event_log()[1].what)},
                                         {1, PlannedRoute{{{0.0, 0.1}, {0.5, 0.2}}}},
                                         {2, PlannedRoute{{{1.5, 2.5}}}},
                                         {3, Decision{}}};
  EventReplay moment(small_frame());
  EXPECT_EQ(moment.scans(), 0U);
  moment.go_to(events, 3);
  EXPECT_EQ(moment.tour().stops.size(), 2U);
  EXPECT_EQ(moment.path_m().size(), 2U);
  moment.go_to(events, 4);
  ASSERT_EQ(moment.path_m().size(), 1U);
  EXPECT_EQ(moment.path_m()[0], Eigen::Vector3d(1.5, 2.5, 0.0));
  moment.go_to(events, 5);
  EXPECT_TRUE(moment.tour().stops.empty());
  EXPECT_EQ(CellRun{}.first, 0U);
  EXPECT_EQ(CellRun{}.count, 0U);
  EXPECT_EQ(EpisodeEvent{}.tick, 0U);
}

}  // namespace
}  // namespace vantage
