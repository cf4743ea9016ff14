// Poses from relative measurements: known answers, and how sure they are.
#include "vantage/localisation/pose_graph.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

/// Four sides of 10 m with a quarter turn each, back to the first pose.
struct Square {
  std::vector<Pose2> truth{{0, 0, 0},
                           {10, 0, std::numbers::pi / 2},
                           {10, 10, std::numbers::pi},
                           {0, 10, -std::numbers::pi / 2}};
  std::vector<PoseEdge> way;
  PoseEdge back;

  /// @param error of the last side, which brings the robot back to the start
  explicit Square(const Pose2& error) {
    const Eigen::Matrix3d sure = Eigen::Vector3d(100.0, 100.0, 1e8).asDiagonal();
    for (std::size_t i = 0; i < 3; ++i) {
      way.push_back({i, i + 1, compose(inverse(truth[i]), truth[i + 1]), sure});
    }
    back = {3, 0, compose(compose(inverse(truth[3]), truth[0]), error), sure};
  }
  [[nodiscard]] std::vector<PoseEdge> edges() const {
    std::vector<PoseEdge> all = way;
    all.push_back(back);
    return all;
  }
};

TEST(PoseGraph, ASquareThatClosesStaysAsItIs) {
  const Square square({});
  std::vector<Pose2> poses = square.truth;
  ASSERT_TRUE(optimise_pose_graph(poses, square.edges()));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(poses[i].x_m, square.truth[i].x_m, 1e-9);
    EXPECT_NEAR(poses[i].y_m, square.truth[i].y_m, 1e-9);
  }
}

/// Headings are as good as known, positions alike: the gap of (0.4, 0) in the world is shared by
/// the four sides, a quarter each.
TEST(PoseGraph, ADriftIsSharedByTheSidesOfALoop) {
  // The last pose heads along -y: its y axis is the world's x.
  const Square square({});
  PoseEdge back = square.back;
  back.T_from_to.y_m += 0.4;
  std::vector<PoseEdge> edges = square.way;
  edges.push_back(back);
  std::vector<Pose2> poses = square.truth;
  ASSERT_TRUE(optimise_pose_graph(poses, edges));
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(poses[i].x_m - square.truth[i].x_m, -0.1 * static_cast<double>(i), 2e-3) << i;
    EXPECT_NEAR(poses[i].y_m - square.truth[i].y_m, 0.0, 2e-3) << i;
  }
}

TEST(PoseGraph, WhatAnEdgeDoesNotTellIsLeftToTheOthers) {
  std::vector<Pose2> poses{{0, 0, 0}, {0, 0, 0}};
  const Eigen::Matrix3d all = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  across(1, 1) = 1e6;  // of y alone
  const std::vector<PoseEdge> edges{{0, 1, {1.0, 0.2, 0.1}, all}, {0, 1, {5.0, 0.0, 1.0}, across}};
  ASSERT_TRUE(optimise_pose_graph(poses, edges));
  EXPECT_NEAR(poses[1].x_m, 1.0, 1e-6);
  EXPECT_NEAR(poses[1].y_m, 0.0, 1e-5);
  EXPECT_NEAR(poses[1].yaw_rad, 0.1, 1e-6);
}

/// Of a straight chain: variances add up, and a heading counts by its lever.
TEST(PoseGraph, CovariancesOfAChainAddUp) {
  const Eigen::Vector3d variance(1e-4, 4e-4, 1e-6);
  const Eigen::Matrix3d information = variance.cwiseInverse().asDiagonal();
  std::vector<Pose2> poses;
  std::vector<PoseEdge> edges;
  for (std::size_t i = 0; i < 5; ++i) {
    poses.push_back({static_cast<double>(i), 0.0, 0.0});
    if (i > 0) edges.push_back({i - 1, i, {1.0, 0.0, 0.0}, information});
  }
  const auto covariance = pose_covariances(poses, edges, std::array<std::size_t, 2>{0, 4});
  EXPECT_TRUE(covariance[0].isZero());
  EXPECT_NEAR(covariance[1](0, 0), 4e-4, 1e-10);
  EXPECT_NEAR(covariance[1](1, 1), 4 * 4e-4 + 1e-6 * (9 + 4 + 1), 1e-9);
  EXPECT_NEAR(covariance[1](2, 2), 4e-6, 1e-12);
}

TEST(PoseGraph, ALoopMakesSurer) {
  const Square square({});
  const std::array<std::size_t, 1> third{2};
  const double open = pose_covariances(square.truth, square.way, third).front().trace();
  const double closed = pose_covariances(square.truth, square.edges(), third).front().trace();
  EXPECT_NEAR(closed / open, 0.5, 0.05) << "two ways there, as good as each other";
}

