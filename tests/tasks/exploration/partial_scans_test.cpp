// Scans that take some images of a sweep alone: what the robot takes, and what is expected of them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/exploration/exploration_drive.hpp"
#include "tests/tasks/replayed.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/exploration/simulated_exploration_robot.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

ResolvedEpisode small_office(const std::vector<std::string>& more) {
  set_verbosity(Verbosity::quiet);
  std::vector<std::string> overrides = {"map.cells=[100,67,20]", "camera.width_px=160",
                                        "camera.height_px=120", "stride_px=1",
                                        "metrics.pose_spacing_m=2"};
  overrides = support::overridden(std::move(overrides), more);
  const auto episode =
      std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml";
  return load_episode(episode, overrides);
}

TEST(ImagesOfASweep, AreItsRowsOneAfterTheOther) {
  RgbdOptions camera;
  camera.width_px = 400;
  camera.height_px = 200;
  camera.fovy_rad = 1.0;
  const SweepImages images = images_of({.pans = 3, .tilts_rad = {0.1, 0.5}}, camera);
  ASSERT_EQ(images.gazes().size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const double pan = static_cast<double>(i % 3) - 1.0;
    EXPECT_NEAR(images.gazes()[i].pan_rad, pan * 2.0 * std::numbers::pi / 3.0, 1e-12);
    EXPECT_EQ(images.gazes()[i].tilt_rad, i < 3 ? 0.1 : 0.5);
  }
  const auto is_shown = [&](double left, double up) {
    const Eigen::Vector3d ahead = direction_of({0.0, 0.1});
    return images.shows(1, ahead + Eigen::Vector3d(up * std::sin(0.1), left, up * std::cos(0.1)));
  };
  const double edge = std::tan(0.5);
  EXPECT_TRUE(is_shown(2.0 * edge - 1e-9, edge - 1e-9));
  EXPECT_FALSE(is_shown(2.0 * edge + 1e-9, 0.0));
  EXPECT_FALSE(is_shown(0.0, edge + 1e-9));
}

/// The second row backwards, from where the first one ends.
TEST(ExplorationRobot, TakesTheImagesThatItIsAskedFor) {
  const ResolvedEpisode episode = small_office({});
  SimulatedExplorationRobot robot(episode.setup, std::get<Exploration>(episode.task));
  const SweepImages& sweep = robot.sweep_images();
  ASSERT_EQ(sweep.gazes().size(), 18U);
  const double start_s = robot.time_s();
  const auto some = robot.observe(std::vector<std::size_t>{2, 3, 12, 14});
  const double some_s = robot.time_s() - start_s;
  ASSERT_EQ(some.views.size(), 4U);
  const std::vector<std::size_t> in_turn{2, 3, 14, 12};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d ahead = some.views[i].T_base_camera.linear().col(2);
    EXPECT_GT(ahead.dot(direction_of(sweep.gazes()[in_turn[i]])), std::cos(0.02)) << i;
  }
  const auto all = robot.observe({});
  EXPECT_EQ(all.views.size(), 18U);
  EXPECT_LT(some_s, 0.4 * (robot.time_s() - start_s - some_s));
}

TEST(ExplorationRobot, LooksWhileTheBaseDoesWhatItDoes) {
  const ResolvedEpisode episode = small_office({});
  SimulatedExplorationRobot robot(episode.setup, std::get<Exploration>(episode.task));
  const Gaze down_left{0.6, 0.7};
  const double start_s = robot.time_s();
  EXPECT_TRUE(robot.head_rests());
  robot.look(down_left);
  EXPECT_EQ(robot.time_s(), start_s) << "returns at once";
  const Pose2 base = robot.estimated_base();
  bool turned = false;
  robot.drive_along(std::vector<Pose2>{base, compose(base, {0.8, 0.0, 0.0})}, 0.3, [&] {
    turned = turned || !robot.head_rests();
    return true;
  });
  EXPECT_TRUE(turned);
  EXPECT_TRUE(robot.head_rests());
  const auto view = robot.take_image();
  ASSERT_TRUE(view);
  EXPECT_GT(view->T_base_camera.linear().col(2).dot(direction_of(down_left)), std::cos(0.02));
  EXPECT_EQ(view->image.depth_m.size(), 160U * 120U);
  EXPECT_GT(robot.time_s(), start_s);
}

