// Where an exploration may begin, where its camera is, and what can be seen at all.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/geometry/floor_outline.hpp"
#include "vantage/tasks/exploration/exploration_map_evaluator.hpp"
#include "vantage/tasks/exploration/simulated_exploration_robot.hpp"
#include "vantage/tasks/exploration/start_check.hpp"
#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

std::string slab_of(double x0, double y0, double x1, double y1, double bottom_m, double top_m) {
  return fmt::format("<geom type=\"box\" pos=\"{} {} {}\" size=\"{} {} {}\"/>", 0.5 * (x0 + x1),
                     0.5 * (y0 + y1), 0.5 * (bottom_m + top_m), 0.5 * (x1 - x0), 0.5 * (y1 - y0),
                     0.5 * (top_m - bottom_m));
}

/// Four walls of 10 cm round a square floor.
std::string closed_room(double x_m, double y_m, double half_m) {
  const double x0 = x_m - half_m;
  const double x1 = x_m + half_m;
  const double y0 = y_m - half_m;
  const double y1 = y_m + half_m;
  return slab_of(x0 - 0.1, y0 - 0.1, x0, y1 + 0.1, 0.0, 1.9) +
         slab_of(x1, y0 - 0.1, x1 + 0.1, y1 + 0.1, 0.0, 1.9) +
         slab_of(x0, y0 - 0.1, x1, y0, 0.0, 1.9) + slab_of(x0, y1, x1, y1 + 0.1, 0.0, 1.9);
}

