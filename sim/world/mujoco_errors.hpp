/// MuJoCo's error and warning callbacks turned into exceptions and lists.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace vantage {

/// What MuJoCo calls an error: a call that it could not finish.
struct MujocoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Installs the process-wide handlers; thread-safe, cheap to repeat. Call before any other MuJoCo
/// function. MuJoCo's own wait for a key on stdin, write MUJOCO_LOG.TXT and end the process. Ours
/// throw MujocoError out of the failing call (reset or discard the mjData it worked on) and hand
/// warnings to this thread's collector, or else to the log. Pairs of geoms that are far apart are
/// left out (near_geoms.hpp).
void install_mujoco_handlers();

/// Collects the warnings that MuJoCo raises on this thread while it lives. May be nested.
class WarningCollector {
 public:
  explicit WarningCollector(std::vector<std::string>& sink);
  ~WarningCollector();
  WarningCollector(const WarningCollector&) = delete;
  WarningCollector& operator=(const WarningCollector&) = delete;

 private:
  std::vector<std::string>* previous_;
};

}  // namespace vantage
