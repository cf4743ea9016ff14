/// What a planar scanner saw along the robot's way, and how those places lie to one another: by the
/// scans of the way just driven, and by those of places it came back to.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vantage/localisation/loop_options.hpp"
#include "vantage/localisation/pose_graph.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/perception/clouds/registration.hpp"

namespace vantage {

/// What the wheels say of the way from one keyframe to the next.
struct WheelStep {
  Pose2 T_previous_now;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of (x, y, yaw), previous frame
  double driven_m = 0.0;
};

class KeyframeGraph {
 public:
  KeyframeGraph(const LoopOptions& options, const RegistrationOptions& registration);

  /// The first keyframe, where the world is told.
  void begin(const PointCloud& scan_base, const Pose2& T_world_base);
  /// Each further one is tied to the one before by the wheels and by the scans of the way just
  /// driven, as a maximum of the posterior: where surfaces say little the wheels decide, and the
  /// pose gets as unsure.  @param scan_base upright surfaces, with normals
  void add(const PointCloud& scan_base, const WheelStep& step);
  /// Looks whether the last keyframe is back at a place of long ago. One that is found waits until
  /// a second one agrees with it; then all poses are optimised. One that contradicts the others is
  /// refused.
  /// @return whether there are new loops
  bool close_loops();

  [[nodiscard]] std::size_t size() const { return poses_.size(); }
  [[nodiscard]] const std::vector<Pose2>& T_world_bases() const { return poses_; }
  [[nodiscard]] std::size_t loops() const { return loops_.size(); }
  [[nodiscard]] std::size_t refused() const { return refused_; }
  /// Of (x, y, yaw) of those keyframes, given the first.
  [[nodiscard]] std::vector<Eigen::Matrix3d> covariances(std::span<const std::size_t> which) const;

 private:
  [[nodiscard]] std::vector<PoseEdge> edges() const;
  [[nodiscard]] std::size_t back_from(std::size_t keyframe, double way_m) const;
  [[nodiscard]] std::size_t on_from(std::size_t keyframe, double way_m) const;
  /// What those keyframes saw, in the frame of `centre`.
  [[nodiscard]] PointCloud seen(std::size_t first, std::size_t last, std::size_t centre) const;
  [[nodiscard]] Eigen::Matrix3d drift_since(std::size_t before) const;
  [[nodiscard]] bool is_tied(std::size_t before) const;
  [[nodiscard]] std::optional<std::size_t> place_of_long_ago() const;
  [[nodiscard]] bool is_within_reach(std::size_t before) const;
  [[nodiscard]] std::optional<PoseEdge> recognise(std::size_t before) const;
  [[nodiscard]] bool is_plausible(const PoseEdge& loop, const Eigen::Matrix3d& drift) const;
  [[nodiscard]] bool agree(const PoseEdge& one, const PoseEdge& other) const;
  bool take(std::vector<PoseEdge> more);

  LoopOptions options_;
  RegistrationOptions registration_;
  std::vector<Pose2> poses_;
  std::vector<double> driven_m_;  ///< up to each keyframe
  std::vector<PointCloud> scans_;
  std::vector<PoseEdge> way_;  ///< from each keyframe to the next
  std::vector<PoseEdge> loops_;
  std::optional<PoseEdge> waiting_;
  double tried_m_ = 0.0;  ///< driven, when a loop was last looked for
  std::size_t refused_ = 0;
};

}  // namespace vantage
