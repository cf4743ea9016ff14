// What is said of a study's file that is wrong here and there, and where its files are found.
#include "vantage/study/study_reading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/study/study_layout.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

const std::string kHead = "episode: assets/episodes/tabletop.yaml\n";
const std::string kMethods = "factors: {method: {a: {scans: 3}, b: {scans: 4}}}\n";

class ReadStudy : public testing::Test {
 protected:
  Study read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return read_study(written(text), overrides);
  }
  std::vector<std::string> problems_of(const std::string& text) {
    return read_study_file(written(text), {}).problems.texts();
  }
  fs::path written(const std::string& text) {
    std::ofstream(folder_ / "s.yaml") << text;
    return folder_ / "s.yaml";
  }
  support::TemporaryDirectory folder_;
};

TEST_F(ReadStudy, SaysWhatIsOfAnotherKindThanItShouldBe) {
  const std::pair<std::string, const char*> wrong[] = {
      {kHead + "set: [a]\n" + kMethods, "s.yaml:2: set: expected a map, got a list"},
      {kHead + "factors: [a]\n", "s.yaml:2: factors: expected a map, got a list"},
      {kHead + "factors: {m: [a]}\n", "expected a map, got a list"},
      {kHead + "factors: {m: {}}\n", "m: a factor needs a level"},
      {kHead + kMethods + "splits: {x: {method: [[a]]}}\n", "expected a scalar, got a list"},
      {kHead + kMethods + "splits: {x: {method: [a, c]}}\n", "no level 'c'; it has a, b"},
      {kHead + kMethods + "report: {groups: [a]}\n", "expected a map, got a list"},
      {kHead + kMethods + "report: {groups: {x: []}}\n", "x: a group needs a level"}};
  for (const auto& [text, problem] : wrong) {
    EXPECT_THAT(problems_of(text), Contains(HasSubstr(problem))) << text;
  }
  EXPECT_THROW(problems_of("[1, 2]\n"), ConfigError);
  EXPECT_THAT(problems_of(kHead + kMethods), testing::IsEmpty());
}

TEST_F(ReadStudy, WhatHasNothingBehindItsColonIsEmpty) {
  const Study study =
      read(kHead + "title:\nset:\nfactors:\n  method:\n    a:\n    b: {scans: 4}\n");
  EXPECT_EQ(study.title, "s");
  EXPECT_EQ(study.name, "s");
  EXPECT_TRUE(study.set.empty());
  ASSERT_EQ(study.factors.at(0).levels.size(), 2U);
  EXPECT_TRUE(study.factors[0].levels[0].overrides.empty());
  EXPECT_EQ(read(kHead + "factors:\nseeds: 1..2\n").factors.size(), 1U);
}

TEST_F(ReadStudy, SaysOfTheReportWhatIsUnknownInIt) {
  const std::pair<const char*, const char*> wrong[] = {
      {"{curves: [aera]}", "s.yaml:3: report.curves: unknown curve 'aera'; "},
      {"{tables: [aera]}", "s.yaml:3: report.tables: unknown metric 'aera'; "},
      {"{panels: strat}", "s.yaml:3: report.panels: unknown factor 'strat'; "},
      {"{cluster: strat}", "s.yaml:3: report.cluster: unknown factor 'strat'; "},
      {"{predictors_along: c}", "s.yaml:3: report.predictors_along: unknown level 'c'; "}};
  for (const auto& [report, problem] : wrong) {
    EXPECT_THAT(problems_of(kHead + kMethods + "report: " + report + "\n"),
                testing::ElementsAre(testing::StartsWith((folder_.path() / problem).string())))
        << report;
  }
}

/// If it has none called so, and says something else of the report.
TEST_F(ReadStudy, ComparesItsFirstFactorUnlessItHasMethods) {
  const Study study = read(kHead + "factors: {start: {a: {scans: 3}, b: {scans: 4}}}\n" +
                           "report: {tables: [area]}\n");
  EXPECT_EQ(study.report.compare, "start");
}

TEST_F(ReadStudy, AGroupOfAllLevelsMayBeCalledAll) {
  const Study study =
      read(kHead + "factors: {start: {a: {scans: 3}, b: {scans: 4}}, method: {x: {}, y: {}}}\n" +
           "report: {panels: start, groups: {all: [a, b]}}\n");
  EXPECT_THAT(StudyLayout(study).panels(), testing::ElementsAre("all"));
}