/// 3 scans, each image at least so far from the one before it.
nlohmann::json driven(double on_the_way_m, const std::filesystem::path& folder) {
  return nlohmann::json::parse(
      run(small_office({"scans=3", "gaze.on_the_way_m=" + std::to_string(on_the_way_m)}),
          {folder, true, false, {}})
          .metrics);
}

TEST(ImagesOnTheWay, ShowMoreOfTheSameViews) {
  const support::TemporaryDirectory folder;
  const auto without = driven(0.0, folder.path() / "without");
  const auto with = driven(0.5, folder.path() / "with");
  EXPECT_EQ(with["scans"][0]["images_on_the_way"], 0) << "it has not driven yet";
  int images = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    const auto& scan = with["scans"][i];
    EXPECT_EQ(without["scans"][i]["images_on_the_way"], 0);
    const int of_scan = scan["images_on_the_way"];
    EXPECT_LE(of_scan, scan["leg_length_m"].get<double>() / 0.5);
    images += of_scan;
  }
  EXPECT_GE(images, 2);
  EXPECT_EQ(with["scans"][0]["unobserved_cells"], without["scans"][0]["unobserved_cells"]);
  EXPECT_EQ(with["scans"][1]["chosen_view"], without["scans"][1]["chosen_view"]);
  EXPECT_LT(with["scans"][1]["unobserved_cells"], without["scans"][1]["unobserved_cells"]);
  EXPECT_GT(with["scans"][2]["precision"], 0.98);
  const ReplayResult again = support::replayed(folder.path() / "with");
  EXPECT_FALSE(again.first_difference) << again.what;
}

/// Notes how much the map knows before the robot comes home.
struct Homecoming : ExplorationParts {
  Homecoming(const MappingContext& context, const Exploration& task,
             ExplorationRobotInterface& robot, ExplorationBelief& belief)
      : ExplorationParts(context, task, robot, belief), map(belief.grid()) {}
  void end() {
    unobserved_at_end = map.count(CellState::unobserved);
    ExplorationParts::end();
  }
  const OccupancyGrid& map;
  std::size_t unobserved_at_end = 0;
};

TEST(ImagesOnTheWay, AreNotTakenOnTheWayHome) {
  const support::TemporaryDirectory folder;
  const ResolvedEpisode episode =
      small_office({"scans=2", "gaze.on_the_way_m=0.3", "budget.return_to_start=true"});
  const RunRequest request = support::exploration_request(episode, folder.path() / "run");
  ExplorationSession<Homecoming> session(request, std::get<Exploration>(episode.task));
  const auto metrics = nlohmann::json::parse(session.run_to_end().metrics);
  EXPECT_TRUE(metrics["budget"]["returned"].get<bool>());
  EXPECT_GT(session.parts.unobserved_at_end, 0U);
  EXPECT_EQ(session.belief.grid().count(CellState::unobserved), session.parts.unobserved_at_end);
}

/// Two images of five arrive: what was a scan of one image is mostly taken again. After the second
/// scan nothing is left but the place of the first, where images were lost.
TEST(PartialScans, ThatShowNothingAreTakenAgainWithAllImages) {
  const support::TemporaryDirectory folder;
  const auto metrics = nlohmann::json::parse(
      run(small_office({"scans=5", "seed=7", "gaze.share=0.1", "faults.dropped_frames=0.6"}),
          {folder.path() / "run", true, false, {}})
          .metrics);
  ASSERT_EQ(metrics["scans"].size(), 5U);
  int whole = 0;
  for (std::size_t i = 1; i < 5; ++i) {
    const auto& scan = metrics["scans"][i];
    if (scan["scan_share"] != 1.0) {
      EXPECT_LT(scan["scan_share"], 0.5);
      continue;
    }
    ++whole;
    double outside = 0.0;
    for (const auto& band : scan["by_distance"]) outside += band["outside_cells"].get<double>();
    EXPECT_LT(outside, 0.1 * scan["actual_new_cells"].get<double>()) << "predicted for all images";
  }
  EXPECT_GE(whole, 2);
}

