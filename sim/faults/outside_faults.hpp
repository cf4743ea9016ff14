/// Faults of the world: what happens whatever the robot does, by the clock alone, so that a replay
/// meets it again.
#pragma once

#include <cstdint>
#include <optional>

#include "vantage/sim/faults/fault_options.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

/// Wind that pushes the robot, and an object that is moved. Nothing if both are off.
/// @throws ConfigError naming faults.moved_object if the scene has no such body, or none that could
/// be drawn, or if it hangs on joints
void add_outside_faults(World& world, const FaultOptions& options, std::uint64_t seed);

/// The body that is moved, and where to.
struct MovedObject {
  int body_id = 0;
  Eigen::Vector3d from_m;  ///< in its parent's frame, which stands fixed
  Eigen::Vector3d to_m;
};
/// Nothing if it is off. @throws ConfigError as add_outside_faults()
std::optional<MovedObject> moved_object(const World& world, const FaultOptions& options,
                                        std::uint64_t seed);

}  // namespace vantage
