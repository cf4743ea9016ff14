/// What a robot touches, and how often it began to.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "vantage/sim/world/world.hpp"

namespace vantage {

/// Geoms of other things that the tree of bodies under `root_body` touches, ascending, each once;
/// as `data`'s last collision detection left them. Where a geom of `on_floor` (wheels, casters)
/// stands on something, within 30 degrees of level, it does not count.
std::vector<int> touched_geoms(const mjModel& model, const mjData& data, int root_body,
                               std::span<const int> on_floor = {});

/// The same with a geom for each contact point, in no order.
std::vector<int> contact_points(const mjModel& model, const mjData& data, int root_body,
                                std::span<const int> on_floor = {});

/// Counts collisions by their onset: touching a geom again within `release_s` is the same one.
class CollisionCounter {
 public:
  explicit CollisionCounter(double release_s = 0.5) : release_s_(release_s) {}
  /// Once per physics step (World::on_step), or short touches are missed. @return how many began.
  int update(std::span<const int> touched_geoms, double time_s);
  template <class Robot>
  int update(const Robot& robot, const World& world) {
    return update(robot.touched_geoms(world), world.time_s());
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  double release_s_;
  std::map<int, double> last_touched_s_;
  int count_ = 0;
};

}  // namespace vantage
