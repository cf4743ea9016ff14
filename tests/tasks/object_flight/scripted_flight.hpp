/// The parts of a flight round objects, with a robot that is at once where it is told to fly. Its
/// images show nothing, so that nothing but motions changes what is believed.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/flight/two_objects.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/object_flight/object_flight_parts.hpp"
#include "vantage/tasks/object_flight/simulated_orbit_robot.hpp"

namespace vantage::support {

struct ScriptedOrbitRobot : OrbitRobotInterface {
  [[nodiscard]] double time_s() const override { return now_s; }
  FlightObservation observe() override {
    CameraImages images;
    images.width_px = 32;
    images.height_px = 24;
    images.focal_px = 30.0;
    images.range_max_m = 5.0;
    images.rgb.assign(32 * 24 * 3, 0);
    images.depth_m.assign(32 * 24, 0.0F);
    return {.arrived = true, .images = images, .T_world_camera = T_world_camera};
  }
  FlightResult fly_along(std::span<const Pose> T_world_places) override {
    flown.assign(T_world_places.begin(), T_world_places.end());
    ++flights;
    return flight;
  }
  [[nodiscard]] FlightPlan plan(std::span<const Pose> T_world_places) const override {
    planned.emplace_back(T_world_places.begin(), T_world_places.end());
    FlightPlan made;
    for (const Pose& place : T_world_places) {
      made.waypoints.push_back({.p_world_m = place.translation() + beside_m, .yaw_rad = 0.0});
    }
    made.duration_s = duration_s(T_world_places.back());
    made.path_m = 2.5;
    made.energy_j = 3.5;
    return made;
  }
  [[nodiscard]] double start_bearing_rad() const override { return 0.5; }
  [[nodiscard]] Pose estimated_body() const override { return T_world_body; }

  double now_s = 2.0;
  Pose T_world_camera =
      make_pose({1.0, 2.0, 3.0}, 0.4, 0.3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
  Pose T_world_body = make_pose({0.0, 0.0, 50.0}, 0.0);
  Eigen::Vector3d beside_m = Eigen::Vector3d::Zero();  ///< waypoints of a plan from its places
  std::function<double(const Pose&)> duration_s = [](const Pose& /*place*/) { return 1.5; };
  FlightResult flight;
  std::vector<Pose> flown;
  int flights = 0;
  mutable std::vector<std::vector<Pose>> planned;
};

/// Its colour tells a mug from a bowl, whichever way they are turned.
inline Recogniser recogniser_by_colour() {
  const ObjectStates states = recogniser_of_two().states;
  const TrainedFeature colour(Colour{}, 0.0);
  ObservationModel model;
  model.feature = "colour";
  model.mean = Eigen::MatrixXf::Zero(colour.dimension(), states.size());
  model.variance = Eigen::MatrixXf::Ones(colour.dimension(), states.size());
  model.mean.row(0).tail(states.bins).setConstant(10.0F);
  return make_recogniser(states, {{colour, model}}, 1);
}

class ScriptedFlight : public testing::Test {
 protected:
  /// The truth, for the evaluator: a mug in the middle of the table that the camera sees turned by
  /// half a turn, and one beside it.
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::quiet);
    episode_ =
        load_episode(std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/recognition.yaml",
                     {"object=mug_1", "camera={width_px: 320, height_px: 240}"});
    ObjectOnTable mug{.object = "mug_1", .category = "mug"};
    mug.yaw_rad = wrap_turn(Rng::stream(episode_->setup.options.seed, "start bearing")
                                .uniform(0.0, 2.0 * std::numbers::pi) +
                            std::numbers::pi);
    objects_ = {mug, mug};
    objects_[1].offset_m = {0.2, 0.1};
    objects_[1].told_m = {0.25, 0.0};
    truth_ =
        std::make_unique<SimulatedOrbitRobot>(episode_->setup, model_source(*episode_),
                                              std::get<RecognitionTask>(episode_->task), objects_);
  }
  static void TearDownTestSuite() {
    truth_.reset();
    episode_.reset();
  }

