#include "vantage/sim/render/outer_walls.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

constexpr double kThin_m =
    0.25;  ///< walls are not thicker, and what is on them is as near the edge
constexpr double kHigh_m = 1.5;
constexpr double kMostOfIt = 0.6;
constexpr double kEdge_m = 0.3;  ///< of a round thing's polyhedron

struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

struct GeomBox {
  int id = 0;
  Eigen::AlignedBox3d box_m;
};

std::vector<GeomBox> still_boxes(const mjModel& model) {
  const std::unique_ptr<mjData, DeleteData> data(mj_makeData(&model));
  std::vector<GeomBox> boxes;
  if (!data) return boxes;
  mj_kinematics(&model, data.get());
  for (const int geom : solid_geoms(model, {.max_group = kLooksGroup})) {
    if (model.geom_type[geom] == mjGEOM_PLANE || is_moving_geom(model, geom)) continue;
    const Eigen::Isometry3d T = T_world_geom(*data, geom);
    GeomBox& found = boxes.emplace_back(GeomBox{geom, {}});
    for (const Eigen::Vector3d& p : geom_triangles(model, geom, kEdge_m).vertices_m) {
      found.box_m.extend(T * p);
    }
  }
  return boxes;
}

/// Sides are numbered as in OuterWalls.
int axis_of(int side) { return side / 2; }
bool is_upper(int side) { return side % 2 == 1 || side == OuterWalls::kSides - 1; }

bool at_side(const Eigen::AlignedBox3d& box_m, const Eigen::AlignedBox3d& extent_m, int side) {
  const int axis = axis_of(side);
  if (axis == 2 && box_m.min().z() < extent_m.min().z() + kHigh_m) return false;  // a worktop
  if (is_upper(side)) return box_m.min()[axis] >= extent_m.max()[axis] - kThin_m;
  return box_m.max()[axis] <= extent_m.min()[axis] + kThin_m;
}

/// How much of the side the box closes: of a wall its length, of a ceiling the area.
double closed(const Eigen::Vector3d& sizes_m, int side) {
  if (axis_of(side) == 2) return sizes_m.x() * sizes_m.y();
  return sizes_m.z() >= kHigh_m ? sizes_m[1 - axis_of(side)] : 0.0;
}

double whole(const Eigen::Vector3d& sizes_m, int side) {
  return axis_of(side) == 2 ? sizes_m.x() * sizes_m.y() : sizes_m[1 - axis_of(side)];
}

}  // namespace

std::vector<int> OuterWalls::before(const Eigen::Vector3d& eye_m) const {
  std::vector<int> hidden;
  for (int side = 0; side < kSides; ++side) {
    const int axis = axis_of(side);
    const bool beyond =
        is_upper(side) ? eye_m[axis] > extent_m.max()[axis] : eye_m[axis] < extent_m.min()[axis];
    const std::vector<int>& on_side = geoms[static_cast<std::size_t>(side)];
    if (beyond) hidden.insert(hidden.end(), on_side.begin(), on_side.end());
  }
  std::ranges::sort(hidden);
  return hidden;
}

OuterWalls outer_walls(const mjModel& model) {
  const std::vector<GeomBox> boxes = still_boxes(model);
  OuterWalls walls;
  if (boxes.empty()) return walls;
  for (const GeomBox& geom : boxes) walls.extent_m.extend(geom.box_m);
  const Eigen::Vector3d extent_m = walls.extent_m.sizes();
  for (int side = 0; side < OuterWalls::kSides; ++side) {
    std::vector<int> at_edge;
    double sum = 0.0;
    for (const GeomBox& geom : boxes) {
      if (!at_side(geom.box_m, walls.extent_m, side)) continue;
      at_edge.push_back(geom.id);
      sum += closed(geom.box_m.sizes(), side);
    }
    if (sum < kMostOfIt * whole(extent_m, side)) continue;
    walls.geoms[static_cast<std::size_t>(side)] = std::move(at_edge);
  }
  return walls;
}

}  // namespace vantage