TEST(PoseGraph, WhatNothingTiesDownIsUnsure) {
  const std::vector<Pose2> poses{{0, 0, 0}, {1, 0, 0}};
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  across(1, 1) = 1.0;
  const std::vector<PoseEdge> edges{{0, 1, {1, 0, 0}, across}};
  const auto covariance = pose_covariances(poses, edges, std::array<std::size_t, 1>{1});
  EXPECT_TRUE(std::isinf(covariance.front()(0, 0)));
}

TEST(PoseGraph, RepeatsToTheBit) {
  Rng rng(3);
  std::vector<Pose2> truth{{0, 0, 0}};
  std::vector<PoseEdge> edges;
  for (std::size_t i = 1; i < 60; ++i) {
    const Pose2 step{0.5 + 0.01 * rng.normal(), 0.01 * rng.normal(), 0.1};
    truth.push_back(compose(truth.back(), step));
    edges.push_back({i - 1, i, step, Eigen::Matrix3d::Identity() * 1e4});
  }
  edges.push_back({0, 59, {0.1, 0.2, -0.3}, Eigen::Matrix3d::Identity() * 1e4});
  std::vector<Pose2> one = truth;
  std::vector<Pose2> other = truth;
  optimise_pose_graph(one, edges);
  optimise_pose_graph(other, edges);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(one[i].x_m, other[i].x_m);
    EXPECT_EQ(one[i].yaw_rad, other[i].yaw_rad);
  }
}

TEST(PoseGraph, AnErrorIsWhatThePosesSayBeyondTheMeasurement) {
  const std::vector<Pose2> poses{{9, 9, 9}, {1.0, 2.0, 0.3}, {4.0, -1.0, 2.9}};
  const Eigen::Vector3d error =
      edge_error({1, 2, {1.5, -0.5, -3.0}, Eigen::Matrix3d::Identity()}, poses);
  EXPECT_NEAR(error.x(), 0.4794488473927996, 1e-12);
  EXPECT_NEAR(error.y(), -3.2525700873608367, 1e-12);
  EXPECT_NEAR(error.z(), 5.6 - 2.0 * std::numbers::pi, 1e-12);
}

/// J^T J by differences of the errors, of all poses but the first.
Eigen::MatrixXd differenced(const std::vector<Pose2>& poses, const std::vector<PoseEdge>& edges) {
  constexpr double kStep = 1e-5;
  const auto unknowns = static_cast<Eigen::Index>(3 * (poses.size() - 1));
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (const PoseEdge& edge : edges) {
    Eigen::MatrixXd jacobian(3, unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const auto moved = [&](double by) {
        std::vector<Pose2> there = poses;
        Pose2& pose = there[static_cast<std::size_t>(i / 3 + 1)];
        (i % 3 == 0 ? pose.x_m : i % 3 == 1 ? pose.y_m : pose.yaw_rad) += by;
        return edge_error(edge, there);
      };
      jacobian.col(i) = (moved(kStep) - moved(-kStep)) / (2.0 * kStep);
    }
    normal += jacobian.transpose() * edge.information * jacobian;
  }
  return normal;
}

TEST(PoseGraph, CovariancesAreThoseOfTheErrorsLinearised) {
  const std::vector<Pose2> poses{{0.5, -1, 0.2}, {1.5, 2, 0.7}, {4, 1, -0.9}, {3, -2, 2.1}};
  Eigen::Matrix3d information;
  information << 40, 7, -3, 7, 90, 11, -3, 11, 200;
  const std::vector<PoseEdge> edges{
      {0, 1, {1.1, 2.7, 0.4}, information},
      {1, 2, {1.5, -2.3, -1.5}, 2.0 * information},
      {2, 3, {1.6, -2.6, 3.1}, Eigen::Vector3d(30, 50, 70).asDiagonal()},
      {3, 0, {1.9, 1.6, -1.8}, 0.5 * information}};
  const Eigen::MatrixXd expected = differenced(poses, edges).inverse();
  const auto found = pose_covariances(poses, edges, std::array<std::size_t, 4>{3, 0, 1, 2});
  EXPECT_TRUE(found[1].isZero());
  const std::array<Eigen::Index, 4> rows{6, -1, 0, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == 1) continue;
    const Eigen::Matrix3d block = expected.block<3, 3>(rows[i], rows[i]);
    EXPECT_LT((found[i] - block).norm(), 1e-6 * block.norm()) << i;
  }
}

