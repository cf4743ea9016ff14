#include "vantage/perception/clouds/registration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/synthetic_room.hpp"

namespace vantage {
namespace {

using support::SyntheticScene;
using support::table_scene;
using support::view_of_table;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSigma = 0.005;
constexpr double kSensorHeight = 1.05;

/// What the robot measures from a pose, in its base frame: a tilting sector and a planar line.
PointCloud measure(const SyntheticScene& scene, const Pose2& T_world_base, double sigma_m,
                   Rng& rng) {
  const Pose T_base_sensor = make_pose({0, 0, kSensorHeight}, 0.0);
  const auto sector =
      support::sector_scan(scene, to_se3(T_world_base) * T_base_sensor, 600, sigma_m, rng);
  PointCloud cloud = transform(to_cloud(sector), T_base_sensor);
  append(cloud, to_cloud(support::floor_scan(scene, T_world_base, sigma_m, rng), 0.25));
  return prepare_scan(cloud, {0, 0, kSensorHeight}, RegistrationOptions{});
}

struct PoseError {
  double distance_m;
  double angle_rad;
};

PoseError error_of(const Pose2& estimate, const Pose2& truth) {
  return {std::hypot(estimate.x_m - truth.x_m, estimate.y_m - truth.y_m),
          std::abs(wrap_angle(estimate.yaw_rad - truth.yaw_rad))};
}

/// Up to 4 cm and 2 deg off, as odometry is.
Pose2 odometry(const Pose2& truth, Rng& rng) {
  const double bearing = rng.uniform(-std::numbers::pi, std::numbers::pi);
  const double distance_m = rng.uniform(0.0, 0.04);
  return {truth.x_m + distance_m * std::cos(bearing), truth.y_m + distance_m * std::sin(bearing),
          truth.yaw_rad + rng.uniform(-2.0, 2.0) * kDegree};
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

class TableRoom : public testing::Test {
 protected:
  PointCloud map_from(double angle_rad) {
    const Pose2 pose = view_of_table(angle_rad);
    return transform(measure(scene, pose, kSigma, rng), to_se3(pose));
  }
  SyntheticScene scene = table_scene();
  Rng rng{7};
  RegistrationOptions options;
};

// Fifty starts, each 36 to 180 deg further round the table than the one scan in the map.
TEST_F(TableRoom, AccurateFromAnyStart) {
  const PointCloud map = map_from(0.0);
  std::vector<double> distances;
  std::vector<double> angles;
  double min_overlap_seen = 1.0;
  int max_iterations_seen = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const double side = trial % 2 == 0 ? 1.0 : -1.0;
    const Pose2 truth = view_of_table(side * 36.0 * (1 + trial % 5) * kDegree);
    const PointCloud scan = measure(scene, truth, kSigma, rng);
    const auto result = register_scan(scan, map, odometry(truth, rng), options);
    ASSERT_TRUE(result.converged) << "trial " << trial << ": " << result.reason;
    EXPECT_EQ(result.unconstrained, 0);
    const PoseError error = error_of(result.T_world_base, truth);
    distances.push_back(error.distance_m);
    angles.push_back(error.angle_rad);
    min_overlap_seen = std::min(min_overlap_seen, result.overlap);
    max_iterations_seen = std::max(max_iterations_seen, result.iterations);
  }
  RecordProperty("rms_mm", std::to_string(1e3 * rms(distances)));
  RecordProperty("max_mm", std::to_string(1e3 * std::ranges::max(distances)));
  RecordProperty("rms_deg", std::to_string(rms(angles) / kDegree));
  RecordProperty("max_deg", std::to_string(std::ranges::max(angles) / kDegree));
  RecordProperty("least_overlap", std::to_string(min_overlap_seen));
  RecordProperty("most_iterations", max_iterations_seen);
  EXPECT_LT(rms(distances), 0.002);
  EXPECT_LT(std::ranges::max(distances), 0.004);
  EXPECT_LT(rms(angles), 0.1 * kDegree);
  EXPECT_LT(std::ranges::max(angles), 0.2 * kDegree);
}

// Seven scans round the table, each registered against all before it, as an episode does.
TEST_F(TableRoom, ErrorsDoNotAddUpAlongARun) {
  PointCloud map = map_from(0.0);
  for (int step = 1; step < 7; ++step) {
    const Pose2 truth = view_of_table(step * 3.0 * 36.0 * kDegree);
    const PointCloud scan = measure(scene, truth, kSigma, rng);
    const auto result = register_scan(scan, map, odometry(truth, rng), options);
    ASSERT_TRUE(result.converged) << "step " << step << ": " << result.reason;
    EXPECT_LT(error_of(result.T_world_base, truth).distance_m, 0.004) << "step " << step;
    append(map, transform(scan, to_se3(result.T_world_base)));
  }
}

TEST_F(TableRoom, ExactWithoutNoiseFromTheSamePlace) {
  const Pose2 truth = view_of_table(0.3);
  const PointCloud scan = measure(scene, truth, 0.0, rng);
  const PointCloud map = transform(scan, to_se3(truth));
  const Pose2 guess{truth.x_m + 0.03, truth.y_m - 0.02, truth.yaw_rad + 1.5 * kDegree};
  options.voxel_m = 1e-4;  // the same points on both sides
  const auto result = register_scan(scan, map, guess, options);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_EQ(result.unconstrained, 0);  // though the one wall ahead fills nine tenths of the scan
  EXPECT_LT(error_of(result.T_world_base, truth).distance_m, 1e-4);
  EXPECT_LT(error_of(result.T_world_base, truth).angle_rad, 1e-4);
  EXPECT_LT(result.rmse_m, 1e-4);
}

TEST_F(TableRoom, SameInputSameBits) {
  const PointCloud map = map_from(0.0);
  const Pose2 truth = view_of_table(1.0);
  const PointCloud scan = measure(scene, truth, kSigma, rng);
  const Pose2 guess = odometry(truth, rng);
  const auto first = register_scan(scan, map, guess, options);
  const auto second = register_scan(scan, map, guess, options);
  EXPECT_EQ(first.T_world_base.x_m, second.T_world_base.x_m);
  EXPECT_EQ(first.T_world_base.y_m, second.T_world_base.y_m);
  EXPECT_EQ(first.T_world_base.yaw_rad, second.T_world_base.yaw_rad);
}

TEST_F(TableRoom, WorksWithoutScanNormals) {
  const PointCloud map = map_from(0.0);
  const Pose2 truth = view_of_table(40.0 * kDegree);
  PointCloud scan = measure(scene, truth, kSigma, rng);
  scan.normals.clear();
  const auto result = register_scan(scan, map, odometry(truth, rng), options);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_LT(error_of(result.T_world_base, truth).distance_m, 0.01);
}

TEST_F(TableRoom, KeepsTheGuessWhenTheCorrectionIsTooLarge) {
  const PointCloud map = map_from(0.0);
  const Pose2 truth = view_of_table(0.0);
  const PointCloud scan = measure(scene, truth, kSigma, rng);
  const Pose2 guess{truth.x_m + 0.06, truth.y_m, truth.yaw_rad};
  options.max_correction_m = 0.03;
  const auto result = register_scan(scan, map, guess, options);
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.reason.find("moved 0.06"), std::string::npos) << result.reason;
  EXPECT_EQ(result.T_world_base.x_m, guess.x_m);
}

TEST_F(TableRoom, KeepsTheGuessWhenTheMapLiesElsewhere) {
  const PointCloud map = transform(map_from(0.0), make_pose({20, 0, 0}, 0.0));
  const Pose2 guess = view_of_table(0.0);
  const auto result = register_scan(measure(scene, guess, kSigma, rng), map, guess, options);
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.reason.find("only 0 points"), std::string::npos) << result.reason;
  EXPECT_EQ(result.T_world_base.yaw_rad, guess.yaw_rad);
}

