// How long studies took, and that what is told of an episode counts only beside its result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

#include "bench/claims/claims.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/study/study_reading.hpp"

namespace vantage::bench {
namespace {

namespace fs = std::filesystem;

const fs::path kStudies = fs::path(VANTAGE_SOURCE_DIR) / "assets/studies";

/// All episodes of the three take that long.
/// @param lacking the file that misses the last episode of each; "": none
std::vector<Finding> study_times(double table_s, double office_s, std::string_view lacking = "") {
  const support::TemporaryDirectory folder;
  const auto without_last = [](const std::string& text) {
    return text.substr(0, text.rfind('\n', text.size() - 2) + 1);
  };
  for (const char* name : {"tabletop", "office_small", "office_large"}) {
    std::string text = "episode,wall_time_s\n";
    std::string results = "episode,status\n";
    const StudyReading reading =
        read_study_file(kStudies / (std::string(name) + ".yaml"), {}, "report");
    for (const auto& [episode, levels] : episode_levels(reading.study)) {
      const double wall_s = std::string_view(name) == "tabletop" ? table_s : office_s;
      text += episode + "," + std::to_string(wall_s) + "\n";
      results += episode + ",completed\n";
    }
    fs::create_directories(folder.path() / name);
    write_file(folder.path() / name / "timings.csv",
               lacking == "timings" ? without_last(text) : text);
    write_file(folder.path() / name / "results.csv",
               lacking == "results" ? without_last(results) : results);
  }
  return study_time_findings(kStudies, folder.path());
}

TEST(StudyTimes, AreOfTwoEpisodesAtATime) {
  const std::vector<Finding> fast = study_times(6.5, 90.0);
  EXPECT_EQ(fast[0].verdict, Verdict::yes) << "550 x 6.5 s / 2 are " << fast[0].measured;
  EXPECT_THAT(fast[0].measured, testing::StartsWith("30 min, half"));
  EXPECT_EQ(fast[1].verdict, Verdict::yes) << "208 + 104 of 90 s are " << fast[1].measured;
  EXPECT_THAT(fast[1].measured, testing::StartsWith("156 and 78 min, half"));
  const std::vector<Finding> slow = study_times(6.6, 93.0);
  EXPECT_EQ(slow[0].verdict, Verdict::no) << slow[0].measured;
  EXPECT_EQ(slow[1].verdict, Verdict::no) << slow[1].measured;
}

TEST(StudyTimes, AreNotRunWithoutOneOfTheirEpisodes) {
  for (const char* lacking : {"timings", "results"}) {
    for (const Finding& finding : study_times(1.0, 1.0, lacking)) {
      EXPECT_EQ(finding.verdict, Verdict::not_run) << lacking << ": " << finding.measured;
    }
  }
  for (const Finding& finding : study_time_findings(kStudies, "nowhere")) {
    EXPECT_EQ(finding.verdict, Verdict::not_run) << finding.measured;
  }
}

TEST(OfResults, LeavesWhatHasAResult) {
  const CsvTable results{{"episode", "state_hash"}, {{"a", "1"}, {"b", "2"}}};
  const CsvTable bounds{
      {"episode", "status", "state_hash"},
      {{"a", "completed", "1"}, {"b", "completed", "3"}, {"c", "completed", "2"}}};
  EXPECT_THAT(of_results(bounds, results).rows,
              testing::ElementsAre(testing::ElementsAre("a", "completed", "1")))
      << "b is of another run";
  const CsvTable timings{{"episode", "wall_time_s"}, {{"b", "7"}, {"c", "8"}}};
  EXPECT_THAT(of_results(timings, results).rows,
              testing::ElementsAre(testing::ElementsAre("b", "7")));
  EXPECT_TRUE(of_results(bounds, {}).rows.empty());
}

}  // namespace
}  // namespace vantage::bench
