// How views and a plan through them are drawn into the panel of a map.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "tests/tasks/drawn_pixels.hpp"
#include "tests/tasks/mapping/run_request.hpp"
#include "tests/tasks/mapping/still_table.hpp"
#include "vantage/core/names.hpp"
#include "vantage/runtime/drawing/map_view.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/tasks/mapping/drawing/map_panel.hpp"

namespace vantage {
namespace {

/// Of a map of 2 x 3 x 1 m.
class MapPanelViews : public testing::Test {
 protected:
  MapPanelViews() { input_.grid = &grid_; }

  [[nodiscard]] cv::Mat drawn() const { return draw_map_panel(input_, {640, 720}); }

  /// At twice the panel's resolution, as draw_map_panel() draws it.
  [[nodiscard]] Eigen::Vector2d px(const Eigen::Vector3d& p_m) const {
    std::vector<Eigen::Vector3d> corners;
    for (int i = 0; i < 8; ++i) {
      corners.emplace_back((i & 1) * 2 - 1, 1.5 * ((i >> 1 & 1) * 2 - 1), i >> 2);
    }
    const MapCamera camera = fit_camera(corners, -0.9, 0.72, {40, 132, 1200, 872});
    return Eigen::Vector2d(0.5 * camera.project(p_m).head<2>());
  }
  /// One of the corners that a view's pyramid opens to.
  static Eigen::Vector3d rim(const Pose& T_world_sensor, double length_m, int corner) {
    const double y = (corner & 1) != 0 ? 0.3 : -0.3;
    const double z = (corner & 2) != 0 ? 0.2 : -0.2;
    return T_world_sensor * Eigen::Vector3d(length_m, length_m * y, length_m * z);
  }
  /// What a view of that length covers, with a round label of `label_px` at its tip.
  [[nodiscard]] Eigen::AlignedBox2d covered(const Pose& T_world_sensor, double length_m,
                                            double label_px) const {
    const Eigen::Vector2d tip = px(T_world_sensor.translation());
    const Eigen::Vector2d label = Eigen::Vector2d::Constant(label_px);
    Eigen::AlignedBox2d box(Eigen::Vector2d(tip - label), Eigen::Vector2d(tip + label));
    for (int i = 0; i < 4; ++i) box.extend(px(rim(T_world_sensor, length_m, i)));
    return box;
  }
  /// The rectangle that holds all differences of two images in a part of them.
  static void expect_changed(const cv::Mat& a, const cv::Mat& b, const cv::Rect& part,
                             const Eigen::AlignedBox2d& expected) {
    const cv::Rect found = support::box_of_changes(a, b, part, 8.0);
    constexpr double kStroke_px = 3.0;
    EXPECT_NEAR(found.x, expected.min().x(), kStroke_px) << found;
    EXPECT_NEAR(found.y, expected.min().y(), kStroke_px) << found;
    EXPECT_NEAR(found.br().x, expected.max().x(), kStroke_px) << found;
    EXPECT_NEAR(found.br().y, expected.max().y(), kStroke_px) << found;
  }
  static int coloured_near(const cv::Mat& image, const Eigen::Vector2d& at_px,
                           const cv::Scalar& bgr) {
    const cv::Rect around(static_cast<int>(at_px.x()) - 1, static_cast<int>(at_px.y()) - 1, 3, 3);
    return support::count_coloured(image, around, bgr);
  }

