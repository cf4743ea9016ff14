// The study file: what it means, and what is said of a wrong one.
#include "vantage/study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/study/study_layout.hpp"
#include "vantage/study/study_reading.hpp"
#include "vantage/study/sweep/sweep.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kSmallStudy = R"(episode: assets/episodes/tabletop.yaml
set: {scans: 3}
factors:
  start:
    near: {robot.start_view: 0}
    far: {robot.start_view: 5}
  method:
    random: {choice: random}
    sparse: {gain: beer_lambert, gain.a: 0.999}
)";

class StudyFile : public testing::Test {
 protected:
  Study read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    std::ofstream(folder_ / "s.yaml") << text;
    return read_study(folder_ / "s.yaml", overrides);
  }
  std::vector<PlannedEpisode> plan(const std::string& text) { return plan_study(read(text)); }
  /// Every one of `parts` is in what is said of the study.
  void expect_problem(const std::string& text, const std::vector<std::string>& parts) {
    try {
      plan_study(read(text));
      ADD_FAILURE() << "accepted";
    } catch (const ConfigError& error) {
      for (const auto& part : parts) EXPECT_THAT(error.what(), HasSubstr(part));
    }
  }
  support::TemporaryDirectory folder_;
};

std::vector<std::string> names(const std::vector<PlannedEpisode>& plan) {
  std::vector<std::string> found;
  for (const auto& episode : plan) found.push_back(episode.name);
  return found;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return text;
}

TEST_F(StudyFile, TheLastFactorIsFastest) {
  EXPECT_THAT(names(plan(kSmallStudy)),
              ElementsAre("near/random", "near/sparse", "far/random", "far/sparse"));
}

TEST_F(StudyFile, OverridesReachTheEpisode) {
  const auto episodes = plan(kSmallStudy);
  const auto& last = std::get<Tabletop>(episodes[3].resolved.task);
  EXPECT_EQ(last.scans, 3);
  EXPECT_EQ(episodes[3].resolved.setup.options.robot.start_view, 5);
  EXPECT_EQ(std::get<BeerLambertGain>(last.gain).a, 0.999);
  EXPECT_EQ(method_name(episodes[0].resolved.task), "random");
  EXPECT_EQ(method_name(last), "beer_lambert a=0.999");
  Tabletop near = last;
  near.choice = GainOverDistance{};
  EXPECT_EQ(method_name(near), "gain_over_distance of beer_lambert a=0.999");
}

TEST_F(StudyFile, SetFromTheCommandLineReachesEveryEpisode) {
  for (const auto& episode : plan_study(read(kSmallStudy, {"scans=7", "map.cells=[9,9,9]"}))) {
    const auto& task = std::get<Tabletop>(episode.resolved.task);
    EXPECT_EQ(task.scans, 7);
    EXPECT_EQ(task.map.frame().cells.z(), 9);
  }
}

TEST_F(StudyFile, ItsOwnTextIsTheSameStudy) {
  const Study first = read(kSmallStudy, {"seed=5"});
  const Study second = read(first.yaml);
  EXPECT_EQ(first.yaml, second.yaml);
  const auto a = plan_study(first);
  const auto b = plan_study(second);
  ASSERT_EQ(names(a), names(b));
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(episode_yaml(a[i].resolved), episode_yaml(b[i].resolved));
  }
}

TEST_F(StudyFile, FilesAreFoundBesideIt) {
  fs::create_directory(folder_ / "mine");
  std::ofstream(folder_ / "mine/scene.xml") << "<mujoco/>";
  const auto text = replaced(kSmallStudy, "{choice: random}", "{scene: mine/scene.xml}");
  EXPECT_EQ(plan(text)[0].resolved.setup.scene, folder_ / "mine/scene.xml");
  EXPECT_THROW(read(replaced(text, "mine/scene.xml", "no.xml")), InputError);
}

TEST_F(StudyFile, EveryFileOfAnEpisodeIsFoundBesideIt) {
  fs::create_directory(folder_ / "mine");
  std::ofstream(folder_ / "mine/a.model") << "model";
  const std::string text =
      "episode: assets/episodes/recognition.yaml\n"
      "set: {database: {models: mine}}\n"
      "factors:\n  method:\n    a: {model: mine/a.model}\n    b: {model: not/yet.model}\n";
  const auto episodes = plan(text);
  const auto& first = std::get<RecognitionTask>(episodes[0].resolved.task);
  EXPECT_EQ(first.model, folder_ / "mine/a.model");
  EXPECT_EQ(first.database.models, folder_ / "mine");
  EXPECT_EQ(std::get<RecognitionTask>(episodes[1].resolved.task).model, "not/yet.model");
}