struct AskedRobot : SimulatedExplorationRobot {
  using SimulatedExplorationRobot::SimulatedExplorationRobot;
  /// Why it may not begin if that is round it; empty: it may.
  std::string complaint(const RayScene& geometry, const EpisodeSetup& setup,
                        const Exploration& task) {
    try {
      check_exploration_start(base_.world(), base_.robot(), geometry, setup, task);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

/// A robot that starts on a plane among these bodies.
struct AskedScene {
  explicit AskedScene(const std::string& bodies = "", const std::string& start = "[0,0,0]",
                      const std::string& size = "8")
      : episode(loaded(folder, bodies, start, size)) {}
  static ResolvedEpisode loaded(const support::TemporaryDirectory& folder,
                                const std::string& bodies, const std::string& start,
                                const std::string& size) {
    const std::filesystem::path scene = folder / "asked.xml";
    write_file(scene, "<mujoco><worldbody><geom type=\"plane\" size=\"9 9 0.1\"/>" + bodies +
                          "</worldbody></mujoco>");
    const std::string cells = size + "0";
    return load_episode(
        std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml",
        {"scene=" + scene.string(), "robot.start_pose=" + start,
         "map.size_m=[" + size + "," + size + ",2]", "map.cells=[" + cells + "," + cells + ",20]",
         fmt::format("floor_map.half_size_m={}", 0.5 * std::stod(size)), "passages.use=false",
         "metrics.pose_spacing_m=2", "camera.width_px=160", "camera.height_px=120"});
  }

  support::TemporaryDirectory folder;
  const ResolvedEpisode episode;
  Exploration task = std::get<Exploration>(episode.task);
};

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// It needs floor within 5 cm of z = 0, and 2 x 0.52 m of it free in one of 24 directions.
TEST(ExplorationStart, NeedsFloorAndRoomOnIt) {
  const AskedScene scene;
  AskedRobot robot(scene.episode.setup, scene.task);
  const auto complaint = [&](const std::string& bodies) {
    const std::filesystem::path file = scene.folder / "round.xml";
    write_file(file, "<mujoco><worldbody>" + bodies + "</worldbody></mujoco>");
    const World world(ModelSource{file, {}});
    return robot.complaint(RayScene(world.model(), world.snapshot()), scene.episode.setup,
                           scene.task);
  };
  const auto floor = [](double top_m) { return slab_of(-3.0, -3.0, 3.0, 3.0, top_m - 0.1, top_m); };
  EXPECT_EQ(complaint(floor(0.04)), "");
  EXPECT_EQ(complaint(floor(-0.04)), "");
  EXPECT_TRUE(says(complaint(floor(0.06)), "no floor at z = 0"));
  EXPECT_TRUE(says(complaint(floor(-0.06)), "no floor at z = 0"));

  EXPECT_EQ(complaint(slab_of(-0.3, -0.3, 0.3, 1.2, -0.1, 0.0)), "");
  EXPECT_TRUE(says(complaint(slab_of(-0.3, -0.3, 0.3, 0.95, -0.1, 0.0)), "no free floor"));
  EXPECT_EQ(complaint(floor(0.0) + closed_room(0.0, 0.0, 0.76)), "") << "1.07 m to the corners";
  EXPECT_TRUE(says(complaint(floor(0.0) + closed_room(0.0, 0.0, 0.70)), "no free floor"));

  const auto strip = [](double degrees) {
    const double angle_rad = degrees * std::acos(-1.0) / 180.0;
    return fmt::format(
        "<geom type=\"box\" pos=\"{} {} -0.05\" size=\"0.65 0.03 0.05\" euler=\"0 0 {}\"/>",
        0.55 * std::cos(angle_rad), 0.55 * std::sin(angle_rad), degrees);
  };
  EXPECT_EQ(complaint(strip(0.0)), "");
  EXPECT_EQ(complaint(strip(15.0)), "");
  EXPECT_EQ(complaint(strip(345.0)), "");
  EXPECT_TRUE(says(complaint(strip(7.5)), "no free floor")) << "between two directions";
}

/// Looked for 20 cm above the floor.
TEST(ExplorationStart, HasRoomBelowWhatHangsHigherThanAnAnkle) {
  const AskedScene scene;
  AskedRobot robot(scene.episode.setup, scene.task);
  const auto complaint = [&](double bottom_m) {
    const std::filesystem::path file = scene.folder / "shelves.xml";
    const std::string shelves = slab_of(-0.8, -0.8, -0.7, 0.8, bottom_m, 1.0) +
                                slab_of(0.7, -0.8, 0.8, 0.8, bottom_m, 1.0) +
                                slab_of(-0.7, -0.8, 0.7, -0.7, bottom_m, 1.0) +
                                slab_of(-0.7, 0.7, 0.7, 0.8, bottom_m, 1.0);
    write_file(file, "<mujoco><worldbody>" + slab_of(-3.0, -3.0, 3.0, 3.0, -0.1, 0.0) + shelves +
                         "</worldbody></mujoco>");
    const World world(ModelSource{file, {}});
    return robot.complaint(RayScene(world.model(), world.snapshot()), scene.episode.setup,
                           scene.task);
  };
  EXPECT_EQ(complaint(0.25), "");
  EXPECT_TRUE(says(complaint(0.15), "no free floor"));
}

TEST(ExplorationStart, IsOnTheMapAndTheWholeRobotOnTheFloorMap) {
  AskedScene scene;
  AskedRobot robot(scene.episode.setup, scene.task);
  const MobileGroundTruth truth = robot.ground_truth();
  const auto complaint = [&] {
    return robot.complaint(truth.geometry(), scene.episode.setup, scene.task);
  };
  scene.task.floor_map.half_size_m = scene.task.navigation.footprint_radius_m + 0.01;
  EXPECT_EQ(complaint(), "");
  scene.task.floor_map.half_size_m -= 0.02;
  EXPECT_TRUE(says(complaint(), "floor_map.half_size_m"));
  scene.task.floor_map.half_size_m = 4.0;
  for (const double side : {-1.0, 1.0}) {
    scene.task.map.centre_m = {3.9 * side, 3.9 * side, 1.0};
    EXPECT_EQ(complaint(), "");
    scene.task.map.centre_m = {4.1 * side, 0.0, 1.0};
    EXPECT_TRUE(says(complaint(), "map.centre_m"));
    scene.task.map.centre_m = {0.0, 4.1 * side, 1.0};
    EXPECT_TRUE(says(complaint(), "map.centre_m"));
  }
}

/// Whatever height is said to fit does.
TEST(ExplorationRobot, LiftsItsCameraToTheHeightOfTheViews) {
  AskedScene scene;
  const auto height_m = [&](double asked_m) {
    scene.task.frontiers.height_m = asked_m;
    const SimulatedExplorationRobot robot(scene.episode.setup, scene.task);
    EXPECT_TRUE(robot.T_base_sweep().linear().isIdentity(1e-9));
    return robot.T_base_sweep().translation().z();
  };
  const double at_first_m = scene.task.frontiers.height_m;
  EXPECT_NEAR(height_m(at_first_m), at_first_m, 0.011);
  for (const double asked_m : {0.3, 3.0}) {
    std::string said;
    try {
      height_m(asked_m);
    } catch (const ConfigError& error) {
      said = error.what();
    }
    const std::size_t end = said.find(" fits");
    ASSERT_NE(end, std::string::npos) << said;
    const double fitting_m = std::stod(said.substr(said.rfind(' ', end - 1) + 1));
    EXPECT_NEAR(height_m(fitting_m), fitting_m, 0.011);
  }
}

/// The camera is before the pan axis, so that it sees farther from there.
TEST(ExplorationRobot, ObservesFromWhereItBelievesToBe) {
  const AskedScene scene;
  SimulatedExplorationRobot robot(scene.episode.setup, scene.task);
  robot.correct_pose({0.3, -0.2, 0.1});
  const ExplorationObservation seen = robot.observe(std::vector<std::size_t>{4});  // straight on
  ASSERT_EQ(seen.views.size(), 1U);
  const Eigen::Vector3d ahead_m =
      seen.views.front().T_base_camera.translation() - robot.T_base_sweep().translation();
  EXPECT_NEAR(robot.view_field().range_max_m,
              scene.task.camera.range_max_m + ahead_m.head<2>().norm(), 0.005);
  EXPECT_NEAR(seen.T_world_base_odometry.x_m, 0.3, 0.01);
  EXPECT_NEAR(seen.T_world_base_odometry.y_m, -0.2, 0.01);
  EXPECT_NEAR(seen.T_world_base_odometry.yaw_rad, 0.1, 0.01);
  const Pose expected = to_se3(robot.estimated_base()) * robot.T_base_sweep();
  EXPECT_TRUE(robot.estimated_sensor().isApprox(expected, 1e-9));
}

/// One in every square that the robot can get into: of the places there the nearest to its middle.
TEST(ObservingPoses, AreInTheMiddleOfSquares) {
  AskedScene scene("", "[0.3,0.1,0.7]", "4");
  scene.task.metrics.pose_spacing_m = 1.5;
  const SimulatedExplorationRobot robot(scene.episode.setup, scene.task);
  const MobileGroundTruth truth = robot.ground_truth();
  const ExplorationMapEvaluator evaluator(scene.task, 2, truth, robot.view_field(),
                                          robot.T_base_sweep());
  const auto square_of = [](const Eigen::Vector2d& p_m) {
    const Eigen::Vector2d square = (p_m - Eigen::Vector2d(-2.0, -2.0)) / 1.5;
    const std::pair key(static_cast<int>(std::floor(square.y())),
                        static_cast<int>(std::floor(square.x())));
    const Eigen::Vector2d middle(key.second + 0.5, key.first + 0.5);
    return std::pair(key, 1.5 * (square - middle).norm());
  };
  const FloorMap floor = free_floor(scene.task.floor_map);
  const PathField field = make_path_field(floor, {0.3, 0.1, 0.7}, scene.task.navigation);
  std::map<std::pair<int, int>, double> nearest_m;
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    if (!field.reachable(cell)) continue;
    const auto [key, off_m] = square_of(floor.centre(floor.cell(cell)));
    const auto entry = nearest_m.try_emplace(key, off_m).first;
    entry->second = std::min(entry->second, off_m);
  }
  const std::vector<Pose>& poses = evaluator.observing_poses();
  ASSERT_EQ(poses.size(), 1 + nearest_m.size());
  ASSERT_GT(nearest_m.size(), 3U);
  EXPECT_EQ(evaluator.poses(), poses.size());
  EXPECT_TRUE(poses.front().isApprox(to_se3({0.3, 0.1, 0.7}) * robot.T_base_sweep(), 1e-6))
      << "the start";
  auto expected = nearest_m.begin();
  for (std::size_t i = 1; i < poses.size(); ++i, ++expected) {
    const Pose2 base = robot.base_for_sensor(poses[i]);
    const auto [key, off_m] = square_of(position(base));
    EXPECT_EQ(key, expected->first) << i;
    EXPECT_NEAR(off_m, expected->second, 1e-9) << i;
    EXPECT_NEAR(base.yaw_rad, 0.0, 1e-9);
  }
  EXPECT_EQ(evaluator.left_out()->rooms, 0);
  EXPECT_EQ(evaluator.left_out()->cells, 0U);
}

/// The robot is shut in one of three rooms of 3 x 3 m; where the fourth would be there is one of
/// half the size, too small, and all else is solid.
TEST(UnreachedRooms, AreThoseThatAreLargeEnough) {
  AskedScene scene(closed_room(2.0, 2.0, 1.5) + closed_room(-2.0, 2.0, 1.5) +
                       closed_room(2.0, -2.0, 1.5) + slab_of(-3.6, -3.6, -2.76, -0.4, 0.0, 1.0) +
                       slab_of(-1.24, -3.6, -0.4, -0.4, 0.0, 1.0) +
                       slab_of(-2.76, -3.6, -1.24, -2.76, 0.0, 1.0) +
                       slab_of(-2.76, -1.24, -1.24, -0.4, 0.0, 1.0),
                   "[2,2,0]");
  const SimulatedExplorationRobot robot(scene.episode.setup, scene.task);
  const MobileGroundTruth truth = robot.ground_truth();
  const auto left_out = [&](double least_area_m2) {
    scene.task.passages.least_area_m2 = least_area_m2;
    const ExplorationMapEvaluator evaluator(scene.task, 2, truth, robot.view_field(),
                                            robot.T_base_sweep());
    return evaluator.left_out().value_or(LeftOut{});
  };
  const LeftOut both = left_out(2.5);
  EXPECT_EQ(both.rooms, 2);
  EXPECT_GT(both.cells, 10000U);
  const LeftOut none = left_out(4.5);  // a disc of 0.52 m moves in less than 1.96 x 1.96 m
  EXPECT_EQ(none.rooms, 0);
  EXPECT_EQ(none.cells, 0U);
}

/// The bases given come first, those of the poses that say what is observable behind them.
TEST(CoverageOfAnExploration, IsOfTheBasesGivenAndOfObservingPoses) {
  const AskedScene scene("", "[0,0,0]", "4");
  const std::vector<Pose2> bases{{0.2, 0.1, 0.0}, {-0.3, 0.3, 1.0}};
  const ViewCoverage coverage = scene.task.coverage(scene.episode.setup, bases);
  const SimulatedExplorationRobot robot(scene.episode.setup, scene.task);
  const MobileGroundTruth truth = robot.ground_truth();
  const ExplorationMapEvaluator evaluator(scene.task, 2, truth, robot.view_field(),
                                          robot.T_base_sweep());
  ASSERT_EQ(coverage.shows.size(), 2 + evaluator.poses());
  EXPECT_EQ(coverage.observable_cells, evaluator.observable_cells());
  std::vector<Eigen::Vector2d> places_m{position(bases[0]), position(bases[1])};
  for (const Pose& pose : evaluator.observing_poses()) {
    places_m.push_back(position(robot.base_for_sensor(pose)));
  }
  ASSERT_EQ(coverage.way_m.rows(), static_cast<Eigen::Index>(places_m.size()));
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const double straight_m = (places_m[i] - places_m[0]).norm();
    const double way_m = coverage.way_m(0, static_cast<Eigen::Index>(i));
    EXPECT_GE(way_m, straight_m - 1e-9) << i;
    EXPECT_LT(way_m, straight_m + 0.2) << i << ", on open floor";
  }
}

/// A wall across the map with a gap of 14 cm, which on a map whose cells are 20 cm long nothing is
/// too wide for, and a wide opening a metre to the right.
TEST(CoverageOfAnExploration, TakesForWaysWhatMightBeWiderThanTheMapSays) {
  AskedScene scene(
      slab_of(-2.05, -0.05, -0.02, 0.05, 0.0, 1.5) + slab_of(0.12, -0.05, 0.95, 0.05, 0.0, 1.5),
      "[-1,-1,0]", "4");
  scene.task.map.cells = {40, 20, 20};
  const std::vector<Pose2> bases{{0.05, -0.8, 0.0}, {0.05, 0.8, 0.0}};
  const ViewCoverage coverage = scene.task.coverage(scene.episode.setup, bases);
  ASSERT_GE(coverage.way_m.rows(), 2);
  EXPECT_GE(coverage.way_m(0, 1), 1.6 - 1e-9);
  EXPECT_LT(coverage.way_m(0, 1), 1.75);
}

/// A corridor of 0.9 m, which its outline fits through, but no disc round it.
TEST(TrueWays, AreThoseOfTheOutlineIfADiscLeavesEnoughOut) {
  AskedScene scene(slab_of(0.3, 0.45, 1.8, 2.05, 0.0, 1.5) +
                       slab_of(0.3, -2.05, 1.8, -0.45, 0.0, 1.5) +
                       slab_of(1.8, -2.05, 2.05, 2.05, 0.0, 1.5),
                   "[-1,0,0]", "4");
  const SimulatedExplorationRobot robot(scene.episode.setup, scene.task);
  const MobileGroundTruth truth = robot.ground_truth();
  const auto evaluator = [&] {
    return ExplorationMapEvaluator(scene.task, 2, truth, robot.view_field(), robot.T_base_sweep());
  };
  const ExplorationMapEvaluator of_disc = evaluator();
  const PathField& field = *of_disc.true_paths();
  const double might_m = inscribed_radius_m(truth.outline().outline) - 0.1;
  std::vector<Eigen::Array2i> reached;
  for (std::size_t cell = 0; cell < field.map.size(); ++cell) {
    if (field.reachable(cell)) reached.push_back(field.map.cell(cell));
  }
  const double near = std::pow(0.6 / field.map.cell_m, 2);
  int left = 0;
  for (std::size_t cell = 0; cell < field.map.size(); ++cell) {
    if (static_cast<double>(field.clearance_m[cell]) < might_m) continue;
    const Eigen::Array2i at = field.map.cell(cell);
    left += std::ranges::none_of(reached, [&](const Eigen::Array2i& other) {
      return static_cast<double>((at - other).square().sum()) <= near;
    });
  }
  ASSERT_GT(left, 100);
  const double left_m2 = left * field.map.cell_m * field.map.cell_m;
  scene.task.passages.use = true;
  scene.task.passages.least_area_m2 = 1.001 * left_m2;
  EXPECT_TRUE(evaluator().true_paths()->space == nullptr);
  scene.task.passages.least_area_m2 = 0.999 * left_m2;
  EXPECT_TRUE(evaluator().true_paths()->space != nullptr);
}

TEST(ExplorationOptions, AreCheckedWithTheRestOfTheEpisode) {
  EpisodeOptions episode;
  const Exploration good;
  EXPECT_NO_THROW(good.check_with(episode));
  Exploration gaps;
  gaps.sweep.pans = 4;
  EXPECT_THROW(gaps.check_with(episode), ConfigError);
  Exploration fine;
  fine.floor_map.half_size_m = 200.0;
  fine.floor_detail.parts = 15;
  EXPECT_THROW(fine.check_with(episode), ConfigError);
  episode.faults.laser_bias_m = 0.1;
  episode.faults.odometry_slip = 0.1;
  EXPECT_NO_THROW(good.check_with(episode));
  episode.faults.weak_rotor = 0.1;
  EXPECT_THROW(good.check_with(episode), ConfigError) << "it has none";
}

}  // namespace
}  // namespace vantage