TEST_F(TableRoom, KeepsTheGuessWhenOverlapIsTooSmall) {
  const PointCloud map = map_from(0.0);
  const Pose2 truth = view_of_table(2.0);
  options.min_overlap = 0.99;
  const auto result =
      register_scan(measure(scene, truth, kSigma, rng), map, odometry(truth, rng), options);
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.reason.find("overlap"), std::string::npos) << result.reason;
}

TEST_F(TableRoom, KeepsTheGuessWhenIterationsRunOut) {
  const PointCloud map = map_from(0.0);
  const Pose2 truth = view_of_table(2.0);
  options.max_iterations = 3;
  const auto result =
      register_scan(measure(scene, truth, kSigma, rng), map, odometry(truth, rng), options);
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.reason.find("3 iterations"), std::string::npos) << result.reason;
}

TEST_F(TableRoom, EmptyMapOrScan) {
  const Pose2 guess = view_of_table(0.0);
  const PointCloud scan = measure(scene, guess, kSigma, rng);
  EXPECT_EQ(register_scan(scan, {}, guess, options).reason, "the map has no upright surface");
  EXPECT_EQ(register_scan({}, transform(scan, to_se3(guess)), guess, options).reason,
            "the scan has no upright surface");
}

/// Points of the wall y = `y_m`, x in [-2, 2], z in [0, 1], facing the origin.
PointCloud wall_along_x(double y_m) {
  PointCloud wall;
  for (double x = -2.0; x <= 2.0; x += 0.03) {
    for (double z = 0.0; z <= 1.0; z += 0.05) {
      wall.points.emplace_back(x, y_m, z);
      wall.normals.emplace_back(0.0F, y_m > 0.0 ? -1.0F : 1.0F, 0.0F);
    }
  }
  return wall;
}

