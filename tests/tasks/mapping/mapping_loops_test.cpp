// What mapping parts make of loops: records that move, how sure poses are, and doubts of the map.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/localisation/plan_world.hpp"
#include "tests/tasks/mapping/still_table.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"

namespace vantage {
namespace {

using support::AtStillTable;
using support::still_table;

/// In the parts' memory: a room of 8 x 6 m from five places, tracked 0.7 m apart and 0.6 m apart
/// by the wheels and by what is seen.
const LoopClosing& with_loops(AtStillTable& at) {
  std::vector<test_plan::Segment> walls;
  test_plan::add_box(walls, -4.0, -3.0, 4.0, 3.0);
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  Rng rng(5);
  const auto tracked = [](int i) { return Pose2{0.7 * i, 0.0, 0.0}; };
  Navigator& navigator = at.parts.navigator_;
  at.table.robot.T_world_base = tracked(0);
  navigator.close_loops({.close = true, .min_way_m = 0.9}, registration, {});
  for (int i = 0; i < 5; ++i) {
    if (i > 0) {
      at.table.robot.T_world_base = compose(tracked(i - 1), {0.6, 0.0, 0.0});
      navigator.correct_pose(tracked(i), Eigen::Matrix3d::Zero());
    }
    PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 30.0};
    for (int beam = -540; beam <= 540; ++beam) {
      const double yaw_rad = 0.00436 * beam;
      const double range_m =
          test_plan::range_m(walls, {0.6 * i - 1.2, 0.0}, {std::cos(yaw_rad), std::sin(yaw_rad)});
      scan.azimuth_rad.push_back(yaw_rad);
      scan.range_m.push_back(static_cast<float>(range_m + 0.01 * rng.normal()));
    }
    navigator.remember(scan, tracked(i));
  }
  return *navigator.loops();
}

/// Of the corners of the map, or of what is 2 m away on the way to them, RMS.
double sigma_of_map_m(const MapBelief& belief, const Pose2& base,
                      const Eigen::Matrix3d& covariance) {
  const Eigen::AlignedBox3d region = belief.grid().frame.box();
  double sum_m2 = 0.0;
  for (const double x_m : {region.min().x(), region.max().x()}) {
    for (const double y_m : {region.min().y(), region.max().y()}) {
      Eigen::Vector2d way_m = Eigen::Vector2d(x_m, y_m) - position(base);
      if (way_m.norm() > 2.0) way_m *= 2.0 / way_m.norm();
      sum_m2 += std::pow(mapped_sigma_m(base, covariance, position(base) + way_m), 2);
    }
  }
  return std::sqrt(0.25 * sum_m2);
}

double pose_sigma_m(const Eigen::Matrix3d& covariance) {
  return std::sqrt(covariance(0, 0) + covariance(1, 1));
}

TEST(MappingLoops, ThatAgreeMakeTheMapAsSureAsThey) {
  AtStillTable at(still_table().task);
  at.parts.scans_.resize(2);
  at.parts.scans_[0].map_sigma_m = 5.0;
  at.parts.scans_[0].keyframe = 4;
  at.parts.scans_[0].T_world_base = {2.8, 0.0, 0.5};
  at.parts.scans_[1].map_sigma_m = 1e-9;
  at.parts.scans_[1].keyframe = 1;
  at.parts.note_agreeing_loops();
  EXPECT_EQ(at.parts.scans_[0].map_sigma_m, 5.0) << "no loops are looked for";
  const LoopClosing& loops = with_loops(at);
  ASSERT_GT(loops.graph().loops(), 0U);
  const double off_m = loops.disagreement_m();
  ASSERT_GT(off_m, 0.1);
  const auto covariances = loops.graph().covariances(std::array<std::size_t, 2>{4, 1});
  at.parts.note_agreeing_loops();
  const ScanRecord& first = at.parts.scans_[0];
  const double by_loops_m =
      std::hypot(off_m, sigma_of_map_m(at.belief, first.T_world_base, covariances[0]));
  ASSERT_LT(by_loops_m, 5.0);
  EXPECT_NEAR(first.map_sigma_m, by_loops_m, 1e-9);
  EXPECT_NEAR(first.pose_sigma_m, pose_sigma_m(covariances[0]), 1e-12);
  EXPECT_EQ(at.parts.scans_[1].map_sigma_m, 1e-9) << "it was surer";
  EXPECT_NEAR(at.parts.scans_[1].pose_sigma_m, pose_sigma_m(covariances[1]), 1e-12);
}

TEST(MappingLoops, MoveAllRecordsAndWhatWasIntended) {
  AtStillTable at(still_table().task);
  const LoopClosing& loops = with_loops(at);
  PoseCorrection correction;
  for (int i = 0; i < 5; ++i) {
    correction.T_world_before.push_back({0.7 * i, 0.0, 0.0});
    correction.T_world_after.push_back({0.6 * i, 0.1 * i, 0.05 * i});
  }
  const Pose T_base_sensor = make_pose({0.1, 0.0, 1.0}, 0.0);
  at.parts.scans_.resize(2);
  const std::array records{&at.parts.scans_[0], &at.parts.scans_[1], &at.parts.current_};
  for (std::size_t i = 0; i < 3; ++i) {
    records[i]->keyframe = i + 1;
    records[i]->T_world_base = {1.0, 0.25, 0.5};
  }
  at.parts.intended_m_ = Eigen::Vector2d(2.0, 1.0);
  const auto expect_moved = [&](const ScanRecord& record) {
    const Pose2 moved = correction.moved(Pose2{1.0, 0.25, 0.5}, record.keyframe);
    EXPECT_NEAR(record.T_world_base.x_m, moved.x_m, 1e-12);
    EXPECT_NEAR(record.T_world_base.y_m, moved.y_m, 1e-12);
    EXPECT_NEAR(record.T_world_base.yaw_rad, moved.yaw_rad, 1e-12);
    EXPECT_TRUE(record.T_world_sensor.isApprox(to_se3(moved) * T_base_sensor, 1e-12));
    const auto covariance =
        loops.graph().covariances(std::array<std::size_t, 1>{record.keyframe}).front();
    EXPECT_NEAR(record.pose_sigma_m, pose_sigma_m(covariance), 1e-9);
    EXPECT_NEAR(record.map_sigma_m, sigma_of_map_m(at.belief, moved, covariance), 1e-9);
  };
  const auto moved_m = [&](std::size_t keyframe) {
    const Pose2 moved = correction.moved(Pose2{1.0, 0.25, 0.5}, keyframe);
    return std::hypot(moved.x_m - 1.0, moved.y_m - 0.25);
  };
  ASSERT_GT(moved_m(2), moved_m(1) + 0.001);
  ASSERT_GT(moved_m(3), moved_m(2) + 0.001);
  const int restarts = at.table.robot.restarts;
  const auto log = at.table.folder / "corrections.txt";
  log_to_file(log);
  at.parts.correct_records(correction, T_base_sensor, false);
  expect_moved(at.parts.scans_[0]);
  expect_moved(at.parts.scans_[1]);
  EXPECT_EQ(at.parts.current_.T_world_base.x_m, 1.0) << "there is no scan under way";
  EXPECT_EQ(at.parts.current_.unobserved_cells, 0U);
  const Eigen::Vector2d intended_m = correction.moved(Eigen::Vector2d(2.0, 1.0), 2);
  ASSERT_TRUE(at.parts.intended_m_);
  EXPECT_NEAR((*at.parts.intended_m_ - intended_m).norm(), 0.0, 1e-12);
  EXPECT_EQ(at.table.robot.restarts, restarts + 1);
  for (std::size_t i = 0; i < 2; ++i) records[i]->T_world_base = {1.0, 0.25, 0.5};
  at.parts.correct_records(correction, T_base_sensor, true);
  log_to_file({});
  for (const ScanRecord* record : records) expect_moved(*record);
  const std::string said = read_file(log);
  const std::string most = ": back at a place of before: poses corrected by up to {:.3f} m";
  for (const std::string& line :
       {fmt::format(fmt::runtime("after the last scan" + most), moved_m(2)),
        fmt::format(fmt::runtime("scan 3" + most), moved_m(3))}) {
    EXPECT_NE(said.find(line), std::string::npos) << line << "\n" << said;
  }
  EXPECT_EQ(at.parts.current_.unobserved_cells, at.belief.grid().size());
}

TEST(MappingLoops, AreSummedUp) {
  Tabletop task = still_table().task;
  task.localisation.tolerance_cells = 1e6;
  task.localisation.max_contradicted = 1.0;
  AtStillTable at(task);
  at.parts.scans_.resize(3);
  const LocalisationSummary none = at.parts.localisation();
  EXPECT_FALSE(none.contradicted_share);
  EXPECT_EQ(none.pose_sigma_m, 0.0);
  const LoopClosing& loops = with_loops(at);
  const std::array<std::size_t, 3> keyframes{2, 4, 0};
  for (std::size_t i = 0; i < 3; ++i) at.parts.scans_[i].keyframe = keyframes[i];
  const LocalisationSummary summary = at.parts.localisation();
  EXPECT_EQ(summary.loops, loops.graph().loops());
  EXPECT_GT(summary.loops, 0U);
  EXPECT_EQ(summary.loops_refused, loops.graph().refused());
  EXPECT_EQ(summary.corrections, 0U);
  ASSERT_TRUE(summary.contradicted_share);
  EXPECT_EQ(*summary.contradicted_share, loops.contradicted_share());
  const auto covariances = loops.graph().covariances(keyframes);
  double most_m = 0.0;
  for (const auto& covariance : covariances) most_m = std::max(most_m, pose_sigma_m(covariance));
  EXPECT_GT(most_m, 0.0);
  EXPECT_NEAR(summary.pose_sigma_m, most_m, 1e-12);
  EXPECT_EQ(summary.doubt, "");
}

/// A wall ahead that is seen twice from one place, and one behind it that is seen from there too.
std::string doubt_before_walls(const LocalisationOptions& options, double* share = nullptr) {
  Tabletop task = still_table().task;
  task.localisation = options;
  AtStillTable at(task);
  at.table.robot.T_world_base = {};
  at.parts.navigator_.close_loops({}, {}, {});
  for (const double distance_m : {2.02, 2.02, 4.02}) {
    PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 10.0};
    for (int i = -50; i <= 50; ++i) {
      scan.azimuth_rad.push_back(0.01 * i);
      scan.range_m.push_back(static_cast<float>(distance_m / std::cos(0.01 * i)));
    }
    at.parts.navigator_.remember(scan, {});
  }
  at.parts.scans_.resize(1);
  at.parts.scans_[0].keyframe = 2;
  const LocalisationSummary summary = at.parts.localisation();
  if (share != nullptr) *share = summary.contradicted_share.value_or(0.0);
  return summary.doubt;
}

