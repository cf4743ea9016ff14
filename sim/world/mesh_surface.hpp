/// The geoms of a compiled MuJoCo model as surfaces: which of them are solid to a sensor, and their
/// triangles.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <string>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

/// Of geoms that are there to be looked at by people alone: no sensor sees them.
inline constexpr int kLooksGroup = 5;

/// Which geoms a sensor can meet. By default the rule of `mj_ray` with `geomgroup` NULL: every
/// geom, static ones included, except those whose colour (the material's, if there is one) has
/// alpha 0; and those of kLooksGroup.
struct GeomFilter {
  std::string exclude_body_prefix =
      {};  ///< leaves out bodies of that name and all below them; "" none
  int max_group =
      kLooksGroup - 1;  ///< leaves out higher ones; 2 keeps what MuJoCo draws by default
};

/// The scene without the robot that stands in it.
inline const GeomFilter kWithoutRobot{.exclude_body_prefix = "robot/"};

/// Ids of the geoms that pass `filter`, ascending.
std::vector<int> solid_geoms(const mjModel& model, const GeomFilter& filter = {});

/// True if the geom can change its place: its body is not welded to the world, or is a mocap body.
bool is_moving_geom(const mjModel& model, int geom_id);

/// Pose of a geom as of the last kinematics on `data`.
Eigen::Isometry3d T_world_geom(const mjData& data, int geom_id);

/// Half the edges of a box round the geom's frame that holds the geom, in m. Not for planes, meshes
/// and height fields.
Eigen::Vector3d primitive_half_extent(const mjModel& model, int geom_id);

struct SurfaceMesh {
  std::vector<Eigen::Vector3d> vertices_m;
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices, no particular orientation
};

/// Surface of any geom but a plane, in the geom's frame. Meshes, height fields and boxes are exact;
/// on round primitives edges across the curvature are at most `max_edge_m` long (but at least 16
/// and at most 512 of them make a turn).
SurfaceMesh geom_triangles(const mjModel& model, int geom_id, double max_edge_m);

}  // namespace vantage
