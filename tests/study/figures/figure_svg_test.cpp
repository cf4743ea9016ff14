// Where the parts of a figure stand in its image.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "vantage/study/figures/figure.hpp"

namespace vantage {
namespace {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// x from 1 to 3 over 390 px, y from 0 to 10 over 248 px.
Figure drawn_figure() {
  Figure figure{.name = "f",
                .title = "Cost",
                .subtitle = "lower is better",
                .x_label = "scans",
                .y_label = "cost",
                .panels = {}};
  figure.panels.push_back({"left",
                           {{"bb",
                             10,
                             {{1.0, 2, 2, 2.0, {1.0, 3.0}},
                              {2.0, 2, 2, 6.0, {5.0, 8.0}},
                              {3.0, 2, 2, 9.0, {9.0, 10.0}}}},
                            {"a", 0, {{1.0, 2, 2, 4.0, {4.0, 4.0}}}}}});
  return figure;
}

/// One panel whose values reach from `low` to `high`.
std::string svg_between(double low, double high) {
  Figure figure = drawn_figure();
  figure.panels[0].series = {{"s", 0, {{1.0, 2, 2, high, {low, high}}}}};
  return figure_svg(figure);
}

std::string label_at(double y, const std::string& text) {
  return fmt::format("<text x=\"58.0\" y=\"{:.1f}\" text-anchor=\"end\" font-size=\"12\">{}</text>",
                     y + 4.0, text);
}

TEST(FigurePlaces, OfValuesThatDifferInTheLastDigitAreThoseOfOne) {
  for (const double value : {0.1, 1e7}) {
    const std::string svg = svg_between(value, std::nextafter(value, 1e9));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_EQ(svg, svg_between(value, value));
  }
}

TEST(FigurePlaces, OfAxesAndTicks) {
  const std::string svg = figure_svg(drawn_figure());
  const std::pair<double, const char*> rows[] = {{339.0, "0"}, {289.4, "2"}, {239.8, "4"},
                                                 {190.2, "6"}, {140.6, "8"}, {91.0, "10"}};
  for (const auto& [y, text] : rows) {
    EXPECT_THAT(svg, HasSubstr(label_at(y, text)));
    EXPECT_THAT(svg, HasSubstr(fmt::format(
                         "<path d=\"M66.0 {0:.1f}L456.0 {0:.1f}\" stroke=\"#e3e8ef\"/>", y)));
  }
  for (const auto& [x, text] : {std::pair(66.0, "1"), {261.0, "2"}, {456.0, "3"}}) {
    EXPECT_THAT(svg, HasSubstr(fmt::format(
                         "<path d=\"M{0:.1f} 339.0L{0:.1f} 343.0\" stroke=\"#566375\"/>", x)));
    EXPECT_THAT(svg, HasSubstr(fmt::format("<text x=\"{:.1f}\" y=\"357.0\" text-anchor=\"middle\" "
                                           "font-size=\"12\">{}</text>",
                                           x, text)));
  }
  EXPECT_THAT(svg, HasSubstr("<path d=\"M66.0 339.0L456.0 339.0\" stroke=\"#566375\"/>"));
}

TEST(FigurePlaces, OfTitlesAndLabels) {
  const std::string svg = figure_svg(drawn_figure());
  for (const char* part :
       {"<text x=\"66.0\" y=\"24.0\" text-anchor=\"start\" font-size=\"16\" font-weight=\"650\" "
        "fill=\"#16202e\">Cost<",
        "<text x=\"66.0\" y=\"45.0\" text-anchor=\"start\" font-size=\"13\">lower is better<",
        "<text x=\"66.0\" y=\"77.0\" text-anchor=\"start\" font-size=\"13.5\" "
        "font-weight=\"650\" fill=\"#16202e\">left<",
        "<text x=\"261.0\" y=\"377.0\" text-anchor=\"middle\" font-size=\"12\">scans<",
        "<text x=\"14.0\" y=\"215.0\" text-anchor=\"middle\" font-size=\"12\" "
        "transform=\"rotate(-90 14.0 215.0)\">cost<",
        "<text x=\"66.0\" y=\"433.0\" text-anchor=\"start\" font-size=\"11\">Mean over",
        "viewBox=\"0 0 486 444\" width=\"486\" height=\"444\"",
        "aria-label=\"Cost: lower is better\""}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
}

TEST(FigurePlaces, OfLinesBandsAndDots) {
  const std::string svg = figure_svg(drawn_figure());
  EXPECT_THAT(svg, HasSubstr("<path d=\"M66.0 264.6L261.0 140.6L456.0 91.0L456.0 115.8L261.0 "
                             "215.0L66.0 314.2Z\" fill=\"#d9480f\" fill-opacity=\".13\"/>"));
  EXPECT_THAT(svg, HasSubstr("<path d=\"M66.0 289.4L261.0 190.2L456.0 115.8\" fill=\"none\" "
                             "stroke=\"#d9480f\" stroke-width=\"1.9\" stroke-linejoin=\"round\" "
                             "stroke-dasharray=\"7 4\"/>"));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"261.0\" cy=\"190.2\" r=\"2.4\" fill=\"#d9480f\"/>"));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"66.0\" cy=\"239.8\" r=\"2.4\" fill=\"#0f6fde\"/>"));
}

