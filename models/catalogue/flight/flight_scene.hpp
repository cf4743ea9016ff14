/// Rooms to fly through: a path at a constant height, support surfaces for objects on both sides,
/// and what is in the way.  [Potthast2016, 5.4]
#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace vantage {

inline constexpr double kPathHeight_m = 1.8;  ///< of the vehicle's body
inline constexpr double kFlightWallHeight_m = 2.5;
inline constexpr double kPedestalHalf_m = 0.25;
inline constexpr double kRoundTableRadius_m = 0.28;

/// A pedestal or a round table with a bare level top.
struct FlightSupport {
  Eigen::Vector2d p_world_m;
  double top_m = 0.8;  ///< world z
  double yaw_rad = 0.0;
  bool round = false;
};

/// A box or a cylinder that stands on the floor.
struct FlightObstacle {
  std::string_view kind;  ///< "column", "cupboard", "sideboard"
  Eigen::Vector2d p_world_m;
  Eigen::Vector3d size_m;  ///< edge lengths; a column's first is its diameter
  double yaw_rad = 0.0;
};

struct PathPoint {
  Eigen::Vector2d p_world_m;
  double yaw_rad = 0.0;  ///< along the path
};

struct FlightScene {
  std::string name;
  std::string about;  ///< one line for people
  Eigen::Vector2d room_m;
  std::vector<Eigen::Vector2d> corners_m;  ///< of the polygon that the path follows, rounded
  int waypoints = 0;
  std::vector<FlightSupport> support_surfaces;
  std::vector<FlightObstacle> obstacles = {};
};

/// trajectory_1 ... trajectory_4.
std::vector<FlightScene> flight_scenes();

/// The waypoints: corners cut four times over [Chaikin1974], evenly along the curve.
std::vector<PathPoint> flight_path_points(const FlightScene& scene);

/// The least distance of any obstacle or wall from the middle of the vehicle on its path, level.
double path_clearance_m(const FlightScene& scene);

}  // namespace vantage