/// Every key of a level is looked at, and those of other factors count.
TEST_F(ReadStudy, AKeyIsSetInOnePlace) {
  EXPECT_THAT(problems_of(kHead + "set: {scans: 3}\n" +
                          "factors: {method: {a: {gain: simple, scans: 4}, b: {}}}\n"),
              testing::ElementsAre(
                  HasSubstr("s.yaml:3: factors.method.a.scans: 'scans' is set in another place")));
  EXPECT_THAT(problems_of(kHead + "factors:\n  start: {a: {scans: 3}, b: {scans: 4}}\n" +
                          "  method: {x: {}, y: {scans: 5}}\n"),
              testing::ElementsAre(
                  HasSubstr("s.yaml:4: factors.method.y.scans: 'scans' is set in another place")));
  EXPECT_THAT(problems_of(kHead + "set: {seed: 4}\nseeds: 1..2\n"),
              testing::ElementsAre(HasSubstr("s.yaml:3: ")));
}

TEST_F(ReadStudy, ItsEpisodeIsFoundBesideItAndFromElsewhere) {
  write_file(folder_ / "mine.yaml",
             read_file(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml"));
  const Study study = read("episode: mine.yaml\n" + kMethods);
  EXPECT_EQ(study.episode, folder_ / "mine.yaml");
  fs::create_directory(folder_ / "elsewhere");
  write_file(folder_ / "elsewhere/study.yaml", study.yaml);
  EXPECT_EQ(read_study(folder_ / "elsewhere/study.yaml").episode, folder_ / "mine.yaml");
}

TEST_F(ReadStudy, FilesOfTheCommandLineAreMissedAtOnce) {
  EXPECT_THROW(read(kHead + kMethods, {"scene=no/such.xml"}), InputError);
}

TEST_F(ReadStudy, AStudyIsAFileOfYaml) {
  const std::string text = kHead + kMethods;
  for (const char* name : {"a.yaml", "a.yml"}) {
    write_file(folder_ / name, text);
    EXPECT_TRUE(is_study(folder_ / name)) << name;
  }
  write_file(folder_ / "a.txt", text);
  EXPECT_FALSE(is_study(folder_ / "a.txt"));
}

TEST_F(ReadStudy, ValidationTriesWhatIsNewInAnyFactor) {
  const auto said_of = [&](const std::string& text) {
    return validate_study(written(text)).problems;
  };
  EXPECT_THAT(said_of(kHead + "factors: {method: {a: {}, b: {choice: {name: external, command: "
                              "[./no_such_planner]}}}}\n"),
              Contains(HasSubstr("no_such_planner")));
  EXPECT_THAT(said_of("episode: assets/episodes/office_small.yaml\nfactors:\n"
                      "  start: {a: {robot.start_site: start_0}, b: {robot.start_site: nowhere}}\n"
                      "  method: {x: {}, y: {}}\nseeds: 1..2\n"),
              Contains(HasSubstr("'nowhere'")))
      << "behind one in which nothing is new";
}

TEST(StudyKeys, AreSectionsOrTexts) {
  const std::vector<KeyDescription> keys = study_keys();
  const auto key = [&](const std::string& name) {
    const auto found = std::ranges::find(keys, name, &KeyDescription::key);
    EXPECT_NE(found, keys.end()) << name;
    return found == keys.end() ? KeyDescription{} : *found;
  };
  for (const char* name : {"set", "factors", "splits", "report", "report.groups"}) {
    EXPECT_EQ(key(name).type, "section");
    EXPECT_TRUE(key(name).section) << name;
    EXPECT_THAT(key(name).text, HasSubstr(" ")) << name;
  }
  for (const char* name : {"title", "episode", "split", "draws"}) {
    EXPECT_EQ(key(name).type, "text");
    EXPECT_FALSE(key(name).section) << name;
    EXPECT_THAT(key(name).text, HasSubstr(" ")) << name;
  }
  for (const char* name : {"report.compare", "report.panels", "report.tables"}) {
    EXPECT_FALSE(key(name).text.empty()) << name;
  }
}

}  // namespace
}  // namespace vantage