  ScriptedFlight()
      : world_(ball_in(folder_)),
        request_{setup_, "recognition", "star", "a: 1\n", {}, lean_options()},
        run_(request_),
        recorder_(run_,
                  {.world = world_,
                   .T_world_body = [this] { return T_world_true_; },
                   .T_world_estimated = [this] { return T_world_true_; }},
                  8, false),
        evaluator_(*truth_) {
    task_.bearings = 4;
    task_.decision.all_features = true;
    task_.decision.views.choice = StarView{};
    task_.decision.enough = {.object_probability = 1.0, .entropy_bits = 0.0};
    task_.decision.transition = RigidTransition{.slip = 0.0};
  }
  ~ScriptedFlight() override { release_run_directory(folder_ / "run"); }

  static ModelSource ball_in(const TemporaryDirectory& folder) {
    write_file(folder / "scene.xml",
               "<mujoco><worldbody><geom type='plane' size='5 5 .1'/>"
               "<body pos='0 0 2'><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
    return {folder / "scene.xml", {}};
  }
  RunOptions lean_options() {
    RunOptions lean;
    lean.directory = folder_ / "run";
    lean.lean = true;
    lean.spectator.on_event = [this](const EpisodeEvent& event) { told_.push_back(event); };
    return lean;
  }

  ObjectFlightContext context() {
    return {setup_.options, task_, recogniser_, robot_, evaluator_, recorder_};
  }
  [[nodiscard]] FlightGoal goal(int targets) const {
    FlightGoal looked_for;
    for (int i = 0; i < targets; ++i) {
      looked_for.p_world_m.emplace_back(task_.p_world_table_m() +
                                        Eigen::Vector3d(0.3 * i, 0.0, 0.0));
    }
    return looked_for;
  }
  [[nodiscard]] ObjectInquiry what_is_it() const { return {recogniser_, task_.decision}; }
  /// A bowl that the first view should see turned by half a turn.
  [[nodiscard]] ObjectInquiry is_it_that_bowl() const {
    ChangeOptions options;
    options.recognition = task_.decision;
    return {recogniser_, options, "bowl_2", std::numbers::pi};
  }
  void look(ObjectFlightParts& parts) {
    parts.update(parts.observe());
    parts.record();
  }
  void travel(double way_m) {
    T_world_true_.translation().x() += way_m;
    world_.advance_tick();
  }
  static std::vector<BearingOption> offered(ObjectFlightParts& parts) {
    EXPECT_EQ(parts.finished(), "");
    return parts.propose();
  }

  static inline std::optional<ResolvedEpisode> episode_;
  static inline std::vector<ObjectOnTable> objects_;
  static inline std::unique_ptr<SimulatedOrbitRobot> truth_;
  TemporaryDirectory folder_;
  Pose T_world_true_ = Pose::Identity();
  std::vector<EpisodeEvent> told_;
  World world_;
  EpisodeSetup setup_;
  RunRequest request_;
  EpisodeRun run_;
  ObjectFlightRecorder recorder_;
  ObjectFlightEvaluator evaluator_;
  ObjectFlight task_;
  Recogniser recogniser_ = recogniser_by_colour();
  ScriptedOrbitRobot robot_;
};

inline constexpr double kRightAngle_rad = std::numbers::pi / 2.0;

inline void expect_same_places(const std::vector<Pose>& found, const std::vector<Pose>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(found[i].isApprox(expected[i], 1e-9)) << i;
  }
}

/// By angles that may be whole turns apart.
inline void expect_same_turn(double found_rad, double expected_rad) {
  EXPECT_NEAR(std::remainder(found_rad - expected_rad, 4.0 * kRightAngle_rad), 0.0, 1e-9);
}

}  // namespace vantage::support