TEST_F(StudyFile, WithoutATitleItIsCalledAsItsFileOrItsFolder) {
  const Study first = read(kSmallStudy);
  EXPECT_EQ(first.title, "s");
  EXPECT_EQ(read("title: ''\n" + std::string(kSmallStudy)).title, "s");
  EXPECT_EQ(read("title: Two gains?\n" + std::string(kSmallStudy)).title, "Two gains?");
  fs::create_directory(folder_ / "results");
  const auto in_results = [&](const std::string& text) {
    std::ofstream(folder_ / "results/study.yaml") << text;
    return read_study(folder_ / "results/study.yaml").title;
  };
  EXPECT_EQ(in_results(first.yaml), "s");
  EXPECT_EQ(in_results(kSmallStudy), "results");
}

TEST_F(StudyFile, SeedsAreAFactor) {
  const auto episodes = plan(std::string(kSmallStudy) + "seeds: 3..5\n");
  ASSERT_EQ(episodes.size(), 4U * 3U);
  EXPECT_EQ(episodes[0].name, "near/random/3");
  EXPECT_EQ(episodes[2].resolved.setup.options.seed, 5U);
  EXPECT_EQ(episodes[3].name, "near/sparse/3");
  EXPECT_EQ(
      read(read(std::string(kSmallStudy) + "seeds: 3..5\n").yaml).factors.back().levels.size(), 3U);
  const std::string alone = "episode: assets/episodes/tabletop.yaml\nseeds: ";
  EXPECT_THAT(names(plan(alone + "[4, 2, 9]\n")), ElementsAre("4", "2", "9"));
  EXPECT_THAT(names(plan(alone + "[7]\n")), ElementsAre("7"));
  EXPECT_EQ(read(alone + "1..20\n").report.compare, "seed");
  EXPECT_THAT(names(plan(alone + "18446744073709551614..18446744073709551615\n")),
              ElementsAre("18446744073709551614", "18446744073709551615"));
  EXPECT_TRUE(is_study(folder_ / "s.yaml"));
  EXPECT_THAT(names(plan(replaced(kSmallStudy, "  start:", "  seeds: 1..2\n  start:"))).front(),
              HasSubstr("1/near/random"));
  for (const char* wrong :
       {"10", "5..3", "1..", "a..b", "-1..2", "[]", "[1, 1]", "[1, x]", "{a: 1}"}) {
    expect_problem(alone + wrong + "\n", {"s.yaml:2", "seed"});
  }
  expect_problem(std::string(kSmallStudy) + "seeds: 1..2\nset: {seed: 4}\n", {"duplicate"});
  expect_problem(replaced(kSmallStudy, "set: {scans: 3}", "set: {seed: 4}") + "seeds: 1..2\n",
                 {"seed"});
}

TEST_F(StudyFile, WithoutAMethodTheFirstFactorIsCompared) {
  const auto study = read(
      "episode: assets/episodes/tabletop.yaml\nseeds: 1..2\n"
      "factors: {start: {near: {}, far: {robot.start_view: 5}}}\n");
  EXPECT_EQ(study.report.compare, "start");
  EXPECT_EQ(study.report.reference, "near");
}

TEST_F(StudyFile, ValidationListsEveryProblem) {
  std::ofstream(folder_ / "s.yaml") << R"(episode: assets/episodes/tabletop.yaml
titel: Wrong
set: {scans: 3, scnas: 4}
factors:
  start:
    ../near: {robot.start_view: 0}
    far: {robot.start_view: five}
  area: {a: {}}
  method:
    random: {choice: radnom}
    other: {scene: no/such.xml}
report: {compare: metod, panels: strat, curves: [aera], tables: [area, path]}
)";
  const Validation found = validate_study(folder_ / "s.yaml");
  EXPECT_EQ(found.code, ExitCode::usage);
  for (const char* part : {"titel", "scnas", "../near", "'five'", "column 'area'", "radnom",
                           "no/such.xml", "metod", "strat", "aera", "'path'"}) {
    EXPECT_THAT(found.problems, testing::Contains(HasSubstr(part)));
  }
  std::ofstream(folder_ / "s.yaml") << replaced(kSmallStudy, "choice: random", "scene: no.xml");
  EXPECT_EQ(validate_study(folder_ / "s.yaml").code, ExitCode::bad_input);
}

