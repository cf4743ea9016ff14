#include "vantage/sim/sensors/exposure.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <functional>

namespace vantage {
namespace {

/// `data` as it was, or will be, in `time_s` from the world's present.
void move_on(const World& world, double time_s, mjData& data) {
  const mjModel& model = world.model();
  std::copy_n(world.data().qpos, model.nq, data.qpos);
  mj_integratePos(&model, data.qpos, data.qvel, time_s);
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
}

}  // namespace

CameraImages rgbd_exposed(Renderer& renderer, const World& world, int camera_id,
                          const RgbdOptions& options, const ExposureOptions& exposure, Rng& rng) {
  check_options(exposure, "exposure");
  CameraImages images = rgbd(renderer, world.model(), world.snapshot(), camera_id, options, rng);
  if (exposure.samples == 1 || exposure.exposure_s == 0.0) return images;
  const DataPtr moment = world.copy_data();
  std::vector<int> sum(images.rgb.begin(), images.rgb.end());
  RenderedImages drawn;
  RenderRequest colour = render_request(options);
  colour.depth_and_segmentation = false;
  for (int i = 1; i < exposure.samples; ++i) {
    move_on(world, -exposure.exposure_s * i / (exposure.samples - 1), *moment);
    renderer.render(world.model(), *moment, FixedCamera{camera_id, options.fovy_rad}, colour,
                    drawn);
    std::transform(sum.begin(), sum.end(), drawn.rgb.begin(), sum.begin(), std::plus<>());
  }
  std::transform(sum.begin(), sum.end(), images.rgb.begin(), [&](int total) {
    return static_cast<std::uint8_t>((total + exposure.samples / 2) / exposure.samples);
  });
  return images;
}

}  // namespace vantage
