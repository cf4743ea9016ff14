#include "vantage/view/painter.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/runtime/drawing/tour_drawing.hpp"
#include "vantage/sim/robots/robot_names.hpp"
#include "vantage/sim/sensors/camera.hpp"

namespace vantage {
namespace {

constexpr double kFovy_rad = 0.7853981633974483;
/// Round the region of the map, for the robot beside it.
constexpr double kMargin_m = 1.2;
/// Of the half diagonal of the region, which is seen obliquely in an image wider than high.
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

/// Leaves nothing but the colours in `image`.
void set_colours(RenderedImages& image, const cv::Mat& bgr) {
  cv::Mat rgb(bgr.size(), CV_8UC3, image.rgb.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  image.depth_m.clear();
  image.segmentation.clear();
}

}  // namespace

FreeCamera overview_of(const World& world, const WindowContent& content) {
  const Eigen::Vector2d size_m = content.overview_m.sizes();
  const Eigen::Vector2d centre_m = content.overview_m.center();
  const double radius_m = 0.5 * kRegionShare * std::hypot(size_m[0], size_m[1]) + kMargin_m;
  FreeCamera camera{.lookat_m = Eigen::Vector3d(centre_m.x(), centre_m.y(), kBodyMiddle_m),
                    .distance_m = radius_m / std::sin(0.5 * kFovy_rad),
                    .azimuth_rad = 0.8,
                    .elevation_rad = -0.6,
                    .fovy_rad = kFovy_rad,
                    .cutaway_m = radius_m};
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
          .fovy_rad = kFovy_rad,
          .cutaway_m = 1.5};
}

ViewPainter::ViewPainter(World& world, const ViewScene& scene)
    : world_(world),
      scene_(scene),
      camera_(robot_camera(world.model())),
      base_body_(robot_base(world.model())),
      known_(scene.content.map.value_or(GridFrame{})) {}

CameraView ViewPainter::camera_for(const ViewControls& controls) const {
  if (controls.camera == ViewCamera::robot && camera_) return FixedCamera{.camera_id = *camera_};
  if (controls.camera == ViewCamera::overview) return controls.overview;
  FreeCamera camera = controls.follow;
  const Eigen::Vector3d p_m = body_pose(world_, base_body_).translation();
  camera.lookat_m += Eigen::Vector3d(p_m.x(), p_m.y(), 0.0);
  if (scene_.content.follows_height) camera.lookat_m.z() += p_m.z() - kBodyMiddle_m;
  return camera;
}

Renderer& ViewPainter::renderer_of(PixelSize size) {
  if (!renderer_ || PixelSize{renderer_->width_px(), renderer_->height_px()} != size) {
    renderer_ = nullptr;  // the memory of one is enough
    renderer_ = make_offscreen_renderer(world_.model(), size.width_px, size.height_px);
  }
  return *renderer_;
}

ViewFrame ViewPainter::paint(const ViewLink::Work& work) {
  const ViewControls& controls = work.controls;
  event_log_.insert(event_log_.end(), work.new_events.begin(), work.new_events.end());
  known_.go_to(event_log_, work.moment.events);
  world_.set_state(work.moment.state);
  RenderRequest request;
  request.shadows = true;
  request.for_people = controls.camera != ViewCamera::robot;
  request.depth_and_segmentation = controls.map || controls.gains;
  ViewFrame frame{{}, world_.time_s(), work.moment.still};
  renderer_of(controls.size)
      .render(world_.model(), world_.snapshot(), camera_for(controls), request, frame.image);

  MapCanvas canvas = canvas_of(frame.image);
  const MapCamera camera = camera_of(frame.image);
  if (controls.map && scene_.content.map) lay_map(canvas, camera, known_.grid());
  if (controls.gains) lay_views(canvas, camera, known_);
  lay_captions(canvas.bgr, captions_for(controls, frame.time_s));
  set_colours(frame.image, canvas.bgr);
  return frame;
}

ViewCaptions ViewPainter::captions_for(const ViewControls& controls, double time_s) const {
  ViewCaptions captions;
  captions.scene = fmt::format("{}    {:.2f} s", scene_.method, time_s);
  if (scene_.content.scans > 0) {
    captions.scene += fmt::format("    {} {} of {}", scene_.content.step_word, known_.scans(),
                                  scene_.content.scans);
  }
  captions.playback = controls.playback;
  captions.gain_unit = scene_.content.gain_unit;
  if (controls.gains) {
    captions.decision = known_.decision();
    captions.plan = plan_text(known_.tour());
  }
  if (controls.duration_s) {
    captions.progress = *controls.duration_s > 0.0 ? time_s / *controls.duration_s : 1.0;
  }
  captions.help = controls.help;
  return captions;
}

}  // namespace vantage