TEST_F(StudyFile, ValidationTriesEveryStartAndEverySplit) {
  const auto problems_of = [&](const std::string& more) {
    std::ofstream(folder_ / "s.yaml")
        << "episode: assets/episodes/office_small.yaml\nfactors:\n  start:\n"
           "    a: {robot.start_site: start_0}\n    b: {robot.start_site: start_1}\n"
        << more;
    return validate_study(folder_ / "s.yaml").problems;
  };
  EXPECT_THAT(problems_of(""), testing::IsEmpty());
  EXPECT_THAT(problems_of("    c: {robot.start_site: nowhere}\n"),
              testing::Contains(HasSubstr("nowhere")));
  EXPECT_THAT(problems_of("splits: {one: {start: [a, b]}, other: {start: [d]}}\n"),
              testing::Contains(HasSubstr("'d'")));
  const std::string unsound = "    c: {robot.start_view: five}\n";
  EXPECT_THAT(problems_of(unsound + "splits: {one: {start: [a]}, other: {start: [b, c]}}\n"),
              testing::ElementsAre(HasSubstr("five")))
      << "a level of the second split";
  EXPECT_THAT(problems_of(unsound + "splits: {one: {start: [a]}, other: {start: [b]}}\n"),
              testing::IsEmpty())
      << "one of no split is never run";
}

TEST_F(StudyFile, UnknownKeysAreNamedWithTheirPlace) {
  expect_problem(std::string(kSmallStudy) + "factor: {}\n", {"s.yaml:10", "factor", "factors"});
  expect_problem(replaced(kSmallStudy, "choice: random", "chioce: random"), {"s.yaml:8", "chioce"});
  expect_problem(replaced(kSmallStudy, "gain.a: 0.999", "gain.b: 1"), {"s.yaml:9", "gain.b", "a"});
  expect_problem(replaced(kSmallStudy, "scans: 3", "scnas: 3"), {"s.yaml:2", "scnas"});
}

TEST_F(StudyFile, DuplicatesAndWrongTypes) {
  expect_problem(replaced(kSmallStudy, "    far:", "    near:"), {"s.yaml:6", "near", "duplicate"});
  expect_problem(replaced(kSmallStudy, "start_view: 5", "start_view: five"),
                 {"s.yaml:6", "robot.start_view", "five"});
  expect_problem(replaced(kSmallStudy, "{choice: random}", "random"), {"s.yaml:8", "random"});
  expect_problem("episode: assets/episodes/tabletop.yaml\n", {"factors"});
  expect_problem("factors: {a: {b: {}}}\n", {"episode"});
}

TEST_F(StudyFile, AKeyHasOneMaster) {
  expect_problem(replaced(kSmallStudy, "set: {scans: 3}", "set: {choice: random}"),
                 {"s.yaml:8", "choice"});
  EXPECT_THROW(read(kSmallStudy, {"choice=oracle"}), ConfigError);
}

TEST_F(StudyFile, NamesThatMakeNoFolderOrColumn) {
  expect_problem(replaced(kSmallStudy, "    near:", "    ../near:"), {"s.yaml:5", "../near"});
  expect_problem(replaced(kSmallStudy, "    near:", "    .near:"), {"s.yaml:5", ".near"});
  expect_problem(replaced(kSmallStudy, "  start:", "  area:"), {"s.yaml:4", "area"});
}

/// Of the tables of results, and of all panels together.
TEST_F(StudyFile, NamesThatAreTaken) {
  for (const char* name : {"episode", "config_hash", "commit", "threads", "cpu", "wall_time_s"}) {
    expect_problem(replaced(kSmallStudy, "  start:", std::string("  ") + name + ":"),
                   {"a column", name});
  }
  const std::string all = replaced(kSmallStudy, "    near:", "    all:");
  expect_problem(all + "report: {panels: start}\n", {"panels", "'all'"});
  read(all);
}

TEST_F(StudyFile, TheReportNamesWhatThereIs) {
  const std::string text = std::string(kSmallStudy) + "report: ";
  expect_problem(text + "{compare: metod}\n", {"s.yaml:10", "metod", "start, method"});
  expect_problem(text + "{reference: simple}\n", {"s.yaml:10", "simple", "random, sparse"});
  expect_problem(text + "{panels: method}\n", {"s.yaml:10", "panels"});
  expect_problem(text + "{curves: [aera]}\n", {"s.yaml:10", "aera", "unobserved_cells"});
  expect_problem(text + "{tables: [aera]}\n", {"s.yaml:10", "aera", "area"});
  expect_problem(text + "{predictors_along: start}\n", {"s.yaml:10", "start"});
  expect_problem(text + "\n  panels: start\n  compare: metod\n",
                 {"s.yaml:12: report.compare: unknown factor 'metod'; did you mean method?"});
  expect_problem(text + "\n  panels: start\n  reference: simple\n",
                 {"s.yaml:12: report.reference: unknown level 'simple'"});
}

