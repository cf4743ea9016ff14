/// Images that take a moment: what moves meanwhile is blurred.
#pragma once

#include "vantage/sim/sensors/camera.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

/// As rgbd() of the world's present moment, whose colour is the mean over the exposure that ends
/// now. Everything is taken to have moved at its present velocity for that long. Depth is that of
/// now.
/// @throws RendererError if OpenGL fails.
CameraImages rgbd_exposed(Renderer& renderer, const World& world, int camera_id,
                          const RgbdOptions& options, const ExposureOptions& exposure, Rng& rng);

}  // namespace vantage
