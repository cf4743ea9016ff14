/// How an episode is recorded.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

struct RecordingOptions {
  double video_speed = 10.0;
  int video_fps = 25;
  int height_px = 720;
  void fields(auto&& f) {
    f("video_speed", video_speed,
      "simulated seconds per second of video; higher makes a shorter video", between(1.0, 1000.0));
    f("video_fps", video_fps,
      "frames per second of the video; higher is smoother and takes longer to render",
      between(1, 120));
    f("height_px", height_px,
      "height of the video, whose width follows at 16:9; higher is sharper and takes longer to "
      "render",
      between(120, 2160));
  }
};

}  // namespace vantage