  const OccupancyGrid grid_{make_grid_frame({0.0, 0.0, 0.5}, {2.0, 3.0, 1.0}, {8, 12, 4})};
  MapPanelInput input_;
};

const cv::Rect kWholePanel(0, 0, 640, 720);
constexpr double kViewLength_m = 0.13 * 2.0;  ///< of the shorter edge of the map
constexpr double kLabel_px = 10.5;

TEST_F(MapPanelViews, AreToTheScaleOfTheMap) {
  const cv::Mat without = drawn();
  const Pose view = make_pose({-0.3, 0.4, 0.5}, 0.4);
  input_.T_world_candidates = {view};
  expect_changed(without, drawn(), kWholePanel, covered(view, kViewLength_m, 0.0));
}

TEST_F(MapPanelViews, ThatAreTakenAreColouredAndTheNewestIsLarger) {
  const cv::Mat without = drawn();
  const Pose left = make_pose({-0.5, -0.6, 0.5}, 0.4);
  const Pose right = make_pose({0.5, 0.7, 0.5}, 0.4);
  const double newest_m = 1.6 * kViewLength_m;
  const auto edge_px = [&](const Pose& view, double length_m, int corner) {
    const Eigen::Vector3d tip = view.translation();
    return px(tip + 0.7 * (rim(view, length_m, corner) - tip));
  };
  input_.T_world_chosen = {left};
  const cv::Mat first = drawn();
  expect_changed(without, first, kWholePanel, covered(left, newest_m, kLabel_px));
  input_.T_world_chosen = {left, right};
  const cv::Mat both = drawn();
  const cv::Rect left_half(0, 0, 320, 720);
  const cv::Rect right_half(320, 0, 320, 720);
  expect_changed(without, both, left_half, covered(left, kViewLength_m, kLabel_px));
  expect_changed(without, both, right_half, covered(right, newest_m, kLabel_px));
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(coloured_near(first, edge_px(left, newest_m, i), panel::kAccent), 0) << i;
    EXPECT_GT(coloured_near(both, edge_px(left, kViewLength_m, i), panel::kVisited), 0) << i;
    EXPECT_GT(coloured_near(both, edge_px(right, newest_m, i), panel::kAccent), 0) << i;
  }
}

/// The sensors look up, out of the labels' row.
TEST_F(MapPanelViews, ShareALabelWhereTheyAreNearerThanTwelvePixels) {
  const Eigen::Vector3d once(-0.3, 0.2, 0.5);
  const Eigen::Vector3d along(std::sin(0.9), std::cos(0.9), 0.0);  // to the right of the image
  const double px_per_m = (px(once + 0.01 * along) - px(once)).norm() / 0.01;
  const auto with_another_at = [&](double off_px) {
    input_.T_world_chosen.clear();
    for (const double at_px : {0.0, off_px}) {
      const Eigen::Vector3d at_m = once + at_px / px_per_m * along;
      input_.T_world_chosen.push_back(make_pose(at_m, 0.0, -0.5 * std::numbers::pi));
    }
    return drawn();
  };
  const auto beside = [&](double off_px) {
    return Eigen::Vector2d(px(once).x() + off_px, px(once).y());
  };
  EXPECT_GT(coloured_near(with_another_at(11.0), beside(-13.5), panel::kAccent), 5) << "1,2";
  const cv::Mat apart = with_another_at(15.0);
  EXPECT_GT(coloured_near(apart, beside(-7.0), panel::kVisited), 5) << "1";
  EXPECT_EQ(coloured_near(apart, beside(-13.5), panel::kAccent), 0);
  EXPECT_GT(coloured_near(apart, beside(15.0 + 7.0), panel::kAccent), 5) << "2";
}

/// Where the newest of them is, no disc marks the goal: it has its number already.
TEST_F(MapPanelViews, HaveThePlanAtTheirHeight) {
  for (const double z_m : {0.2, 0.6}) {
    input_.T_world_chosen.push_back(make_pose({0.7, 0.9, z_m}, 0.0));
  }
  input_.T_world_base = {0.7, -0.6, 0.0};
  input_.tour.stops.push_back({.place_m = {-0.7, -0.6}});
  const cv::Mat image = drawn();
  EXPECT_GT(coloured_near(image, px({0.0, -0.6, 0.6}), panel::kPlan), 0);
  EXPECT_EQ(coloured_near(image, px({0.0, -0.6, 0.2}), panel::kPlan), 0);
  EXPECT_EQ(coloured_near(image, px({0.0, -0.6, 0.0}), panel::kPlan), 0);
  EXPECT_EQ(coloured_near(image, px({-0.75, -0.6, 0.6}), panel::kPlan), 0) << "it ends there";
}

/// With what their panel is made of.
struct PanelParts : TabletopParts {
  using TabletopParts::current_;
  using TabletopParts::scans_;
  using TabletopParts::TabletopParts;
  using TabletopParts::tour_;
};

/// A robot at a table whose run is filmed, with an obstacle on its map.
struct FilmedTable {
  FilmedTable() { belief.grid_.log_odds[belief.grid_.size() / 2] = 3.0F; }

