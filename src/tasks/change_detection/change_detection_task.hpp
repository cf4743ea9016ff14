/// The options of the task in which a quadrotor looks whether an object on a table is still what
/// and how its map says. Those of the flight, the views and the database are of RecognitionTask.
#pragma once

#include <optional>
#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/recognition/change_detection.hpp"

namespace vantage {

struct ChangeDetectionTask {
  /// What has changed on the table: none, object, pose, removed. Truth: the robot is not told.
  std::string scenario = "none";
  std::string expected_object;  ///< what the map says stands there; empty: drawn by the seed
  std::optional<double> expected_yaw_rad;  ///< of that, world; none: drawn by the seed
  /// Scenario pose: how far it was turned; none: drawn by the seed, at least by half a bin
  std::optional<double> turned_rad;
  ChangeOptions options;  ///< its `recognition` is not read: `recognition` of the episode holds
  void fields(auto&& f) {
    f("scenario", scenario);
    f("expected_object", expected_object);
    f("expected_yaw_rad", expected_yaw_rad, between(-1000.0, 1000.0));
    f("turned_rad", turned_rad, between(-1000.0, 1000.0));
    options.decision_fields(f);
  }
  void check() const;  ///< a known scenario; and what `options` check
};

}  // namespace vantage