TEST_F(StudyFile, IsToldFromAnEpisode) {
  read(kSmallStudy);
  EXPECT_TRUE(is_study(folder_ / "s.yaml"));
  EXPECT_FALSE(is_study(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml"));
  EXPECT_FALSE(is_study(folder_ / "missing.yaml"));
}

TEST_F(StudyFile, ShippedStudiesAreGood) {
  const fs::path studies = fs::path(VANTAGE_SOURCE_DIR) / "assets/studies";
  for (const auto& entry : fs::directory_iterator(studies)) {
    if (entry.is_directory()) continue;  // of commands of their own
    EXPECT_FALSE(plan_study(read_study(entry.path())).empty()) << entry.path();
  }
}

constexpr const char* kSplits = R"(splits:
  development: {start: [near]}
  report: {start: [far], method: [sparse]}
)";

TEST_F(StudyFile, ASplitIsSomeOfTheLevels) {
  const std::string text = std::string(kSmallStudy) + kSplits;
  EXPECT_THAT(names(plan(text)), ElementsAre("near/random", "near/sparse")) << "the first";
  read(text);
  const Study report = read_study(folder_ / "s.yaml", {}, "report");
  EXPECT_EQ(report.split, "report");
  EXPECT_THAT(names(plan_study(report)), ElementsAre("far/sparse"));
  EXPECT_THAT(names(plan(report.yaml)), ElementsAre("far/sparse")) << "read back as it was";
  EXPECT_THROW(read_study(folder_ / "s.yaml", {}, "test"), ConfigError);
}

TEST_F(StudyFile, WrongSplitsAreTold) {
  const std::string text = kSmallStudy;
  expect_problem(text + "splits: {a: {begin: [near]}}\n", {"s.yaml:10", "no factor 'begin'"});
  expect_problem(text + "splits: {a: {start: [nearby]}}\n", {"no level 'nearby'", "near, far"});
  expect_problem(text + "splits: {a: {start: []}}\n", {"needs a level"});
  expect_problem(text + "splits: {a: [near]}\n", {"expected a map, got a list"});
  expect_problem(text + "splits: {a: {start: near}}\n", {"expected a list"});
  expect_problem(text + "splits: [near]\n", {"expected a map, got a list"});
  expect_problem(text + "splits: {}\n", {"expected a split"});
  expect_problem(text + "split: a\n", {"no splits"});
  expect_problem(text + "splits: {a: {}}\nsplit: b\n", {"unknown split 'b'", "known: a"});
}

TEST_F(StudyFile, LevelsOfAGroupGoByOneName) {
  const std::string report = "report: {groups: {any: [near, far]}, panels: start}\n";
  const Study study = read(kSmallStudy + report);
  const StudyLayout layout(study);
  EXPECT_THAT(layout.panels(), ElementsAre("any"));
  EXPECT_THAT(layout.levels(), ElementsAre("random", "sparse"));
  EXPECT_NE(layout.place({0, 0}).pair, layout.place({1, 0}).pair);
  EXPECT_EQ(layout.place({0, 0}).pair, layout.place({0, 1}).pair);
  EXPECT_EQ(layout.place({1, 1}).panel, 0U);
  EXPECT_EQ(layout.place({1, 1}).level, 1U);
  EXPECT_THAT(names(plan(study.yaml)), testing::SizeIs(4));
  const std::string text = kSmallStudy;
  expect_problem(text + "report: {groups: {any: [near, sparse]}}\n", {"of one factor"});
  expect_problem(text + "report: {groups: {any: [here]}}\n", {"no factor has a level 'here'"});
  expect_problem(text + "report: {groups: {a: [near], b: [near]}}\n", {"'near' is of two groups"});
}

TEST_F(StudyFile, AClusterIsAFactorThatIsNotCompared) {
  const StudyLayout layout(read(std::string(kSmallStudy) + "report: {cluster: start}\n"));
  EXPECT_EQ(layout.place({1, 0}).cluster, layout.place({1, 1}).cluster);
  EXPECT_NE(layout.place({1, 0}).cluster, layout.place({0, 0}).cluster);
  const std::string text = kSmallStudy;
  expect_problem(text + "report: {cluster: begin}\n", {"unknown factor 'begin'"});
  expect_problem(text + "report: {cluster: method}\n", {"report.cluster", "alike"});
}

TEST_F(StudyFile, DrawsAreOfTheEpisodeAlone) {
  const std::string seen =
      replaced(kSmallStudy, "random: {choice: random}", "random: {choice: random, choice.draw: 1}");
  const auto draw = [](const PlannedEpisode& episode) {
    return std::get<RandomView>(std::get<Tabletop>(episode.resolved.task).choice).draw;
  };
  const auto shared = plan(seen);
  EXPECT_EQ(draw(shared[0]), 1);
  EXPECT_EQ(draw(shared[2]), 1) << "from the other start";
  const auto own = plan("draws: choice.draw\n" + seen);
  EXPECT_NE(draw(own[0]), draw(own[2]));
  EXPECT_EQ(draw(own[0]), draw(plan("draws: choice.draw\n" + seen)[0]));
  EXPECT_EQ(method_name(own[1].resolved.task), "beer_lambert a=0.999") << "it draws nothing";
  expect_problem("draws: choice.drow\n" + seen, {"s.yaml:1", "no level sets 'choice.drow'"});
}

TEST_F(StudyFile, ShardsAreAPartition) {
  const auto all = names(plan(kSmallStudy));
  std::vector<std::string> merged;
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    for (const auto& name : names(shard_of(plan(kSmallStudy), parse_shard(part)))) {
      merged.push_back(name);
    }
  }
  EXPECT_THAT(merged, testing::UnorderedElementsAreArray(all));
  for (const char* wrong : {"", "1", "0/3", "4/3", "1/0", "1/3x", "1x3", "1/", "-1/3", "a/b"}) {
    EXPECT_THROW(parse_shard(wrong), ConfigError) << wrong;
  }
}