TEST(PartialScans, OfAnEpisodeShowWhatIsExpectedOfThem) {
  const support::TemporaryDirectory folder;
  const auto metrics =
      nlohmann::json::parse(run(small_office({"scans=4", "gaze.worth=0.5", "choice=tour"}),
                                {folder.path() / "run", true, false, {}})
                                .metrics);
  ASSERT_EQ(metrics["scans"].size(), 4U);
  EXPECT_EQ(metrics["scans"][0]["scan_share"], 1.0) << "nothing is known yet";
  const double whole_s = metrics["scans"][0]["scan_time_s"];
  double left_out = 0.0;
  double predicted_sum = 0.0;
  double actual_sum = 0.0;
  for (std::size_t i = 1; i < 4; ++i) {
    const auto& scan = metrics["scans"][i];
    const double share = scan["scan_share"];
    const double images = 18.0 * share;
    EXPECT_NEAR(images, std::round(images), 1e-9);
    EXPECT_GE(images, 1.0);
    left_out += 1.0 - share;
    EXPECT_NEAR(scan["scan_time_s"].get<double>(), whole_s * share, 0.15 * whole_s);
    const double actual = scan["actual_new_cells"];
    double outside = 0.0;
    double predicted = 0.0;
    for (const auto& band : scan["by_distance"]) {
      outside += band["outside_cells"].get<double>();
      predicted += band["predicted_cells"].get<double>();
    }
    EXPECT_LT(outside, 0.1 * actual) << "what is predicted for is what is looked at";
    EXPECT_NEAR(scan["predicted"]["adaptive"].get<double>(), predicted, 1e-6 * predicted + 1e-6);
    predicted_sum += predicted;
    actual_sum += actual;
  }
  EXPECT_GT(left_out, 0.3);
  EXPECT_NEAR(predicted_sum, actual_sum, 0.2 * actual_sum);
  const ReplayResult again = support::replayed(folder.path() / "run");
  EXPECT_FALSE(again.first_difference) << again.what;
}

TEST(ExplorationRobot, KnowsWhereToStandForASweep) {
  const ResolvedEpisode episode = small_office({});
  const SimulatedExplorationRobot robot(episode.setup, std::get<Exploration>(episode.task));
  ASSERT_GT(robot.T_base_sweep().translation().head<2>().norm(), 0.05);
  const Pose2 base{1.5, -0.5, 2.0};
  const Pose2 found = robot.base_for_sensor(to_se3(base) * robot.T_base_sweep());
  EXPECT_NEAR(found.x_m, base.x_m, 1e-9);
  EXPECT_NEAR(found.y_m, base.y_m, 1e-9);
  EXPECT_NEAR(found.yaw_rad, base.yaw_rad, 1e-9);
}

/// Its camera measures disparities in whole steps.
TEST(ExplorationRobot, MeasuresEveryImageThatItDraws) {
  const ResolvedEpisode episode = small_office({"threads=1"});
  const auto& task = std::get<Exploration>(episode.task);
  SimulatedExplorationRobot robot(episode.setup, task);
  const auto seen = robot.observe(std::vector<std::size_t>{12, 13});
  ASSERT_EQ(seen.views.size(), 2U);
  for (const HeadView& view : seen.views) {
    int readings = 0;
    int between_steps = 0;
    for (const float depth_m : view.image.depth_m) {
      if (depth_m == 0.0F || std::isinf(depth_m)) continue;
      const double steps = 1.0 / (task.camera.quantisation_per_m * static_cast<double>(depth_m));
      ++readings;
      between_steps += std::abs(steps - std::round(steps)) > 1e-3 ? 1 : 0;
    }
    EXPECT_GT(readings, 1000) << "it looks down on the floor";
    EXPECT_EQ(between_steps, 0);
  }
}

