#include "src/episode/view_painter.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/camera.hpp"
#include "src/episode/view_overlays.hpp"

namespace vantage {
namespace {

constexpr double kFovy_rad = 0.7853981633974483;
/// Round the region of the map, for the robot beside it.
constexpr double kMargin_m = 1.2;
/// Of the half diagonal of the region, which is seen obliquely in a picture wider than high.
constexpr double kRegionShare = 0.75;
constexpr double kBodyMiddle_m = 0.7;

MapCamera camera_of(const RenderedImages& image) {
  MapCamera camera;
  camera.T_camera_world = image.T_world_camera.inverse();
  camera.focal_px = image.focal_px;
  camera.centre_px = {0.5 * (image.width_px - 1), 0.5 * (image.height_px - 1)};  // of the pixels
  return camera;
}

/// Colours, and depth if there is any.
MapCanvas canvas_of(RenderedImages& image) {
  MapCanvas canvas;
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3, image.rgb.data());
  cv::cvtColor(rgb, canvas.bgr, cv::COLOR_RGB2BGR);
  if (image.depth_m.empty()) return canvas;
  canvas.inverse_depth = cv::Mat(rgb.size(), CV_32F);
  std::ranges::transform(image.depth_m, canvas.inverse_depth.begin<float>(),
                         [](float depth_m) { return depth_m > 0.0F ? 1.0F / depth_m : 0.0F; });
  return canvas;
}

std::string scene_caption(const Episode& episode, double time_s, std::size_t scans) {
  return fmt::format("{}    {:.2f} s    scan {} of {}", method_name(episode), time_s, scans,
                     episode.scans);
}

}  // namespace

FreeCamera overview_of(const World& world, const Episode& episode) {
  const auto& size_m = episode.map.size_m;
  const double radius_m = 0.5 * kRegionShare * std::hypot(size_m[0], size_m[1]) + kMargin_m;
  FreeCamera camera{
      .lookat_m = Eigen::Vector3d(episode.map.centre_m[0], episode.map.centre_m[1], kBodyMiddle_m),
      .distance_m = radius_m / std::sin(0.5 * kFovy_rad),
      .azimuth_rad = 0.8,
      .elevation_rad = -0.6,
      .fovy_rad = kFovy_rad};
  if (const auto id = find_model_id(world.model(), ModelObject::camera, "overview")) {
    const Eigen::Vector3d forward =
        T_world_camera(world.model(), world.snapshot(), *id).linear().col(2);
    camera.azimuth_rad = std::atan2(forward.y(), forward.x());
    camera.elevation_rad = std::asin(std::clamp(forward.z(), -1.0, 1.0));
  }
  return camera;
}

FreeCamera follow_of_robot() {
  return {.lookat_m = {0.0, 0.0, kBodyMiddle_m},
          .distance_m = 3.0,
          .azimuth_rad = 0.8,
          .elevation_rad = -0.5,
          .fovy_rad = kFovy_rad};
}

ViewPainter::ViewPainter(World& world, const Episode& episode)
    : world_(world), episode_(episode), robot_(world.model()), known_(episode.grid_frame()) {}

CameraView ViewPainter::camera_for(const ViewControls& controls) const {
  if (controls.camera == ViewCamera::robot) return FixedCamera{.camera_id = robot_.camera_id()};
  if (controls.camera == ViewCamera::overview) return controls.overview;
  FreeCamera camera = controls.follow;
  const Pose2 base = robot_.T_world_base(world_);
  camera.lookat_m += Eigen::Vector3d(base.x_m, base.y_m, 0.0);
  return camera;
}

ViewPicture ViewPainter::paint(const ViewLink::Work& work) {
  const ViewControls& controls = work.controls;
  story_.insert(story_.end(), work.new_events.begin(), work.new_events.end());
  known_.go_to(story_, work.moment.events);
  world_.set_state(work.moment.state);
  const auto [width_px, height_px] = controls.size;
  if (!renderer_ || PixelSize{renderer_->width_px(), renderer_->height_px()} != controls.size) {
    renderer_ = nullptr;
    renderer_ = make_offscreen_renderer(world_.model(), width_px, height_px);
  }
  RenderRequest request;
  request.shadows = true;
  request.depth_and_segmentation = controls.map || controls.gains;
  ViewPicture picture{{}, world_.time_s(), work.moment.still};
  renderer_->render(world_.model(), world_.snapshot(), camera_for(controls), request,
                    picture.image);

  MapCanvas canvas = canvas_of(picture.image);
  const MapCamera camera = camera_of(picture.image);
  if (controls.map) lay_map(canvas, camera, known_.grid());
  if (controls.gains) lay_views(canvas, camera, known_);
  ViewCaptions captions{.scene = scene_caption(episode_, picture.time_s, known_.scans()),
                        .playback = controls.playback,
                        .gain_unit = std::string(unit_of(episode_.gain)),
                        .decision = controls.gains ? known_.decision() : std::nullopt,
                        .progress = std::nullopt,
                        .help = controls.help};
  if (controls.duration_s) captions.progress = picture.time_s / *controls.duration_s;
  lay_captions(canvas.bgr, captions);
  cv::Mat rgb(height_px, width_px, CV_8UC3, picture.image.rgb.data());
  cv::cvtColor(canvas.bgr, rgb, cv::COLOR_BGR2RGB);
  picture.image.depth_m.clear();
  picture.image.segmentation.clear();
  return picture;
}

}  // namespace vantage
