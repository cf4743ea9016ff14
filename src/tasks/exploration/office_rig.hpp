/// The robot in an office: the RGB-D camera on its head on top of what it drives with.
#pragma once

#include <memory>
#include <vector>

#include "vantage/sim/sensors/camera.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/tasks/mapping/mobile_rig.hpp"

namespace vantage {

struct DepthView {
  CameraImages image;  ///< depth alone
  Pose T_base_camera;  ///< OpenCV's axes
};

/// What the robot knows after standing still for a sweep.
struct OfficeObservation {
  std::vector<DepthView> views;
  PlanarScan base_scan;             ///< planar scanner near the floor
  double base_scan_height_m = 0.0;  ///< of that scanner above the floor
  Pose2 T_world_base_odometry;      ///< dead reckoning since the last correction
};

class OfficeRig : public MobileRig {
 public:
  /// @throws ConfigError, InputError if the episode cannot begin, see start_check.hpp
  explicit OfficeRig(const ResolvedEpisode& resolved);

  /// Turns the head all round while the base stands. @throws Interrupted, RendererError
  OfficeObservation observe();
  /// Where a sweep is taken from: on the head's pan axis, x along the base's.
  [[nodiscard]] const Pose& T_base_sweep() const { return T_base_sweep_; }
  [[nodiscard]] Pose estimated_sweep() const { return lift(estimated_base()) * T_base_sweep_; }
  [[nodiscard]] Pose2 base_for_sweep(const Pose& T_world_sweep) const;
  [[nodiscard]] const FieldOfView& view_field() const { return field_; }

 private:
  void turn_head(double pan_rad, double tilt_rad);
  DepthView take_image();

  Pose T_base_sweep_;
  FieldOfView field_;
  std::unique_ptr<Renderer> renderer_;
  Rng camera_noise_;
};

}  // namespace vantage
