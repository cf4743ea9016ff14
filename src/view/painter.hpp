/// Draws what a window shows: the world as it was at a moment, with what the robot knew and
/// weighed then.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/view/link.hpp"
#include "vantage/view/overlays.hpp"

namespace vantage {

/// From where the scene's own camera "overview" looks, else obliquely from above, at the region of
/// the map and its surroundings.
FreeCamera overview_of(const World& world, const WindowContent& content);
/// Obliquely from above at the middle of the robot; see ViewControls::follow.
FreeCamera follow_of_robot();

/// What is shown of an episode.
struct ViewScene {
  std::string method;
  WindowContent content;
};

class ViewPainter {
 public:
  /// `world` is only drawn in, and may be used by nobody else meanwhile. Use a painter from the
  /// thread that made it.
  ViewPainter(World& world, const ViewScene& scene);

  /// The same image for the same moment, however it was reached.
  /// @throws RendererError
  ViewFrame paint(const ViewLink::Work& work);

 private:
  [[nodiscard]] CameraView camera_for(const ViewControls& controls) const;
  Renderer& renderer_of(PixelSize size);
  [[nodiscard]] ViewCaptions captions_for(const ViewControls& controls, double time_s) const;

  World& world_;
  ViewScene scene_;
  std::optional<int> camera_;  ///< the robot's
  int base_body_;
  std::unique_ptr<Renderer> renderer_;
  std::vector<EpisodeEvent> event_log_;
  EventReplay known_;
};

}  // namespace vantage
