#include "vantage/tasks/flight/image_gate.hpp"

#include <fmt/format.h>

#include "vantage/core/log.hpp"
#include "vantage/perception/clouds/usable_readings.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {

bool ImageGate::admit(bool arrived, CameraImages& images) {
  discard_unusable(images);
  if (arrived && !is_repeated(last_, images)) {
    refused_ = 0;
    last_.depth_m = images.depth_m;
    return true;
  }
  log_debug(arrived ? "an image is stale: it is not used" : "an image was lost");
  if (++refused_ < max_refused_) return false;
  throw EpisodeFailed(
      fmt::format("the robot is blind: the last {} images were lost or stale", refused_));
}

}  // namespace vantage
