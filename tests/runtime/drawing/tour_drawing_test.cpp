#include "vantage/runtime/drawing/tour_drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "vantage/runtime/drawing/panel_style.hpp"

namespace vantage {
namespace {

/// From above: the unit square of the floor in 200 x 200 px, x downwards and y to the right.
MapCamera camera_above() {
  MapCamera camera;
  camera.T_camera_world.linear() << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  camera.T_camera_world.translation() << 0, 0, 10;
  camera.focal_px = 2000.0;
  return camera;
}

PlannedTour stops_at(const std::vector<Eigen::Vector2d>& places_m) {
  PlannedTour tour;
  for (const Eigen::Vector2d& place_m : places_m) tour.stops.push_back({.place_m = place_m});
  return tour;
}

cv::Mat image_of(const PlannedTour& tour, const TourDrawing& how) {
  MapCanvas canvas = make_canvas({200, 200});
  draw_tour(canvas, camera_above(), tour, how);
  return canvas.bgr;
}

bool is_near_colour(const cv::Mat& image, const Eigen::Vector2d& place_m, const cv::Scalar& bgr) {
  const auto& pixel = image.at<cv::Vec3b>(static_cast<int>(std::lround(200.0 * place_m.x())),
                                          static_cast<int>(std::lround(200.0 * place_m.y())));
  return cv::norm(cv::Scalar(pixel[0], pixel[1], pixel[2]) - bgr) < 25.0;
}

bool alike(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

TEST(TourDrawing, IsSolidToTheNextStop) {
  const PlannedTour tour = stops_at({{0.5, 0.2}});
  const cv::Mat image = image_of(tour, {.from_m = Eigen::Vector2d(0.5, 0.9)});
  for (double y = 0.3; y < 0.88; y += 0.01) {
    EXPECT_TRUE(is_near_colour(image, {0.5, y}, panel::kPlan)) << y;
  }
  const cv::Mat without = image_of(tour, {});
  EXPECT_FALSE(is_near_colour(without, {0.5, 0.6}, panel::kPlan)) << "drawn by another";
}

/// 160 px are 13 dashes of 7 px and as many gaps of 5 px, stretched a little; the round ends of a
/// stroke add 1 px on either side.
TEST(TourDrawing, IsDashedBeyond) {
  const cv::Mat image = image_of(stops_at({{0.1, 0.1}, {0.5, 0.1}, {0.5, 0.9}}), {});
  int drawn = 0;
  int dashes = 0;
  bool before = false;
  for (int x = 36; x < 166; ++x) {
    const bool now = image.at<cv::Vec3b>(100, x)[0] > 112;
    drawn += now ? 1 : 0;
    dashes += now && !before ? 1 : 0;
    before = now;
  }
  EXPECT_NEAR(dashes, 11, 1);
  EXPECT_NEAR(drawn, 98, 5);
}

TEST(TourDrawing, TheNextStopIsADiscAndTheOthersAreRings) {
  const cv::Mat image = image_of(stops_at({{0.2, 0.3}, {0.7, 0.6}}), {.unit = 2.0});
  // Discs are 18 px large at two pixels a stroke; below their numbers they show themselves.
  EXPECT_TRUE(is_near_colour(image, {0.2 + 14.0 / 200.0, 0.3}, panel::kPlan));
  EXPECT_FALSE(is_near_colour(image, {0.2 + 22.0 / 200.0, 0.3}, panel::kPlan));
  EXPECT_TRUE(is_near_colour(image, {0.7 + 14.0 / 200.0, 0.6}, panel::kBottom));
  bool is_round = false;
  for (int off = 16; off <= 20; ++off) {
    is_round = is_round || is_near_colour(image, {0.7 + off / 200.0, 0.6}, panel::kPlan);
  }
  EXPECT_TRUE(is_round) << "a ring";
}

TEST(TourDrawing, NumbersGoOnFromTheNextStop) {
  const PlannedTour tour = stops_at({{0.2, 0.3}, {0.7, 0.6}});
  EXPECT_FALSE(alike(image_of(tour, {}), image_of(tour, {.number = 7})));
  EXPECT_TRUE(alike(image_of(tour, {}), image_of(tour, {.number = 1})));
}

TEST(TourDrawing, MayLeaveTheNextStopUnmarked) {
  EXPECT_EQ(cv::countNonZero(image_of({}, {}).reshape(1)), 0);
  EXPECT_EQ(cv::countNonZero(image_of(stops_at({{0.5, 0.5}}), {.marks_next = false}).reshape(1)),
            0);
  EXPECT_GT(cv::countNonZero(image_of(stops_at({{0.5, 0.5}}), {}).reshape(1)), 100);
}

TEST(TourDrawing, StopsThatWouldCoverOthersAreDots) {
  EXPECT_TRUE(
      alike(image_of(stops_at({{0.5, 0.5}, {0.5, 0.5}}), {}), image_of(stops_at({{0.5, 0.5}}), {})))
      << "a dot covers no number";
  // Discs of 9 px cover each other up to 18 px: a ring shows its dark middle, a dot has none.
  const cv::Mat dot = image_of(stops_at({{0.5, 0.5}, {0.5, 0.585}}), {.marks_next = true});
  EXPECT_TRUE(is_near_colour(dot, {0.5 + 2.0 / 200.0, 0.585 + 2.0 / 200.0}, panel::kPlan));
  const cv::Mat ring = image_of(stops_at({{0.5, 0.5}, {0.5, 0.595}}), {.marks_next = true});
  EXPECT_TRUE(is_near_colour(ring, {0.5 + 6.0 / 200.0, 0.595}, panel::kBottom));
}

/// One metre above the floor, looking along x.
TEST(TourDrawing, GoesOnAfterAStopBehindTheCamera) {
  MapCamera ahead;
  ahead.T_camera_world.linear() << 0, 1, 0, 0, 0, -1, 1, 0, 0;
  ahead.T_camera_world.translation() << -0.5, 1, 0;
  ahead.focal_px = 100.0;
  ahead.centre_px = {100.0, 50.0};
  const auto drawn = [&](const std::vector<Eigen::Vector2d>& places_m) {
    MapCanvas canvas = make_canvas({200, 200});
    draw_tour(canvas, ahead, stops_at(places_m), {});
    return canvas.bgr;
  };
  const cv::Mat first = drawn({{1.0, 0.5}});
  EXPECT_TRUE(alike(drawn({{1.0, 0.5}, {-1.0, 0.5}}), first));
  const cv::Mat third = drawn({{1.0, 0.5}, {-1.0, 0.5}, {2.0, 1.5}});
  cv::Mat more = third != first;
  cv::Mat where;
  cv::extractChannel(more, where, 0);
  const cv::Rect ring = cv::boundingRect(where);
  EXPECT_NEAR(ring.x + 0.5 * (ring.width - 1), 150.0, 1.0);
  EXPECT_NEAR(ring.y + 0.5 * (ring.height - 1), 100.0, 1.0);
  EXPECT_NEAR(ring.width, 21, 3);
}

TEST(TourDrawing, IsToldInWords) {
  EXPECT_EQ(plan_text({}), "");
  PlannedTour tour = stops_at({{0.0, 0.0}});
  tour.stops.back().departure_s = 181.7;
  EXPECT_EQ(plan_text(tour), "plan: 1 view, 182 s; the first plan");
  tour.stops.push_back({.departure_s = 300.0});
  tour.reason = {PlanChange::cheaper, 14.25};
  EXPECT_EQ(plan_text(tour),
            "plan: 2 views, 300 s; another tour costs 14.2 s less than the best that goes on as "
            "intended");
}

TEST(PanelColours, AreOfOneDarkTheme) {
  const auto hex = [](const cv::Scalar& bgr) {
    return fmt::format("{:02x}{:02x}{:02x}", static_cast<int>(bgr[2]), static_cast<int>(bgr[1]),
                       static_cast<int>(bgr[0]));
  };
  EXPECT_EQ(hex(panel::kTop), "16202e");
  EXPECT_EQ(hex(panel::kBottom), "0b1018");
  EXPECT_EQ(hex(panel::kCard), "161f2c");
  EXPECT_EQ(hex(panel::kText), "e8eef4");
  EXPECT_EQ(hex(panel::kDim), "8a98aa");
  EXPECT_EQ(hex(panel::kFaint), "485668");
  EXPECT_EQ(hex(panel::kAccent), "ffbe3c");
  EXPECT_EQ(hex(panel::kVisited), "5aaac8");
  EXPECT_EQ(hex(panel::kRobot), "78e696");
  EXPECT_EQ(hex(panel::kPlan), "f08ce1");
}

TEST(PanelLayout, ScalesWithTheUnit) {
  const panel::Layout layout{2.0, {640, 480}};
  EXPECT_EQ(layout.px(3.5), 7.0);
  EXPECT_EQ(layout.stroke(0.1), 1) << "at least one pixel";
  EXPECT_EQ(layout.stroke(1.3), 3);
  EXPECT_EQ(layout.rect(1.2, 2.3, 3.4, 4.6), cv::Rect(2, 4, 6, 9));
  EXPECT_EQ(layout.height(), 240.0);
}

TEST(PanelText, BeginsEndsOrHasItsMiddleWhereItIsAsked) {
  const auto extent = [](panel::Align align) {
    cv::Mat image(60, 300, CV_8UC3, cv::Scalar());
    panel::text(image, {1.0, image.size()}, "HHHHHH", {150.0, 40.0}, 22.0, cv::Scalar::all(255),
                align);
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    return cv::boundingRect(grey);
  };
  const cv::Rect left = extent(panel::Align::left);
  const cv::Rect centre = extent(panel::Align::centre);
  const cv::Rect right = extent(panel::Align::right);
  EXPECT_GT(left.width, 60);
  EXPECT_NEAR(left.x, 150, 6);
  EXPECT_NEAR(centre.x + 0.5 * centre.width, 150.0, 6.0);
  EXPECT_NEAR(right.x + right.width, 150, 6);
}

TEST(PanelNumbers, AreGroupedByThousands) {
  EXPECT_EQ(panel::grouped(0.0), "0");
  EXPECT_EQ(panel::grouped(999.0), "999");
  EXPECT_EQ(panel::grouped(1000.0), "1 000");
  EXPECT_EQ(panel::grouped(12345.4), "12 345");
  EXPECT_EQ(panel::grouped(1234567.0), "1 234 567");
  EXPECT_EQ(panel::grouped(-1234.0), "-1 234");
  EXPECT_EQ(panel::grouped(-0.2), "0");
  EXPECT_EQ(panel::grouped(std::numeric_limits<double>::quiet_NaN()), "-");
  EXPECT_EQ(panel::grouped(std::numeric_limits<double>::infinity()), "-");
}

TEST(PanelNumbers, StepsAreRound) {
  EXPECT_DOUBLE_EQ(panel::round_step(10.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(panel::round_step(15.0, 10), 2.0);
  EXPECT_DOUBLE_EQ(panel::round_step(10.0, 4), 5.0);
  EXPECT_DOUBLE_EQ(panel::round_step(70.0, 10), 10.0);
  EXPECT_DOUBLE_EQ(panel::round_step(300.0, 10), 50.0);
  EXPECT_DOUBLE_EQ(panel::round_step(0.3, 100), 0.005);
}

TEST(TourDrawing, IsDashedFromTheFirstStopOn) {
  const cv::Mat image = image_of(stops_at({{0.5, 0.1}, {0.5, 0.9}}), {});
  int drawn = 0;
  for (int x = 36; x < 166; ++x) drawn += image.at<cv::Vec3b>(100, x)[0] > 112 ? 1 : 0;
  EXPECT_GT(drawn, 50);
}

/// A stroke of 2.2 px covers 0.6 of the pixels beside its middle.
TEST(TourDrawing, IsAStrokeThatIsFaintBehindSomething) {
  const TourDrawing how{.from_m = Eigen::Vector2d(0.5, 0.9)};
  const auto share_of_colour = [&](float inverse_depth, int aside_px) {
    MapCanvas canvas = make_canvas({200, 200});
    canvas.inverse_depth.setTo(cv::Scalar(inverse_depth));
    draw_tour(canvas, camera_above(), stops_at({{0.5, 0.2}}), how);
    return canvas.bgr.at<cv::Vec3b>(100 + aside_px, 120)[2] / panel::kPlan[2];
  };
  EXPECT_NEAR(share_of_colour(0.0F, 0), 0.95, 0.01);
  EXPECT_NEAR(share_of_colour(0.0F, 1), 0.6 * 0.95, 0.01);
  EXPECT_EQ(share_of_colour(0.0F, 2), 0.0);
  EXPECT_NEAR(share_of_colour(1.0F, 0), 0.4, 0.01);
}

TEST(TourDrawing, DotsAndDiscsGrowWithTheStroke) {
  const cv::Mat small = image_of(stops_at({{0.5, 0.5}, {0.5, 0.585}}), {});
  EXPECT_FALSE(is_near_colour(small, {0.5, 0.585 + 5.5 / 200.0}, panel::kPlan)) << "4 px";
  // Discs of 18 px at 30 px from each other.
  const cv::Mat large = image_of(stops_at({{0.5, 0.4}, {0.5, 0.55}}), {.unit = 2.0});
  EXPECT_TRUE(is_near_colour(large, {0.5, 0.55 + 5.0 / 200.0}, panel::kPlan)) << "7 px";
  EXPECT_FALSE(is_near_colour(large, {0.5, 0.55 + 9.0 / 200.0}, panel::kPlan));
}

TEST(TourDrawing, NumbersCountFromStopToStop) {
  const PlannedTour tour = stops_at({{0.2, 0.2}, {0.8, 0.3}, {0.5, 0.7}});
  const auto lettered = [&](std::size_t first, const Eigen::Vector2d& place_m) {
    const cv::Mat image = image_of(tour, {.number = first});
    const cv::Point middle(static_cast<int>(std::lround(200.0 * place_m.y())),
                           static_cast<int>(std::lround(200.0 * place_m.x())));
    return cv::Mat(image, cv::Rect(middle - cv::Point(5, 5), cv::Size(11, 11)));
  };
  EXPECT_TRUE(alike(lettered(1, {0.5, 0.7}), lettered(2, {0.8, 0.3}))) << "a 3";
  EXPECT_FALSE(alike(lettered(1, {0.5, 0.7}), lettered(1, {0.8, 0.3})));
}

TEST(PanelText, IsAsLargeAsAsked) {
  const auto drawn = [](double size, bool bold) {
    cv::Mat image(80, 300, CV_8UC3, cv::Scalar());
    panel::text(image, {2.0, image.size()}, "HHHHHH", {10.0, 60.0}, size, cv::Scalar::all(255),
                panel::Align::left, bold);
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    return grey;
  };
  const cv::Rect box = cv::boundingRect(drawn(11.0, false));
  EXPECT_NEAR(box.width, 6 * 22, 12);
  EXPECT_NEAR(box.height, 21, 4);
  EXPECT_GT(cv::sum(drawn(11.0, true))[0], 1.2 * cv::sum(drawn(11.0, false))[0]);
  cv::Mat plain(80, 300, CV_8UC3, cv::Scalar());
  panel::text(plain, {2.0, plain.size()}, "HHHHHH", {10.0, 60.0}, 11.0, cv::Scalar::all(255));
  cv::cvtColor(plain, plain, cv::COLOR_BGR2GRAY);
  EXPECT_TRUE(alike(plain, drawn(11.0, false))) << "neither bold nor in the middle";
}

}  // namespace
}  // namespace vantage
