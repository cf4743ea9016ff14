// Comparisons and figures as tables to read, to the letter.
#include "vantage/study/tables/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vantage {
namespace {
using testing::ElementsAre;
using testing::IsEmpty;

ComparisonRow reference_row(const std::string& panel) {
  return {.panel = panel,
          .level = "ref",
          .count = 3,
          .clusters = 3,
          .mean = 12345.6,
          .interval = {9999.0, 20000.6},
          .least = 100.0,
          .most = 30000.0,
          .difference = std::nullopt};
}

/// By half a unit less than the reference, by an interval that is told from nothing or not.
ComparisonRow our_row(const std::string& panel, const Interval& interval) {
  Difference difference;
  difference.pairs = 2;
  difference.clusters = 2;
  difference.mean = -0.5;
  difference.interval = interval;
  difference.ratio = 0.75;
  difference.ratio_interval = Interval{0.5, 0.875};
  difference.p_value = 0.34567;
  return {.panel = panel,
          .level = "ours",
          .count = 4,
          .clusters = 1,
          .mean = 1.23456,
          .interval = {1.0, 2.0},
          .least = 0.25,
          .most = 2.5,
          .difference = difference};
}

Comparison written_comparison() {
  Comparison comparison{"cost", "cost, m", "ref", {}, Better::lower, "scene"};
  comparison.rows = {reference_row("left"), our_row("left", {-1.0, 0.25}), reference_row("all"),
                     our_row("all", {-1.0, -0.25})};
  return comparison;
}

TEST(ComparisonTables, HaveATableAPanelAndARowALevel) {
  const std::vector<TextTable> tables = text_tables(written_comparison());
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[0].title, "left");
  EXPECT_EQ(tables[1].title, "all");
  EXPECT_THAT(tables[0].header, ElementsAre("", "episodes", "mean [95 %, by scene]",
                                            "difference to ref [95 %]", "ratio [95 %]", "p"));
  ASSERT_EQ(tables[0].rows.size(), 2U);
  EXPECT_THAT(tables[0].rows[0], ElementsAre("ref", "3", "12346 [9999, 20001]", "", "", ""));
  EXPECT_THAT(tables[0].rows[1],
              ElementsAre("ours", "4", "1.235", "-0.5 [-1, 0.25]", "0.75 [0.5, 0.875]", "0.35"));
  Comparison apart = written_comparison();
  apart.cluster.clear();
  EXPECT_EQ(text_tables(apart)[0].header[2], "mean [95 %]");
  apart.rows[1].difference->ratio.reset();
  EXPECT_EQ(text_tables(apart)[0].rows[1][4], "");
}

TEST(ComparisonTables, AreTheSameAsCsvAndJson) {
  const Comparison comparison = written_comparison();
  const std::string csv = comparison_csv(comparison);
  EXPECT_EQ(csv.substr(csv.find('\n') + 1, csv.find("all") - csv.find('\n') - 1),
            "left,ref,3,12345.6,9999,20000.6,,,,,,,,\n"
            "left,ours,4,1.23456,,,2,-0.5,-1,0.25,0.75,0.5,0.875,0.34567\n");
  const auto ours = comparison_json(comparison)["left"]["ours"];
  EXPECT_EQ(ours["episodes"], 4);
  EXPECT_EQ(ours["least"], 0.25);
  EXPECT_EQ(ours["most"], 2.5);
  EXPECT_EQ(ours["difference"]["to"], "ref");
  EXPECT_EQ(ours["difference"]["pairs"], 2);
  EXPECT_EQ(ours["difference"]["mean"], -0.5);
  EXPECT_EQ(ours["difference"]["interval"], nlohmann::ordered_json({-1.0, 0.25}));
  EXPECT_EQ(ours["difference"]["ratio"], 0.75);
  EXPECT_EQ(ours["difference"]["ratio_interval"], nlohmann::ordered_json({0.5, 0.875}));
  EXPECT_EQ(ours["difference"]["p_value"], 0.34567);
}

TEST(ComparisonTables, TheOverviewHasARowALevelAndAColumnAComparison) {
  Comparison time = written_comparison();
  time.title = "time, s";
  time.rows.back().level = "theirs";
  const TextTable table = overview({written_comparison(), time});
  EXPECT_EQ(table.title, "");
  EXPECT_THAT(table.header, ElementsAre("", "cost, m", "time, s"));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_THAT(table.rows[0], ElementsAre("ref", "12346 [9999, 20001]", "12346 [9999, 20001]"));
  EXPECT_THAT(table.rows[1], ElementsAre("ours", "1.235", ""));
  EXPECT_THAT(table.rows[2], ElementsAre("theirs", "", "1.235"));
  EXPECT_THAT(overview({}).rows, IsEmpty());
}

