// The panel of a flight along a path, 640 x 720 px, at places worked out by hand.
#include "vantage/tasks/trajectory/trajectory_panel.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/tasks/drawn_pixels.hpp"
#include "tests/tasks/flight/two_objects.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/runtime/drawing/panel_style.hpp"

namespace vantage {
namespace {

using support::count_coloured;
using support::is_coloured;
using support::is_written;
using Points = std::vector<cv::Point>;

const std::vector<Eigen::Vector4d> kNominal{
    {0.0, 0.0, 1.8, 0.0}, {2.0, 0.0, 1.8, 0.0}, {2.0, 1.0, 1.8, 0.0}};
/// A little to the left of it.
const std::vector<Eigen::Vector4d> kPlan{
    {0.0, 0.3, 1.8, 0.0}, {2.0, 0.3, 1.8, 0.0}, {2.0, 1.3, 1.8, 0.0}};

const cv::Scalar kNotKnown(80, 110, 240);

/// One object that was found and not observed yet. On its card below on the left the path has
/// 89.09 px a metre; its middle, (1, 0.5) m, is at (208, 520) px.
cv::Mat drawn_flight(const cv::Mat& camera_image) {
  const Recogniser recogniser = support::recogniser_of_two();
  ObjectObservations observations(recogniser, {}, RigidTransition{});
  observations.found(7, {1.0, 1.2, 0.8});
  TrajectoryPanelInput input{
      .observations = observations, .nominal = kNominal, .plan = kPlan, .at = 1};
  input.T_world_body = make_pose({1.0, 0.1, 1.8}, std::numbers::pi / 2.0);
  input.target = ViewTarget{.object = 7,
                            .direction = 3,
                            .p_world_object_m = {0.0, -0.3, 0.8},
                            .p_world_view_m = {0.0, 1.5, 1.8}};
  return draw_trajectory_panel(input, camera_image, {640, 720});
}

bool is_near(const cv::Mat& panel, cv::Point at, const cv::Scalar& bgr) {
  return count_coloured(panel, {at.x - 3, at.y - 3, 7, 7}, bgr) > 0;
}

TEST(TrajectoryPanel, ShowsThePathAndThePlan) {
  const cv::Mat panel = drawn_flight({});
  EXPECT_TRUE(is_near(panel, {150, 565}, panel::kFaint));
  EXPECT_TRUE(is_near(panel, {297, 552}, panel::kFaint)) << "up to its end";
  for (const int x : {122, 150, 290}) {
    EXPECT_TRUE(is_coloured(panel, {x, 538}, panel::kVisited)) << x;
  }
  for (const int y : {530, 500, 452}) {
    EXPECT_TRUE(is_coloured(panel, {297, y}, panel::kAccent)) << y;
  }
  for (const cv::Point beside : Points{{113, 538}, {150, 545}, {297, 440}, {297, 575}}) {
    EXPECT_TRUE(is_coloured(panel, beside, panel::kCard)) << beside;
  }
  EXPECT_EQ(count_coloured(panel, {100, 532, 90, 12}, panel::kAccent), 0) << "that is behind it";
}

/// It sees half a radian to either side, 2 m far.
TEST(TrajectoryPanel, ShowsWhereTheRobotIsAndWhatItSees) {
  const cv::Mat panel = drawn_flight({});
  for (const cv::Point robot : Points{{208, 556}, {205, 556}, {211, 556}}) {
    EXPECT_TRUE(is_coloured(panel, robot, panel::kRobot)) << robot;
  }
  for (const cv::Point edge : Points{{251, 477}, {165, 477}, {289, 407}, {127, 407}}) {
    EXPECT_TRUE(is_near(panel, edge, panel::kRobot)) << edge;
  }
  for (const cv::Point beside : Points{{208, 500}, {298, 391}, {118, 391}, {165, 635}}) {
    EXPECT_FALSE(is_near(panel, beside, panel::kRobot)) << beside;
  }
  EXPECT_TRUE(is_near(panel, {164, 573}, panel::kDim)) << "towards its target";
  EXPECT_NEAR(support::mean_radius_px(panel, {119, 431}, 10, panel::kAccent), 6.0, 0.6)
      << "the view that it wants";
}

TEST(TrajectoryPanel, ShowsObjectsAndTheirDirections) {
  const cv::Mat panel = drawn_flight({});
  EXPECT_TRUE(is_coloured(panel, {208, 458}, kNotKnown));
  EXPECT_TRUE(is_coloured(panel, {206, 458}, kNotKnown));
  EXPECT_TRUE(is_coloured(panel, {217, 461}, panel::kCard));
  for (const cv::Point ray : Points{{237, 458}, {179, 458}, {208, 429}, {208, 487}}) {
    EXPECT_TRUE(is_near(panel, ray, panel::kFaint)) << ray;
  }
  EXPECT_TRUE(is_coloured(panel, {208, 414}, panel::kCard)) << "no longer than 0.45 m";
  EXPECT_TRUE(is_written(panel, {424, 64, 100, 12})) << "its name";
  EXPECT_GT(count_coloured(panel, {424, 78, 190, 12}, kNotKnown), 0) << "its entropy";
  EXPECT_FALSE(is_written(panel, {424, 96, 190, 40})) << "there is one";
}

/// An image of one colour.
void expect_image(const cv::Size& size, const Points& inside, const Points& beside) {
  const cv::Scalar shown(90, 200, 10);
  const cv::Mat panel = drawn_flight(cv::Mat(size, CV_8UC3, shown));
  for (const cv::Point& at : inside) EXPECT_TRUE(is_coloured(panel, at, shown)) << at;
  for (const cv::Point& at : beside) EXPECT_TRUE(is_coloured(panel, at, panel::kCard)) << at;
}

TEST(TrajectoryPanel, ShowsTheImageAsLargeAsItFits) {
  expect_image({40, 20}, {{14, 178}, {401, 178}, {200, 83}, {200, 272}}, {{200, 76}, {200, 280}});
}

/// Seen from (1.9, 1.2) m, at (288, 458) px; what was seen tells nothing.
TEST(TrajectoryPanel, ShowsFromWhereAnObjectWasObserved) {
  const TrainedFeature colour(Colour{}, 0.0);
  ObservationModel model;
  model.feature = "colour";
  model.mean = Eigen::MatrixXf::Zero(colour.dimension(), 8);
  model.variance = Eigen::MatrixXf::Ones(colour.dimension(), 8);
  const Recogniser recogniser =
      make_recogniser(support::recogniser_of_two().states, {{colour, model}}, 1);
  ObjectObservations observations(recogniser, {}, RigidTransition{});
  observations.found(7, {1.0, 1.2, 0.8});
  ObjectView view;
  view.width_px = view.height_px = 12;
  view.rgb.assign(432, 90);
  view.depth_m.assign(144, 1.0F);
  view.mask.assign(144, 1);
  Rng rng(1);
  observations.take(7, {}, view, make_pose({1.9, 1.2, 1.8}, 0.0), 1.0, rng);
  const TrajectoryPanelInput input{
      .observations = observations, .nominal = kNominal, .plan = kPlan, .at = 1};
  const cv::Mat panel = draw_trajectory_panel(input, {}, {640, 720});
  EXPECT_TRUE(is_coloured(panel, {288, 458}, kNotKnown));
  EXPECT_TRUE(is_coloured(panel, {282, 458}, panel::kCard)) << "a small dot";
  EXPECT_TRUE(is_near(panel, {237, 458}, kNotKnown)) << "that direction is used";
  for (const cv::Point ray : Points{{179, 458}, {208, 429}, {208, 487}}) {
    EXPECT_TRUE(is_near(panel, ray, panel::kFaint)) << ray;
  }
}

/// Two objects of which it is sure enough.
TEST(TrajectoryPanel, ListsObjectsBelowEachOther) {
  const Recogniser recogniser = support::recogniser_of_two();
  ObservationOptions options;
  options.known_below_nats = 1.0;
  ObjectObservations observations(recogniser, options, RigidTransition{});
  observations.found(7, {1.0, 1.2, 0.8});
  observations.found(8, {1.9, 1.2, 0.8});
  const TrajectoryPanelInput input{
      .observations = observations, .nominal = kNominal, .plan = kPlan, .at = 1};
  const cv::Mat drawn = draw_trajectory_panel(input, {}, {640, 720});
  EXPECT_EQ(drawn.at<cv::Vec3b>(458, 208), cv::Vec3b(140, 210, 90)) << "known";
  cv::Mat expected(drawn.size(), CV_8UC3, panel::kCard);
  const panel::Layout layout{1.0, expected.size()};
  panel::text(expected, layout, "7  not seen closely yet", {424.0, 74.0}, 10, panel::kDim);
  panel::text(expected, layout, "8  not seen closely yet", {424.0, 106.0}, 10, panel::kDim);
  for (const int top : {62, 94}) {
    const cv::Rect line(416, top, 210, 14);
    EXPECT_EQ(cv::norm(drawn(line), expected(line), cv::NORM_INF), 0.0) << top;
  }
}

TEST(TrajectoryPanel, SaysBelowTheNameOfAnObjectHowSureItIs) {
  const Recogniser recogniser = support::recogniser_of_two();
  ObjectObservations observations(recogniser, {}, RigidTransition{});
  observations.found(7, {1.0, 1.2, 0.8});
  const TrajectoryPanelInput input{
      .observations = observations, .nominal = kNominal, .plan = kPlan, .at = 1};
  const cv::Mat drawn = draw_trajectory_panel(input, {}, {640, 720});
  cv::Mat expected(drawn.size(), CV_8UC3, panel::kCard);
  const panel::Layout layout{1.0, expected.size()};
  const double nats = observations.entropy_nats(observations.objects().front());
  panel::text(expected, layout, "7  not seen closely yet", {424.0, 74.0}, 10, panel::kDim);
  panel::text(expected, layout, fmt::format("{:.2f} nats, 0 observations", nats), {424.0, 88.0}, 9,
              kNotKnown);
  const cv::Rect lines(416, 62, 210, 34);
  EXPECT_EQ(cv::norm(drawn(lines), expected(lines), cv::NORM_INF), 0.0);
}

TEST(TrajectoryPanel, ShowsATallImageInTheMiddle) {
  expect_image({20, 40}, {{139, 178}, {276, 178}, {208, 38}, {208, 317}}, {{134, 178}, {282, 178}});
}

/// Before the first waypoint it is as if it were there.
TEST(TrajectoryPanel, SaysAboveWhatFliesAndHowFarItIs) {
  const Recogniser recogniser = support::recogniser_of_two();
  const ObjectObservations observations(recogniser, {}, RigidTransition{});
  for (const int at : {-1, 0, 1}) {
    TrajectoryPanelInput input{
        .observations = observations, .nominal = kNominal, .plan = kPlan, .at = at};
    input.method = "stomp";
    const cv::Mat drawn = draw_trajectory_panel(input, {}, {640, 720});
    cv::Mat expected(drawn.size(), CV_8UC3, panel::kBottom);
    const panel::Layout layout{1.0, expected.size()};
    panel::text(expected, layout, "stomp", {14.0, 24.0}, 14, panel::kText, panel::Align::left,
                true);
    panel::text(expected, layout, fmt::format("waypoint {} of 3, 0 observations", at < 1 ? 1 : 2),
                {626.0, 24.0}, 12, panel::kDim, panel::Align::right);
    const cv::Rect top(0, 0, 640, 36);
    EXPECT_EQ(cv::norm(drawn(top), expected(top), cv::NORM_INF), 0.0) << at;
    EXPECT_TRUE(is_near(drawn, {150, 538}, at < 1 ? panel::kAccent : panel::kVisited)) << at;
  }
}

TEST(TrajectoryPanel, HasRaysOfAllEightDirections) {
  const cv::Mat panel = drawn_flight({});
  for (const cv::Point ray : Points{{227, 439}, {189, 439}, {227, 477}, {189, 477}}) {
    EXPECT_TRUE(is_near(panel, ray, panel::kFaint)) << ray;
  }
}

TEST(TrajectoryPanel, ListsNoMoreObjectsThanFit) {
  const Recogniser recogniser = support::recogniser_of_two();
  ObjectObservations observations(recogniser, {}, RigidTransition{});
  for (int id = 0; id < 25; ++id) observations.found(id, {1.0, 1.2, 0.8});
  const TrajectoryPanelInput input{
      .observations = observations, .nominal = kNominal, .plan = kPlan, .at = 1};
  const cv::Mat panel = draw_trajectory_panel(input, {}, {640, 720});
  EXPECT_TRUE(is_written(panel, {424, 672, 100, 12})) << "the twentieth";
  EXPECT_FALSE(is_written(panel, {416, 702, 210, 18}));
}

/// Twice as wide, all is twice as large.
TEST(TrajectoryPanel, GrowsWithItsSize) {
  const Recogniser recogniser = support::recogniser_of_two();
  ObjectObservations observations(recogniser, {}, RigidTransition{});
  observations.found(7, {1.0, 1.2, 0.8});
  TrajectoryPanelInput input{
      .observations = observations, .nominal = kNominal, .plan = kPlan, .at = 1};
  input.T_world_body = make_pose({1.0, 0.1, 1.8}, std::numbers::pi / 2.0);
  const cv::Mat drawn = draw_trajectory_panel(input, {}, {1280, 1440});
  for (const cv::Point robot : Points{{416, 1111}, {410, 1111}, {422, 1111}}) {
    EXPECT_TRUE(is_coloured(drawn, robot, panel::kRobot)) << robot;
  }
  cv::Mat expected(drawn.size(), CV_8UC3, panel::kCard);
  const panel::Layout layout{2.0, expected.size()};
  panel::text(expected, layout, "7  not seen closely yet", {848.0, 148.0}, 10, panel::kDim);
  const cv::Rect line(840, 124, 400, 28);
  EXPECT_EQ(cv::norm(drawn(line), expected(line), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace vantage
