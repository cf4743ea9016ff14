#include "vantage/sim/sensors/camera.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>
#include <utility>

namespace vantage {

void RgbdOptions::check() const {
  if (range_min_m >= range_max_m) throw ConfigError("range_min_m must be below range_max_m");
}

double depth_sigma_m(const RgbdOptions& options, double z_m) {
  const double beyond_m = z_m - options.noise_nearest_m;
  return options.noise_floor_m + options.noise_growth_per_m * beyond_m * beyond_m;
}

double depth_error_m(const RgbdOptions& options, double z_m) {
  if (!options.noise) return 0.0;
  const double step_m = options.quantisation_per_m * z_m * z_m;
  return std::hypot(depth_sigma_m(options, z_m), step_m / std::sqrt(12.0));
}

float measured_depth_m(const RgbdOptions& options, float z_m, Rng& rng) {
  const float far = options.tells_far ? std::numeric_limits<float>::infinity() : 0.0F;
  double z = z_m;
  if (z < options.range_min_m) return 0.0F;
  if (z > options.range_max_m) return far;
  if (!options.noise) return z_m;
  z = rng.normal(z, depth_sigma_m(options, z));
  if (options.quantisation_per_m > 0.0 && z > 0.0) {
    // Such cameras measure disparity, proportional to 1/z, in whole steps.
    z = 1.0 / (options.quantisation_per_m * std::round(1.0 / (options.quantisation_per_m * z)));
  }
  if (z > options.range_max_m) return far;
  return z < options.range_min_m ? 0.0F : static_cast<float>(z);
}

double focal_length_px(const RgbdOptions& options) {
  return 0.5 * options.height_px / std::tan(0.5 * options.fovy_rad);
}

Pose T_world_camera(const mjModel& model, const mjData& data, int camera_id) {
  expects(camera_id >= 0 && camera_id < model.ncam, "camera id of the model");
  Pose T = Pose::Identity();
  T.translation() = Eigen::Map<const Eigen::Vector3d>(data.cam_xpos + 3 * camera_id);
  T.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data.cam_xmat +
                                                                              9 * camera_id) *
               Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return T;
}

RenderRequest render_request(const RgbdOptions& options) {
  RenderRequest request;
  request.near_at_most_m = options.range_min_m;
  request.far_at_least_m = options.range_max_m;
  return request;
}

namespace {

/// Depth is that of surfaces, without errors; 0: there is none.
CameraImages drawn_by(Renderer& renderer, const mjModel& model, const mjData& data, int camera_id,
                      const RenderRequest& request, const RgbdOptions& options) {
  expects(renderer.width_px() == options.width_px && renderer.height_px() == options.height_px,
          "renderer of the camera's image size");
  expects(camera_id >= 0 && camera_id < model.ncam, "camera id of the model");
  RenderedImages drawn;
  renderer.render(model, data, FixedCamera{camera_id, options.fovy_rad}, request, drawn);
  return {.width_px = drawn.width_px,
          .height_px = drawn.height_px,
          .focal_px = focal_length_px(options),
          .range_max_m = options.range_max_m,
          .rgb = std::move(drawn.rgb),
          .depth_m = std::move(drawn.depth_m)};
}

}  // namespace

CameraImages rgbd(Renderer& renderer, const mjModel& model, const mjData& data, int camera_id,
                  const RgbdOptions& options, Rng& rng) {
  CameraImages images =
      drawn_by(renderer, model, data, camera_id, render_request(options), options);
  measure_depth(images, options, rng);
  return images;
}

CameraImages exact_depth_image(Renderer& renderer, const mjModel& model, const mjData& data,
                               int camera_id, const RgbdOptions& options) {
  RenderRequest request = render_request(options);
  request.rgb = false;
  request.range_m = options.range_max_m;
  return drawn_by(renderer, model, data, camera_id, request, options);
}

void measure_depth(CameraImages& images, const RgbdOptions& options, Rng& rng) {
  for (float& depth : images.depth_m) {
    const bool nothing = depth == 0.0F;
    depth =
        measured_depth_m(options, nothing ? std::numeric_limits<float>::infinity() : depth, rng);
  }
}

CameraImages depth_image(Renderer& renderer, const mjModel& model, const mjData& data,
                         int camera_id, const RgbdOptions& options, Rng& rng) {
  CameraImages images = exact_depth_image(renderer, model, data, camera_id, options);
  measure_depth(images, options, rng);
  return images;
}

}  // namespace vantage
