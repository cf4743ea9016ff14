// No run comes below the bound of what any policy needs.
#include "vantage/hindsight/run_bound.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/hindsight/short_run.hpp"
#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"

namespace vantage {
namespace {

class RunBounds : public testing::Test {
 protected:
  support::TemporaryDirectory folder;
};

TEST_F(RunBounds, AreBelowEveryRunOfAnyChoice) {
  for (const char* choice : {"greedy", "random", "tour", "oracle_tour", "information_rate"}) {
    const RecordedRun run = support::short_run(
        folder.path() / choice, {std::string("choice=") + choice, "scans=8", "robot.start_view=3"});
    const RunBound bound = bound_of_run(run);
    ASSERT_EQ(bound.shares.size(), 4U);
    int reached = 0;
    std::size_t scans = 0;
    for (const ShareBound& share : bound.shares) {
      ASSERT_TRUE(share.least) << choice;
      EXPECT_GE(share.least->scans, scans) << choice;
      scans = share.least->scans;
      EXPECT_GE(share.least->time_s, bound.first_scan.time_s);
      if (!share.run) continue;
      ++reached;
      EXPECT_LE(share.least->scans, share.run->scans) << choice << ' ' << share.percent;
      EXPECT_LE(share.least->way_m, share.run->way_m + 1e-9) << choice << ' ' << share.percent;
      EXPECT_LE(share.least->time_s, share.run->time_s + 1e-9) << choice << ' ' << share.percent;
      EXPECT_LT(static_cast<double>(share.given_cells),
                0.02 * static_cast<double>(run.observable_cells));
    }
    EXPECT_GE(reached, 1) << choice;
    // And it says something: all of them need more than the scan at the start.
    EXPECT_GE(bound.shares[3].least->scans, 4U) << choice;
  }
}

TEST_F(RunBounds, TellTheShareAsMetricsDo) {
  const RecordedRun run = support::short_run(folder.path() / "run", {"scans=8"});
  RunBound bound = bound_of_run(run);
  const auto metrics = nlohmann::json::parse(std::ifstream(run.directory / "metrics.json"));
  for (const ShareBound& share : bound.shares) {
    const auto recorded = metrics["time_to_" + std::to_string(share.percent) + "_s"];
    EXPECT_EQ(recorded.is_null(), !share.run.has_value());
    if (share.run) {
      EXPECT_EQ(recorded, share.run->time_s);
    }
  }
  add_oracle_tour(run, bound);
  EXPECT_TRUE(bound.has_oracle_tour);
  EXPECT_TRUE(bound.shares[0].oracle_tour);
}

TEST_F(RunBounds, AreRefusedWhereTheSceneIsAnother) {
  RecordedRun run = support::short_run(folder.path() / "run", {"scans=2"});
  run.observable_cells += 1;
  EXPECT_THROW(bound_of_run(run), InputError);
}

/// A wall with a gap: no way between its sides is shorter than that round its end, and none is told
/// longer.
TEST(LeastWays, AreNeverLongerThanTheShortestWay) {
  FloorMapOptions options;
  options.half_size_m = 6.0;
  OpenFloor floor{free_floor(options), 0.33};
  block_box(floor.map, {Eigen::Vector2d(-0.1, -6.0), Eigen::Vector2d(0.1, 3.0)});
  const std::vector<Eigen::Vector2d> places{{-2.0, 0.0}, {2.0, 0.0}, {-2.0, 4.5}, {-2.0, -3.0}};
  const Eigen::MatrixXd ways_m = least_ways_m(floor, places, 1);
  const double radius_m = 0.33;
  const double corner_m = std::hypot(1.9, 3.0);    // to the corner of the wall
  const double shortest_m = 2.0 * corner_m + 0.2;  // a point's; a disc's is longer
  EXPECT_LT(ways_m(0, 1), shortest_m + 2.0 * radius_m);
  EXPECT_GT(ways_m(0, 1), 0.85 * shortest_m);  // not the straight line of 4 m
  EXPECT_LE(ways_m(0, 2), 4.5 + 1e-9);
  EXPECT_NEAR(ways_m(0, 3), 3.0, 1e-9);
  EXPECT_EQ(ways_m(0, 1), ways_m(1, 0));
}

/// 97 % cannot be seen from where the first scan is taken.
TEST_F(RunBounds, CountTheWayThatIsStillToBeDriven) {
  const RecordedRun run =
      support::short_run(folder.path() / "run", {"scans=8", "robot.start_view=3"});
  const RunBound bound = bound_of_run(run);
  for (const ShareBound& share : bound.shares) {
    ASSERT_TRUE(share.least) << share.percent;
    EXPECT_GE(share.least->way_m, bound.first_scan.way_m) << share.percent;
  }
  EXPECT_GT(bound.shares.back().least->way_m, bound.first_scan.way_m);
}

/// Of a map that has all cells after its second scan, and one that has them after its first.
TEST_F(RunBounds, GiveAnyPolicyWhatTheMapHadBeyondItsScans) {
  RecordedRun run = support::short_run(folder.path() / "run", {"scans=3", "robot.start_view=3"});
  run.scans[1].scan_time_s = 0.75;
  run.scans[1].cells_left = 0;
  const RunBound after_two = bound_of_run(run);
  run.scans[0].cells_left = 0;
  const RunBound after_one = bound_of_run(run);
  EXPECT_GT(after_one.shares[3].given_cells, after_two.shares[3].given_cells)
      << "the second scan shows cells, too";
  for (std::size_t i = 0; i < 4; ++i) {
    const ShareBound& share = after_one.shares[i];
    EXPECT_EQ(share.percent, kBoundShares_percent[i]);
    ASSERT_TRUE(share.run && share.least) << share.percent;
    EXPECT_EQ(share.run->scans, 1U);
    EXPECT_EQ(share.least->scans, 1U) << "no more is needed";
    EXPECT_EQ(share.least->way_m, run.scans[0].path_length_m);
    EXPECT_EQ(share.least->time_s, run.scans[0].time_s);
  }
  EXPECT_EQ(after_one.scan_s, 0.75) << "the shortest of the run";
  EXPECT_EQ(after_one.speed_m_s, std::get<Tabletop>(run.episode.task).drive.controller.speed_m_s);
  EXPECT_EQ(after_one.first_scan.scans, 1U);
  EXPECT_EQ(after_one.first_scan.way_m, run.scans[0].path_length_m);
  EXPECT_EQ(after_one.first_scan.time_s, run.scans[0].time_s);
  EXPECT_FALSE(after_one.has_oracle_tour);
}

/// Where the trajectory of a run has the base at its scans.
class ScanLines {
 public:
  explicit ScanLines(const RecordedRun& run) : file_(run.directory / "trajectory.tum") {
    std::vector<std::pair<double, std::string>> lines;
    std::ifstream stream(file_);
    for (std::string line; std::getline(stream, line);) {
      if (line.empty() || line.front() == '#') continue;
      const std::size_t blank = line.find(' ');
      lines.emplace_back(std::stod(line.substr(0, blank)), line.substr(blank));
    }
    for (const RecordedScan& scan : run.scans) {
      std::size_t at = 0;
      while (at + 1 < lines.size() && lines[at + 1].first <= scan.time_s + 1e-6) ++at;
      places_.emplace_back(scan.time_s, lines.at(at).second);
    }
  }
  /// At each scan its place, and a moment before and after it another.
  void write(double later_s = 0.0) const {
    std::ofstream stream(file_);
    stream.precision(17);
    for (const auto& [time_s, place] : places_) {
      stream << later_s + time_s - 0.01 << " 2.5 2.5 0 0 0 0 1\n";
      stream << later_s + time_s << place << "\n";
      stream << later_s + time_s + 0.01 << " 2.5 2.5 0 0 0 0 1\n";
    }
  }

 private:
  std::filesystem::path file_;
  std::vector<std::pair<double, std::string>> places_;
};

TEST_F(RunBounds, TakeTheScansFromWhereTheBaseIsAtTheirEnd) {
  const RecordedRun run =
      support::short_run(folder.path() / "run", {"scans=3", "robot.start_view=3"});
  const auto before = run_bound_json(bound_of_run(run));
  const ScanLines lines(run);
  lines.write();
  EXPECT_EQ(run_bound_json(bound_of_run(run)), before);
  lines.write(1000.0);
  EXPECT_THROW(bound_of_run(run), InputError) << "it begins after the first scan";
}

}  // namespace
}  // namespace vantage