TEST_F(StudyFile, AFactorHasANameThatMakesAColumn) {
  for (const std::string name : {"my start", "a/b", ".start", "start,method"}) {
    expect_problem(replaced(kSmallStudy, "  start:", "  " + name + ":"), {"s.yaml:4", name});
  }
}

TEST_F(StudyFile, AFolderOfAnotherStudyIsKeptUnlessItIsToBeOverwritten) {
  const Study study = read(kSmallStudy);
  const Study another = read(kSmallStudy, {"seed=5"});
  StudySweepOptions options{.directory = folder_ / "results"};
  prepare_study_folder(study, options);
  EXPECT_NO_THROW(prepare_study_folder(study, options)) << "its own";
  EXPECT_THROW(prepare_study_folder(another, options), ConfigError);
  options.overwrite = true;
  EXPECT_NO_THROW(prepare_study_folder(another, options));
}

TEST_F(StudyFile, AFolderOfARunIsNoneOfAStudy) {
  const StudySweepOptions options{.directory = folder_ / "table", .overwrite = true};
  std::filesystem::create_directory(options.directory);
  write_file(options.directory / "config.yaml", "task: tabletop\n");
  EXPECT_THROW(prepare_study_folder(read(kSmallStudy), options), ConfigError);
  EXPECT_FALSE(std::filesystem::exists(options.directory / "study.yaml"));
}

/// The second start has no other level that is new.
TEST_F(StudyFile, ValidationTriesEveryStartBesideOtherFactors) {
  std::ofstream(folder_ / "s.yaml")
      << "episode: assets/episodes/office_small.yaml\nfactors:\n  start:\n"
         "    a: {robot.start_site: nowhere}\n    b: {robot.start_site: elsewhere}\nseeds: [1]\n";
  const std::vector<std::string> problems = validate_study(folder_ / "s.yaml").problems;
  EXPECT_THAT(problems, testing::Contains(HasSubstr("'nowhere'")));
  EXPECT_THAT(problems, testing::Contains(HasSubstr("'elsewhere'")));
}

TEST_F(StudyFile, AKeyThatIsNotThereIsNamedBehindTheFile) {
  expect_problem("factors: {a: {b: {}}}\n", {"s.yaml: episode: "});
}

TEST(StudyNames, HoldLettersDigitsAndFewSigns) {
  for (const char* good : {"a", "Z9", "_x", "-", "+1", "a.b", "beer_lambert-0.5"}) {
    EXPECT_TRUE(is_study_name(good)) << good;
  }
  for (const char* wrong : {"", ".", ".a", "a b", "a/b", "a,b", "a:b", "\xc3\xa4", "a*"}) {
    EXPECT_FALSE(is_study_name(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace vantage
