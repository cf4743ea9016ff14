// A quadrotor at a table: where it flies, what it sees, and whether it finds the object itself.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/support/overrides.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/object_flight/object_flight_evaluator.hpp"
#include "vantage/tasks/object_flight/object_flight_run.hpp"
#include "vantage/tasks/object_flight/simulated_orbit_robot.hpp"
#include "vantage/tasks/recognition/recognition_ground_truth.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

ResolvedEpisode episode(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"settle_s=0.2", "segmentation.mask_growth_px=0"};
  overrides = support::overridden(std::move(overrides), more);
  return load_episode(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/recognition.yaml", overrides);
}

RecognitionTask task_of(const ResolvedEpisode& resolved) {
  return std::get<RecognitionTask>(resolved.task);
}

ObjectOnTable object_of(const ResolvedEpisode& resolved) {
  return draw_object(task_of(resolved), resolved.setup.options.seed);
}

/// The robot of the episode in its world.
struct OrbitingRobot : SimulatedOrbitRobot {
  explicit OrbitingRobot(const ResolvedEpisode& resolved)
      : OrbitingRobot(resolved, object_of(resolved)) {}
  OrbitingRobot(const ResolvedEpisode& resolved, const ObjectOnTable& object)
      : SimulatedOrbitRobot(resolved.setup, model_source(resolved), task_of(resolved),
                            {&object, 1}),
        orbit(task_of(resolved).orbit()),
        bearing_rad(start_bearing_rad()) {}

  [[nodiscard]] std::vector<Pose> way_to(double to_rad) const {
    return orbit_arc(orbit, bearing_rad, to_rad, 0.2);
  }
  FlightResult fly_to(double to_rad) {
    const std::vector<Pose> way = way_to(to_rad);
    bearing_rad = to_rad;
    return fly_along(way);
  }

  Orbit orbit;
  double bearing_rad;  ///< flown to last
};

/// Intersection over union of the cut's mask with where the object truly is in the image.
double overlap(const ObjectView& view, const RgbdOptions& camera, const std::vector<int>& truth,
               int body) {
  int both = 0;
  int either = 0;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column) {
      const int r = row - view.top_px;
      const int c = column - view.left_px;
      const bool in_cut = r >= 0 && c >= 0 && r < view.height_px && c < view.width_px;
      const bool masked = in_cut && view.mask[view.index(r, c)] != 0;
      const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(camera.width_px) +
                         static_cast<std::size_t>(column);
      const bool meant = truth[pixel] == body;
      both += masked && meant ? 1 : 0;
      either += masked || meant ? 1 : 0;
    }
  }
  return static_cast<double>(both) / either;
}

/// What the robot cut out of its image beside where the simulator knows the object to be.
double overlap_with_truth(OrbitingRobot& robot, const FlightObservation& observation,
                          const RecognitionTask& task) {
  Rng rng(1);
  const SegmentedObject found = segment_object(observation.images, observation.T_world_camera,
                                               task.p_world_table_m(), task.segmentation, rng);
  EXPECT_TRUE(found.view) << found.reason;
  if (!found.view) return 0.0;
  World& world = robot.quadrotor().world();
  const mjModel& model = world.model();
  const auto renderer = make_offscreen_renderer(model, task.camera.width_px, task.camera.height_px);
  const std::vector<int> truth =
      body_ids(*renderer, model, world.snapshot(),
               model_id(model, ModelObject::camera, "robot/camera"), task.camera.fovy_rad);
  return overlap(*found.view, task.camera, truth, model_id(model, ModelObject::body, "object"));
}

class OrbitRobotObject : public testing::TestWithParam<const char*> {};

TEST_P(OrbitRobotObject, IsCutOutOfPicturesFromSeveralBearings) {
  const ResolvedEpisode resolved = episode({std::string("object=") + GetParam()});
  OrbitingRobot robot(resolved);
  for (int i = 0; i < 3; ++i) {
    if (i > 0) {
      const FlightResult flight = robot.fly_to(robot.bearing_rad + 1.7);
      EXPECT_EQ(flight.status, FlightStatus::arrived);
    }
    const FlightObservation observation = robot.observe();
    EXPECT_GT(overlap_with_truth(robot, observation, task_of(resolved)), 0.85)
        << GetParam() << " at bearing " << robot.bearing_rad;
    EXPECT_LT(robot.ground_truth().position_error_m, 0.05);
    EXPECT_LT(robot.ground_truth().angle_error_rad, 3.0 * std::numbers::pi / 180.0);
  }
  EXPECT_EQ(robot.ground_truth().collisions, 0);
}

