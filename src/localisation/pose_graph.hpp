/// Poses on the floor that relative measurements tie together: what they are, and how sure that is.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/geometry/pose.hpp"

namespace vantage {

/// A measurement of one pose from another. In directions that `information` leaves out it says
/// nothing.
struct PoseEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< inverse covariance, in frame `from`
};

/// (x, y, yaw) of T_from_to as measured, taken from what the poses say; in frame `from`.
Eigen::Vector3d edge_error(const PoseEdge& edge, std::span<const Pose2> T_world_poses);

/// The poses of least squared error, weighted by information [GrisettiEtAl2010, (4)]; the first
/// pose stays where it is. One thread and a fixed order: the same bits always.
/// @return whether the solver has come to rest
bool optimise_pose_graph(std::vector<Pose2>& T_world_poses, std::span<const PoseEdge> edges);

/// Covariance of (x, y, yaw) of each of `which`, given the first pose: that block of the inverse of
/// J^T J. Where any pose is tied down by no measurement, all but the first have an infinite one.
std::vector<Eigen::Matrix3d> pose_covariances(std::span<const Pose2> T_world_poses,
                                              std::span<const PoseEdge> edges,
                                              std::span<const std::size_t> which);

}  // namespace vantage