/// An end of the interval at 0 is in it.
TEST(ComparisonTables, VerdictsAreOfTheLastPanelAndOfItsInterval) {
  const auto verdict_with = [](const Interval& interval) {
    Comparison comparison = written_comparison();
    comparison.rows.back() = our_row("all", interval);
    const std::vector<std::string> lines = verdicts({comparison});
    return lines.size() == 1 ? lines.front() : std::string("lines too many or few");
  };
  const std::string start = "ours against ref: cost -0.5 ";
  EXPECT_EQ(verdict_with({-1.0, -0.25}), start + "[-1, -0.25], better (2 pairs)");
  EXPECT_EQ(verdict_with({-1.0, 0.0}), start + "[-1, 0], no clear difference (2 pairs)");
  EXPECT_EQ(verdict_with({0.0, 1.0}), start + "[0, 1], no clear difference (2 pairs)");
  EXPECT_EQ(verdict_with({-1.0, 1.0}), start + "[-1, 1], no clear difference (2 pairs)");
  EXPECT_EQ(verdict_with({0.25, 1.0}), start + "[0.25, 1], better (2 pairs)");
}

TEST(ComparisonTables, VerdictsOfWhatIsMore) {
  const auto verdict_if = [](Better better) {
    Comparison comparison = written_comparison();
    comparison.better = better;
    comparison.rows.back().difference->mean = 0.5;
    comparison.rows.back().difference->interval = {0.25, 0.75};
    return verdicts({comparison}).at(0);
  };
  const std::string start = "ours against ref: cost +0.5 [0.25, 0.75], ";
  EXPECT_EQ(verdict_if(Better::unsaid), start + "more (2 pairs)");
  EXPECT_EQ(verdict_if(Better::lower), start + "worse (2 pairs)");
  EXPECT_EQ(verdict_if(Better::higher), start + "better (2 pairs)");
}

TEST(ComparisonTables, HaveNoExponentsOfWhatIsLarge) {
  Comparison comparison = written_comparison();
  comparison.rows[0].mean = 9999.5;
  comparison.rows[0].interval = {9999.4, 123456.0};
  EXPECT_EQ(text_tables(comparison)[0].rows[0][2], "10000 [9999, 123456]");
}

TEST(FigureTables, HaveABlankWhereASeriesHasNoPoint) {
  Figure figure{"f", "t", "", "scans", "y", {}};
  figure.panels.push_back(
      {"p",
       {{"a", 0, {{1.0, 2, 2, 5.0, {4.0, 6.0}}, {3.0, 2, 2, 7.0, {6.0, 8.0}}}},
        {"b", 1, {{2.0, 1, 1, 9.0, {9.0, 9.0}}, {3.0, 1, 1, 8.0, {8.0, 8.0}}}}}});
  const std::vector<TextTable> tables = text_tables(figure);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_THAT(tables[0].header, ElementsAre("scans", "a", "b"));
  EXPECT_THAT(tables[0].rows,
              ElementsAre(ElementsAre("1", "5 [4, 6]", ""), ElementsAre("2", "", "9"),
                          ElementsAre("3", "7 [6, 8]", "8")));
}

TEST(TextTables, AsMarkdownAndAsHtml) {
  const std::vector<TextTable> tables{{"first <one>", {"", "x", "y"}, {{"a", "1", "2"}}},
                                      {"", {"n"}, {{"3"}, {"4"}}}};
  EXPECT_EQ(markdown("All", tables),
            "# All\n"
            "\n## first <one>\n"
            "\n|  | x | y |\n|---|---:|---:|\n| a | 1 | 2 |\n"
            "\n| n |\n|---|\n| 3 |\n| 4 |\n");
  EXPECT_EQ(html(tables),
            "<h3>first &lt;one&gt;</h3>\n<div class=\"table-wrap\"><table>\n"
            "<thead><tr><th></th><th>x</th><th>y</th></tr>\n</thead>\n"
            "<tbody>\n<tr><td>a</td><td>1</td><td>2</td></tr>\n</tbody></table></div>\n"
            "<div class=\"table-wrap\"><table>\n<thead><tr><th>n</th></tr>\n</thead>\n"
            "<tbody>\n<tr><td>3</td></tr>\n<tr><td>4</td></tr>\n</tbody></table></div>\n");
}

}  // namespace
}  // namespace vantage
