/// Images of the simulated world. The seam between where pixels are drawn (OSMesa's memory
/// buffer, a window) and those who want images.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vantage/geometry/pose.hpp"

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

/// A camera of the model.
struct FixedCamera {
  int camera_id = 0;
  std::optional<double> fovy_rad = {};  ///< vertical field of view instead of the model's
};
/// A camera that circles a point; for people.
struct FreeCamera {
  Eigen::Vector3d lookat_m = Eigen::Vector3d::Zero();  ///< world
  double distance_m = 3.0;
  double azimuth_rad = 1.5707963267948966;     ///< heading of the line of sight
  double elevation_rad = -0.7853981633974483;  ///< of the line of sight; negative looks down
  std::optional<double> fovy_rad = {};         ///< as of a FixedCamera
  /// What stands farther than that before the point, along the line of sight, is cut away.
  std::optional<double> cutaway_m = {};
};
using CameraView = std::variant<FixedCamera, FreeCamera>;

/// Things drawn into the colour image that are not in the world (candidate views, paths).
struct SphereMarker {
  Eigen::Vector3d p_world_m;
  double radius_m = 0.05;
  Eigen::Vector4f rgba{1.0F, 0.0F, 0.0F, 1.0F};
};
struct BoxMarker {
  Eigen::Isometry3d T_world_box;
  Eigen::Vector3d half_size_m;
  Eigen::Vector4f rgba{1.0F, 0.0F, 0.0F, 1.0F};
};
struct LineMarker {
  Eigen::Vector3d from_world_m;
  Eigen::Vector3d to_world_m;
  double width_m = 0.01;
  Eigen::Vector4f rgba{1.0F, 0.0F, 0.0F, 1.0F};
};
using Marker = std::variant<SphereMarker, BoxMarker, LineMarker>;

inline constexpr std::size_t kMaxMarkers = 5000;

struct RenderRequest {
  bool rgb = true;
  bool depth_and_segmentation = true;  ///< one more pass
  bool shadows = false;                ///< slow: another pass per light
  int max_group = 2;                   ///< geoms of higher groups are not drawn
  /// As people want to see a scene: with the geoms of kLooksGroup, without the outer walls that a
  /// camera outside of them would look at, and lit where it has no light. Sensors never ask for it.
  bool for_people = false;
  std::vector<Marker> markers = {};  ///< at most kMaxMarkers; seen in rgb only
  /// What lies wholly farther along the optical axis need not be drawn.
  double range_m = std::numeric_limits<double>::infinity();
  /// Near and far plane, where those of the scene would cut off what a sensor's range holds.
  double near_at_most_m = std::numeric_limits<double>::infinity();
  double far_at_least_m = 0.0;
};

/// Row-major, top row first. What was not requested is empty.
struct RenderedImages {
  int width_px = 0;
  int height_px = 0;
  Pose T_world_camera = Pose::Identity();  ///< axes as in sim/camera.hpp
  double focal_px = 0.0;                   ///< the optical axis meets the middle of the image
  std::vector<std::uint8_t> rgb;           ///< 3 bytes a pixel
  std::vector<float> depth_m;     ///< along the optical axis; 0: nothing up to the far plane
  std::vector<int> segmentation;  ///< geom id, -1: nothing
};

/// Draws one model. Use it from the thread that made it.
class Renderer {
 public:
  Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  virtual ~Renderer() = default;

  [[nodiscard]] virtual int width_px() const = 0;
  [[nodiscard]] virtual int height_px() const = 0;
  /// Draws `data` as its last kinematics left it; `model` is the one this renderer was made for.
  /// @throws RendererError if OpenGL fails.
  virtual void render(const mjModel& model, const mjData& data, const CameraView& view,
                      const RenderRequest& request, RenderedImages& out) = 0;
};

/// Draws in memory with OSMesa, without a display. Round primitives are drawn with the model's
/// `visual/quality` slices and stacks: their depth is that of the polyhedron.
/// @throws RendererError if there is no OpenGL context to be had.
std::unique_ptr<Renderer> make_offscreen_renderer(const mjModel& model, int width_px,
                                                  int height_px);

/// An OpenGL context that one renderer after the other draws in: shaders are compiled once, which
/// takes longer than a few images. What is drawn is the same as in a context of its own. Use it
/// from the thread that made it.
class OffscreenContext;
/// @throws RendererError if there is no OpenGL context to be had.
std::shared_ptr<OffscreenContext> make_offscreen_context();
/// @param context of no other renderer that is still there
std::unique_ptr<Renderer> make_offscreen_renderer(const mjModel& model, int width_px, int height_px,
                                                  std::shared_ptr<OffscreenContext> context);

/// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Compatibility Profile) Mesa 22.3.6".
/// @throws RendererError if there is no OpenGL context to be had.
std::string renderer_name();

}  // namespace vantage
