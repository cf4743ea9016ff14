/// The parts of the loop for the task `wait`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/tasks/wait/turning_robot_interface.hpp"
#include "vantage/tasks/wait/wait.hpp"
#include "vantage/tasks/wait/wait_recorder.hpp"

namespace vantage {

class WaitParts {
 public:
  WaitParts(const Wait& task, std::uint64_t seed, TurningRobotInterface& robot,
            WaitRecorder& recorder);

  PlanarScan observe() { return robot_.observe(); }
  void update(const PlanarScan& scan);
  void record();
  [[nodiscard]] std::string finished() const;
  /// Turning rates, rad/s.
  [[nodiscard]] std::vector<double> propose() const;
  void score(const std::vector<double>&) {}
  std::size_t choose(const std::vector<double>& rates_rad_s);
  void act(double rate_rad_s) { robot_.turn(rate_rad_s); }

  [[nodiscard]] const std::vector<WaitRecord>& records() const { return records_; }

 private:
  Wait task_;
  TurningRobotInterface& robot_;
  WaitRecorder& recorder_;
  Rng choice_rng_;
  std::vector<WaitRecord> records_;
};

}  // namespace vantage
