#include "vantage/sim/world/floor_plan.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

constexpr double kEdge_m = 0.05;

/// Andrew's monotone chain: the lower side, then the upper one.
FloorOutline convex_hull(std::vector<Eigen::Vector2d> points) {
  std::ranges::sort(points, {}, [](const auto& p) { return std::tuple(p.x(), p.y()); });
  FloorOutline hull;
  const auto turns_left = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2];
    const Eigen::Vector2d b = p - hull.back();
    return a.x() * b.y() - a.y() * b.x() > 1e-12;
  };
  const auto add_side = [&](auto begin, auto end) {
    const std::size_t fixed = hull.size() + 1;
    for (auto p = begin; p != end; ++p) {
      while (hull.size() > fixed && !turns_left(*p)) hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  add_side(points.begin(), points.end());
  add_side(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

std::vector<FloorOutline> floor_plan(const mjModel& model, const mjData& data,
                                     const FloorPlanBand& band) {
  std::vector<FloorOutline> plan;
  for (const int geom : solid_geoms(model, kWithoutRobot)) {
    if (model.geom_type[geom] == mjGEOM_PLANE) continue;
    const Eigen::Isometry3d T = T_world_geom(data, geom);
    double low_m = std::numeric_limits<double>::infinity();
    double high_m = -low_m;
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector3d& p : geom_triangles(model, geom, kEdge_m).vertices_m) {
      const Eigen::Vector3d at = T * p;
      low_m = std::min(low_m, at.z());
      high_m = std::max(high_m, at.z());
      points.emplace_back(at.head<2>());
    }
    if (high_m < band.low_m || low_m > band.high_m) continue;
    FloorOutline outline = convex_hull(std::move(points));
    if (outline.size() >= 3) plan.push_back(std::move(outline));
  }
  return plan;
}

}  // namespace vantage
