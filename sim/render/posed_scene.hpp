/// Images of a scene whose things are put where they shall be, without physics.
#pragma once

#include <memory>
#include <string_view>

#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/world/scene.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

/// A model with its state and renderer. Use it from the thread that made it.
class PosedScene {
 public:
  /// @param context of no other renderer that is still there
  /// @throws RendererError if OpenGL fails.
  PosedScene(ModelPtr model, int width_px, int height_px,
             std::shared_ptr<OffscreenContext> context = make_offscreen_context());

  /// Moves a body that the model declares as mocap.
  void set_pose(std::string_view body, const Pose& T_world_body);
  /// Draws what `camera` of the model sees, every geom as it was posed last.
  /// @throws RendererError if OpenGL fails.
  void render(std::string_view camera, const RenderRequest& request, RenderedImages& out);
  /// Id of a geom, as segmentation tells it.
  [[nodiscard]] int geom_id(std::string_view name) const;

 private:
  ModelPtr model_;
  DataPtr data_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace vantage
