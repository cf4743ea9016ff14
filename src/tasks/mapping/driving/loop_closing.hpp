/// Keeps what the planar scanner saw along the way, notices when the robot is back at a place of
/// long ago, and says where all of it was seen from then.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/geometry/range_scan.hpp"
#include "vantage/localisation/keyframe_graph.hpp"
#include "vantage/sim/robots/odometry.hpp"

namespace vantage {

/// Of the poses that the robot believed to have been at when it remembered what it saw.
struct PoseCorrection {
  std::vector<Pose2> T_world_before;
  std::vector<Pose2> T_world_after;

  /// A pose, or a point, that was believed when `keyframe` was the last one.
  [[nodiscard]] Pose2 moved(const Pose2& T_world_base, std::size_t keyframe) const;
  [[nodiscard]] Eigen::Vector2d moved(const Eigen::Vector2d& p_world_m, std::size_t keyframe) const;
};

/// Covariance of (x, y, yaw) of a step that odometry measures, in the frame it starts from; biases
/// count as in the long run.
Eigen::Matrix3d wheel_covariance(const OdometryOptions& odometry, double driven_m,
                                 double turned_rad);

class LoopClosing {
 public:
  LoopClosing(const LoopOptions& options, const RegistrationOptions& registration,
              const OdometryOptions& odometry, const Pose2& T_world_base);

  /// By the wheels, since the last call, the base has come from where it was put to there; from
  /// now on it is believed to be at `T_world_base`.
  void moved_to(const Pose2& T_world_base_wheels, const Pose2& T_world_base);
  /// What was seen from there is remembered; looks for a loop.
  void remember(const PlanarScan& scan, double scanner_height_m, const Pose2& T_world_base);

  /// By the wheels, since the last that was remembered.
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  /// There are loops since the last correction, and poses by loops differ from those of the map by
  /// more than `correct_m`; there what was seen does not fit together much worse.
  [[nodiscard]] bool wants_correction() const;
  /// From now on what was remembered was seen from there.
  PoseCorrection correct();

  struct Remembered {
    PlanarScan scan;
    double scanner_height_m = 0.0;
    Pose2 T_world_base;  ///< as the map has it
  };
  [[nodiscard]] const std::vector<Remembered>& remembered() const { return remembered_; }
  [[nodiscard]] const KeyframeGraph& graph() const { return graph_; }
  [[nodiscard]] std::size_t corrections() const { return corrections_; }
  /// How far the loops would move some pose, or what is seen from it.
  [[nodiscard]] double disagreement_m() const;
  /// map_contradiction.hpp, of the map as it is.
  [[nodiscard]] double contradicted_share() const;

 private:
  [[nodiscard]] double contradicted_at(std::span<const Pose2> T_world_bases) const;

  LoopOptions options_;
  RegistrationOptions registration_;
  OdometryOptions odometry_;
  KeyframeGraph graph_;
  std::vector<Remembered> remembered_;
  Pose2 T_world_put_;        ///< where the base was last put
  Pose2 T_keyframe_wheels_;  ///< by the wheels, since the last keyframe
  double driven_m_ = 0.0;    ///< since the last keyframe
  double turned_rad_ = 0.0;
  std::size_t corrections_ = 0;
  std::size_t loops_corrected_ = 0;
};

}  // namespace vantage
