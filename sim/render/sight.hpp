/// What of a scene a camera can see.
#pragma once

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include <array>
#include <limits>

namespace vantage {

/// The room before a camera that an image shows.
class Sight {
 public:
  /// @param range_m along the optical axis, beyond which nothing is looked for
  Sight(const mjvGLCamera& camera, int width_px, int height_px,
        double range_m = std::numeric_limits<double>::infinity());

  /// Whether a sphere may be in sight; true for some that are not.
  [[nodiscard]] bool may_show(const Eigen::Vector3d& p_world_m, double radius_m) const;

 private:
  Eigen::Vector3d p_world_m_;
  std::array<Eigen::Vector3d, 4> inwards_;  ///< normals of the sides, through the eye
  Eigen::Vector3d forward_;
  double near_m_;
  double far_m_;
};

/// Takes geoms that cannot be in sight out of `scene`, which else are drawn all the same. The image
/// does not change by it. Nothing is taken out where mirrors show what is not in sight.
void leave_out_unseen(const mjModel& model, const Sight& sight, mjvScene& scene);

/// Tells OpenGL's readers where each geom is listed now.
void number_anew(mjvScene& scene);

}  // namespace vantage