  support::StillTable& table = support::still_table();
  support::TemporaryDirectory folder;
  RunRequest request =
      support::mapping_request(table.episode, {folder.path() / "run", true, true, {}, true});
  EpisodeRun run{request};
  MappingRecorder recorder{run, recorded(table.robot), {}, 5};
  support::StillBelief belief{table.options, table.task};
  PanelParts parts{MappingContext{table.options, table.robot, table.evaluator, recorder, nullptr},
                   table.task, table.robot, belief};

  /// The panel of the still of that scan: its right half.
  [[nodiscard]] cv::Mat panel(int scan) const {
    const std::string name = fmt::format("run/frames/scan_{:02}.png", scan);
    const cv::Mat still = cv::imread((folder.path() / name).string());
    EXPECT_EQ(still.size(), cv::Size(1280, 720));
    return still(cv::Rect(640, 0, 640, 720));
  }
};

/// On its way to a view; a still of the video has the panel in its right half. Of the stops of the
/// plan, nobody can propose the second one yet.
TEST(MappingParts, ShowTheirScansTheirGoalAndTheirPlan) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  FilmedTable filmed;
  const support::StillTable& table = filmed.table;
  PanelParts& parts = filmed.parts;
  const std::vector<Candidate>& views = parts.views();
  const std::string gain = strategy_label(table.task.gain);
  parts.scans_.resize(2);
  parts.scans_[0].T_world_sensor = views[0].T_world_sensor;
  parts.scans_[0].observable_unobserved_cells = 900;
  parts.scans_[1].T_world_sensor = views[9].T_world_sensor;
  parts.scans_[1].observable_unobserved_cells = 400;
  parts.scans_[1].actual_new_cells = 500.0;
  parts.scans_[1].predicted_cells = {{"another", 1.0}, {gain, 321.0}};
  parts.current_.chosen_view = 15;
  parts.tour_.stops = {{.id = 15}, {.id = -1, .place_m = {0.3, -0.2}}, {.id = 24}};
  filmed.recorder.scan({}, 3, filmed.belief.grid());

  const auto place_of = [&](std::size_t view) {
    return Eigen::Vector2d(views[view].T_world_sensor.translation().head<2>());
  };
  MapPanelInput expected;
  expected.grid = &filmed.belief.grid();
  for (const Candidate& view : views) expected.T_world_candidates.push_back(view.T_world_sensor);
  for (const std::size_t view : {0U, 9U, 15U}) {
    expected.T_world_chosen.push_back(views[view].T_world_sensor);
  }
  expected.T_world_base = table.robot.T_world_base;
  expected.tour.stops = {{.id = 15, .place_m = place_of(15)},
                         {.id = -1, .place_m = {0.3, -0.2}},
                         {.id = 24, .place_m = place_of(24)}};
  expected.observable_unobserved_cells = {900.0, 400.0};
  expected.scans_planned = table.task.scans;
  expected.method = table.task.method_name();
  expected.predicted_new_cells = 321.0;
  expected.actual_new_cells = 500.0;
  const cv::Mat shown = filmed.panel(3);
  EXPECT_EQ(cv::norm(shown, draw_map_panel(expected, {640, 720}), cv::NORM_INF), 0.0);
}

TEST(MappingParts, ShowTheWayToTheirFirstViewBeforeAnyScan) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  FilmedTable filmed;
  const support::StillTable& table = filmed.table;
  PanelParts& parts = filmed.parts;
  parts.current_.chosen_view = 0;
  parts.tour_.stops = {{.id = 0}, {.id = 24}};
  filmed.recorder.scan({}, 1, filmed.belief.grid());

  MapPanelInput expected;
  expected.grid = &filmed.belief.grid();
  for (const Candidate& view : parts.views()) {
    expected.T_world_candidates.push_back(view.T_world_sensor);
  }
  const Pose& first = expected.T_world_candidates[0];
  const Pose& second = expected.T_world_candidates[24];
  expected.T_world_chosen = {first};
  expected.T_world_base = table.robot.T_world_base;
  expected.tour.stops = {{.id = 0, .place_m = first.translation().head<2>()},
                         {.id = 24, .place_m = second.translation().head<2>()}};
  expected.scans_planned = table.task.scans;
  expected.method = table.task.method_name();
  const cv::Mat shown = filmed.panel(1);
  EXPECT_EQ(cv::norm(shown, draw_map_panel(expected, {640, 720}), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace vantage
