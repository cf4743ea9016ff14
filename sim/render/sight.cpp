#include "vantage/sim/render/sight.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <span>

namespace vantage {
namespace {

std::span<mjvGeom> geoms_of(mjvScene& scene) {
  return {scene.geoms, static_cast<std::size_t>(scene.ngeom)};
}

/// Planes and height fields have no sphere that they are in.
bool has_sphere(const mjModel& model, const mjvGeom& geom) {
  if (geom.objtype != mjOBJ_GEOM || geom.objid < 0) return false;
  const int type = model.geom_type[geom.objid];
  return type != mjGEOM_PLANE && type != mjGEOM_HFIELD && model.geom_rbound[geom.objid] > 0.0;
}

}  // namespace

Sight::Sight(const mjvGLCamera& camera, int width_px, int height_px, double range_m)
    : p_world_m_(Eigen::Vector3f(camera.pos).cast<double>()),
      forward_(Eigen::Vector3f(camera.forward).cast<double>().normalized()),
      near_m_(camera.frustum_near),
      far_m_(std::min(static_cast<double>(camera.frustum_far), range_m)) {
  const Eigen::Vector3d up = Eigen::Vector3f(camera.up).cast<double>().normalized();
  const Eigen::Vector3d right = forward_.cross(up);
  const double half_height =
      0.5 * (static_cast<double>(camera.frustum_top) - camera.frustum_bottom);
  const double half_width = half_height * width_px / height_px;
  const double centre = camera.frustum_center;
  const auto side = [&](const Eigen::Vector3d& across, double edge) {
    return (across - edge / near_m_ * forward_).normalized();
  };
  inwards_ = {side(right, centre - half_width), -side(right, centre + half_width),
              side(up, camera.frustum_bottom), -side(up, camera.frustum_top)};
}

bool Sight::may_show(const Eigen::Vector3d& p_world_m, double radius_m) const {
  constexpr double kSlack_m = 1e-3;  // cameras and corners are in single precision
  const Eigen::Vector3d p = p_world_m - p_world_m_;
  const double reach_m = 1.001 * radius_m + kSlack_m + 1e-5 * p.norm();
  const double ahead_m = forward_.dot(p);
  return ahead_m >= near_m_ - reach_m && ahead_m <= far_m_ + reach_m &&
         std::ranges::all_of(inwards_,
                             [&](const auto& normal) { return normal.dot(p) >= -reach_m; });
}

void number_anew(mjvScene& scene) {
  int at = 0;
  for (mjvGeom& geom : geoms_of(scene)) {
    if (geom.segid >= 0) geom.segid = at;
    ++at;
  }
}

void leave_out_unseen(const mjModel& model, const Sight& sight, mjvScene& scene) {
  const std::span<mjvGeom> geoms = geoms_of(scene);
  if (std::ranges::any_of(geoms, [](const mjvGeom& geom) { return geom.reflectance > 0.0F; })) {
    return;
  }
  const auto unseen = [&](const mjvGeom& geom) {
    const Eigen::Vector3d p_world_m = Eigen::Vector3f(geom.pos).cast<double>();
    return has_sphere(model, geom) && !sight.may_show(p_world_m, model.geom_rbound[geom.objid]);
  };
  const auto kept_end = std::remove_if(geoms.begin(), geoms.end(), unseen);
  scene.ngeom = static_cast<int>(kept_end - geoms.begin());
  number_anew(scene);
}

}  // namespace vantage
