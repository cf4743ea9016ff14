#include "vantage/study/figures/flight_figure.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vantage {
namespace {
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

Json object(double x_m, bool correct, const Json& looks) {
  return {{"x_m", x_m}, {"y_m", 0.0}, {"correct", correct}, {"looks", looks}};
}

Json flight() {
  const Json look = {{"direction", 2}, {"view", {{"x_m", 0.0}, {"y_m", 1.0}}}};
  return {{"path", {{-1.0, 0.0, 1.8, 0.0}, {1.0, 0.0, 1.8, 0.0}}},
          {"plan", {{-1.0, 0.0, 1.8, 0.0}, {1.0, 0.5, 1.8, 0.0}}},
          {"objects",
           {object(0.0, true, Json::array({look})), object(0.5, false, Json::array({look})),
            object(1.0, false, Json::array())}}};
}

/// A room of 9.2 m x 5.2 m: with its margin 10 m x 6 m, 60 px a metre.
const std::vector<FloorOutline> kRoom{{{-4.6, -2.6}, {4.6, -2.6}, {4.6, -2.5}, {-4.6, -2.5}},
                                      {{-4.6, 2.5}, {4.6, 2.5}, {4.6, 2.6}, {-4.6, 2.6}}};

TEST(FlightFigure, HasAxesInMetresToOneScale) {
  const std::string svg = flight_svg(flight(), "a flight", kRoom);
  EXPECT_THAT(svg, HasSubstr(">x, m</text>"));
  EXPECT_THAT(svg, HasSubstr(">y, m</text>"));
  EXPECT_THAT(svg, HasSubstr(">1 m</text>"));
  const double middle_x = 52.0 + 300.0;
  const double middle_y = 34.0 + 180.0;
  EXPECT_THAT(svg, HasSubstr(fmt::format("points=\"{:.1f},{:.1f} {:.1f},{:.1f} \"", middle_x - 60.0,
                                         middle_y, middle_x + 60.0, middle_y - 30.0)));
}

TEST(FlightFigure, DrawsTheRoom) {
  const std::string svg = flight_svg(flight(), "a flight", kRoom);
  EXPECT_THAT(svg, HasSubstr("<polygon points=\"76.0,370.0 628.0,370.0 628.0,364.0 76.0,364.0 \""));
  EXPECT_THAT(flight_svg(flight(), "a flight", {}), Not(HasSubstr("<polygon")));
}

/// Of a flight that was interrupted at once, without a room.
TEST(FlightFigure, OfNothingIsASquareRoundTheOrigin) {
  const Json nothing = {
      {"path", Json::array()}, {"plan", Json::array()}, {"objects", Json::array()}};
  const std::string svg = flight_svg(nothing, "no flight", {});
  EXPECT_THAT(svg, HasSubstr("<rect x=\"52.0\" y=\"34.0\" width=\"600.0\" height=\"600.0\""));
  EXPECT_THAT(svg, HasSubstr("<text x=\"352.0\" y=\"651.0\" text-anchor=\"middle\">0<"));
  EXPECT_THAT(svg, HasSubstr("<text x=\"44.0\" y=\"338.0\" text-anchor=\"end\">0<"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(FlightFigure, SaysWhatItsMarksMeanAndTellsObjectsApart) {
  const std::string svg = flight_svg(flight(), "a <flight>", kRoom);
  EXPECT_THAT(svg, HasSubstr("a &lt;flight&gt;"));
  for (const char* entry : {"path as given", "path as planned at the end", "start",
                            "camera at an observation", "walls and furniture"}) {
    EXPECT_THAT(svg, HasSubstr(fmt::format(">{}</text>", entry)));
  }
  // One of each in the drawing, one of each in the legend.
  for (const char* colour : {"#0c8a5b", "#c92a4b", "#5c6b7e"}) {
    std::size_t marks = 0;
    const std::string mark = fmt::format("r=\"8\" fill=\"{}\"", colour);
    for (auto at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at + 1)) ++marks;
    EXPECT_EQ(marks, 2U) << colour;
  }
}

TEST(FlightFigure, AxesAndScaleStandAroundThePlot) {
  const std::string svg = flight_svg(flight(), "a flight", kRoom);
  for (
      const char* part :
      {"width=\"666\" height=\"528\" viewBox=\"0 0 666 528\"",
       R"(<text x="52.0" y="21.0" font-size="14" font-weight="600" fill="#16202e">a flight<)",
       "<rect x=\"52.0\" y=\"34.0\" width=\"600.0\" height=\"360.0\" fill=\"none\"",
       "<path d=\"M472.0 34.0L472.0 394.0\" stroke=\"#eef1f5\"/>",
       "<path d=\"M472.0 394.0L472.0 398.0\" stroke=\"#566375\"/>",
       "<text x=\"472.0\" y=\"411.0\" text-anchor=\"middle\">2<",
       "<path d=\"M52.0 154.0L652.0 154.0\" stroke=\"#eef1f5\"/>",
       "<path d=\"M48.0 154.0L52.0 154.0\" stroke=\"#566375\"/>",
       "<text x=\"44.0\" y=\"158.0\" text-anchor=\"end\">1<",
       "<text x=\"352.0\" y=\"430.0\" text-anchor=\"middle\">x, m<",
       R"svg(<text x="14.0" y="214.0" text-anchor="middle" transform="rotate(-90 14 214.0)">y, m<)svg",
       "<path d=\"M592.0 426.0L652.0 426.0\" stroke=\"#16202e\" stroke-width=\"3\"/>",
       "<text x=\"585.0\" y=\"430.0\" text-anchor=\"end\" fill=\"#16202e\">1 m<"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
}

/// From 0.18 m to 0.45 m off the object, eight directions counter-clockwise from +x.
TEST(FlightFigure, SpokesShowFromWhereAnObjectWasSeen) {
  const std::string svg = flight_svg(flight(), "a flight", kRoom);
  const auto spoke = [](const char* line, const char* style) {
    return fmt::format("<path d=\"{}\" {}/>", line, style);
  };
  constexpr auto kBold = "stroke=\"#d9480f\" stroke-width=\"3\"";
  constexpr auto kThin = "stroke=\"#aab3bf\" stroke-width=\"1\"";
  EXPECT_THAT(svg, HasSubstr(spoke("M362.8 214.0L379.0 214.0", kThin)));
  EXPECT_THAT(svg, HasSubstr(spoke("M359.6 206.4L371.1 194.9", kThin)));
  EXPECT_THAT(svg, HasSubstr(spoke("M352.0 203.2L352.0 187.0", kBold)));
  EXPECT_THAT(svg, HasSubstr(spoke("M352.0 224.8L352.0 241.0", kThin)));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"352.0\" cy=\"154.0\" r=\"2.6\" fill=\"#d9480f\"/>"));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"292.0\" cy=\"214.0\" r=\"4.5\" fill=\"#ffffff\""));
  for (const auto& [x, number] : {std::pair(352.0, 1), {382.0, 2}, {412.0, 3}}) {
    EXPECT_THAT(svg, HasSubstr(fmt::format(
                         "<text x=\"{:.1f}\" y=\"217.5\" fill=\"#ffffff\" font-size=\"10\" "
                         "text-anchor=\"middle\">{}<",
                         x, number)));
  }
}

TEST(FlightFigure, TheLegendStandsInColumnsBelow) {
  const std::string svg = flight_svg(flight(), "a flight", kRoom);
  const auto place = [](double x, double y) {
    return fmt::format("<g transform=\"translate({:.1f} {:.1f})\">", x, y);
  };
  EXPECT_THAT(svg, HasSubstr(place(26.0, 450.0) + "\n<path d=\"M-14.0 0.0L14.0 0.0\" fill"));
  EXPECT_THAT(svg, HasSubstr(place(248.0, 470.0)));
  EXPECT_THAT(svg, HasSubstr("<text x=\"270.0\" y=\"474.0\" fill=\"#16202e\">direction it was "
                             "seen from<"));
  EXPECT_THAT(svg, HasSubstr(place(26.0, 510.0)));
}

/// A metre apart up to 14 of them, then 2, 5, 10 m.
TEST(FlightFigure, TicksAreNotTooMany) {
  const auto labels = [](double length_m) {
    const std::vector<FloorOutline> hall{{{0.0, 0.0}, {length_m, 0.0}, {length_m, 2.0}}};
    return flight_svg(flight(), "a flight", hall);
  };
  const auto has = [](int metres) {
    return HasSubstr(fmt::format("\"middle\">{}</text>", metres));
  };
  EXPECT_THAT(labels(11.0), has(7));
  EXPECT_THAT(labels(24.0), testing::AllOf(has(14), Not(has(13))));
  EXPECT_THAT(labels(40.0), testing::AllOf(has(35), Not(has(34)), Not(has(36))));
  EXPECT_THAT(labels(100.0), testing::AllOf(has(70), Not(has(75))));
}

/// Every 5 m from the first to the last within the plot, which goes 0.4 m beyond the hall.
TEST(FlightFigure, TicksStandWithinThePlot) {
  const auto lines = [](double from_m, double to_m, int first, int last) {
    const std::vector<FloorOutline> hall{{{from_m, 0.0}, {to_m, 0.0}, {to_m, 2.0}}};
    const std::string svg = flight_svg(flight(), "a flight", hall);
    for (const int metres : {first, last}) {
      EXPECT_THAT(svg, HasSubstr(fmt::format("\"middle\">{}</text>", metres)));
    }
    std::size_t count = 0;
    const std::string line = "stroke=\"#eef1f5\"/>";
    for (auto at = svg.find(line); at != svg.npos; at = svg.find(line, at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(lines(0.0, 40.0, 0, 40), 9U + 1U) << "y is from -0.4 to 2.4 m";
  EXPECT_EQ(lines(-22.6, 18.6, -20, 15), 8U + 1U);
}

/// From -2 m of the path to 9 m of the last object, from 0 to 0.5 m of the plan, and 0.4 m beyond:
/// 11.8 m x 1.3 m.
TEST(FlightFigure, WithoutARoomItIsAsLargeAsAllThatIsDrawn) {
  Json far = flight();
  far["path"][0][0] = -2.0;
  far["objects"][2]["x_m"] = 9.0;
  const std::string svg = flight_svg(far, "a flight", {});
  EXPECT_THAT(svg, HasSubstr("<rect x=\"52.0\" y=\"34.0\" width=\"600.0\" height=\"66.1\""));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"631.7\" cy=\"79.8\" r=\"8\" fill=\"#5c6b7e\"/>"));
}

/// Eight of each of three objects, of which two were seen from one direction; one in the legend.
TEST(FlightFigure, SpokesAreEightAnObject) {
  const std::string svg = flight_svg(flight(), "a flight", kRoom);
  const auto count = [&](const std::string& mark) {
    std::size_t found = 0;
    for (auto at = svg.find(mark); at != svg.npos; at = svg.find(mark, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("stroke=\"#aab3bf\""), 3U * 8U - 2U + 1U);
  EXPECT_EQ(count("stroke=\"#d9480f\""), 2U + 1U);
}

/// Of a room of 1 m x 9.2 m, drawn 174 px wide.
TEST(FlightFigure, TheLegendOfANarrowRoomIsOneColumn) {
  const Json nothing = {
      {"path", Json::array()}, {"plan", Json::array()}, {"objects", Json::array()}};
  const std::string svg =
      flight_svg(nothing, "no flight", {{{-0.5, -4.6}, {0.5, -4.6}, {0.5, 4.6}, {-0.5, 4.6}}});
  for (const char* part :
       {"width=\"174\"", "<g transform=\"translate(26.0 690.0)\">",
        "<g transform=\"translate(26.0 710.0)\">",
        "<g transform=\"translate(26.0 730.0)\">\n<circle cx=\"0.0\" cy=\"0.0\" r"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
}

}  // namespace
}  // namespace vantage
