#include "vantage/sim/render/gl_scene.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>

#include "vantage/core/error.hpp"
#include "vantage/sim/render/sight.hpp"
#include "vantage/sim/world/mesh_surface.hpp"
#include "vantage/sim/world/mujoco_errors.hpp"

namespace vantage {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

void make_context(const mjModel& model, mjrContext& context) {
  // MuJoCo keeps the OpenGL entry points it looks up here in globals.
  static std::mutex loading;
  const std::lock_guard lock(loading);
  install_mujoco_handlers();
  try {
    mjr_makeContext(&model, &context, mjFONTSCALE_100);
  } catch (const std::exception& error) {
    throw RendererError(std::string("OpenGL: ") + error.what());
  }
}

mjvOption drawing_options(const RenderRequest& request) {
  mjvOption option;
  mjv_defaultOption(&option);
  std::fill(std::begin(option.flags), std::end(option.flags), mjtByte{0});
  for (const int shown : {mjVIS_TEXTURE, mjVIS_STATIC, mjVIS_SKIN}) option.flags[shown] = 1;
  for (int group = 0; group < mjNGROUP; ++group) {
    const bool looks = request.for_people && group == kLooksGroup;
    option.geomgroup[group] = looks || group <= request.max_group ? 1 : 0;
    option.sitegroup[group] = 0;
  }
  return option;
}

mjvCamera mujoco_camera(const CameraView& view) {
  mjvCamera camera;
  mjv_defaultCamera(&camera);
  if (const auto* fixed = std::get_if<FixedCamera>(&view)) {
    camera.type = mjCAMERA_FIXED;
    camera.fixedcamid = fixed->camera_id;
    return camera;
  }
  const auto& free = std::get<FreeCamera>(view);
  std::copy(free.lookat_m.begin(), free.lookat_m.end(), camera.lookat);
  camera.distance = free.distance_m;
  camera.azimuth = free.azimuth_rad * kDegreesPerRadian;
  camera.elevation = free.elevation_rad * kDegreesPerRadian;
  return camera;
}

void set_field_of_view(mjvScene& scene, double fovy_rad) {
  for (mjvGLCamera& camera : scene.camera) {
    camera.frustum_top = camera.frustum_near * static_cast<float>(std::tan(0.5 * fovy_rad));
    camera.frustum_bottom = -camera.frustum_top;
  }
}

/// The scene holds a camera for each eye; images are taken from the middle between them.
void describe_camera(const mjvScene& scene, RenderedImages& out) {
  const mjvGLCamera camera = mjv_averageCamera(&scene.camera[0], &scene.camera[1]);
  const Eigen::Vector3d forward = Eigen::Vector3f(camera.forward).cast<double>();
  const Eigen::Vector3d down = -Eigen::Vector3f(camera.up).cast<double>();
  out.T_world_camera.linear() << down.cross(forward), down, forward;
  out.T_world_camera.translation() = Eigen::Vector3f(camera.pos).cast<double>();
  out.focal_px = 0.5 * out.height_px * camera.frustum_near / camera.frustum_top;
}

/// The same field of view from another near plane on.
void move_near_plane(mjvGLCamera& camera, double near_m) {
  const float scale = static_cast<float>(near_m) / camera.frustum_near;
  for (float* edge : {&camera.frustum_near, &camera.frustum_top, &camera.frustum_bottom,
                      &camera.frustum_center}) {
    *edge *= scale;
  }
}

/// Moves the near plane, if anything, away from the camera.
void cut_away(mjvScene& scene, double near_m) {
  for (mjvGLCamera& camera : scene.camera) {
    if (near_m > camera.frustum_near) move_near_plane(camera, near_m);
  }
}

/// Moves the near plane, if anything, towards the camera.
void look_nearer(mjvScene& scene, double near_m) {
  constexpr double kNearest_m = 0.01;  // depth is of few digits far off otherwise
  for (mjvGLCamera& camera : scene.camera) {
    const double wanted_m = std::max(near_m, kNearest_m);
    if (wanted_m < camera.frustum_near) move_near_plane(camera, wanted_m);
  }
}

/// Moves the far plane, if anything, away from the camera.
void look_farther(mjvScene& scene, double far_m) {
  for (mjvGLCamera& camera : scene.camera) {
    camera.frustum_far = std::max(camera.frustum_far, static_cast<float>(far_m));
  }
}

/// A lamp beside the eye where a scene has no light of its own.
void lighten(const mjModel& model, mjvScene& scene) {
  if (model.nlight > 0) return;
  mjvLight& lamp = scene.lights[0];
  if (scene.nlight == 0) {
    const mjvGLCamera camera = mjv_averageCamera(&scene.camera[0], &scene.camera[1]);
    lamp = {};
    std::copy_n(camera.pos, 3, lamp.pos);
    std::copy_n(camera.forward, 3, lamp.dir);
    lamp.attenuation[0] = 1.0F;
    lamp.cutoff = 180.0F;
    lamp.directional = lamp.headlight = 1;
    scene.nlight = 1;
  }
  constexpr float kAmbient = 0.4F;
  constexpr float kDiffuse = 0.5F;
  for (float& value : lamp.ambient) value = std::max(value, kAmbient);
  for (float& value : lamp.diffuse) value = std::max(value, kDiffuse);
}

struct DrawMarker {
  mjvGeom& geom;

