/// Where to look from at what the robot cannot reach yet.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

/// The ways on from where the robot gets to, as if nothing were there but what the planar scanner
/// has met: what is hidden from the camera behind the posts of a door may turn out to be free. They
/// keep the robot's inscribed disc from what was met, so that they lead through the middle of a
/// door, and not through walls.
class Outlooks {
 public:
  explicit Outlooks(const PathField& paths);

  /// The last reachable cell on the way to `p_m`, or as near to it as a way leads; none if nothing
  /// is reachable.
  [[nodiscard]] std::optional<std::size_t> towards(const Eigen::Vector2d& p_m) const;

 private:
  void find_ways(const std::vector<std::uint8_t>& passable);

  const FloorMap& map_;
  std::vector<float> way_m_;         ///< per cell, from the last reachable one; or infinity
  std::vector<std::uint32_t> from_;  ///< that one
};

}  // namespace vantage