/// No sooner, though its head is at rest: it might not have begun to turn.
TEST(ExplorationRobot, TakesAnImageAfterFiveTicksWhereItLooksAlready) {
  const ResolvedEpisode episode = small_office({});
  SimulatedExplorationRobot robot(episode.setup, std::get<Exploration>(episode.task));
  const std::vector<std::size_t> image{13};
  robot.observe(image);
  const double start_s = robot.time_s();
  robot.observe(image);
  EXPECT_NEAR(robot.time_s() - start_s, 5.0 * episode.setup.options.simulation.control_period_s,
              1e-9);
}

/// It believes to be where it is put, and takes the images that it is given.
struct PutRobot : SimulatedExplorationRobot {
  using SimulatedExplorationRobot::SimulatedExplorationRobot;
  [[nodiscard]] Pose2 estimated_base() const override { return T_world_base; }
  [[nodiscard]] bool head_rests() const override { return true; }
  std::optional<HeadView> take_image() override {
    ++asked;
    return view;
  }

  Pose2 T_world_base;
  std::optional<HeadView> view;  ///< none: it is lost
  int asked = 0;                 ///< for an image
};

/// On its way from the first scan.
struct LookingParts : ExplorationParts {
  LookingParts(const MappingContext& context, const Exploration& task,
               ExplorationRobotInterface& robot, ExplorationBelief& belief)
      : ExplorationParts(context, task, robot, belief) {
    scans_.emplace_back();
  }
  void tell() { navigator_.on_the_way(); }
  [[nodiscard]] int images() const { return current_.images_on_the_way; }
};

struct LookingDrive : support::ExplorationDrive<PutRobot> {
  LookingDrive()
      : ExplorationDrive([](const std::filesystem::path&) {
          return small_office({"gaze.on_the_way_m=0.5", "localisation.loops.close=false"});
        }) {}
  LookingParts parts{context(), task, robot, belief};

  void come_to(const Pose2& T_world_base) {
    robot.T_world_base = T_world_base;
    parts.tell();
  }
};

HeadView view_ahead(float depth_m) {
  CameraImages image{.width_px = 3,
                     .height_px = 3,
                     .focal_px = 100.0,
                     .range_max_m = 3.5,
                     .rgb = {},
                     .depth_m = std::vector<float>(9, depth_m)};
  Pose T_base_camera = make_pose({0.0, 0.0, 1.2}, 0.0);
  T_base_camera.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return {std::move(image), T_base_camera};
}

/// From place to place the base turns by 0.015 rad, then by 0.025, then not at all.
TEST(ImagesOnTheWay, AreTakenWhereTheBaseHardlyTurnsAndCountIfTheyAreNew) {
  LookingDrive drive;
  drive.come_to({0.0, 0.0, 0.0});
  EXPECT_EQ(drive.robot.asked, 0) << "here it begins";
  drive.come_to({0.6, 0.0, 0.015});
  EXPECT_EQ(drive.robot.asked, 1);
  EXPECT_EQ(drive.parts.images(), 0) << "it was lost";
  drive.robot.view = view_ahead(2.0F);
  drive.come_to({1.2, 0.0, 0.04});
  EXPECT_EQ(drive.robot.asked, 1) << "it turns";
  drive.come_to({1.2, 0.0, 0.04});
  EXPECT_EQ(drive.robot.asked, 2);
  EXPECT_EQ(drive.parts.images(), 1);
  drive.come_to({1.8, 0.0, 0.04});
  EXPECT_EQ(drive.robot.asked, 3);
  EXPECT_EQ(drive.parts.images(), 1) << "it is the one before";
}

/// Its first images show nothing; it is where it stands, wherever it is to drive.
struct BlindAtFirst : PutRobot {
  using PutRobot::PutRobot;
  DriveResult drive_along(std::span<const Pose2> /*path*/, double /*max_speed_m_s*/,
                          const std::function<bool()>& /*go_on*/) override {
    return {};
  }
  ExplorationObservation observe(std::span<const std::size_t> images) override {
    asked_for.push_back(images.size());
    ExplorationObservation observation;
    observation.views.push_back(view_ahead(asked_for.size() > 1 ? 2.0F : 0.0F));
    return observation;
  }

