/// MuJoCo's drawing resources inside whatever OpenGL context is current: shared by the renderers
/// that differ in where the context comes from.
#pragma once

#include <mujoco/mujoco.h>

#include <optional>
#include <vector>

#include "vantage/sim/render/outer_walls.hpp"
#include "vantage/sim/render/renderer.hpp"

namespace vantage {

/// Empty at first, and freed with its owner, even one whose constructor throws.
struct OwnedScene : mjvScene {
  OwnedScene() : mjvScene{} { mjv_defaultScene(this); }
  OwnedScene(const OwnedScene&) = delete;
  OwnedScene& operator=(const OwnedScene&) = delete;
  ~OwnedScene() { mjv_freeScene(this); }
};
struct OwnedContext : mjrContext {
  OwnedContext() : mjrContext{} { mjr_defaultContext(this); }
  OwnedContext(const OwnedContext&) = delete;
  OwnedContext& operator=(const OwnedContext&) = delete;
  ~OwnedContext() { mjr_freeContext(this); }
};

/// Owns an mjvScene and an mjrContext. The context that was current at construction must be current
/// again at each call and at destruction.
class GlScene {
 public:
  /// @throws RendererError if MuJoCo cannot use the current context.
  explicit GlScene(const mjModel& model);

  /// Draws into the context's default framebuffer of that size and reads the images back.
  void render(const mjData& data, const CameraView& view, const RenderRequest& request,
              int width_px, int height_px, RenderedImages& out);

  [[nodiscard]] const mjModel& model() const { return *model_; }

 private:
  void update(const mjData& data, const CameraView& view, const RenderRequest& request);
  void leave_out_walls();
  void add_markers(const std::vector<Marker>& markers);
  void read_rgb(const mjrRect& viewport, RenderedImages& out);
  void read_depth_and_segmentation(const mjrRect& viewport, RenderedImages& out);

  const mjModel* model_;
  std::optional<OuterWalls> walls_;  ///< found when people look first
  OwnedScene scene_;
  OwnedContext context_;
  std::vector<float> buffer_depth_;  ///< scratch, bottom row first
  std::vector<unsigned char> buffer_rgb_;
};

}  // namespace vantage