INSTANTIATE_TEST_SUITE_P(Several, OrbitRobotObject,
                         testing::Values("mug_1", "cereal_box_1", "banana_1", "bowl_1"));

TEST(OrbitRobotInterface, SeesTheObjectTurnAgainstIt) {
  OrbitingRobot robot(episode());
  const double before_rad = robot.ground_truth().object_angle_rad;
  const double bearing_rad = robot.bearing_rad;
  EXPECT_EQ(robot.fly_to(bearing_rad + 0.8).status, FlightStatus::arrived);
  EXPECT_NEAR(wrap_angle(robot.ground_truth().object_angle_rad - before_rad), -0.8, 0.06);
}

TEST(OrbitRobotInterface, PlansWhatItFlies) {
  OrbitingRobot robot(episode());
  const double to_rad = robot.bearing_rad - 1.2;
  const FlightPlan plan = robot.plan(robot.way_to(to_rad));
  const FlightResult flight = robot.fly_to(to_rad);
  EXPECT_NEAR(flight.path_length_m, plan.path_m, 0.1 * plan.path_m + 0.05);
  EXPECT_GT(flight.duration_s, plan.duration_s);
  EXPECT_LT(flight.duration_s, plan.duration_s + 2.0) << "it settles soon";
  EXPECT_NEAR(flight.energy_J / flight.duration_s, plan.energy_j / plan.duration_s,
              0.1 * plan.energy_j / plan.duration_s);
}

template <class T>
concept TellsBodyIds = requires(const T& images) {
  images.segmentation;
};
template <class T>
concept TellsTruth = requires(T& robot) {
  robot.ground_truth();
}
|| requires(T& robot) { robot.quadrotor(); }
|| requires(T& robot) { robot.world(); };

TEST(OrbitRobotInterface, TakesNoTruthAlong) {
  EXPECT_FALSE(TellsBodyIds<decltype(FlightObservation::images)>);
  EXPECT_FALSE(TellsTruth<OrbitRobotInterface>);
  EXPECT_TRUE(TellsTruth<SimulatedOrbitRobot>) << "asked of evaluators";
}

TEST(ObjectOnTable, NamingItLeavesItWhereItWas) {
  const ResolvedEpisode drawn = episode();
  const ObjectOnTable first = object_of(drawn);
  const ObjectOnTable named = object_of(episode({"object=bowl_1"}));
  EXPECT_EQ(named.object, "bowl_1");
  EXPECT_EQ(named.category, "bowl");
  EXPECT_EQ(named.yaw_rad, first.yaw_rad);
  EXPECT_EQ(named.offset_m, first.offset_m);
  EXPECT_LE(first.offset_m.norm(), task_of(drawn).placement_m);
  EXPECT_NE(object_of(episode({"seed=2"})).yaw_rad, first.yaw_rad);
}

TEST(ObjectOnTable, MustBeOfTheDatabase) {
  EXPECT_THROW(object_of(episode({"object=unicorn_1"})), ConfigError);
}

/// Of noise that is strong enough to take some colours past it.
TEST(OrbitRobotInterface, ColoursEndAtWhite) {
  OrbitingRobot robot(episode({"colour_noise=100"}));
  const std::vector<std::uint8_t> rgb = robot.observe().images.rgb;
  const auto white = std::ranges::count(rgb, std::uint8_t{255});
  EXPECT_GT(static_cast<double>(white), 0.01 * static_cast<double>(rgb.size()));
}

/// With nothing of its own that could not be copied.
struct BareOrbitRobot : OrbitRobotInterface {
  [[nodiscard]] double time_s() const override { return 0.0; }
  FlightObservation observe() override { return {}; }
  FlightResult fly_along(std::span<const Pose> /*T_world_places*/) override { return {}; }
  [[nodiscard]] FlightPlan plan(std::span<const Pose> /*T_world_places*/) const override {
    return {};
  }
  [[nodiscard]] double start_bearing_rad() const override { return 0.0; }
  [[nodiscard]] Pose estimated_body() const override { return Pose::Identity(); }
};

