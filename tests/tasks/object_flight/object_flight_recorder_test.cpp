// What a flight round an object leaves in its run folder, field by field.
#include "vantage/tasks/object_flight/object_flight_recorder.hpp"

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "tests/support/terminal.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

/// In a room without a robot.
struct RoomRecorder {
  explicit RoomRecorder(bool of_change)
      : world(room_in(folder)),
        request{setup, "recognition", "star", "a: 1\n", {}, options()},
        run(request),
        recorder(run,
                 {.world = world,
                  .T_world_body = [] { return Pose(Pose::Identity()); },
                  .T_world_estimated = [] { return Pose(Pose::Identity()); }},
                 8, of_change) {
    set_verbosity(Verbosity::quiet);
  }
  RoomRecorder(const RoomRecorder&) = delete;
  RoomRecorder& operator=(const RoomRecorder&) = delete;
  ~RoomRecorder() { release_run_directory(folder / "run"); }

  static ModelSource room_in(const support::TemporaryDirectory& folder) {
    write_file(folder / "scene.xml",
               "<mujoco><worldbody><geom type='plane' size='5 5 .1'/>"
               "<body pos='0 0 2'><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
    return {folder / "scene.xml", {}};
  }
  RunOptions options() {
    RunOptions watched;
    watched.directory = folder / "run";
    watched.spectator.on_step = [this](std::string_view columns, std::string_view row) {
      step.clear();
      std::istringstream names{std::string(columns)};
      std::istringstream values{std::string(row)};
      for (std::string name, value; std::getline(names, name, ',');) {
        std::getline(values, value, ',');
        step[name] = value;
        value.clear();
      }
      EXPECT_TRUE(values.eof()) << "no values beyond the names";
    };
    return watched;
  }
  [[nodiscard]] double number(const std::string& column) const {
    return std::stod(step.at(column));
  }

  support::TemporaryDirectory folder;
  std::map<std::string, std::string> step;  ///< the last row of steps.csv, by column
  World world;
  EpisodeSetup setup;
  RunRequest request;
  EpisodeRun run;
  ObjectFlightRecorder recorder;
};

/// 4 x 3 px, one colour.
CameraImages small_image() {
  CameraImages image;
  image.width_px = 4;
  image.height_px = 3;
  for (int i = 0; i < 12; ++i) image.rgb.insert(image.rgb.end(), {10, 20, 30});
  return image;
}

TEST(ObjectFlightRecorder, AnyNameOfAnObjectIsOneField) {
  RoomRecorder room(false);
  ObservationRecord record;
  record.estimate = "mug \"blue\"";
  room.recorder.observation(record, 1, small_image(), std::nullopt);
  EXPECT_EQ(room.step.at("estimate"), "\"mug \"\"blue\"\"\"");
}

TEST(ObjectFlightRecorder, ARowHasAllOfItsRecord) {
  RoomRecorder room(true);
  ObservationRecord record;
  record.time_s = 12.5;
  record.bearing_id = 3;
  record.target = 1;
  record.expected_visible = 0.75;
  record.seen_share = 0.625;
  record.report.view_rad = 1.5;
  record.report.features = {"colour", "sift"};
  record.report.entropy_bits = 2.25;
  record.report.feature_time_s = 0.125;
  record.report.selection_time_s = 0.0625;
  record.report.view_time_s = 0.03125;
  record.gain_bits = 0.875;
  record.flight = FlightResult{FlightStatus::timeout, 6.5, 4.0, 0.01, 0.02, 321.5};
  record.object_px = 77;
  record.estimate = "mug_1";
  record.map_probability = 0.5;
  record.change = {0.25, Change::pose};
  record.position_error_m = 0.015625;
  record.angle_error_rad = 0.375;
  record.bin_error = 2;
  record.collisions = 1;
  record.path_length_m = 9.5;
  record.leg_length_m = 4.25;
  Pose T_forward_camera = Pose::Identity();  // OpenCV's axes of a camera that looks along x
  T_forward_camera.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  record.T_world_camera = make_pose({1.0, 2.0, 3.0}, 0.3, 0.4) * T_forward_camera;
  room.recorder.observation(record, 7, small_image(), std::nullopt);
  const std::map<std::string, double> expected{{"time_s", 12.5},
                                               {"view", 7.0},
                                               {"chosen_view", 3.0},
                                               {"x_m", 1.0},
                                               {"y_m", 2.0},
                                               {"z_m", 3.0},
                                               {"yaw_rad", 0.3},
                                               {"pitch_rad", 0.4},
                                               {"view_rad", 1.5},
                                               {"entropy_bits", 2.25},
                                               {"map_probability", 0.5},
                                               {"gain_bits", 0.875},
                                               {"feature_time_s", 0.125},
                                               {"selection_time_s", 0.0625},
                                               {"view_time_s", 0.03125},
                                               {"flight_time_s", 6.5},
                                               {"path_length_m", 9.5},
                                               {"leg_length_m", 4.25},
                                               {"energy_j", 321.5},
                                               {"object_px", 77.0},
                                               {"target", 2.0},
                                               {"expected_visible", 0.75},
                                               {"seen_share", 0.625},
                                               {"position_error_m", 0.015625},
                                               {"angle_error_rad", 0.375},
                                               {"bin_error", 2.0},
                                               {"collisions", 1.0},
                                               {"change_probability", 0.25}};
  for (const auto& [column, value] : expected) {
    EXPECT_NEAR(room.number(column), value, 1e-9) << column;
  }
  EXPECT_EQ(room.step.at("features"), "colour sift");
  EXPECT_EQ(room.step.at("estimate"), "mug_1");
  EXPECT_EQ(room.step.at("flight"), to_string(FlightStatus::timeout));
  EXPECT_EQ(room.step.at("decision"), "pose");
  EXPECT_EQ(room.step.size(), expected.size() + 4U);
}

TEST(ObjectFlightRecorder, ARowOfTheFirstViewHasNoFlight) {
  RoomRecorder room(false);
  room.recorder.observation({}, 1, small_image(), std::nullopt);
  EXPECT_EQ(room.step.at("flight"), "");
  EXPECT_EQ(room.number("flight_time_s"), 0.0);
  EXPECT_EQ(room.number("energy_j"), 0.0);
  EXPECT_EQ(room.number("target"), 1.0);
  EXPECT_FALSE(room.step.contains("change_probability"));
}

/// From 2 m beside and 1 m above what is looked at.
TEST(ObjectFlightRecorder, KeepsWhatAViewWasChosenAmong) {
  RoomRecorder room(false);
  const Orbit orbit{.centre_m = {1.0, 2.0, 0.75}, .radius_m = 2.0, .height_m = 1.0};
  std::vector<BearingOption> options(2);
  ObjectViewDecision decision{.action = 1, .scores = std::vector<ObjectViewScore>(2)};
  for (std::size_t i = 0; i < 2; ++i) {
    const double n = static_cast<double>(i);
    options[i].id = 4 + static_cast<int>(i);
    options[i].target = i;
    options[i].T_world_way = {orbit.place(2.0), orbit.place(n)};
    options[i].action = {.yaw_rad = 0.0,
                         .time_s = 5.0 + n,
                         .path_m = 7.0 + n,
                         .energy_j = 90.0 + n,
                         .visited = false,
                         .visible = 0.5 + 0.25 * n};
    decision.scores[i].gain.bits = 0.75 + n;
    decision.scores[i].cost = 3.0 + n;
  }
  room.recorder.decision(options, decision, orbit);
  room.recorder.commit();
  const CsvTable table = read_csv(room.folder.path() / "run/candidates.csv");
  ASSERT_EQ(table.rows.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const double n = static_cast<double>(i);
    std::map<std::string, std::string> row;
    for (std::size_t c = 0; c < table.columns.size(); ++c) row[table.columns[c]] = table.rows[i][c];
    const Eigen::Vector3d place_m = orbit.place(n).translation();
    const std::map<std::string, double> expected{
        {"decision", 1.0},      {"candidate", 4.0 + n}, {"x_m", place_m.x()},
        {"y_m", place_m.y()},   {"z_m", 1.75},          {"pitch_rad", std::atan2(1.0, 2.0)},
        {"gain", 0.75 + n},     {"way_m", 7.0 + n},     {"flight_time_s", 5.0 + n},
        {"energy_j", 90.0 + n}, {"cost", 3.0 + n},      {"visible", 0.5 + 0.25 * n},
        {"target", 1.0 + n},    {"chosen", n}};
    for (const auto& [column, value] : expected) {
      EXPECT_NEAR(std::stod(row.at(column)), value, 1e-9) << i << " " << column;
    }
    EXPECT_NEAR(std::cos(std::stod(row.at("yaw_rad")) - n), -1.0, 1e-9) << "back at the middle";
    EXPECT_EQ(row.at("gain_unit"), "bits");
    EXPECT_EQ(row.at("predicted_cells"), "");
  }
}

TEST(ObjectFlightRecorder, KeepsTheImageWithTheObjectsOutline) {
  RoomRecorder room(false);
  const CameraImages image = small_image();
  ObjectView cut;
  cut.width_px = cut.height_px = 2;
  cut.mask.assign(4, 1);
  cut.left_px = 1;
  room.recorder.observation({}, 3, image, cut);
  room.recorder.observation({}, 4, image, std::nullopt);
  const std::filesystem::path views = room.folder.path() / "run/views";
  const cv::Mat outlined_view = cv::imread((views / "view_03.png").string());
  const cv::Mat bare_view = cv::imread((views / "view_04.png").string());
  ASSERT_EQ(outlined_view.size(), cv::Size(4, 3));
  EXPECT_EQ(cv::norm(outlined_view, outlined(image, &cut), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(bare_view, cv::Mat(3, 4, CV_8UC3, cv::Scalar(30, 20, 10)), cv::NORM_INF), 0.0);
}

/// Two cells: something in one of them from the first view on, in the other from the second.
TEST(ObjectFlightRecorder, KeepsItsStoryAndSinceWhichViewTheMapHasWhat) {
  RoomRecorder room(false);
  OccupancyGrid map(GridFrame{.min_corner_m = {0.0, 0.0, 0.0},
                              .cell_size_m = Eigen::Vector3d::Constant(0.5),
                              .cells = {2, 1, 1}});
  map.log_odds = {3.0F, -3.0F};
  room.recorder.map(map);
  Decision decision;
  decision.candidates.resize(3);
  decision.chosen = 2;
  PlannedFlight way;
  way.path_m = {Eigen::Vector3d(1.0, 2.0, 3.0)};
  room.recorder.show(decision, way);
  map.log_odds[1] = 3.0F;
  room.recorder.map(map);
  room.recorder.commit();
  const VoxelMap voxels = read_voxels(room.folder.path() / "run/voxels.bin");
  ASSERT_EQ(voxels.voxels.size(), 2U);
  EXPECT_EQ(voxels.voxels[0].step, 0);
  EXPECT_EQ(voxels.voxels[1].step, 1);
  const std::vector<EpisodeEvent> story = read_event_log(room.folder.path() / "run/story.bin", 2);
  ASSERT_EQ(story.size(), 4U);
  EXPECT_TRUE(std::holds_alternative<MapChange>(story[0].what));
  ASSERT_TRUE(std::holds_alternative<Decision>(story[1].what));
  EXPECT_EQ(std::get<Decision>(story[1].what).chosen, 2U);
  ASSERT_TRUE(std::holds_alternative<PlannedFlight>(story[2].what));
  EXPECT_EQ(std::get<PlannedFlight>(story[2].what).path_m, way.path_m);
  EXPECT_TRUE(std::holds_alternative<MapChange>(story[3].what));
  EXPECT_TRUE(std::filesystem::exists(room.folder.path() / "run/scene.bin"));
}

TEST(ObjectFlightRecorder, ShowsHowFarTheFlightHasCome) {
  if (!support::has_terminals()) GTEST_SKIP() << "no /dev/pts here";
  RoomRecorder room(true);
  ObservationRecord record;
  record.time_s = 12.5;
  record.estimate = "mug_1";
  record.map_probability = 0.75;
  const auto shown = [&](std::size_t number) {
    return support::shown_progress(
        [&] { room.recorder.observation(record, number, small_image(), std::nullopt); });
  };
  EXPECT_THAT(shown(2), testing::HasSubstr(" 25 % view 2 of at most 8: mug_1 with probability "
                                           "0.75, 12.5 s simulated"));
  record.change = {0.25, Change::none};
  EXPECT_THAT(shown(6), testing::HasSubstr(" 75 % view 6 of at most 8: changed with probability "
                                           "0.25, 12.5 s simulated"));
}

}  // namespace
}  // namespace vantage