TEST(MappingLoops, LeaveTheMapInDoubtWhereWallsAreDrawnTwiceOrPosesAreUnsure) {
  LocalisationOptions options;
  options.tolerance_cells = 1e6;
  options.max_contradicted = 1.0;
  double share = 0.0;
  EXPECT_EQ(doubt_before_walls(options, &share), "");
  ASSERT_GT(share, 0.2);
  options.max_contradicted = share;
  EXPECT_EQ(doubt_before_walls(options), "") << "no more than it may be";
  options.max_contradicted = 0.99 * share;
  EXPECT_NE(doubt_before_walls(options).find("localisation.max_contradicted"), std::string::npos);
  options.max_contradicted = 1.0;
  options.tolerance_cells = 1e-9;
  EXPECT_NE(doubt_before_walls(options).find("localisation.tolerance_cells"), std::string::npos);
}

TEST(MappingLoops, AreNotNeededToDoubtAMapThatScansDoNotFit) {
  Tabletop task = still_table().task;
  task.localisation.max_unregistered = 0.4;
  AtStillTable at(task);
  at.parts.scans_.resize(5);
  at.parts.scans_[1].registered = at.parts.scans_[4].registered = false;
  EXPECT_EQ(at.parts.localisation().doubt, "") << "no more than may be";
  at.parts.scans_[0].registered = false;
  const std::string doubt = at.parts.localisation().doubt;
  EXPECT_NE(doubt.find("3 of 5 scans fit nowhere"), std::string::npos) << doubt;
  EXPECT_NE(doubt.find("localisation.max_unregistered"), std::string::npos) << doubt;
  at.parts.scans_tell_pose_ = false;
  EXPECT_EQ(at.parts.localisation().doubt, "") << "there is nothing to fit to";
}