TEST(OrbitRobotInterface, IsOfOneRobotThatIsNotCopied) {
  EXPECT_TRUE(std::is_default_constructible_v<BareOrbitRobot>);
  EXPECT_FALSE(std::is_copy_constructible_v<BareOrbitRobot>);
  EXPECT_FALSE(std::is_copy_assignable_v<BareOrbitRobot>);
}

TEST(OrbitRobotInterface, TellsHowItSeesAnObjectFarFromTheMiddleOfTheTable) {
  const ResolvedEpisode resolved = episode();
  ObjectOnTable object = object_of(resolved);
  for (const Eigen::Vector2d& p_m : {Eigen::Vector2d(0.3, 0.0), Eigen::Vector2d(0.0, 0.3)}) {
    object.offset_m = p_m;
    object.told_m = p_m;
    const OrbitingRobot robot(resolved, object);
    const double seen_rad = robot.ground_truth().object_angle_rad;
    EXPECT_NEAR(wrap_angle(seen_rad - (object.yaw_rad - robot.bearing_rad)), 0.0, 0.02) << p_m;
  }
}

/// It flies round where it is told that the object stands; the truth is where it stands.
TEST(OrbitRobotInterface, FliesRoundThePlaceThatItIsTold) {
  const ResolvedEpisode resolved = episode();
  const RecognitionTask task = task_of(resolved);
  ObjectOnTable object = object_of(resolved);
  object.told_m = {0.3, 0.0};
  object.offset_m = {0.0, 0.2};
  const OrbitingRobot robot(resolved, object);
  EXPECT_EQ(robot.start_bearing_rad(), Rng::stream(resolved.setup.options.seed, "start bearing")
                                           .uniform(0.0, 2.0 * std::numbers::pi));
  const Eigen::Vector3d told_m = task.p_world_table_m() + Eigen::Vector3d(0.3, 0.0, 0.0);
  const Eigen::Vector3d camera_m =
      task.orbit_round(told_m).place(robot.start_bearing_rad()).translation();
  const OrbitGroundTruth truth = robot.ground_truth();
  EXPECT_NEAR(truth.position_error_m, 0.0, 1e-3);
  const Eigen::Vector3d from_m = camera_m - task.p_world_table_m();
  const double seen_rad = object.yaw_rad - std::atan2(from_m.y() - 0.2, from_m.x());
  EXPECT_NEAR(wrap_angle(truth.object_angle_rad - seen_rad), 0.0, 1e-2);
  EXPECT_GE(truth.object_angle_rad, 0.0);
  EXPECT_LT(truth.object_angle_rad, 2.0 * std::numbers::pi);
}

TEST(OrbitRobotInterface, SeesAnObjectThatWasMovedFromWhereItIsNow) {
  const ResolvedEpisode resolved = episode();
  OrbitingRobot robot(resolved);
  World& world = robot.quadrotor().world();
  const int body = model_id(world.model(), ModelObject::body, "object");
  const ObjectOnTable object = object_of(resolved);
  const Eigen::Vector3d there_m =
      task_of(resolved).p_world_table_m() +
      Eigen::Vector3d(object.offset_m.x() + 0.25, object.offset_m.y(), 0.0);
  world.put_fixed_body(body, there_m);
  const Eigen::Vector3d camera_m = robot.orbit.place(robot.bearing_rad).translation();
  const double seen_rad =
      object.yaw_rad - std::atan2(camera_m.y() - there_m.y(), camera_m.x() - there_m.x());
  EXPECT_NEAR(wrap_angle(robot.ground_truth().object_angle_rad - seen_rad), 0.0, 1e-2);
}