  std::vector<std::size_t> asked_for;  ///< so many images each time; 0: all
};

/// With what a robot keeps to itself, and a whole scan behind it.
struct OpenLookingParts : LookingParts {
  OpenLookingParts(const MappingContext& context, const Exploration& task,
                   ExplorationRobotInterface& robot, ExplorationBelief& belief)
      : LookingParts(context, task, robot, belief) {
    ScanRecord whole;
    whole.time_s = 40.0;
    whole.scan_time_s = 36.0;
    budget_.observe(whole, nullptr);
  }
  using LookingParts::correct_pose;
  void hold_for_seen(double confidence) {
    views_.emplace_back();
    LeftRecord left;
    left.confidence = confidence;
    scans_.back().left = left;
  }
};

TEST(PartialScans, OfWhichNoImageShowsAnythingAreTakenAgainAsWhole) {
  LookingDrive drive;
  Exploration task = drive.task;
  task.gaze.worth = 1.0;
  BlindAtFirst robot(drive.episode.setup, task);
  ExplorationBelief belief(drive.options, task);
  OpenLookingParts parts(
      MappingContext{drive.options, robot, drive.evaluator, drive.recorder, nullptr}, task, robot,
      belief);
  Candidate here;
  here.T_world_sensor = robot.estimated_sensor();
  parts.act(here);
  const ExplorationObservation seen = parts.observe();
  EXPECT_EQ(seen.views.size(), 1U);
  ASSERT_EQ(robot.asked_for.size(), 2U) << "the first shows nothing, the second does";
  EXPECT_GT(robot.asked_for[0], 0U);
  EXPECT_EQ(robot.asked_for[1], 0U);
}

TEST(ExplorationParts, SayHowSureItIsThatEnoughHasBeenSeen) {
  LookingDrive drive;
  Exploration task = drive.task;
  task.stop.share = 0.95;
  task.stop.confidence = 0.8;
  OpenLookingParts parts(
      MappingContext{drive.options, drive.robot, drive.evaluator, drive.recorder, nullptr}, task,
      drive.robot, drive.belief);
  parts.hold_for_seen(0.875);
  const std::string why = parts.finished();
  EXPECT_NE(why.find("95 % of what can be seen"), std::string::npos) << why;
  EXPECT_NE(why.find("87.5 % sure"), std::string::npos) << why;
}

TEST(ExplorationParts, BeginDeadReckoningAnewWhereAScanHasPutTheBase) {
  LookingDrive drive;
  OpenLookingParts parts(
      MappingContext{drive.options, drive.robot, drive.evaluator, drive.recorder, nullptr},
      drive.task, drive.robot, drive.belief);
  BeliefUpdate update;
  update.T_world_base = {0.1, -0.2, 0.3};
  parts.correct_pose(update);
  const Pose2 reckoned = drive.robot.dead_reckoned_base();
  EXPECT_NEAR(reckoned.x_m, 0.1, 1e-9);
  EXPECT_NEAR(reckoned.y_m, -0.2, 1e-9);
  EXPECT_NEAR(reckoned.yaw_rad, 0.3, 1e-9);
}

struct PushedRobot : SimulatedExplorationRobot {
  using SimulatedExplorationRobot::SimulatedExplorationRobot;
  void push() { base_.robot().command_twist(base_.world(), {0.5, 0.0, 0.0}); }
};

TEST(ExplorationRobot, StandsWhileItObservesAndTellsHowHighItsScannerIs) {
  const ResolvedEpisode episode = small_office({});
  PushedRobot robot(episode.setup, std::get<Exploration>(episode.task));
  const Pose2 before = robot.ground_truth().T_world_base();
  robot.push();
  const auto seen = robot.observe(std::vector<std::size_t>{13});
  const Pose2 after = robot.ground_truth().T_world_base();
  EXPECT_LT(std::hypot(after.x_m - before.x_m, after.y_m - before.y_m), 0.01);
  EXPECT_EQ(seen.base_scan_height_m, robot.base_scan_height_m());
  EXPECT_GT(seen.base_scan_height_m, 0.05);
}

}  // namespace
}  // namespace vantage
