/// What taking a scan into the belief came to.
#pragma once

#include <cstddef>
#include <string>

#include "vantage/geometry/pose.hpp"

namespace vantage {

struct BeliefUpdate {
  Pose2 T_world_base;      ///< after registration
  bool registered = true;  ///< false: the odometry's pose was kept
  std::string registration_note;
  std::size_t freed_cells = 0;
  std::size_t filled_cells = 0;
};

}  // namespace vantage