  void operator()(const SphereMarker& marker) const {
    const double size[3] = {marker.radius_m, marker.radius_m, marker.radius_m};
    mjv_initGeom(&geom, mjGEOM_SPHERE, size, marker.p_world_m.data(), nullptr, marker.rgba.data());
  }
  void operator()(const BoxMarker& marker) const {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = marker.T_world_box.linear();
    const Eigen::Vector3d position = marker.T_world_box.translation();
    mjv_initGeom(&geom, mjGEOM_BOX, marker.half_size_m.data(), position.data(), rotation.data(),
                 marker.rgba.data());
  }
  void operator()(const LineMarker& marker) const {
    const Eigen::Vector3d& a = marker.from_world_m;
    const Eigen::Vector3d& b = marker.to_world_m;
    mjv_initGeom(&geom, mjGEOM_CAPSULE, nullptr, nullptr, nullptr, marker.rgba.data());
    mjv_makeConnector(&geom, mjGEOM_CAPSULE, 0.5 * marker.width_m, a.x(), a.y(), a.z(), b.x(),
                      b.y(), b.z());
  }
};

/// Source index of a pixel in an OpenGL image, which has the bottom row first.
std::size_t flipped(int row, int column, const mjrRect& viewport) {
  return static_cast<std::size_t>(viewport.height - 1 - row) *
             static_cast<std::size_t>(viewport.width) +
         static_cast<std::size_t>(column);
}

}  // namespace

GlScene::GlScene(const mjModel& model) : model_(&model) {
  make_context(model, context_);
  if (!context_.windowAvailable) throw RendererError("OpenGL: no default framebuffer");
  const int geoms = model.ngeom + model.nskin + 1000 + static_cast<int>(kMaxMarkers);
  mjv_makeScene(&model, &scene_, geoms);
}

void GlScene::update(const mjData& data, const CameraView& view, const RenderRequest& request) {
  // These functions only read, but for a warning counter when the scene is full.
  auto* drawn = const_cast<mjData*>(&data);
  const mjvOption option = drawing_options(request);
  mjvCamera camera = mujoco_camera(view);
  // Infinite planes are laid round the camera that the scene holds before the update: without this
  // an image would depend on the one before.
  mjv_updateCamera(model_, drawn, &camera, &scene_);
  mjv_updateScene(model_, drawn, &option, nullptr, &camera, mjCAT_ALL, &scene_);
  const auto fovy_rad = std::visit([](const auto& camera) { return camera.fovy_rad; }, view);
  if (fovy_rad) set_field_of_view(scene_, *fovy_rad);
  look_nearer(scene_, request.near_at_most_m);
  look_farther(scene_, request.far_at_least_m);
  if (const auto* free = std::get_if<FreeCamera>(&view); free != nullptr && free->cutaway_m) {
    cut_away(scene_, free->distance_m - *free->cutaway_m);
  }
  if (request.for_people) {
    lighten(*model_, scene_);
    leave_out_walls();
  }
  add_markers(request.markers);
}

/// Nothing is then before the room, so that the depth of the image is spent on the room.
void GlScene::leave_out_walls() {
  constexpr double kSkyPerDistance = 2.5;
  if (!walls_) walls_ = outer_walls(*model_);
  const mjvGLCamera camera = mjv_averageCamera(&scene_.camera[0], &scene_.camera[1]);
  const Eigen::Vector3d eye_m = Eigen::Vector3f(camera.pos).cast<double>();
  const std::vector<int> hidden = walls_->before(eye_m);
  if (hidden.empty()) return;
  cut_away(scene_, 0.5 * walls_->extent_m.exteriorDistance(eye_m));
  const double size_m = walls_->extent_m.diagonal().norm();
  look_farther(scene_, kSkyPerDistance * (walls_->extent_m.exteriorDistance(eye_m) + size_m));
  const auto is_hidden = [&](const mjvGeom& geom) {
    return geom.objtype == mjOBJ_GEOM && std::ranges::binary_search(hidden, geom.objid);
  };
  mjvGeom* const end = std::remove_if(scene_.geoms, scene_.geoms + scene_.ngeom, is_hidden);
  scene_.ngeom = static_cast<int>(end - scene_.geoms);
  number_anew(scene_);
}

