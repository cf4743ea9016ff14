// Seeds of a study, and where its episodes stand in its comparison.
#include "vantage/study/kit/study_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/study/study_layout.hpp"

namespace vantage {
namespace {
using testing::ElementsAre;

std::vector<std::uint64_t> seeds_of(const std::string& yaml) {
  return read_seeds(parse_yaml(yaml, "s.yaml"));
}

TEST(Seeds, OfARangeHoldBothEnds) {
  EXPECT_THAT(seeds_of("7..9"), ElementsAre(7U, 8U, 9U));
  EXPECT_THAT(seeds_of("5..5"), ElementsAre(5U));
  EXPECT_THAT(seeds_of("0..1"), ElementsAre(0U, 1U));
  EXPECT_THAT(seeds_of("[4, 2, 9]"), ElementsAre(4U, 2U, 9U));
}

TEST(Seeds, AreAHundredThousandAtMost) {
  EXPECT_EQ(seeds_of("1..100000").size(), 100000U);
  EXPECT_EQ(seeds_of("1..100000").back(), 100000U);
  EXPECT_THROW(seeds_of("1..100001"), ConfigError);
  EXPECT_THROW(seeds_of("9..8"), ConfigError);
}

TEST(Seeds, ThatAreNoneAreTold) {
  for (const char* wrong : {"3", "1..2x", "..4", "[3, 3]", "[1, [2]]", "[]", "{a: 1}"}) {
    EXPECT_THROW(seeds_of(wrong), ConfigError) << wrong;
  }
}

/// Two starts, three methods, four seeds.
Study study_of_three_factors() {
  const auto factor = [](const char* name, const std::vector<std::string>& levels) {
    Factor made{name, {}};
    for (const std::string& level : levels) made.levels.push_back({level, {}});
    return made;
  };
  Study study;
  study.factors = {factor("start", {"near", "far"}), factor("method", {"a", "b", "c"}),
                   factor("seed", {"5", "6", "7", "8"})};
  study.report.compare = "method";
  return study;
}

TEST(StudyPlaces, PairWhatDiffersInTheComparedFactorAlone) {
  const StudyLayout layout(study_of_three_factors());
  EXPECT_THAT(layout.panels(), ElementsAre("all"));
  EXPECT_THAT(layout.levels(), ElementsAre("a", "b", "c"));
  EXPECT_EQ(layout.level_called("a"), 0U);
  EXPECT_EQ(layout.level_called("c"), 2U);
  const EpisodePlace place = layout.place({1, 2, 3});
  EXPECT_EQ(place.pair, (1U * 3U + 0U) * 4U + 3U);
  EXPECT_EQ(place.level, 2U);
  EXPECT_EQ(place.panel, 0U);
  EXPECT_EQ(place.cluster, place.pair);
  EXPECT_EQ(layout.place({0, 1, 2}).pair, 2U);
  EXPECT_EQ(layout.place({1, 0, 3}).pair, place.pair);
}

TEST(StudyPlaces, PanelsAndClustersAreLevelsOfTheirFactors) {
  Study study = study_of_three_factors();
  study.report.panels = "start";
  study.report.cluster = "seed";
  const StudyLayout layout(study);
  EXPECT_THAT(layout.panels(), ElementsAre("near", "far"));
  const EpisodePlace place = layout.place({1, 2, 3});
  EXPECT_EQ(place.panel, 1U);
  EXPECT_EQ(place.cluster, 3U);
  const Sample sample = sample_at(place, 7, 2.5);
  EXPECT_EQ(sample.panel, 1U);
  EXPECT_EQ(sample.level, 7U);
  EXPECT_EQ(sample.pair, place.pair);
  EXPECT_EQ(sample.value, 2.5);
  EXPECT_EQ(sample.cluster, 3U);
}

TEST(StudyPlaces, GroupsStandWhereTheirFirstLevelStood) {
  const Factor factor{"f", {{"a", {}}, {"b", {}}, {"c", {}}, {"d", {}}, {"e", {}}}};
  const GroupedLevels grouped = grouped_levels(factor, {{"y", {"e"}}, {"x", {"b", "d"}}});
  EXPECT_THAT(grouped.names, ElementsAre("a", "x", "c", "y"));
  EXPECT_THAT(grouped.of_level, ElementsAre(0U, 1U, 2U, 1U, 3U));
}

TEST(StudyPlaces, FactorsAndLevelsHaveTheirIndex) {
  const Study study = study_of_three_factors();
  EXPECT_EQ(factor_index(study, "start"), 0U);
  EXPECT_EQ(factor_index(study, "seed"), 2U);
  EXPECT_EQ(level_index(study.factors[2], "8"), 3U);
  const std::vector<EpisodeLevels> all = episode_levels(study);
  ASSERT_EQ(all.size(), 24U);
  EXPECT_EQ(all[23].name, "far/c/8");
  EXPECT_EQ(all[17].name, "far/b/6");
  EXPECT_THAT(all[17].levels, ElementsAre(1U, 1U, 1U));
}

/// 100 000 episodes and no more.
TEST(StudyPlaces, EpisodesAreNotTooMany) {
  Study study;
  const auto factor = [](const std::string& name, int levels) {
    Factor made{name, {}};
    for (int i = 0; i < levels; ++i) made.levels.push_back({std::to_string(i), {}});
    return made;
  };
  study.factors = {factor("a", 250), factor("b", 400)};
  EXPECT_EQ(episode_levels(study).size(), 100000U);
  study.factors.push_back(factor("c", 2));
  EXPECT_THROW(episode_levels(study), ConfigError);
  study.factors = {factor("a", 100001)};
  EXPECT_THROW(episode_levels(study), ConfigError);
}

TEST(StudyPlaces, AreTheFirstUnlessTold) {
  const EpisodePlace place{};
  EXPECT_EQ(place.panel, 0U);
  EXPECT_EQ(place.level, 0U);
  EXPECT_EQ(place.pair, 0U);
  EXPECT_EQ(place.cluster, 0U);
}

TEST(FilesOfAStudy, AreMissedUnlessTheyAreMadeLater) {
  const support::TemporaryDirectory folder;
  write_file(folder / "mine.xml", "x");
  const auto settled = [&](const std::string& yaml) {
    ConfigNode overrides = parse_yaml(yaml, "s.yaml");
    settle_files(overrides, folder.path());
    return to_yaml(overrides);
  };
  const auto as_written = [](const std::string& yaml) { return to_yaml(parse_yaml(yaml, "s")); };
  EXPECT_EQ(settled("scene: mine.xml"),
            as_written("scene: \"" + (folder / "mine.xml").string() + "\""));
  for (const char* missed : {"scene: no/such", "robot.model: no/such", "robot: {model: no/such}"}) {
    EXPECT_THROW(settled(missed), InputError) << missed;
  }
  for (const char* kept : {"model: no/such", "database: {models: no/such}", "scene: ''"}) {
    EXPECT_EQ(settled(kept), as_written(kept));
  }
}

TEST(FilesOfAStudy, AreFoundInACommandToo) {
  const support::TemporaryDirectory folder;
  write_file(folder / "planner.py", "x");
  const auto settled = [&](const char* yaml) {
    ConfigNode overrides = parse_yaml(yaml, "s.yaml");
    settle_files(overrides, folder.path());
    return to_yaml(overrides);
  };
  const std::string planner = (folder / "planner.py").string();
  const auto as_written = [](const std::string& yaml) { return to_yaml(parse_yaml(yaml, "s")); };
  EXPECT_EQ(settled("choice: {command: [python3, planner.py, 7]}"),
            as_written("choice: {command: [python3, \"" + planner + "\", 7]}"));
  EXPECT_EQ(settled("choice.command: [./planner.py, none]"),
            as_written("choice.command: [\"" + planner + "\", none]"));
  EXPECT_EQ(settled("choice: {other: [planner.py]}"), as_written("choice: {other: [planner.py]}"));
}

}  // namespace
}  // namespace vantage
