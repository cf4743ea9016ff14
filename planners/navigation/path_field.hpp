/// Shortest ways from the robot to everywhere it can drive.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/planners/navigation/footprint_space.hpp"

namespace vantage {

/// Nodes that a search settles between two calls of poll_stop().
inline constexpr std::size_t kNodesBetweenPolls = 1 << 15;

struct NavigationOptions {
  double footprint_radius_m = 0.48;
  double margin_m = 0.04;
  double clearance_weight = 1;
  double comfort_m = 0.30;
  double escape_radius_m = 0.6;
  double watch_m = 1.0;
  void fields(auto&& f) {
    f("footprint_radius_m", footprint_radius_m,
      "radius of a circle that holds the robot at any heading; higher keeps farther away from "
      "obstacles",
      at_least(0.0));
    f("margin_m", margin_m,
      "clearance beyond the footprint that a path keeps; 0.71 cells of the floor map make up for "
      "their size",
      at_least(0.0));
    f("clearance_weight", clearance_weight,
      "extra cost per length of path that touches the margin; higher takes longer detours for more "
      "clearance",
      at_least(0.0));
    f("comfort_m", comfort_m,
      "clearance beyond the margin from which more is no better; higher keeps to the middle of "
      "wider places",
      above(0.0));
    f("escape_radius_m", escape_radius_m,
      "length of the way out that is looked for where the robot stands too near an obstacle",
      at_least(0.0));
    f("watch_m", watch_m,
      "length of the way ahead on which a newly seen obstacle stops the robot; higher stops "
      "earlier; 0: never",
      at_least(0.0));
  }
  [[nodiscard]] double inflation_m() const { return footprint_radius_m + margin_m; }
};

/// A pose in a passage, where the heading matters.
struct NarrowPose {
  Pose2 pose;
  std::size_t cell;    ///< of the map
  double cost;         ///< as PathField::cost
  std::size_t parent;  ///< as PathField::parent
};

/// Between two cells or poses of passages, numbered as PathField::parent does; either way.
struct NarrowEdge {
  std::size_t from, to;
  double cost;
  double length_m;  ///< a metre counts for as many as it takes the time of
};

/// One search from the robot's pose over the known free cells that keep the footprint and margin
/// from everything else; answers any goal. It holds a copy of the map: after a new scan, make a new
/// one.
struct PathField {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  FloorMap map;  ///< as it was searched
  NavigationOptions options;
  Pose2 start;                      ///< T_world_base the search started from
  std::vector<float> clearance_m;   ///< per cell, see clearances_m()
  std::vector<double> cost;         ///< length weighted by clearance; infinity where unreachable
  std::vector<std::size_t> parent;  ///< the cell before, towards the start; kNone at its cell.
                                    ///< From map.size() on they are poses in passages, `narrow`
  std::size_t start_cell = kNone;
  std::shared_ptr<const FootprintSpace> space;  ///< of the robot's outline; none: only a disc
  std::vector<NarrowPose> narrow;
  std::vector<NarrowEdge> narrow_edges;

  [[nodiscard]] bool traversable(std::size_t cell) const;
  [[nodiscard]] bool reachable(std::size_t cell) const;
  [[nodiscard]] bool reachable(const Eigen::Vector2d& p_world) const;
  /// Whether so many traversable cells are reached as make an open place: the robot can turn there,
  /// and goes on. Without `space`, one will do.
  [[nodiscard]] bool reaches_open_place() const;
  /// At which the robot stands there, if it cannot turn.
  [[nodiscard]] std::optional<double> heading_rad(std::size_t cell) const;
  /// Cost of a metre driven in `cell`, 1 to 1 + clearance_weight.
  [[nodiscard]] double cost_per_metre(std::size_t cell) const;
};

/// Dijkstra over 8-connected cells; diagonal steps do not cut corners. If the robot stands closer
/// to something than the inflation allows, the search starts from the traversable cell that is
/// nearest by a way through known free cells and at most escape_radius_m long, if possible one that
/// comes no nearer to anything; if there is none, nothing is reachable.
PathField make_path_field(const FloorMap& map, const Pose2& T_world_base,
                          const NavigationOptions& options);

/// The same, and on through passages that the robot's outline fits through at some heading. What a
/// disc reaches is reached as without them.
PathField make_path_field(const FloorMap& map, const Pose2& T_world_base,
                          const NavigationOptions& options,
                          std::shared_ptr<const FootprintSpace> space);

/// The reachable cell whose centre is nearest to `p_world`, the cheaper one of equals; none if
/// nothing is reachable.
std::optional<std::size_t> nearest_reachable(const PathField& field,
                                             const Eigen::Vector2d& p_world);

}  // namespace vantage
