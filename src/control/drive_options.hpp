/// Driving a path: how, and what came of it.
#pragma once

#include <string_view>

#include "vantage/control/base_controller.hpp"

namespace vantage {

struct DriveOptions {
  BaseControllerOptions controller = {};
  double goal_tolerance_m = 0.01;
  double goal_tolerance_rad = 0.0105;  // 0.6 deg
  double rest_speed_m_s = 0.002;
  double stuck_time_s = 1.0;
  double timeout_factor = 4.0;
  void fields(auto&& f) {
    f("controller", controller, "speeds and gains of the base controller");
    f("goal_tolerance_m", goal_tolerance_m,
      "distance of the estimated position from the goal within which the base, at rest, has "
      "arrived; higher arrives sooner and less exactly",
      Range{0.001, 1.0});
    f("goal_tolerance_rad", goal_tolerance_rad,
      "heading error within which the base, at rest, has arrived; higher arrives sooner and less "
      "exactly",
      Range{0.001, 1.0});
    f("rest_speed_m_s", rest_speed_m_s,
      "speed of the footprint's edge below which the base is at rest", Range{0.001, 0.1});
    f("stuck_time_s", stuck_time_s,
      "time of commanding motion that the wheels do not measure after which the base is stuck; "
      "higher is more patient",
      above(0.0));
    f("timeout_factor", timeout_factor,
      "time allowed for a drive, as a multiple of the time that its path should take; higher is "
      "more patient",
      at_least(1.0));
  }
};

enum class DriveStatus { arrived, stuck, stopped, timeout };
std::string_view to_string(DriveStatus status);

struct DriveResult {
  DriveStatus status = DriveStatus::arrived;
  double path_length_m = 0.0;  ///< truly driven
  double duration_s = 0.0;     ///< simulated
};

}  // namespace vantage