TEST(PoseGraph, HeadingsAreWrappedAndTheFirstPoseStays) {
  std::vector<Pose2> poses{{1.0, 2.0, 3.0}, {0.0, 0.0, 0.0}};
  const Pose2 step{0.6, -0.4, 0.5};
  ASSERT_TRUE(optimise_pose_graph(
      poses, std::vector<PoseEdge>{{0, 1, step, Eigen::Vector3d(9, 16, 25).asDiagonal()}}));
  EXPECT_EQ(poses[0].x_m, 1.0);
  EXPECT_EQ(poses[0].y_m, 2.0);
  EXPECT_EQ(poses[0].yaw_rad, 3.0);
  const Pose2 there = compose(poses[0], step);
  EXPECT_NEAR(poses[1].x_m, there.x_m, 1e-6);
  EXPECT_NEAR(poses[1].y_m, there.y_m, 1e-6);
  EXPECT_NEAR(poses[1].yaw_rad, 3.5 - 2.0 * std::numbers::pi, 1e-6);
}

TEST(PoseGraph, OfOnePoseIsAtRest) {
  std::vector<Pose2> one{{1.0, 2.0, 3.0}};
  EXPECT_TRUE(optimise_pose_graph(one, {}));
  EXPECT_EQ(one[0].yaw_rad, 3.0);
  const auto covariances = pose_covariances(one, {}, std::array<std::size_t, 1>{0});
  ASSERT_EQ(covariances.size(), 1U);
  EXPECT_TRUE(covariances[0].isZero());
}

TEST(PoseGraph, AnEdgeMayLeadBackwards) {
  const std::vector<Pose2> poses{{0.5, -1, 0.2}, {1.5, 2, 0.7}, {4, 1, -0.9}};
  Eigen::Matrix3d information;
  information << 40, 7, -3, 7, 90, 11, -3, 11, 200;
  const std::vector<PoseEdge> edges{{0, 1, {1.1, 2.7, 0.4}, information},
                                    {2, 1, {-1.5, 2.3, 1.5}, 2.0 * information}};
  const Eigen::MatrixXd expected = differenced(poses, edges).inverse();
  const auto found = pose_covariances(poses, edges, std::array<std::size_t, 2>{1, 2});
  for (const Eigen::Index i : {0, 1}) {
    const Eigen::Matrix3d block = expected.block<3, 3>(3 * i, 3 * i);
    EXPECT_LT((found[static_cast<std::size_t>(i)] - block).norm(), 1e-6 * block.norm()) << i;
  }
}

TEST(PoseGraph, WithoutMeasurementsAllStaysAsItIs) {
  std::vector<Pose2> poses{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  EXPECT_TRUE(optimise_pose_graph(poses, {}));
  EXPECT_EQ(poses[1].x_m, 4.0);
  EXPECT_EQ(poses[1].yaw_rad, 6.0) << "not even wrapped";
}

TEST(PoseGraph, TheFirstPoseStaysWhereNothingTiesItToTheOthers) {
  std::vector<Pose2> poses{{1.0, 2.0, 6.0}, {3.0, 0.0, 0.5}, {9.0, 9.0, 0.0}};
  const Pose2 step{0.6, -0.4, 0.5};
  optimise_pose_graph(poses,
                      std::vector<PoseEdge>{{1, 2, step, Eigen::Vector3d(9, 16, 25).asDiagonal()}});
  EXPECT_EQ(poses[0].x_m, 1.0);
  EXPECT_EQ(poses[0].y_m, 2.0);
  EXPECT_EQ(poses[0].yaw_rad, 6.0) << "not even wrapped";
  const Pose2 found = compose(inverse(poses[1]), poses[2]);
  EXPECT_NEAR(found.x_m, step.x_m, 1e-4);
  EXPECT_NEAR(found.y_m, step.y_m, 1e-4);
  EXPECT_NEAR(found.yaw_rad, step.yaw_rad, 1e-4);
}

TEST(PoseGraph, LittleInformationIsInformation) {
  const std::vector<Pose2> poses{{0, 0, 0}, {1, 0, 0}};
  const Eigen::Matrix3d little = 0.25 * Eigen::Matrix3d::Identity();
  const auto covariance = pose_covariances(poses, std::vector<PoseEdge>{{0, 1, {1, 0, 0}, little}},
                                           std::array<std::size_t, 1>{1});
  EXPECT_NEAR(covariance.front()(0, 0), 4.0, 1e-9);
}

TEST(PoseGraph, AllAreUnsureWhereOneIsTiedByNothing) {
  const std::vector<Pose2> poses{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  across(1, 1) = 1.0;
  const std::vector<PoseEdge> edges{{0, 1, {1, 0, 0}, across}};
  const auto covariances = pose_covariances(poses, edges, std::array<std::size_t, 3>{0, 1, 2});
  EXPECT_TRUE(covariances[0].isZero());
  EXPECT_TRUE(std::isinf(covariances[1](2, 2)));
  EXPECT_TRUE(std::isinf(covariances[2](2, 2)));
}

}  // namespace
}  // namespace vantage