/// Of nine colours and three dashes; the tenth series has the first colour again, dashed.
TEST(FigurePlaces, OfLegendsAreInOrderOfStyles) {
  const auto entry = [](double x, double y, const char* colour, const char* dash,
                        const char* name) {
    return fmt::format(
        "<path d=\"M{:.1f} {:.1f}h22\" stroke=\"{}\" stroke-width=\"2.4\" "
        "stroke-dasharray=\"{}\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"start\" "
        "font-size=\"12\" fill=\"#16202e\">{}</text>",
        x, y, colour, dash, x + 28.0, y + 4.0, name);
  };
  // Of names of two letters a column is 60.8 px wide.
  const std::string svg = figure_svg(drawn_figure());
  EXPECT_THAT(svg, AllOf(HasSubstr(entry(66.0, 403.0, "#0f6fde", "", "a")),
                         HasSubstr(entry(126.8, 403.0, "#d9480f", "7 4", "bb"))));
  // Of 20 letters 194 px, so that two fit beside each other.
  Figure figure = drawn_figure();
  figure.panels[0].series[0].name = std::string(20, 'n');
  for (const std::size_t style : {20U, 27U}) {
    figure.panels[0].series.push_back({fmt::format("s{}", style), style, {}});
  }
  const std::string two_rows = figure_svg(figure);
  EXPECT_THAT(two_rows, AllOf(HasSubstr(entry(66.0, 403.0, "#0f6fde", "", "a")),
                              HasSubstr(entry(66.0, 427.0, "#0c8a5b", "2 4", "s20")),
                              HasSubstr(entry(260.0, 427.0, "#0f6fde", "", "s27")),
                              HasSubstr("viewBox=\"0 0 486 468\"")));
}

/// The axis of y begins at 0 unless all is above 0.35 of the top.
TEST(FigureAxes, ShowZeroWhereItIsNear) {
  EXPECT_THAT(svg_between(3.0, 10.0), HasSubstr(label_at(339.0, "0")));
  EXPECT_THAT(svg_between(0.3, 1.0), HasSubstr(label_at(339.0, "0")));
  EXPECT_THAT(svg_between(3.5, 10.0), HasSubstr(label_at(339.0, "2"))) << "0.35 is not below";
  EXPECT_THAT(svg_between(4.0, 10.0), HasSubstr(label_at(339.0, "4")));
  EXPECT_THAT(svg_between(-4.0, 10.0), HasSubstr(label_at(339.0, "-5")));
}

TEST(FigureAxes, TickLabelsAreShort) {
  const auto labels = [](double high, const std::vector<std::string>& texts) {
    const std::string svg = svg_between(0.0, high);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(texts.size() - 1);
      EXPECT_THAT(svg, HasSubstr(label_at(339.0 - 248.0 * share, texts[i]))) << high;
    }
  };
  labels(8.0, {"0", "2", "4", "6", "8"});
  labels(1.0, {"0", "0.2", "0.4", "0.6", "0.8", "1"});
  labels(5.0, {"0", "1", "2", "3", "4", "5"});
  labels(4.5, {"0", "1", "2", "3", "4", "5"});
  labels(22.0, {"0", "5", "10", "15", "20", "25"});
  labels(8000.0, {"0", "2000", "4000", "6000", "8000"});
  labels(9000.0, {"0", "2 k", "4 k", "6 k", "8 k", "10 k"});
  labels(800000.0, {"0", "200 k", "400 k", "600 k", "800 k"});
  labels(4000000.0, {"0", "1 M", "2 M", "3 M", "4 M"});
}

