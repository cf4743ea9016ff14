#include "vantage/sim/robots/robot_outline.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/sim/robots/robot_names.hpp"

namespace vantage {
namespace {

constexpr int kLines = 64;

Pose pose_in_base(const mjModel& model, int base_body, int geom) {
  Pose T = pose_of(model.geom_pos + 3 * geom, model.geom_quat + 4 * geom);
  for (int at = model.geom_bodyid[geom]; at != base_body; at = model.body_parentid[at]) {
    T = pose_of(model.body_pos + 3 * at, model.body_quat + 4 * at) * T;
  }
  return T;
}

double farthest_vertex(const mjModel& model, int geom, const Eigen::Vector3d& along) {
  const int mesh = model.geom_dataid[geom];
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  double reach = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < model.mesh_vertnum[mesh]; ++i) {
    const Eigen::Vector3d p(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]);
    reach = std::max(reach, along.dot(p));
  }
  return reach;
}

/// How far the geom reaches from its middle in a direction of its own frame.
double reach_of(const mjModel& model, int geom, const Eigen::Vector3d& along) {
  const Eigen::Vector3d size(model.geom_size[3 * geom], model.geom_size[3 * geom + 1],
                             model.geom_size[3 * geom + 2]);
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE: return size.x();
    case mjGEOM_CAPSULE: return std::abs(along.z()) * size.y() + size.x();
    case mjGEOM_CYLINDER: return std::abs(along.z()) * size.y() + along.head<2>().norm() * size.x();
    case mjGEOM_ELLIPSOID: return along.cwiseProduct(size).norm();
    case mjGEOM_MESH: return farthest_vertex(model, geom, along);
    default: return along.cwiseAbs().dot(size);
  }
}

/// How far the robot reaches from the base's origin in each of the directions.
std::vector<double> reaches_of(const mjModel& model, int base_body,
                               const std::vector<Eigen::Vector3d>& directions) {
  std::vector<double> reaches(directions.size(), -std::numeric_limits<double>::infinity());
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const bool is_robots =
        model.body_rootid[model.geom_bodyid[geom]] == model.body_rootid[base_body];
    if (!is_robots || (model.geom_contype[geom] == 0 && model.geom_conaffinity[geom] == 0))
      continue;
    const Pose T_base_geom = pose_in_base(model, base_body, geom);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double reach = directions[i].dot(T_base_geom.translation()) +
                           reach_of(model, geom, T_base_geom.linear().transpose() * directions[i]);
      reaches[i] = std::max(reaches[i], reach);
    }
  }
  return reaches;
}

}  // namespace

FloorOutline outline_of_geoms(const mjModel& model, int base_body, const std::string& where) {
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < kLines; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kLines;
    directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  }
  const std::vector<double> reaches = reaches_of(model, base_body, directions);
  if (!std::isfinite(reaches.front())) {
    throw InputError(fmt::format("{}: none of the geoms of body '{}' can touch anything", where,
                                 model_name(model, ModelObject::body, base_body)));
  }
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::size_t next = (i + 1) % directions.size();
    Eigen::Matrix2d lines;
    lines << directions[i].head<2>().transpose(), directions[next].head<2>().transpose();
    corners.emplace_back(lines.inverse() * Eigen::Vector2d(reaches[i], reaches[next]));
  }
  return convex_outline(std::move(corners));
}

FloorOutline outline_of_corners(std::span<const std::array<double, 2>> corners_m) {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [x_m, y_m] : corners_m) corners.emplace_back(x_m, y_m);
  return convex_outline(std::move(corners));
}

FloorOutline robot_outline(const mjModel& model, int base_body,
                           std::span<const std::array<double, 2>> corners_m,
                           const std::string& where) {
  return corners_m.empty() ? outline_of_geoms(model, base_body, where)
                           : outline_of_corners(corners_m);
}

}  // namespace vantage
