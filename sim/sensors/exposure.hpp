/// Images that take a moment: what moves meanwhile is blurred.
#pragma once

#include "vantage/sim/sensors/camera.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

struct ExposureOptions {
  double exposure_s = 0.004;  ///< higher blurs more; 0 is sharp
  int samples = 4;            ///< images averaged; higher blurs more smoothly, renders slower
  void fields(auto&& f) {
    f("exposure_s", exposure_s, between(0.0, 0.1));
    f("samples", samples, between(1, 64));
  }
};

/// As rgbd() of the world's present moment, whose colour is the mean over the exposure that ends
/// now. Everything is taken to have moved at its present velocity for that long. Depth and body ids
/// are those of now.
/// @throws RendererError if OpenGL fails.
CameraImages rgbd_exposed(Renderer& renderer, const World& world, int camera_id,
                          const RgbdOptions& options, const ExposureOptions& exposure, Rng& rng);

}  // namespace vantage
