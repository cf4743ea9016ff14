/// Interface of a robot that turns in place and scans.
#pragma once

#include "vantage/geometry/range_scan.hpp"

namespace vantage {

class TurningRobotInterface {
 public:
  TurningRobotInterface() = default;
  TurningRobotInterface(const TurningRobotInterface&) = delete;
  TurningRobotInterface& operator=(const TurningRobotInterface&) = delete;
  virtual ~TurningRobotInterface() = default;

  [[nodiscard]] virtual double time_s() const = 0;
  /// One scan of the planar scanner.
  virtual PlanarScan observe() = 0;
  /// Turns in place for the time that the task says. @throws Interrupted
  virtual void turn(double rate_rad_s) = 0;
};

}  // namespace vantage
