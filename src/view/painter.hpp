/// Draws what a window shows: the world as it was at a moment, with what the robot knew and
/// weighed then.
#pragma once

#include <memory>
#include <vector>

#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/scenario.hpp"
#include "vantage/view/link.hpp"
#include "vantage/view/overlays.hpp"

namespace vantage {

/// From where the scene's own camera "overview" looks, else obliquely from above, at the region of
/// the map and its surroundings.
FreeCamera overview_of(const World& world, const Episode& episode);
/// Obliquely from above at the middle of the robot; see ViewControls::follow.
FreeCamera follow_of_robot();

class ViewPainter {
 public:
  /// `world` is only drawn in, and may be used by nobody else meanwhile. Use a painter from the
  /// thread that made it.
  ViewPainter(World& world, const Episode& episode);

  /// The same image for the same moment, however it was reached.
  /// @throws RendererError
  ViewFrame paint(const ViewLink::Work& work);

 private:
  [[nodiscard]] CameraView camera_for(const ViewControls& controls) const;
  Renderer& renderer_of(PixelSize size);
  [[nodiscard]] ViewCaptions captions_for(const ViewControls& controls, double time_s) const;

  World& world_;
  Episode episode_;
  int camera_;  ///< the robot's
  int base_body_;
  std::unique_ptr<Renderer> renderer_;
  std::vector<EpisodeEvent> event_log_;
  EventReplay known_;
};

}  // namespace vantage
