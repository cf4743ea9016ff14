/// An RGB-D camera on the robot. The only place where MuJoCo's camera axes (looking along -z) turn
/// into OpenCV's (along +z).
#pragma once

#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/sensors/camera_options.hpp"

namespace vantage {

/// A reading of a surface at `z_m` along the optical axis (+inf: there is none): noise,
/// quantisation, range limits. 0 or +inf where there is no reading, see RgbdOptions::tells_far.
float measured_depth_m(const RgbdOptions& options, float z_m, Rng& rng);

/// Colour and measured depth from a camera of the model as `data` has it. The
/// renderer's image size must be that of the options.
/// @throws RendererError if OpenGL fails.
CameraImages rgbd(Renderer& renderer, const mjModel& model, const mjData& data, int camera_id,
                  const RgbdOptions& options, Rng& rng);

/// The same without colour, at half the cost.
CameraImages depth_image(Renderer& renderer, const mjModel& model, const mjData& data,
                         int camera_id, const RgbdOptions& options, Rng& rng);

/// depth_image in two: what is drawn, in the renderer's thread, then what the camera measures of
/// it, in any. What is beyond options.range_max_m may be left out: it measures as nothing does.
CameraImages exact_depth_image(Renderer& renderer, const mjModel& model, const mjData& data,
                               int camera_id, const RgbdOptions& options);
void measure_depth(CameraImages& images, const RgbdOptions& options, Rng& rng);

/// What a renderer is to draw for it: colour, depth and segmentation, all of its range.
RenderRequest render_request(const RgbdOptions& options);

/// Pose of a camera of the model in OpenCV's axes: z forward, x right, y down.
Pose T_world_camera(const mjModel& model, const mjData& data, int camera_id);

}  // namespace vantage
