// Curves against scans, and their image.
#include "vantage/study/figures/figure.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "vantage/information/resampling.hpp"
#include "vantage/study/tables/text_table.hpp"

namespace vantage {
namespace {
using testing::HasSubstr;
using testing::Not;

const std::vector<std::size_t> kApart{0, 1};

TEST(MeanSeries, EndedCurvesKeepTheirLastValue) {
  const std::vector<std::vector<double>> curves{{4.0, 2.0}, {8.0, 6.0, 4.0}};
  const FigureSeries series = mean_series({}, "p", "s", 0, {curves, kApart}, {}, true);
  ASSERT_EQ(series.points.size(), 3U);
  EXPECT_EQ(series.points[0].x, 1.0);
  EXPECT_DOUBLE_EQ(series.points[0].mean, 6.0);
  EXPECT_EQ(series.points[2].x, 3.0);
  EXPECT_DOUBLE_EQ(series.points[2].mean, 3.0);
  EXPECT_EQ(series.points[2].count, 2U);
}

TEST(MeanSeries, OrAreLeftOut) {
  const std::vector<std::vector<double>> curves{{4.0, 2.0}, {8.0, 6.0, 4.0}};
  const FigureSeries series = mean_series({}, "p", "s", 0, {curves, kApart}, {2.0, 0.5}, false);
  EXPECT_EQ(series.points[2].x, 3.0);
  EXPECT_DOUBLE_EQ(series.points[2].mean, 4.0);
  EXPECT_EQ(series.points[2].count, 1U);
}

/// Both of one scene: one value, and no interval.
TEST(MeanSeries, BandsAreOfClusters) {
  const std::vector<std::vector<double>> curves{{4.0}, {8.0}};
  const std::vector<std::size_t> alike{3, 3};
  const FigureSeries series = mean_series({}, "p", "s", 0, {curves, alike}, {}, true);
  EXPECT_EQ(series.points[0].count, 2U);
  EXPECT_EQ(series.points[0].clusters, 1U);
  EXPECT_DOUBLE_EQ(series.points[0].interval.low, 6.0);
  EXPECT_DOUBLE_EQ(series.points[0].interval.high, 6.0);
}

Figure small_figure() {
  Figure figure{"f", "Cost & gain", "", "scans", "cost, m", {}};
  figure.panels.push_back(
      {"<left>", {{"ours", 1, {{1, 2, 2, 0.0, {0.0, 0.0}}, {2, 2, 2, 1e6, {9e5, 1.2e6}}}}}});
  figure.panels.push_back({"empty", {}});
  return figure;
}

TEST(FigureSvg, TextIsEscapedAndNumbersAreFinite) {
  const std::string svg = figure_svg(small_figure());
  for (const char* part : {"Cost &amp; gain", "&lt;left&gt;", "cost, m", "ours", ">1 M<", ">0<"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
  for (const char* part : {"nan", "inf", "<left>"}) EXPECT_THAT(svg, Not(HasSubstr(part)));
}

/// Right end of the lines of text, letters of half their size wide.
double rightmost_end(const std::string& svg) {
  double most = 0.0;
  const std::regex line(
      R"re(<text x="([0-9.]+)" [^>]*anchor="start" font-size="([0-9.]+)"([^>]*)>([^<]*)<)re");
  for (std::sregex_iterator m(svg.begin(), svg.end(), line), end; m != end; ++m) {
    const bool pressed = (*m)[3].str().find("textLength") != std::string::npos;
    if (pressed) continue;
    most = std::max(most, std::stod((*m)[1]) +
                              0.5 * std::stod((*m)[2]) * static_cast<double>((*m)[4].length()));
  }
  return most;
}

TEST(FigureSvg, NoTextLeavesTheImage) {
  Figure figure = small_figure();
  figure.panels.pop_back();
  figure.title = "Does it pay to learn how far a beam goes into unknown space on a small table?";
  figure.subtitle = "share of all of the cells that could have been observed, lower is better";
  figure.panels[0].series[0].name = std::string(120, 'n');
  figure.panels[0].title = "a_name_without_any_space_in_it_that_is_longer_than_its_panel_is_wide";
  figure.note = std::string(30, 'a') + " " + std::string(60, 'b') + " " + std::string(30, 'c');
  const std::string svg = figure_svg(figure);
  EXPECT_LT(rightmost_end(svg), 486.0);
  for (const char* part : {"Does it pay", "small table?", "lower is better", "textLength"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
  EXPECT_EQ(full_title(figure), figure.title + " " + figure.subtitle);
  figure.title = "Two gains";
  EXPECT_EQ(full_title(figure), "Two gains: " + figure.subtitle);
}

TEST(FigureSvg, SaysBelowWhatItShows) {
  Figure figure = small_figure();
  EXPECT_THAT(figure_svg(figure), HasSubstr(">Mean over episodes; band: 95 %"));
  figure.note = "Medians <of one run>.";
  EXPECT_THAT(figure_svg(figure), HasSubstr(">Medians &lt;of one run&gt;.<"));
  EXPECT_THAT(figure_svg(figure), Not(HasSubstr("Mean over episodes")));
}

TEST(FigureSvg, OneLegendEntryForEachSeries) {
  Figure figure = small_figure();
  figure.panels.push_back(figure.panels.front());
  const std::string svg = figure_svg(figure);
  EXPECT_EQ(svg.find(">ours<"), svg.rfind(">ours<"));
}

TEST(FigureTable, ARowForEveryScan) {
  const auto tables = text_tables(small_figure());
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[0].rows[1], (std::vector<std::string>{"2", "1000000 [900000, 1200000]"}));
  const std::string text = markdown("Cost", tables);
  EXPECT_THAT(text, HasSubstr("| scans | ours |\n|---|---:|\n| 1 | 0 [0, 0] |"));
}

TEST(FigureCsv, HoldsEveryPoint) {
  EXPECT_EQ(figure_csv(small_figure()),
            "panel,series,scans,episodes,mean,low,high\n"
            "<left>,ours,1,2,0,0,0\n<left>,ours,2,2,1000000,900000,1200000\n");
}

TEST(FigurePoints, AreOfNothingUnlessTold) {
  const FigurePoint point{};
  EXPECT_EQ(point.x, 0.0);
  EXPECT_EQ(point.count, 0U);
  EXPECT_EQ(point.clusters, 0U);
  EXPECT_EQ(point.mean, 0.0);
  EXPECT_EQ(FigureSeries{}.style, 0U);
  EXPECT_EQ(Figure{}.least_x_step, 1.0);
}

TEST(MeanSeries, OfNoCurvesHasNoPoints) {
  const std::vector<std::vector<double>> none;
  EXPECT_THAT(mean_series({}, "p", "s", 0, {none, kApart}, {}, true).points, testing::IsEmpty());
  const std::vector<std::vector<double>> ended{{}, {}};
  EXPECT_THAT(mean_series({}, "p", "s", 0, {ended, kApart}, {}, true).points, testing::IsEmpty());
}

/// By the seed 1, so that a figure is the same whenever it is drawn.
TEST(MeanSeries, IntervalsAreDrawnByTheNameOfTheirPoint) {
  std::vector<std::vector<double>> curves;
  std::vector<std::size_t> marks;
  for (std::size_t i = 0; i < 20; ++i) {
    const auto x = static_cast<double>(i);
    curves.push_back({std::sin(7.0 * x), 5.0 + 3.0 * std::cos(11.0 * x)});
    marks.push_back(i);
  }
  Figure figure;
  figure.name = "f";
  const FigureSeries series = mean_series(figure, "p", "s", 0, {curves, marks}, {}, true);
  ASSERT_EQ(series.points.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> values;
    for (const auto& curve : curves) values.push_back(curve[k]);
    Rng rng = Rng::stream(1, fmt::format("f/p/s/{}", k));
    const Interval drawn = bootstrap_mean(values, clusters_of(marks), rng);
    EXPECT_EQ(series.points[k].interval.low, drawn.low) << k;
    EXPECT_EQ(series.points[k].interval.high, drawn.high) << k;
  }
}

TEST(FigureTitles, StandAloneWhereThereIsNoOther) {
  Figure figure = small_figure();
  EXPECT_EQ(full_title(figure), "Cost & gain");
  figure.title.clear();
  figure.subtitle = "lower is better";
  EXPECT_EQ(full_title(figure), "lower is better");
}

}  // namespace
}  // namespace vantage