// A corridor: walls say y and yaw, nothing says x.
//     ===============   y = +1
//            o->
//     ===============   y = -1
TEST(Registration, ACorridorLeavesItsLengthToOdometry) {
  PointCloud corridor = wall_along_x(1.0);
  append(corridor, wall_along_x(-1.0));
  const Pose2 guess{0.05, 0.03, 1.0 * kDegree};
  const auto result = register_scan(corridor, corridor, guess, RegistrationOptions{});
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_EQ(result.unconstrained, 1);
  EXPECT_NEAR(result.T_world_base.x_m, 0.05, 2e-3);
  EXPECT_NEAR(result.T_world_base.y_m, 0.0, 5e-4);
  EXPECT_NEAR(result.T_world_base.yaw_rad, 0.0, 5e-4);
}

TEST(Registration, TellsWhatItKnowsAndWhatNot) {
  PointCloud corridor = wall_along_x(1.0);
  append(corridor, wall_along_x(-1.0));
  const auto result = register_scan(corridor, corridor, {}, RegistrationOptions{});
  const Eigen::Matrix3d& information = result.information;
  EXPECT_NEAR(information(0, 0), 0.0, 1e-6 * information(1, 1)) << "nothing is seen across";
  // Each pair is good to 3 cm; of those kept every normal is along y.
  const double pairs = information(1, 1) * 0.03 * 0.03;
  EXPECT_GT(pairs, 0.85 * static_cast<double>(corridor.size()));
  EXPECT_LT(pairs, static_cast<double>(corridor.size()));
  EXPECT_TRUE(register_scan({}, corridor, {}, RegistrationOptions{}).information.isZero());
}

/// A wall across the way, and a scan of it most of which stands 1 cm before it, the rest 4 cm; one
/// step in closed form.
class OneStep : public testing::Test {
 protected:
  OneStep() {
    for (int i = -30; i <= 30; ++i) {
      const auto y = static_cast<float>(0.05 * i);
      wall_.points.emplace_back(2.0F, y, 0.5F);
      wall_.normals.emplace_back(-1.0F, 0.0F, 0.0F);
      const bool odd = i % 10 == 0;
      scan_.points.emplace_back(odd ? 1.96F : 1.99F, y, 0.5F);
      ++(odd ? far_ : near_);
    }
    options_.min_correspondence_m = options_.max_correspondence_m = 0.06;
    options_.tolerance_m = options_.tolerance_rad = 1.0;  // at rest after any step
    options_.trim_fraction = 1.0;
  }
  [[nodiscard]] RegistrationResult step() const {
    return register_scan(scan_, wall_, {}, options_);
  }

  PointCloud wall_;
  PointCloud scan_;
  int near_ = 0;
  int far_ = 0;
  RegistrationOptions options_;
};

TEST_F(OneStep, WeighsPairsByTheKernelOfGemanAndMcClure) {
  options_.kernel_scale_m = 0.03;
  const auto weight = [](double residual_m) {
    const double ratio = residual_m / 0.03;
    return 1.0 / std::pow(1.0 + ratio * ratio, 2);
  };
  const double near = near_ * weight(0.01);
  const double far = far_ * weight(0.04);
  const auto result = step();
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_EQ(result.iterations, 1);
  EXPECT_NEAR(result.T_world_base.x_m, (0.01 * near + 0.04 * far) / (near + far), 1e-5);
  EXPECT_NEAR(result.T_world_base.yaw_rad, 0.0, 1e-6);
}

TEST_F(OneStep, LeavesTheWorstPairsOut) {
  options_.kernel_scale_m = 100.0;
  const double all_m = (0.01 * near_ + 0.04 * far_) / (near_ + far_);
  EXPECT_NEAR(step().T_world_base.x_m, all_m, 1e-5);
  options_.trim_fraction = 0.85;  // there are 54 and 7
  EXPECT_NEAR(step().T_world_base.x_m, 0.01, 1e-5);
}

TEST_F(TableRoom, KeepsTheGuessWhereOdometryCannotHaveDriftedSoFar) {
  const PointCloud map = map_from(0.0);
  const Pose2 truth = view_of_table(0.0);
  const PointCloud scan = measure(scene, truth, kSigma, rng);
  const Pose2 guess{truth.x_m + 0.06, truth.y_m, truth.yaw_rad};
  const auto result = register_scan(scan, map, guess, options, {.shift_m = 0.03, .turn_rad = 0.1});
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.reason.find("odometry explains 0.030 m"), std::string::npos) << result.reason;
  EXPECT_EQ(result.T_world_base.x_m, guess.x_m);
  EXPECT_TRUE(register_scan(scan, map, guess, options, {.shift_m = 0.1}).converged);
}

TEST(Registration, OnlyAFloorSaysNothing) {
  PointCloud floor;
  for (double x = -1.0; x <= 1.0; x += 0.05) {
    for (double y = -1.0; y <= 1.0; y += 0.05) {
      floor.points.emplace_back(x, y, 0.0);
      floor.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  const auto result = register_scan(floor, floor, {0.02, 0.0, 0.0}, RegistrationOptions{});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.T_world_base.x_m, 0.02);
}

TEST(Registration, OptionsAreChecked) {
  RegistrationOptions options;
  EXPECT_NO_THROW(check_options(options));
  options.min_correspondence_m = 1.0;
  EXPECT_THROW(check_options(options), ConfigError);
}

}  // namespace
}  // namespace vantage
