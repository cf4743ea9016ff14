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

}  // namespace
}  // namespace vantage