TEST(MappingLoops, MakeTheMapsOfTheNavigatorAnew) {
  AtStillTable at(still_table().task);
  const LoopClosing& loops = with_loops(at);
  Navigator& navigator = at.parts.navigator_;
  // The wall at the far end of the room, 5.2 m from the first place, is seen 0.1 m farther off from
  // each of the tracked ones.
  const auto occupied = [&](double from_m, double to_m) {
    int cells = 0;
    for (double x_m = from_m; x_m < to_m; x_m += 0.01) {
      cells += navigator.floor().state_at({x_m, 0.02}) == CellState::occupied ? 1 : 0;
    }
    return cells;
  };
  ASSERT_GT(occupied(5.5, 5.7), 0);
  const auto correction = navigator.correct_over_loops();
  ASSERT_TRUE(correction);
  EXPECT_EQ(correction->T_world_before.size(), 5U);
  EXPECT_EQ(occupied(5.4, 5.9), 0);
  EXPECT_GT(occupied(5.1, 5.3), 0);
  EXPECT_EQ(navigator.floor().state_at({1.0, 0.02}), CellState::free);
  const auto covariance = loops.graph().covariances(std::array<std::size_t, 1>{4}).front();
  EXPECT_TRUE(navigator.uncertainty().covariance().isApprox(covariance, 1e-9));
  at.parts.scans_.resize(1);
  EXPECT_EQ(at.parts.localisation().corrections, 1U);
  EXPECT_FALSE(navigator.correct_over_loops()) << "all is where it belongs";
}

}  // namespace
}  // namespace vantage
