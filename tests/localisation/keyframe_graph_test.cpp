// A robot in a corridor loop: how far it drifts, how sure it is, and what coming back does to both.
#include "vantage/localisation/keyframe_graph.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/localisation/plan_world.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using namespace test_plan;

RegistrationOptions registration() {
  RegistrationOptions options;
  options.normals.radius_m = 0.25;
  return options;
}

/// Drives along `way` in the world of `walls`, closing loops.
struct Drive {
  std::vector<Pose2> truth;
  KeyframeGraph graph;
  std::vector<double> sigma_m;  ///< of the last keyframe, after each step

  Drive(const std::vector<Segment>& walls, std::vector<Pose2> way, std::uint64_t seed,
        const LoopOptions& loops = {.close = true})
      : truth(std::move(way)), graph(loops, registration()) {
    Rng rng(seed);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const PointCloud seen = scan(walls, truth[i], 0.01, rng, registration());
      if (i == 0) {
        graph.begin(seen, truth[0]);
        continue;
      }
      graph.add(seen, wheels(truth[i - 1], truth[i], rng));
      graph.close_loops();
    }
  }
  [[nodiscard]] Eigen::Vector2d off_m(std::size_t keyframe) const {
    const Pose2& found = graph.T_world_bases()[keyframe];
    return {found.x_m - truth[keyframe].x_m, found.y_m - truth[keyframe].y_m};
  }
  [[nodiscard]] double worst() const { return worst_m(graph.T_world_bases(), truth); }
  [[nodiscard]] Eigen::Matrix3d covariance(std::size_t keyframe) const {
    return graph.covariances(std::array{keyframe}).front();
  }
};

/// Once round and 10 m more.
std::vector<Pose2> once_round_and_on() {
  auto way = way_round(15.0, 28.0, 2.0, 2);
  way.resize(way.size() / 2 + 20);
  return way;
}

TEST(KeyframeGraph, PosesAlongPlainWallsAreUnsureAlongThem) {
  std::vector<Segment> walls;
  add_box(walls, -50.0, -1.0, 50.0, 1.0);
  std::vector<Pose2> way;
  for (int i = 0; i < 24; ++i) way.push_back({0.5 * i, 0.0, 0.0});
  const Drive drive(walls, way, 1);
  const Eigen::Matrix3d covariance = drive.covariance(23);
  // 11.5 m by the wheels alone, 3 % of the root of each metre.
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), 0.03 * std::sqrt(11.5), 0.02);
  EXPECT_LT(std::sqrt(covariance(1, 1)), 0.03);
  EXPECT_NEAR(drive.graph.T_world_bases().back().y_m, 0.0, 0.05);
}

TEST(KeyframeGraph, ACornerMakesSure) {
  std::vector<Segment> walls;
  add_box(walls, -6.0, -1.0, 6.0, 8.0);
  std::vector<Pose2> way;
  for (int i = 0; i < 10; ++i) way.push_back({-4.0 + 0.5 * i, 0.0, 0.0});
  const Eigen::Matrix3d covariance = Drive(walls, way, 1).covariance(9);
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.015);
  EXPECT_LT(std::sqrt(covariance(1, 1)), 0.02);
}

/// Where the robot is back it knows where it is. How long the corridors are, only its wheels tell:
/// it is no surer of its poses on the way than it may be.
TEST(KeyframeGraph, ALoopIsClosedAndItsPosesCorrected) {
  const auto walls = ring(15.0, 28.0, 2.0);
  double drifted_m = 0.0;
  for (std::uint64_t seed = 2; seed < 6; ++seed) {
    const Drive drifted(walls, once_round_and_on(), seed, {.close = false});
    const Drive closed(walls, once_round_and_on(), seed);
    EXPECT_EQ(drifted.graph.loops(), 0U);
    EXPECT_GE(closed.graph.loops(), 8U) << seed;
    EXPECT_EQ(closed.graph.refused(), 0U) << seed;
    const std::size_t last = closed.graph.size() - 1;
    drifted_m = std::max(drifted_m, drifted.off_m(last).norm());
    EXPECT_LT(closed.off_m(last).norm(), 0.06) << seed;
    EXPECT_LT(closed.covariance(last)(0, 0), 0.1 * drifted.covariance(last)(0, 0));
    for (std::size_t i = 20; i < last; i += 20) {
      const Eigen::Vector2d off_m = closed.off_m(i);
      const Eigen::Matrix2d covariance = closed.covariance(i).topLeftCorner<2, 2>();
      EXPECT_LT(off_m.dot(covariance.inverse() * off_m), 9.2) << seed << ", 99 % of two: " << i;
    }
  }
  EXPECT_GT(drifted_m, 0.3);
}

/// A second corner that looks like the first, where the robot believes the first to be: its wheels
/// tell it so, and nothing else is seen. One loop is found and none confirms it.
TEST(KeyframeGraph, NoLoopAcrossPlacesThatOnlyLookAlike) {
  // Two rooms of one shape, 40 m apart, seen from the same places in them.
  std::vector<Segment> walls;
  add_box(walls, -3.0, -2.0, 3.0, 2.0);
  add_box(walls, 37.0, -2.0, 43.0, 2.0);
  std::vector<Pose2> way;
  for (int i = 0; i < 9; ++i) way.push_back({-2.0 + 0.5 * i, 0.0, 0.0});
  for (int i = 0; i < 9; ++i) way.push_back({38.0 + 0.5 * i, 0.0, 0.0});
  const Drive drive(walls, way, 3);
  EXPECT_EQ(drive.graph.loops(), 0U) << "40 m away, it cannot be the same place";
  EXPECT_LT(drive.worst(), 0.5);
}

TEST(KeyframeGraph, ALoopThatNoOtherConfirmsIsNotTaken) {
  const auto walls = ring(15.0, 28.0, 2.0);
  const Drive drive(walls, once_round_and_on(), 2,
                    {.close = true, .agreement_m = 1e-9, .agreement_rad = 1e-9});
  EXPECT_EQ(drive.graph.loops(), 0U);
  EXPECT_GT(drive.graph.refused(), 0U);
}

TEST(KeyframeGraph, RepeatsToTheBit) {
  const auto walls = ring(15.0, 28.0, 2.0);
  const Drive one(walls, once_round_and_on(), 4);
  const Drive other(walls, once_round_and_on(), 4);
  EXPECT_EQ(one.graph.T_world_bases().back().x_m, other.graph.T_world_bases().back().x_m);
  EXPECT_EQ(one.graph.T_world_bases().back().yaw_rad, other.graph.T_world_bases().back().yaw_rad);
}

TEST(LoopOptions, AreChecked) {
  LoopOptions options;
  options.min_way_m = 0.0;
  EXPECT_THROW(KeyframeGraph(options, registration()), ConfigError);
}

}  // namespace
}  // namespace vantage
