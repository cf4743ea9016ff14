#include "vantage/sim/render/overview.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/sim/render/outer_walls.hpp"

namespace vantage {
namespace {

constexpr double kMargin_m = 1.2;    ///< round what stands still, for the robot beside it
constexpr double kFloorShown = 0.8;  ///< of the half diagonal, which is seen obliquely

}  // namespace

CameraView overview_camera(const mjModel& model) {
  const int own = mj_name2id(&model, mjOBJ_CAMERA, "overview");
  if (own >= 0) return FixedCamera{.camera_id = own, .fovy_rad = std::nullopt};
  FreeCamera camera{.lookat_m = {0.0, 0.0, 0.8}, .azimuth_rad = 0.8, .elevation_rad = -0.8};
  double radius_m = kMargin_m;
  if (const Eigen::AlignedBox3d extent_m = outer_walls(model).extent_m; !extent_m.isEmpty()) {
    camera.lookat_m = extent_m.center();
    radius_m += 0.5 * kFloorShown * std::hypot(extent_m.sizes().x(), extent_m.sizes().y());
  }
  const double half_rad =
      0.5 * static_cast<double>(model.vis.global.fovy) * std::numbers::pi / 180.0;
  const double far_m = static_cast<double>(model.vis.map.zfar) * model.stat.extent;
  const double wanted_m = radius_m / std::sin(half_rad);
  camera.distance_m = std::clamp(wanted_m, 0.1, std::max(0.1, 0.9 * far_m - radius_m));
  return camera;
}

}  // namespace vantage
