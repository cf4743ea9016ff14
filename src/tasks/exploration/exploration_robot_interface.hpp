/// Robot interface of the exploration task: a mobile robot with an RGB-D camera on its head.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vantage/geometry/gaze.hpp"
#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"

namespace vantage {

struct HeadView {
  CameraImages image;  ///< depth alone
  Pose T_base_camera;  ///< OpenCV's axes
};

/// What the robot observes with one sweep, standing still.
struct ExplorationObservation {
  std::vector<HeadView> views;      ///< that arrived, as they were taken
  PlanarScan base_scan;             ///< planar scanner near the floor
  double base_scan_height_m = 0.0;  ///< of that scanner above the floor
  Pose2 T_world_base_odometry;      ///< dead reckoning since the last correction
};

class ExplorationRobotInterface : public MobileRobotInterface {
 public:
  /// Turns the head round while the base stands. @throws Interrupted, RendererError
  /// @param images of sweep_images() that are taken, ascending; none: all of them
  virtual ExplorationObservation observe(std::span<const std::size_t> images) = 0;
  /// Turns the head while the base does what it does; returns at once.
  virtual void look(const Gaze& gaze) = 0;
  /// Whether an image would be sharp: neither joint of the head turns. The base may.
  [[nodiscard]] virtual bool head_rests() const = 0;
  /// One image from where the head is now, if it arrives. @throws RendererError
  virtual std::optional<HeadView> take_image() = 0;
  /// Those of a whole sweep.
  [[nodiscard]] virtual const SweepImages& sweep_images() const = 0;
  /// Where a sweep is taken from: on the head's pan axis, x along the base's.
  [[nodiscard]] virtual const Pose& T_base_sweep() const = 0;
};

}  // namespace vantage