TEST(FigureAxes, StepsOfCountsAreWhole) {
  Figure figure = drawn_figure();
  figure.least_x_step = 0.5;
  EXPECT_THAT(figure_svg(figure), HasSubstr(">1.5</text>"));
  figure.least_x_step = 1.0;
  EXPECT_THAT(figure_svg(figure), Not(HasSubstr(">1.5</text>")));
}

TEST(FigurePlaces, DotsOnFewPointsOnly) {
  const auto circles = [](int points) {
    Figure figure = drawn_figure();
    figure.panels[0].series = {{"s", 0, {}}};
    for (int i = 0; i < points; ++i) {
      figure.panels[0].series[0].points.push_back({1.0 * i, 2, 2, 1.0, {1.0, 1.0}});
    }
    const std::string svg = figure_svg(figure);
    std::size_t count = 0;
    for (auto at = svg.find("<circle"); at != svg.npos; at = svg.find("<circle", at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(circles(25), 25U);
  EXPECT_EQ(circles(26), 0U);
}

/// No axes of nothing.
TEST(FigurePlaces, PanelsWithoutPointsAreNotRun) {
  Figure figure = drawn_figure();
  EXPECT_THAT(figure_svg(figure), Not(HasSubstr("not run")));
  figure.panels[0].series = {{"a", 0, {}}};
  EXPECT_THAT(figure_svg(figure), HasSubstr("<text x=\"261.0\" y=\"215.0\" text-anchor=\"middle\" "
                                            "font-size=\"12\">not run<"));
  EXPECT_THAT(figure_svg(figure),
              AllOf(HasSubstr(">not run<"), HasSubstr(">left<"), Not(HasSubstr(">scans<"))));
}

/// One, two or three columns, as many rows as are needed.
TEST(FigurePlaces, OfPanels) {
  const auto svg_of = [](std::size_t panels) {
    Figure figure = drawn_figure();
    figure.panels.clear();
    for (std::size_t i = 0; i < panels; ++i) figure.panels.push_back({fmt::format("p{}", i), {}});
    return figure_svg(figure);
  };
  const auto title = [](double x, double y, const char* name) {
    return fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"start\" font-size=\"13.5\" "
        "font-weight=\"650\" fill=\"#16202e\">{}<",
        x, y, name);
  };
  const std::pair<std::size_t, const char*> sizes[] = {
      {1, "0 0 486 420"},  {2, "0 0 956 420"},  {3, "0 0 956 750"},  {4, "0 0 956 750"},
      {5, "0 0 1426 750"}, {6, "0 0 1426 750"}, {7, "0 0 1426 1080"}};
  for (const auto& [panels, size] : sizes) {
    EXPECT_THAT(svg_of(panels), HasSubstr(fmt::format("viewBox=\"{}\"", size))) << panels;
  }
  EXPECT_THAT(svg_of(3),
              AllOf(HasSubstr(title(66.0, 77.0, "p0")), HasSubstr(title(536.0, 77.0, "p1")),
                    HasSubstr(title(66.0, 407.0, "p2"))));
  EXPECT_THAT(svg_of(5),
              AllOf(HasSubstr(title(1006.0, 77.0, "p2")), HasSubstr(title(536.0, 407.0, "p4"))));
}

TEST(FigurePlaces, OfLegendsWithoutNamesAreColumnsOfTheirMarks) {
  Figure figure = drawn_figure();
  for (FigureSeries& series : figure.panels[0].series) series.name.clear();
  EXPECT_THAT(figure_svg(figure), AllOf(HasSubstr("<path d=\"M66.0 403.0h22\""),
                                        HasSubstr("<path d=\"M112.0 403.0h22\"")));
}

TEST(FigurePlaces, OfLegendsAreOfEveryPanel) {
  Figure figure = drawn_figure();
  figure.panels.push_back({"right", {{"a", 0, {}}, {"c", 20, {}}}});
  const std::string svg = figure_svg(figure);
  for (const char* mark :
       {"<path d=\"M66.0 403.0h22\" stroke=\"#0f6fde\"",
        "<path d=\"M126.8 403.0h22\" stroke=\"#d9480f\"",
        "<path d=\"M187.6 403.0h22\" stroke=\"#0c8a5b\"", ">a</text>", ">bb</text>", ">c</text>"}) {
    EXPECT_THAT(svg, HasSubstr(mark));
  }
  EXPECT_EQ(svg.find(">a</text>"), svg.rfind(">a</text>")) << "once";
}

TEST(FigureAxes, OfASingleValueIsAUnitHigh) {
  EXPECT_THAT(svg_between(4.0, 4.0),
              AllOf(HasSubstr(label_at(339.0, "4")), HasSubstr(">4.2</text>"),
                    HasSubstr(label_at(91.0, "5"))));
}

/// What is close together keeps its digits.
TEST(FigureAxes, TickLabelsAreShortWhereTheStepsAreLong) {
  struct LabelledRange {
    double low, high;
    const char* label;
  };
  for (const auto& [low, high, label] :
       {LabelledRange{10000.0, 10500.0, "10.1 k"}, LabelledRange{10000.0, 10250.0, "10050"},
        LabelledRange{0.0, 1000000.0, "0.2 M"}, LabelledRange{1000000.0, 1020000.0, "1005 k"},
        LabelledRange{1000000.0, 1050000.0, "1.01 M"}}) {
    EXPECT_THAT(svg_between(low, high), HasSubstr(fmt::format(">{}</text>", label)));
  }
}

/// Of 21 scans every second one has a tick; the first stands on the axis, the last at its end.
TEST(FigureAxes, CurvesReachFromEndToEnd) {
  Figure figure = drawn_figure();
  figure.panels[0].series = {{"s", 0, {}}};
  for (int i = 1; i <= 21; ++i) {
    figure.panels[0].series[0].points.push_back({1.0 * i, 2, 2, 1.0, {0.0, 10.0}});
  }
  const std::string svg = figure_svg(figure);
  EXPECT_THAT(svg, AllOf(HasSubstr("<path d=\"M66.0 314.2L85.5 314.2L"),
                         HasSubstr("L456.0 314.2\" fill=\"none\"")));
  const auto has_tick = [&](int scan) {
    const std::string tick =
        fmt::format("y=\"357.0\" text-anchor=\"middle\" font-size=\"12\">{}</text>", scan);
    return svg.find(tick) != svg.npos;
  };
  for (int scan = 0; scan <= 22; ++scan) {
    EXPECT_EQ(has_tick(scan), scan % 2 == 0 && scan >= 2 && scan <= 20) << scan;
  }
}

TEST(FigurePlaces, TextIsPressedIntoItsRoom) {
  Figure figure = drawn_figure();
  const std::string wide(80, 'n');
  figure.x_label = figure.y_label = figure.panels[0].title = wide;
  figure.panels[0].series[1].name = wide;
  const std::string svg = figure_svg(figure);
  for (const char* part :
       {"font-size=\"13.5\" font-weight=\"650\" fill=\"#16202e\" textLength=\"390\"",
        "y=\"377.0\" text-anchor=\"middle\" font-size=\"12\" textLength=\"390\"",
        "<text x=\"14.0\" y=\"215.0\" text-anchor=\"middle\" font-size=\"12\" textLength=\"310\"",
        "font-size=\"12\" fill=\"#16202e\" textLength=\"384\""}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
  EXPECT_THAT(svg_between(12345678.0, 12345688.0),
              HasSubstr("text-anchor=\"end\" font-size=\"12\" textLength=\"56\""));
}

/// 406 px hold 39 bold letters of 16 px.
TEST(FigurePlaces, TitlesAreBrokenWithinTheImage) {
  const std::string first(19, 'a');
  const auto is_broken = [&](std::size_t letters) {
    Figure figure = drawn_figure();
    figure.title = first + " " + std::string(letters, 'b');
    return figure_svg(figure).find(">" + first + "<") != std::string::npos;
  };
  EXPECT_FALSE(is_broken(19));
  EXPECT_TRUE(is_broken(20));
}

/// Of 24 letters 223.6 px: no two in 420 px.
TEST(FigurePlaces, OfLegendsWithLongNamesAreBelowEachOther) {
  Figure figure = drawn_figure();
  for (FigureSeries& series : figure.panels[0].series) series.name = std::string(24, 'n');
  EXPECT_THAT(figure_svg(figure), AllOf(HasSubstr("<path d=\"M66.0 403.0h22\""),
                                        HasSubstr("<path d=\"M66.0 427.0h22\"")));
}

}  // namespace
}  // namespace vantage
