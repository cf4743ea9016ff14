/// What keys and mouse do in a window that shows an episode.
#pragma once

#include "vantage/sim/render/window.hpp"
#include "vantage/view/link.hpp"
#include "vantage/view/playback_gate.hpp"

namespace vantage {

struct ViewInput {
  ViewControls& controls;
  PlaybackGate& gate;
  double shown_s = 0.0;  ///< simulated time of the image that is shown
  double tick_s = 0.025;
  bool scrubbing = false;  ///< the drag began on the timeline

  bool quit = false;
  bool screenshot = false;

  void operator()(const KeyPressed& event);
  void operator()(const MousePressed& event);
  void operator()(const MouseDragged& event);
  void operator()(const WheelTurned& event);

 private:
  void playback_key(char key);
  void recording_key(char key);
  void scrub_to(double x_px);
  FreeCamera* moved_camera();
};

}  // namespace vantage
