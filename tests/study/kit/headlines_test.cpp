// What is said first of two studies, and how problems of a file are kept.
#include "vantage/study/kit/headlines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "vantage/study/kit/problems.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

TEST(RelativeDifference, IsAShareOfTheLargerOne) {
  EXPECT_DOUBLE_EQ(relative_difference(4.0, 5.0), 0.2);
  EXPECT_DOUBLE_EQ(relative_difference(5.0, 4.0), 0.2);
  EXPECT_DOUBLE_EQ(relative_difference(-4.0, 5.0), 1.8);
  EXPECT_DOUBLE_EQ(relative_difference(0.0, -3.0), 1.0);
  EXPECT_EQ(relative_difference(0.0, 0.0), 0.0);
}

/// Over all panels.
Json summary_of(int completed, const Json& levels) {
  return {{"completed", completed},
          {"tables",
           {{"area", {{"left", {{"a", {{"mean", 77.0}}}}}, {"all", levels}}},
            {"empty", Json::object()}}}};
}

TEST(StudyHeadlines, AreTheMeansOverAllPanels) {
  const Json first = summary_of(4, {{"a", {{"mean", 2.0}}}, {"b", {{"mean", 4.0}}}});
  const Json second = summary_of(5, {{"a", {{"mean", 2.5}}}, {"c", {{"mean", 1.0}}}});
  const std::vector<Headline> rows = study_headlines(first, second, 0.2);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].name, "completed");
  EXPECT_EQ(rows[0].first, 4.0);
  EXPECT_EQ(rows[0].second, 5.0);
  EXPECT_FALSE(rows[0].beyond) << "a fifth is tolerated";
  EXPECT_EQ(rows[1].name, "area, a");
  EXPECT_EQ(rows[1].first, 2.0);
  EXPECT_EQ(rows[1].second, 2.5);
  EXPECT_FALSE(rows[1].beyond);
  EXPECT_EQ(rows[2].name, "area, b");
  EXPECT_EQ(rows[2].first, 4.0);
  EXPECT_FALSE(rows[2].second);
  EXPECT_TRUE(rows[2].beyond) << "of one alone";
  EXPECT_TRUE(study_headlines(first, second, 0.19)[1].beyond);
}

TEST(StudyHeadlines, LeaveOutWallTimes) {
  Json study = summary_of(4, {{"a", {{"mean", 2.0}}}});
  study["tables"]["replan_time_s"]["all"]["a"]["mean"] = 0.1;
  EXPECT_EQ(study_headlines(study, study, 0.0).size(), 2U);
}

TEST(StudyHeadlines, WhatIsNoNumberIsNotThere) {
  const Json odd = {{"completed", "all"},
                    {"tables", {{"area", {{"all", {{"a", {{"mean", "two"}}}}}}}}}};
  const std::vector<Headline> rows = study_headlines(odd, odd, 0.0);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].first, 0.0);
  EXPECT_FALSE(rows[1].first);
  EXPECT_FALSE(rows[1].beyond) << "neither has it";
}

TEST(HeadlineRows, StandBelowEachOther) {
  const std::vector<Headline> rows{{"path_length_m", 4.0, 5.5, true},
                                   {"cost", 12345.6, 12345.6, false},
                                   {"recall", std::nullopt, 0.123456, true}};
  EXPECT_EQ(headlines_text(rows, "one", "a/long/folder"),
            "                        one  a/long/folder  difference\n"
            "! path_length_m           4            5.5        +1.5\n"
            "  cost                12346          12346        same\n"
            "! recall                  -         0.1235            \n");
  EXPECT_EQ(headlines_json(rows)[0], Json({{"name", "path_length_m"},
                                           {"first", 4.0},
                                           {"second", 5.5},
                                           {"difference", 1.5},
                                           {"beyond", true}}));
  EXPECT_TRUE(headlines_json(rows)[2]["first"].is_null());
  EXPECT_TRUE(headlines_json(rows)[2]["difference"].is_null());
  EXPECT_EQ(headlines_json(rows)[2]["second"], 0.123456);
}

TEST(StudyHeadlines, AreOfTheTablesThatTheFirstHas) {
  const Json first = {
      {"completed", 1},
      {"tables", {{"empty", Json::object()}, {"area", {{"all", {{"a", {{"mean", 2.0}}}}}}}}}};
  const std::vector<Headline> rows = study_headlines(first, {{"completed", 1}}, 0.2);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].name, "area, a");
  EXPECT_EQ(rows[1].first, 2.0);
  EXPECT_FALSE(rows[1].second);
  EXPECT_FALSE(Headline{}.beyond);
}

TEST(HeadlineRows, HaveNoExponentsOfWhatIsLarge) {
  const std::string text = headlines_text({{"n", 9999.5, 9999.4, true}}, "a", "b");
  EXPECT_EQ(text.substr(text.find('\n')), "\n! n       10000        9999        -0.1\n");
}

TEST(ProblemsOfAFile, AreKeptOnceEach) {
  Problems problems;
  EXPECT_TRUE(problems.attempt([] {}));
  EXPECT_EQ(problems.code(), ExitCode::done);
  EXPECT_NO_THROW(problems.throw_if_any());
  EXPECT_FALSE(problems.attempt([] { throw InputError("no x"); }));
  EXPECT_EQ(problems.code(), ExitCode::bad_input);
  EXPECT_FALSE(problems.attempt([] { throw InputError("no x"); }));
  EXPECT_THAT(problems.texts(), testing::ElementsAre("no x"));
  const auto said = [&] {
    try {
      problems.throw_if_any();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(said(), "no x");
  problems.attempt([] { throw InputError("no y"); });
  EXPECT_EQ(said(), "no x (and 1 more)");
  problems.attempt([] { throw InputError("no z"); });
  EXPECT_EQ(said(), "no x (and 2 more)");
}

TEST(ProblemsOfAFile, OfAConfigurationOutweighThoseOfFiles) {
  Problems problems;
  problems.attempt([] { throw InputError("no x"); });
  problems.attempt([] { throw ConfigError(std::vector<std::string>{"a is wrong", "b is wrong"}); });
  EXPECT_EQ(problems.code(), ExitCode::usage);
  problems.attempt([] { throw InputError("no y"); });
  EXPECT_EQ(problems.code(), ExitCode::usage);
  try {
    problems.throw_if_any();
    ADD_FAILURE() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.problems(), testing::ElementsAre("no x", "a is wrong", "b is wrong", "no y"));
  }
}

}  // namespace
}  // namespace vantage