TEST(OrbitRobotInterface, AFlightIntoTheTableHasFailed) {
  const ResolvedEpisode resolved = episode();
  OrbitingRobot robot(resolved);
  const std::vector<Pose> into_it{
      make_pose(task_of(resolved).p_world_table_m() - Eigen::Vector3d(0.0, 0.0, 0.3), 0.0)};
  try {
    robot.fly_along(into_it);
    FAIL() << "it flew on";
  } catch (const EpisodeFailed& error) {
    EXPECT_NE(std::string(error.what()).find("touched"), std::string::npos) << error.what();
  }
  EXPECT_GE(robot.ground_truth().collisions, 1);
  const ObjectFlightEvaluator evaluator(robot);
  ObservationRecord record;
  const ObjectStates states{.objects = {"a_1"}, .categories = {"a"}, .category_of = {0}, .bins = 4};
  evaluator.measure(states, 0, 0, 0, record);
  EXPECT_EQ(record.collisions, robot.ground_truth().collisions);
  EXPECT_EQ(record.position_error_m, robot.ground_truth().position_error_m);
  EXPECT_EQ(record.angle_error_rad, robot.ground_truth().angle_error_rad);
  EXPECT_GT(record.position_error_m, 0.05) << "from where it was to fly";
}

TEST(OrbitRobotInterface, PlansAreAsLongAsTheirWaypointsAreApart) {
  const ResolvedEpisode resolved = episode();
  OrbitingRobot robot(resolved);
  const FlightPlan plan = robot.plan(robot.way_to(robot.bearing_rad + 1.0));
  ASSERT_EQ(plan.waypoints.size(), 5U);
  double path_m = 0.0;
  Eigen::Vector3d at_m = robot.quadrotor().true_body().translation();
  for (const FlightWaypoint& waypoint : plan.waypoints) {
    path_m += (waypoint.p_world_m - at_m).norm();
    at_m = waypoint.p_world_m;
  }
  EXPECT_NEAR(plan.path_m, path_m, 1e-3);
  const FlightPlan farther = robot.plan(robot.way_to(robot.bearing_rad + 2.0));
  EXPECT_NEAR(farther.energy_j / farther.duration_s, plan.energy_j / plan.duration_s, 1e-9);
  EXPECT_GT(farther.duration_s, plan.duration_s);
}

TEST(OrbitRobotInterface, NeedsASceneWithAnObject) {
  const ResolvedEpisode resolved = episode();
  const support::TemporaryDirectory folder;
  write_file(folder / "bare.xml",
             "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  ModelSource source = model_source(resolved);
  source.scene = folder / "bare.xml";
  source.files.clear();
  const ObjectOnTable object = object_of(resolved);
  EXPECT_THROW(SimulatedOrbitRobot(resolved.setup, source, task_of(resolved), {&object, 1}),
               InputError);
}

/// The estimate has errors of its own.
TEST(OrbitRobotInterface, IsRecordedWhereItIsAndWhereItBelievesToBe) {
  const ResolvedEpisode resolved = episode();
  OrbitingRobot robot(resolved);
  robot.observe();
  const RecordedRobot kept = recorded(static_cast<SimulatedOrbitRobot&>(robot));
  EXPECT_EQ(&kept.world, &robot.quadrotor().world());
  EXPECT_TRUE(kept.T_world_body().isApprox(robot.quadrotor().true_body(), 0.0));
  EXPECT_TRUE(kept.T_world_estimated().isApprox(robot.estimated_body(), 0.0));
  EXPECT_FALSE(kept.T_world_body().isApprox(kept.T_world_estimated(), 1e-9));
  EXPECT_EQ(kept.faults, &robot.quadrotor().faults());
}

/// Of colours that are far from black and white: without bias, of that standard deviation.
TEST(OrbitRobotInterface, ColoursAreAsNoisyAsTheyAreSaidToBe) {
  OrbitingRobot plain(episode({"colour_noise=0"}));
  OrbitingRobot noisy(episode({"colour_noise=6"}));
  const std::vector<std::uint8_t> clear = plain.observe().images.rgb;
  const std::vector<std::uint8_t> seen = noisy.observe().images.rgb;
  ASSERT_EQ(seen.size(), clear.size());
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < clear.size(); ++i) {
    if (clear[i] < 40 || clear[i] > 215) continue;
    const double off = static_cast<double>(seen[i]) - static_cast<double>(clear[i]);
    count += 1.0;
    sum += off;
    squares += off * off;
  }
  ASSERT_GT(count, 10000.0);
  EXPECT_NEAR(sum / count, 0.0, 0.2);
  EXPECT_NEAR(std::sqrt(squares / count), 6.0, 0.2);
}

}  // namespace
}  // namespace vantage
