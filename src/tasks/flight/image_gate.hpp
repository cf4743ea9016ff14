/// What stands between a camera that may fail and the belief.
#pragma once

#include "vantage/geometry/range_scan.hpp"

namespace vantage {

/// Admits images that arrived and are new, and of their depth what says something.
class ImageGate {
 public:
  /// @param max_refused in a row: the robot is blind then
  explicit ImageGate(int max_refused) : max_refused_(max_refused) {}

  /// Whether the image may be used; discards readings that say nothing.
  /// @throws EpisodeFailed if the last ones in a row, `max_refused` of them, may not
  bool admit(bool arrived, CameraImages& images);

  /// The first that is admitted of those that `observe` makes.
  auto first_admitted(auto&& observe) {
    auto observation = observe();
    while (!admit(observation.arrived, observation.images)) observation = observe();
    return observation;
  }

 private:
  int max_refused_;
  int refused_ = 0;  ///< in a row
  CameraImages last_;
};

}  // namespace vantage
