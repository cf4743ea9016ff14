#include "vantage/sim/world/mesh_surface.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

bool below_named_body(const mjModel& model, int body_id, std::string_view prefix) {
  for (int b = body_id; b > 0; b = model.body_parentid[b]) {
    if (std::string_view(model.names + model.name_bodyadr[b]).starts_with(prefix)) return true;
  }
  return false;
}

bool invisible(const mjModel& model, int geom_id) {
  const int material = model.geom_matid[geom_id];
  return (material < 0 ? model.geom_rgba[4 * geom_id + 3] : model.mat_rgba[4 * material + 3]) == 0;
}

void add_quad(SurfaceMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

SurfaceMesh asset_triangles(const mjModel& model, int mesh_id) {
  SurfaceMesh mesh;
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh_id];
  for (int v = 0; v < model.mesh_vertnum[mesh_id]; ++v) {
    mesh.vertices_m.emplace_back(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]);
  }
  const int* faces = model.mesh_face + 3 * model.mesh_faceadr[mesh_id];
  for (int f = 0; f < model.mesh_facenum[mesh_id]; ++f) {
    mesh.triangles.push_back({faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]});
  }
  return mesh;
}

/// Closes a height field below: sides and floor at z = -base. Vertices 0 .. nrow * ncol - 1 are the
/// relief's; their copies at the base follow in the same order.
void add_base(SurfaceMesh& mesh, int nrow, int ncol, double base_m) {
  const int top = nrow * ncol;
  for (int i = 0; i < top; ++i) {
    const Eigen::Vector3d p = mesh.vertices_m[static_cast<std::size_t>(i)];
    mesh.vertices_m.emplace_back(p.x(), p.y(), -base_m);
  }
  const auto side = [&](int a, int b) { add_quad(mesh, a, b, b + top, a + top); };
  for (int c = 0; c + 1 < ncol; ++c) {
    side(c, c + 1);
    side((nrow - 1) * ncol + c, (nrow - 1) * ncol + c + 1);
  }
  for (int r = 0; r + 1 < nrow; ++r) {
    side(r * ncol, (r + 1) * ncol);
    side(r * ncol + ncol - 1, (r + 1) * ncol + ncol - 1);
  }
  add_quad(mesh, top, top + ncol - 1, 2 * top - 1, 2 * top - ncol);
}

/// The relief is cut along the same diagonals as in MuJoCo's renderer and ray caster.
SurfaceMesh relief_triangles(const mjModel& model, int hfield_id) {
  const int nrow = model.hfield_nrow[hfield_id];
  const int ncol = model.hfield_ncol[hfield_id];
  const double* size = model.hfield_size + 4 * hfield_id;
  const float* height = model.hfield_data + model.hfield_adr[hfield_id];
  SurfaceMesh mesh;
  for (int r = 0; r < nrow; ++r) {
    for (int c = 0; c < ncol; ++c) {
      mesh.vertices_m.emplace_back(2.0 * size[0] * c / (ncol - 1) - size[0],
                                   2.0 * size[1] * r / (nrow - 1) - size[1],
                                   height[r * ncol + c] * size[2]);
    }
  }
  for (int r = 0; r + 1 < nrow; ++r) {
    for (int c = 0; c + 1 < ncol; ++c) {
      const int i = r * ncol + c;
      add_quad(mesh, i, i + 1, i + ncol + 1, i + ncol);
    }
  }
  add_base(mesh, nrow, ncol, size[3]);
  return mesh;
}

SurfaceMesh box_triangles(const Eigen::Vector3d& half_m) {
  SurfaceMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices_m.emplace_back((corner & 1) != 0 ? half_m.x() : -half_m.x(),
                                 (corner & 2) != 0 ? half_m.y() : -half_m.y(),
                                 (corner & 4) != 0 ? half_m.z() : -half_m.z());
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << ((axis + 1) % 3);
    const int v = 1 << ((axis + 2) % 3);
    for (const int side : {0, 1 << axis}) add_quad(mesh, side, side + u, side + u + v, side + v);
  }
  return mesh;
}

/// Turns a profile of points (radius, z) once round the z axis.
SurfaceMesh revolve(const std::vector<Eigen::Vector2d>& profile, int segments) {
  SurfaceMesh mesh;
  for (const Eigen::Vector2d& point : profile) {
    for (int s = 0; s < segments; ++s) {
      const double angle = 2.0 * std::numbers::pi * s / segments;
      mesh.vertices_m.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle),
                                   point.y());
    }
  }
  for (int ring = 0; ring + 1 < static_cast<int>(profile.size()); ++ring) {
    for (int s = 0; s < segments; ++s) {
      const int next = (s + 1) % segments;
      add_quad(mesh, ring * segments + s, ring * segments + next, (ring + 1) * segments + next,
               (ring + 1) * segments + s);
    }
  }
  return mesh;
}

