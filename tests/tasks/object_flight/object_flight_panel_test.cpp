// The panel of a recognition, 640 x 720 px, at places worked out by hand.
#include "vantage/tasks/object_flight/object_flight_panel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/tasks/drawn_pixels.hpp"
#include "vantage/runtime/drawing/panel_style.hpp"

namespace vantage {
namespace {

using support::count_coloured;
using support::is_coloured;
using support::is_written;
using Points = std::vector<cv::Point>;

constexpr double kQuarter_rad = std::numbers::pi / 2.0;

cv::Mat drawn(const RecognitionPanelInput& input) {
  return draw_recognition_panel(input, {640, 720});
}

/// From bearings of 45 and 135 deg.
std::vector<ObservationRecord> two_records() {
  std::vector<ObservationRecord> records(2);
  records[0].report.entropy_bits = 2.0;
  records[0].report.view_rad = 0.5 * kQuarter_rad;
  records[1].report.entropy_bits = 1.0;
  records[1].report.view_rad = 1.5 * kQuarter_rad;
  return records;
}

const Orbit kOrbit{.centre_m = {1.0, 2.0, 0.7}, .radius_m = 1.0, .height_m = 1.0};

/// From (22, 697) px up, 91.5 px a view; the highest value is 226 px high.
TEST(RecognitionPanel, HasABarOfEntropyAView) {
  const auto records = two_records();
  const cv::Mat panel = drawn({.observation_records = records, .orbit = kOrbit});
  for (const cv::Point bar : Points{{24, 474}, {24, 694}, {84, 474}, {116, 587}, {175, 694}}) {
    EXPECT_TRUE(is_coloured(panel, bar, panel::kVisited)) << bar;
  }
  for (const cv::Point beside :
       Points{{19, 690}, {24, 700}, {89, 600}, {110, 690}, {117, 570}, {181, 690}, {300, 584}}) {
    EXPECT_TRUE(is_coloured(panel, beside, panel::kCard)) << beside;
  }
  EXPECT_TRUE(is_written(panel, {40, 457, 28, 10})) << "2.0";
  EXPECT_TRUE(is_written(panel, {132, 570, 28, 10})) << "1.0";
  EXPECT_EQ(count_coloured(panel, {12, 429, 386, 280}, panel::kAccent), 0);
}

/// 1 is the highest there may be.
TEST(RecognitionPanel, ShowsTheProbabilityOfAChangeAndItsThreshold) {
  auto records = two_records();
  records[0].change = {0.25, Change::none};
  records[1].change = {0.75, Change::none};
  const cv::Mat panel = drawn(
      {.observation_records = records, .orbit = kOrbit, .expected = "mug_1", .threshold = 0.5});
  EXPECT_TRUE(is_coloured(panel, {24, 643}, panel::kVisited));
  EXPECT_TRUE(is_coloured(panel, {24, 620}, panel::kCard));
  EXPECT_TRUE(is_coloured(panel, {116, 531}, panel::kVisited));
  EXPECT_TRUE(is_coloured(panel, {116, 505}, panel::kCard));
  for (const int x : {24, 150, 300, 385}) {
    EXPECT_TRUE(is_coloured(panel, {x, 584}, panel::kAccent)) << x;
  }
  EXPECT_TRUE(is_coloured(panel, {300, 580}, panel::kCard));
  EXPECT_TRUE(is_coloured(panel, {392, 584}, panel::kCard));
}

TEST(RecognitionPanel, ShowsNoThresholdBeforeTheFirstView) {
  const cv::Mat panel =
      drawn({.observation_records = {}, .orbit = kOrbit, .expected = "mug_1", .threshold = 0.5});
  EXPECT_EQ(count_coloured(panel, {12, 429, 386, 280}, panel::kAccent), 0);
}

TEST(RecognitionPanel, ListsTheMostProbableObjectsFirst) {
  RecognitionPanelInput input{.observation_records = {}, .orbit = kOrbit};
  input.objects = {"mug_1", "bowl_2", "cup_3"};
  input.p_object = Eigen::Vector3d(0.1, 0.7, 0.2);
  const cv::Mat panel = drawn(input);
  const std::vector<double> p{0.7, 0.2, 0.1};
  for (int i = 0; i < 3; ++i) {
    const int y = 79 + 22 * i;
    const int end = 418 + static_cast<int>(200.0 * p[static_cast<std::size_t>(i)]);
    EXPECT_TRUE(is_coloured(panel, {420, y}, panel::kAccent)) << i;
    EXPECT_TRUE(is_coloured(panel, {end - 3, y}, panel::kAccent)) << i;
    EXPECT_TRUE(is_coloured(panel, {end + 3, y}, panel::kFaint)) << i;
    EXPECT_TRUE(is_coloured(panel, {616, y}, panel::kFaint)) << i;
    EXPECT_TRUE(is_coloured(panel, {620, y}, panel::kCard)) << i;
    EXPECT_TRUE(is_coloured(panel, {415, y}, panel::kCard)) << i;
    EXPECT_TRUE(is_written(panel, {418, y - 13, 40, 8})) << "its name";
    EXPECT_TRUE(is_written(panel, {590, y - 13, 28, 8})) << "its probability";
    EXPECT_FALSE(is_written(panel, {620, y - 13, 7, 8}));
  }
  EXPECT_FALSE(is_written(panel, {418, 130, 200, 20})) << "there are no more";
}

/// Of the card below on the right, 79.2 px a metre; the middle of the orbit is at (518, 580) px.
RecognitionPanelInput from_above(const std::vector<ObservationRecord>& records) {
  RecognitionPanelInput input{.observation_records = records, .orbit = kOrbit};
  input.bearings_rad = {0.0, kQuarter_rad, 2.0 * kQuarter_rad};
  input.visible = {1.0, 0.25};
  input.goal_rad = 3.0 * kQuarter_rad;
  input.T_world_body = make_pose(kOrbit.centre_m + Eigen::Vector3d(0.3, -0.25, 1.0), kQuarter_rad);
  return input;
}

TEST(RecognitionPanel, ShowsWherePlacesAre) {
  const auto records = two_records();
  const cv::Mat panel = drawn(from_above(records));
  for (const cv::Point text : Points{{518, 580}, {521, 580}, {597, 580}, {599, 580}, {518, 501}}) {
    EXPECT_TRUE(is_coloured(panel, text, panel::kText)) << text;
  }
  EXPECT_FALSE(is_coloured(panel, {518, 504}, panel::kText)) << "a quarter of the area";
  EXPECT_FALSE(is_coloured(panel, {439, 580}, panel::kText)) << "how much is not known";
  EXPECT_GT(count_coloured(panel, {433, 574, 13, 13}, panel::kDim), 0) << "but that there is one";
  for (const int x : {574, 462}) {
    EXPECT_TRUE(is_coloured(panel, {x - 7, 524}, panel::kVisited)) << x;
    EXPECT_TRUE(is_coloured(panel, {x + 7, 524}, panel::kVisited)) << x;
    EXPECT_TRUE(is_coloured(panel, {x - 12, 524}, panel::kCard)) << x;
  }
  EXPECT_GT(count_coloured(panel, {458, 632, 9, 9}, panel::kFaint), 0) << "the orbit, at 225 deg";
  EXPECT_NEAR(support::mean_radius_px(panel, {518, 659}, 18, panel::kAccent), 12.0, 0.5)
      << "round where it is at or flies to";
}

TEST(RecognitionPanel, ShowsWhereTheRobotIsAndLooks) {
  const auto records = two_records();
  const cv::Mat panel = drawn(from_above(records));
  for (const cv::Point robot : Points{{542, 600}, {538, 600}, {546, 600}, {542, 585}}) {
    EXPECT_TRUE(is_coloured(panel, robot, panel::kRobot)) << robot;
  }
  for (const cv::Point beside : Points{{542, 573}, {542, 612}, {533, 600}, {551, 600}}) {
    EXPECT_TRUE(is_coloured(panel, beside, panel::kCard)) << beside;
  }
}

/// Three columns of cells: something in one, nothing in the next, and one that was not seen.
TEST(RecognitionPanel, ShowsWhatStandsOnTheTable) {
  OccupancyGrid map({.min_corner_m = {0.5, 2.3, 0.7},
                     .cell_size_m = Eigen::Vector3d::Constant(0.1),
                     .cells = {3, 1, 2}});
  map.log_odds = {-3.0F, -3.0F, 0.0F, 3.0F, 0.0F, 0.0F};
  RecognitionPanelInput input{.observation_records = {}, .orbit = kOrbit};
  input.map = &map;
  input.targets_m = {kOrbit.centre_m, kOrbit.centre_m + Eigen::Vector3d(0.0, -0.5, 0.0)};
  const cv::Mat panel = drawn(input);
  EXPECT_TRUE(is_coloured(panel, {481, 551}, panel::kDim));
  EXPECT_TRUE(is_coloured(panel, {490, 551}, panel::kCard));
  EXPECT_TRUE(is_coloured(panel, {498, 551}, panel::kFaint));
  EXPECT_TRUE(is_coloured(panel, {481, 559}, panel::kCard));
  EXPECT_TRUE(is_coloured(panel, {481, 544}, panel::kCard));
  EXPECT_NEAR(support::mean_radius_px(panel, {518, 620}, 9, panel::kText), 5.0, 0.7);
}

TEST(RecognitionPanel, ShowsTheImageAsLargeAsItFits) {
  CameraImages image{.width_px = 40, .height_px = 20, .rgb = {}, .depth_m = {}};
  for (int i = 0; i < 800; ++i) image.rgb.insert(image.rgb.end(), {10, 200, 90});
  RecognitionPanelInput input{.observation_records = {}, .orbit = kOrbit};
  input.camera_image = &image;
  const cv::Mat panel = drawn(input);
  const cv::Scalar shown(90, 200, 10);
  for (const cv::Point inside : Points{{14, 227}, {395, 227}, {200, 134}, {200, 321}}) {
    EXPECT_TRUE(is_coloured(panel, inside, shown)) << inside;
  }
  for (const cv::Point beside : Points{{200, 127}, {200, 328}}) {
    EXPECT_TRUE(is_coloured(panel, beside, panel::kCard)) << beside;
  }
}

TEST(OutlinedImage, HasTheMasksEdgeInIt) {
  CameraImages image{.width_px = 8, .height_px = 6, .rgb = {}, .depth_m = {}};
  for (int i = 0; i < 48; ++i) image.rgb.insert(image.rgb.end(), {200, 100, 0});
  ObjectView cut;
  cut.width_px = cut.height_px = 3;
  cut.mask.assign(9, 1);
  cut.left_px = 2;
  cut.top_px = 1;
  EXPECT_EQ(count_coloured(outlined(image, nullptr), {0, 0, 8, 6}, {0, 100, 200}), 48);
  const cv::Mat with_edge = outlined(image, &cut);
  EXPECT_EQ(count_coloured(with_edge, {2, 1, 3, 3}, panel::kAccent), 8);
  EXPECT_EQ(count_coloured(with_edge, {0, 0, 8, 6}, {0, 100, 200}), 40);
  EXPECT_TRUE(is_coloured(with_edge, {3, 2}, {0, 100, 200}));
}

/// Its baseline is 4 px below the middle of the dot.
TEST(RecognitionPanel, NumbersItsViews) {
  const auto records = two_records();
  const cv::Mat panel = drawn(from_above(records));
  const double aside_px = 79.2 * std::sqrt(0.5);
  for (const int number : {1, 2}) {
    const cv::Point2d dot(518.0 + (number == 1 ? aside_px : -aside_px), 580.2 - aside_px);
    cv::Mat expected(panel.size(), CV_8UC3, panel::kVisited);
    panel::text(expected, {1.0, {640, 720}}, std::to_string(number), dot + cv::Point2d(0.0, 4.0),
                11, panel::kBottom, panel::Align::centre, true);
    const cv::Rect inside(static_cast<int>(dot.x) - 5, static_cast<int>(dot.y) - 5, 11, 11);
    EXPECT_GT(count_coloured(expected, inside, panel::kBottom), 0);
    EXPECT_EQ(cv::norm(panel(inside), expected(inside), cv::NORM_INF), 0.0) << number;
  }
}

TEST(RecognitionPanel, LooksAtTheFirstOfSeveralObjectsIfNothingElseIsSaid) {
  RecognitionPanelInput input{.observation_records = {}, .orbit = kOrbit};
  input.targets_m = {kOrbit.centre_m, kOrbit.centre_m + Eigen::Vector3d(0.0, -0.5, 0.0)};
  const cv::Mat unsaid = drawn(input);
  input.target = 0;
  EXPECT_EQ(cv::norm(unsaid, drawn(input), cv::NORM_INF), 0.0);
  input.target = 1;
  EXPECT_GT(cv::norm(unsaid, drawn(input), cv::NORM_INF), 0.0) << "its heading says which";
}

/// Two objects in two yaw bins each; what is unknown comes behind them.
TEST(RecognitionPanel, ListsAllThatItMayBe) {
  ObjectStates states{.objects = {"mug_1", "bowl_2"},
                      .categories = {"mug", "bowl"},
                      .category_of = {0, 1},
                      .bins = 2};
  RecognitionPanelInput input{.observation_records = {}, .orbit = kOrbit};
  const Eigen::VectorXd certain = Eigen::Vector4d(0.5, 0.25, 0.125, 0.125);
  input.set_belief(states, ObjectBelief{certain.array().log().matrix()});
  EXPECT_EQ(input.objects, states.objects);
  ASSERT_EQ(input.p_object.size(), 2);
  EXPECT_NEAR(input.p_object[0], 0.75, 1e-12);
  states.unknown_category = {kNoCategory};
  Eigen::VectorXd doubtful(5);
  doubtful << 0.25, 0.125, 0.0625, 0.0625, 0.5;
  input.set_belief(states, ObjectBelief{doubtful.array().log().matrix()});
  EXPECT_EQ(input.objects, (std::vector<std::string>{"mug_1", "bowl_2", "unknown"}));
  ASSERT_EQ(input.p_object.size(), 3);
  EXPECT_NEAR(input.p_object[0], 0.375, 1e-12);
  EXPECT_NEAR(input.p_object[2], 0.5, 1e-12);
}

/// From top to bottom, left of all that is drawn on the cards.
TEST(RecognitionPanel, CardsStandBelowItsHeading) {
  const cv::Mat drawn_panel = drawn({.observation_records = {}, .orbit = kOrbit});
  cv::Mat expected(720, 1, CV_8UC3, panel::kBottom);
  expected.rowRange(36, 419).setTo(panel::kCard);
  expected.rowRange(429, 709).setTo(panel::kCard);
  EXPECT_EQ(cv::norm(drawn_panel.col(13), expected, cv::NORM_INF), 0.0);
}

/// 6 of 8, at 22 px each; equal ones in their order.
TEST(RecognitionPanel, ListsSixObjectsAtMost) {
  RecognitionPanelInput input{.observation_records = {}, .orbit = kOrbit};
  for (int i = 0; i < 8; ++i) input.objects.push_back("mug_" + std::to_string(i));
  input.p_object = Eigen::VectorXd::Constant(8, 0.125);
  const cv::Mat panel = drawn(input);
  for (int i = 0; i < 6; ++i) {
    EXPECT_TRUE(is_coloured(panel, {440, 79 + 22 * i}, panel::kAccent)) << i;
    cv::Mat expected(panel.size(), CV_8UC3, panel::kCard);
    panel::text(expected, {1.0, {640, 720}}, "mug_" + std::to_string(i), {418.0, 74.0 + 22.0 * i},
                11, panel::kText);
    const cv::Rect name(418, 64 + 22 * i, 60, 13);
    EXPECT_EQ(cv::norm(panel(name), expected(name), cv::NORM_INF), 0.0) << i;
  }
  EXPECT_EQ(count_coloured(panel, {412, 200, 212, 200}, panel::kAccent), 0);
}

/// What it asks stands on the left, how far it has come on the right.
TEST(RecognitionPanel, SaysInItsHeadingWhatItLooksAt) {
  const auto records = two_records();
  const auto heading = [](const RecognitionPanelInput& input) {
    return drawn(input)(cv::Rect(0, 0, 640, 34)).clone();
  };
  const auto written = [](const std::string& left, const std::string& right) {
    cv::Mat expected(720, 640, CV_8UC3, panel::kBottom);
    const panel::Layout layout{1.0, {640, 720}};
    panel::text(expected, layout, left, {14.0, 24.0}, 14, panel::kText, panel::Align::left, true);
    panel::text(expected, layout, right, {626.0, 24.0}, 12, panel::kDim, panel::Align::right);
    return expected(cv::Rect(0, 0, 640, 34)).clone();
  };
  RecognitionPanelInput input{.observation_records = records, .orbit = kOrbit};
  input.method = "star";
  EXPECT_EQ(cv::norm(heading(input), written("star", "2 views"), cv::NORM_INF), 0.0);
  input.targets_m.push_back(kOrbit.centre_m);
  EXPECT_EQ(cv::norm(heading(input), written("star", "2 views"), cv::NORM_INF), 0.0);
  input.targets_m.push_back(kOrbit.centre_m + Eigen::Vector3d(0.0, -0.5, 0.0));
  input.target = 1;
  EXPECT_EQ(cv::norm(heading(input), written("star", "object 2 of 2, 2 views"), cv::NORM_INF), 0.0);
  input.observation_records = {};
  input.targets_m.clear();
  input.expected = "mug_1";
  EXPECT_EQ(cv::norm(heading(input), written("is it mug_1 still?", "0 views"), cv::NORM_INF), 0.0);
}

/// Above its bars, at (22, 447) px.
TEST(RecognitionPanel, SaysWhatItHoldsTheChangeFor) {
  auto records = two_records();
  records[0].change = {0.75, Change::object};
  records[1].change = {0.75, Change::pose};
  const auto title = [](const RecognitionPanelInput& input) {
    return drawn(input)(cv::Rect(12, 429, 386, 24)).clone();
  };
  const auto written = [](const std::string& words) {
    cv::Mat expected(720, 640, CV_8UC3, panel::kCard);
    panel::text(expected, {1.0, {640, 720}}, words, {22.0, 447.0}, 11, panel::kDim);
    return expected(cv::Rect(12, 429, 386, 24)).clone();
  };
  const cv::Mat before =
      title({.observation_records = {}, .orbit = kOrbit, .expected = "mug_1", .threshold = 0.5});
  EXPECT_EQ(
      cv::norm(before, written("probability of a change, by now: not known yet"), cv::NORM_INF),
      0.0);
  const cv::Mat after = title(
      {.observation_records = records, .orbit = kOrbit, .expected = "mug_1", .threshold = 0.5});
  EXPECT_EQ(cv::norm(after, written("probability of a change, by now: pose"), cv::NORM_INF), 0.0);
  const cv::Mat entropy = title({.observation_records = {}, .orbit = kOrbit});
  EXPECT_EQ(cv::norm(entropy, written("entropy, bits, after each view"), cv::NORM_INF), 0.0);
}

/// Six of them are 61 px a view; a value of nothing is a line of 1 px.
TEST(RecognitionPanel, MakesRoomForMoreThanFourViews) {
  std::vector<ObservationRecord> records(6);
  for (std::size_t i = 0; i < 5; ++i) records[i].report.entropy_bits = 3.0;
  const cv::Mat panel = drawn({.observation_records = records, .orbit = kOrbit});
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(is_coloured(panel, {24 + 61 * i, 600}, panel::kVisited)) << i;
    EXPECT_TRUE(is_coloured(panel, {62 + 61 * i, 600}, panel::kVisited)) << i;
    EXPECT_TRUE(is_coloured(panel, {68 + 61 * i, 600}, panel::kCard)) << i;
  }
  EXPECT_TRUE(is_coloured(panel, {330, 696}, panel::kVisited));
  EXPECT_TRUE(is_coloured(panel, {330, 694}, panel::kCard));
}

}  // namespace
}  // namespace vantage
