#include "vantage/tasks/flight/simulated_quadrotor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/sim/sensors/camera.hpp"
#include "vantage/sim/sensors/exposure.hpp"

namespace vantage {
namespace {

void add_colour_noise(CameraImages& images, double sigma, Rng& rng) {
  if (sigma == 0.0) return;
  for (std::uint8_t& value : images.rgb) {
    const double noisy = std::clamp(value + sigma * rng.normal(), 0.0, 255.0);
    value = static_cast<std::uint8_t>(std::lround(noisy));
  }
}

}  // namespace

SimulatedQuadrotor::SimulatedQuadrotor(const EpisodeOptions& episode, const ModelSource& source,
                                       const TrajectoryTrackingOptions& tracking,
                                       const FlightCameraOptions& camera,
                                       const std::function<Quadrotor(World&)>& place)
    : options_(camera),
      world_(source, episode.simulation),
      vehicle_(place(world_)),
      tracking_(world_, vehicle_, tracking, Rng::stream(episode.seed, "pose")),
      renderer_(
          make_offscreen_renderer(world_.model(), camera.camera.width_px, camera.camera.height_px)),
      faults_(episode.faults, episode.seed) {
  faults_.attach(world_, vehicle_.rotor_actuators());
}

CameraImages SimulatedQuadrotor::depth_image(Rng& rng) {
  return vantage::depth_image(*renderer_, world_.model(), world_.snapshot(), vehicle_.camera_id(),
                              options_.camera, rng);
}

CameraImages SimulatedQuadrotor::colour_image(Rng& rng) {
  CameraImages images = rgbd_exposed(*renderer_, world_, vehicle_.camera_id(), options_.camera,
                                     options_.exposure, rng);
  if (faults_.in_the_dark(world_.time_s())) std::ranges::fill(images.rgb, std::uint8_t{0});
  add_colour_noise(images, options_.colour_noise, rng);
  return images;
}

Pose SimulatedQuadrotor::T_body_camera() const {
  return vehicle_.T_body_camera(vehicle_.camera_pitch_rad(world_));
}

std::string SimulatedQuadrotor::touched() const {
  std::vector<std::string> names;
  for (const int geom : vehicle_.touched_geoms(world_)) {
    const std::string name = model_name(world_.model(), ModelObject::geom, geom);
    names.push_back(name.empty() ? fmt::format("geom number {}", geom) : name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace vantage