/// Meridian of a capsule from the bottom pole to the top pole; half length 0 is a sphere.
std::vector<Eigen::Vector2d> capsule_profile(double radius_m, double half_length_m, int segments) {
  std::vector<Eigen::Vector2d> profile;
  const int quarter = std::max(1, segments / 4);
  for (const int half : {-1, 1}) {
    for (int i = 0; i <= quarter; ++i) {
      const int step = half < 0 ? i - quarter : i;
      const double elevation = 0.5 * std::numbers::pi * step / quarter;
      profile.emplace_back(radius_m * std::cos(elevation),
                           half * half_length_m + radius_m * std::sin(elevation));
    }
  }
  return profile;
}

int segments_for(double radius_m, double max_edge_m) {
  const double wanted = std::ceil(2.0 * std::numbers::pi * radius_m / max_edge_m);
  return static_cast<int>(std::clamp(wanted, 16.0, 512.0));
}

}  // namespace

std::vector<int> solid_geoms(const mjModel& model, const GeomFilter& filter) {
  std::vector<int> solid;
  for (int g = 0; g < model.ngeom; ++g) {
    if (invisible(model, g) || model.geom_group[g] > filter.max_group) continue;
    if (!filter.exclude_body_prefix.empty() &&
        below_named_body(model, model.geom_bodyid[g], filter.exclude_body_prefix)) {
      continue;
    }
    solid.push_back(g);
  }
  return solid;
}

bool is_moving_geom(const mjModel& model, int geom_id) {
  const int body = model.geom_bodyid[geom_id];
  return model.body_weldid[body] != 0 || model.body_mocapid[model.body_rootid[body]] >= 0;
}

Eigen::Isometry3d T_world_geom(const mjData& data, int geom_id) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Map<const Eigen::Vector3d>(data.geom_xpos + 3 * geom_id);
  T.linear() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data.geom_xmat + 9 * geom_id);
  return T;
}

Eigen::Vector3d primitive_half_extent(const mjModel& model, int geom_id) {
  const double* size = model.geom_size + 3 * geom_id;
  switch (model.geom_type[geom_id]) {
    case mjGEOM_SPHERE: return {size[0], size[0], size[0]};
    case mjGEOM_CAPSULE: return {size[0], size[0], size[0] + size[1]};
    case mjGEOM_CYLINDER: return {size[0], size[0], size[1]};
    case mjGEOM_ELLIPSOID:
    case mjGEOM_BOX: return {size[0], size[1], size[2]};
    default: assertion_failed("primitive geom");
  }
}

SurfaceMesh geom_triangles(const mjModel& model, int geom_id, double max_edge_m) {
  expects(max_edge_m > 0.0, "edge length above 0");
  const Eigen::Vector3d size = Eigen::Map<const Eigen::Vector3d>(model.geom_size + 3 * geom_id);
  switch (model.geom_type[geom_id]) {
    case mjGEOM_MESH: return asset_triangles(model, model.geom_dataid[geom_id]);
    case mjGEOM_HFIELD: return relief_triangles(model, model.geom_dataid[geom_id]);
    case mjGEOM_BOX: return box_triangles(size);
    case mjGEOM_CYLINDER: {
      const double r = size[0];
      const double h = size[1];
      return revolve({{0.0, -h}, {r, -h}, {r, h}, {0.0, h}}, segments_for(r, max_edge_m));
    }
    case mjGEOM_SPHERE:
    case mjGEOM_CAPSULE: {
      const double half_length = model.geom_type[geom_id] == mjGEOM_CAPSULE ? size[1] : 0.0;
      const int segments = segments_for(size[0], max_edge_m);
      return revolve(capsule_profile(size[0], half_length, segments), segments);
    }
    case mjGEOM_ELLIPSOID: {
      const int segments = segments_for(size.maxCoeff(), max_edge_m);
      SurfaceMesh mesh = revolve(capsule_profile(1.0, 0.0, segments), segments);
      for (Eigen::Vector3d& v : mesh.vertices_m) v = v.cwiseProduct(size);
      return mesh;
    }
    default: assertion_failed("geom with a bounded surface");
  }
}

}  // namespace vantage
