/// Tracking a trajectory: how, and what came of it.
#pragma once

#include <string_view>
#include <vector>

#include "vantage/control/flight_disturbance.hpp"
#include "vantage/control/minimum_jerk_trajectory.hpp"

namespace vantage {

struct TrajectoryTrackingOptions {
  FlightControllerOptions controller = {};
  FlightLimits limits = {};
  PoseNoiseOptions pose_noise = {};
  std::vector<Gust> gusts = {};
  double goal_tolerance_m = 0.05;
  double goal_tolerance_rad = 0.05;
  double rest_speed_m_s = 0.05;
  double settle_time_s = 0.3;
  double timeout_s = 8.0;
  void fields(auto&& f) {
    f("controller", controller, "gains and limits of the flight controller");
    f("limits", limits, "greatest speed, acceleration and yaw rate of planned trajectories");
    f("pose_noise", pose_noise, "errors of the pose estimate");
    f("gusts", gusts, "forces that push the vehicle for a while; empty: none");
    f("goal_tolerance_m", goal_tolerance_m,
      "distance of the estimated position from the goal within which the vehicle has arrived; "
      "higher arrives sooner and less exactly; without effect in `trajectory`, which stops nowhere",
      Range{0.001, 1.0});
    f("goal_tolerance_rad", goal_tolerance_rad,
      "heading error within which the vehicle has arrived; higher arrives sooner and less exactly; "
      "without effect in `trajectory`",
      Range{0.001, 1.0});
    f("rest_speed_m_s", rest_speed_m_s,
      "speed below which the vehicle is at rest; without effect in `trajectory`",
      Range{0.001, 1.0});
    f("settle_time_s", settle_time_s,
      "time within tolerance and at rest after which the vehicle has arrived; higher is steadier "
      "and slower; without effect in `trajectory`",
      between(0.0, 10.0));
    f("timeout_s", timeout_s,
      "time after the planned end of a trajectory until it is given up; higher is more patient; "
      "without effect in `trajectory`",
      above(0.0));
  }
};

enum class FlightStatus { arrived, contact, stopped, timeout };
std::string_view to_string(FlightStatus status);

struct FlightResult {
  FlightStatus status = FlightStatus::arrived;
  double duration_s = 0.0;     ///< simulated
  double path_length_m = 0.0;  ///< truly flown
  double rms_error_m = 0.0;    ///< of the true position from the reference, over time
  double greatest_error_m = 0.0;
  double energy_J = 0.0;  ///< induced power of the rotors, integrated
};

}  // namespace vantage
