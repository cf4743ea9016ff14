/// What is really so of a mobile robot and its scene. For evaluators alone.
#pragma once

#include "vantage/planners/navigation/footprint_space.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

/// Looks at a simulation that outlives it.
class MobileGroundTruth {
 public:
  /// @param geometry of the scene without the robot
  MobileGroundTruth(const World& world, const MobileBase& robot, const RayScene& geometry,
                    const CollisionCounter& collisions)
      : world_(world), robot_(robot), geometry_(geometry), collisions_(collisions) {}

  [[nodiscard]] Pose2 T_world_base() const { return robot_.T_world_base(world_); }
  [[nodiscard]] RobotOutline outline() const {
    return {.outline = robot_.outline(), .goes_sideways = robot_.is_holonomic()};
  }
  [[nodiscard]] int collisions() const { return collisions_.count(); }
  [[nodiscard]] const RayScene& geometry() const { return geometry_; }
  [[nodiscard]] const World& world() const { return world_; }

 private:
  const World& world_;
  const MobileBase& robot_;
  const RayScene& geometry_;
  const CollisionCounter& collisions_;
};

}  // namespace vantage
