/// Ray casting against the true geometry of a compiled MuJoCo model, with Embree. [Wald2014]
#pragma once

#include <Eigen/Core>

#include <limits>
#include <memory>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {

struct RayHit {
  double distance_m = std::numeric_limits<double>::infinity();  ///< infinity: nothing within range
  int geom_id = -1;

  [[nodiscard]] bool hit() const { return geom_id >= 0; }
};

/// The solid geoms of a model (see GeomFilter) as MuJoCo's `mj_ray` sees them, at about a
/// thousandth of its cost towards large meshes. Distances are in double precision. Two deliberate
/// differences: a height field is a closed surface also for rays that start inside it, and its
/// sides are right where it has more rows than columns.
class RayScene {
 public:
  /// Places every geom as `data` has it (kinematics must have run). Keeps what it needs of the
  /// model: both arguments may go away.
  RayScene(const mjModel& model, const mjData& data, const GeomFilter& filter = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Moves the geoms of bodies that can move to where `data` of the same model has them. Not while
  /// another thread casts.
  void update(const mjData& data);

  /// The first surface that the ray from `p_world_m` along the unit vector `direction` meets up to
  /// `range_max_m`, ignoring the geoms of body `exclude_body` (the one that carries the sensor).
  /// Of two geoms at the same distance the lower id is reported. Threads may cast at the same time.
  [[nodiscard]] RayHit cast(const Eigen::Vector3d& p_world_m, const Eigen::Vector3d& direction,
                            double range_max_m, int exclude_body = -1) const;

  /// Whether it meets any up to there. `blocker_id`, -1 at first, is the geom that blocked a ray
  /// last: likely this one, too, and so asked first. It becomes the one that blocks, if one does.
  [[nodiscard]] bool blocks(const Eigen::Vector3d& p_world_m, const Eigen::Vector3d& direction,
                            double range_max_m, int exclude_body, int& blocker_id) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vantage