void GlScene::add_markers(const std::vector<Marker>& markers) {
  expects(markers.size() <= kMaxMarkers, "at most kMaxMarkers markers");
  for (const Marker& marker : markers) {
    if (scene_.ngeom >= scene_.maxgeom) throw RendererError("too many things to draw");
    mjvGeom& geom = scene_.geoms[scene_.ngeom++];
    std::visit(DrawMarker{geom}, marker);
    geom.category = mjCAT_DECOR;
    geom.specular = 0.0F;
    geom.segid = -1;  // not in the segmentation pass, which is the depth pass too
  }
}

void GlScene::render(const mjData& data, const CameraView& view, const RenderRequest& request,
                     int width_px, int height_px, RenderedImages& out) {
  const mjrRect viewport{0, 0, width_px, height_px};
  out.width_px = width_px;
  out.height_px = height_px;
  out.rgb.clear();
  out.depth_m.clear();
  out.segmentation.clear();
  mjr_setBuffer(mjFB_WINDOW, &context_);
  update(data, view, request);
  if (!request.shadows) {  // which fall into the image from outside
    const mjvGLCamera camera = mjv_averageCamera(&scene_.camera[0], &scene_.camera[1]);
    leave_out_unseen(*model_, Sight(camera, width_px, height_px, request.range_m), scene_);
  }
  describe_camera(scene_, out);
  scene_.flags[mjRND_SHADOW] = request.shadows ? 1 : 0;
  if (request.rgb) {
    scene_.flags[mjRND_SEGMENT] = scene_.flags[mjRND_IDCOLOR] = 0;
    mjr_render(viewport, &scene_, &context_);
    read_rgb(viewport, out);
  }
  if (request.depth_and_segmentation) {
    scene_.flags[mjRND_SEGMENT] = scene_.flags[mjRND_IDCOLOR] = 1;
    mjr_render(viewport, &scene_, &context_);
    read_depth_and_segmentation(viewport, out);
  }
  if (mjr_getError() != 0) throw RendererError("OpenGL: error while drawing");
}

void GlScene::read_rgb(const mjrRect& viewport, RenderedImages& out) {
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(viewport.width);
  buffer_rgb_.resize(row_bytes * static_cast<std::size_t>(viewport.height));
  mjr_readPixels(buffer_rgb_.data(), nullptr, viewport, &context_);
  out.rgb.resize(buffer_rgb_.size());
  for (int row = 0; row < viewport.height; ++row) {
    std::copy_n(buffer_rgb_.data() + 3 * flipped(row, 0, viewport), row_bytes,
                out.rgb.data() + row_bytes * static_cast<std::size_t>(row));
  }
}

void GlScene::read_depth_and_segmentation(const mjrRect& viewport, RenderedImages& out) {
  const std::size_t pixels =
      static_cast<std::size_t>(viewport.width) * static_cast<std::size_t>(viewport.height);
  buffer_rgb_.resize(3 * pixels);
  buffer_depth_.resize(pixels);
  mjr_readPixels(buffer_rgb_.data(), buffer_depth_.data(), viewport, &context_);
  const double near = scene_.camera[0].frustum_near;
  const double far = scene_.camera[0].frustum_far;
  out.depth_m.resize(pixels);
  out.segmentation.resize(pixels);
  std::size_t pixel = 0;
  for (int row = 0; row < viewport.height; ++row) {
    std::size_t source = flipped(row, 0, viewport);
    for (int column = 0; column < viewport.width; ++column, ++source, ++pixel) {
      const unsigned char* id = buffer_rgb_.data() + 3 * source;
      const int drawn = id[0] + 256 * id[1] + 65536 * id[2] - 1;
      const double d = buffer_depth_[source];
      const bool nothing = drawn < 0 || d >= 1.0;
      out.depth_m[pixel] =
          nothing ? 0.0F : static_cast<float>(near * far / (far - d * (far - near)));
      const bool is_geom =
          !nothing && drawn < scene_.ngeom && scene_.geoms[drawn].objtype == mjOBJ_GEOM;
      out.segmentation[pixel] = is_geom ? scene_.geoms[drawn].objid : -1;
    }
  }
}

}  // namespace vantage
