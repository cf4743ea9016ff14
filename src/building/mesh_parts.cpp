#include "vantage/building/mesh_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace vantage {
namespace {

using Edge = std::pair<int, int>;

/// A side of a triangle, from the lower vertex to the higher, or back.
struct Side {
  std::size_t triangle;
  bool forward;
};
using Sides = std::map<Edge, std::vector<Side>>;

Sides sides_of(const std::vector<Triangle>& triangles) {
  Sides sides;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = triangles[t][i];
      const int b = triangles[t][(i + 1) % 3];
      sides[std::minmax(a, b)].push_back({t, a < b});
    }
  }
  return sides;
}

using Neighbours = std::vector<std::vector<std::pair<std::size_t, bool>>>;

void join(const Side& a, const Side& b, Neighbours& neighbours) {
  const bool alike = a.forward != b.forward;
  neighbours[a.triangle].emplace_back(b.triangle, alike);
  neighbours[b.triangle].emplace_back(a.triangle, alike);
}

/// Beside each triangle, those across an edge, and whether they are wound alike. Of an edge where
/// several solids meet, the two triangles of one object of the file.
Neighbours neighbours_of(const BuildingMesh& mesh) {
  Neighbours neighbours(mesh.triangles.size());
  for (const auto& [edge, all] : sides_of(mesh.triangles)) {
    if (all.size() == 2) join(all[0], all[1], neighbours);
    if (all.size() <= 2) continue;
    std::map<int, std::vector<Side>> of_object;
    for (const Side& side : all) of_object[mesh.objects[side.triangle]].push_back(side);
    for (const auto& [object, own] : of_object) {
      if (own.size() == 2) join(own[0], own[1], neighbours);
    }
  }
  return neighbours;
}

Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

bool is_closed(const std::vector<Triangle>& triangles) {
  const Sides sides = sides_of(triangles);
  return std::ranges::all_of(sides, [](const auto& entry) {
    const auto forward = std::ranges::count(entry.second, true, &Side::forward);
    return 2 * forward == static_cast<std::ptrdiff_t>(entry.second.size());
  });
}

double volume_of(const BuildingMesh& mesh, const std::vector<Triangle>& triangles) {
  const Eigen::Vector3d& origin = mesh.corner(triangles.front(), 0);
  double six_volumes_m3 = 0.0;
  for (const Triangle& t : triangles) {
    six_volumes_m3 += (mesh.corner(t, 0) - origin)
                          .dot((mesh.corner(t, 1) - origin).cross(mesh.corner(t, 2) - origin));
  }
  return six_volumes_m3 / 6.0;
}

/// Whether a robot could be inside.
bool is_as_large_as_a_room(const BuildingMesh& mesh, const MeshPart& part) {
  constexpr double kNarrowest_m = 1.5;
  constexpr double kThickness_m = 0.6;  // of a wardrobe it is less
  Eigen::AlignedBox3d box;
  double area_m2 = 0.0;
  for (const Triangle& t : part.triangles) {
    for (std::size_t i = 0; i < 3; ++i) box.extend(mesh.corner(t, i));
    area_m2 += 0.5 * mesh.normal(t).norm();
  }
  return box.sizes().minCoeff() >= kNarrowest_m &&
         2.0 * std::abs(part.volume_m3) / area_m2 >= kThickness_m;
}

void orient(const BuildingMesh& mesh, MeshPart& part) {
  part.closed = is_closed(part.triangles);
  if (!part.closed) return;
  part.volume_m3 = volume_of(mesh, part.triangles);
  if (part.volume_m3 >= 0.0 || is_as_large_as_a_room(mesh, part)) return;
  for (Triangle& t : part.triangles) t = turned(t);
  part.volume_m3 = -part.volume_m3;
}

}  // namespace

std::vector<MeshPart> mesh_parts(const BuildingMesh& mesh) {
  const Neighbours neighbours = neighbours_of(mesh);
  std::vector<std::uint8_t> taken(mesh.triangles.size(), 0);
  std::vector<MeshPart> parts;
  for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (taken[seed] != 0) continue;
    MeshPart part{.triangles = {}, .colour = mesh.colours[seed]};
    std::vector<std::pair<std::size_t, bool>> open{{seed, true}};
    taken[seed] = 1;
    while (!open.empty()) {
      const auto [at, as_it_is] = open.back();
      open.pop_back();
      part.triangles.push_back(as_it_is ? mesh.triangles[at] : turned(mesh.triangles[at]));
      for (const auto& [next, alike] : neighbours[at]) {
        if (taken[next] != 0) continue;
        taken[next] = 1;
        open.emplace_back(next, alike == as_it_is);
      }
    }
    orient(mesh, part);
    parts.push_back(std::move(part));
  }
  return parts;
}

bool is_solid(const MeshPart& part) { return part.closed && part.volume_m3 > 0.0; }

std::vector<Eigen::Vector3d> corners_of(const BuildingMesh& mesh, const MeshPart& part) {
  std::set<int> ids;
  for (const Triangle& t : part.triangles) ids.insert(t.begin(), t.end());
  std::vector<Eigen::Vector3d> corners;
  for (const int id : ids) corners.push_back(mesh.vertices_m[static_cast<std::size_t>(id)]);
  return corners;
}

bool is_convex(const BuildingMesh& mesh, const MeshPart& part) {
  constexpr std::size_t kMostCorners = 256;
  constexpr double kFlat_m = 1e-3;
  if (!is_solid(part) || part.triangles.size() > 2 * kMostCorners) return false;
  const std::vector<Eigen::Vector3d> corners = corners_of(mesh, part);
  return std::ranges::all_of(part.triangles, [&](const Triangle& t) {
    const Eigen::Vector3d normal = mesh.normal(t).normalized();
    const double offset_m = normal.dot(mesh.corner(t, 0)) + kFlat_m;
    return std::ranges::all_of(corners,
                               [&](const auto& p_m) { return normal.dot(p_m) <= offset_m; });
  });
}

bool is_box(const BuildingMesh& mesh, const MeshPart& part, OrientedBox& box) {
  constexpr double kSameTurn = 1e-3;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  int found = 0;
  for (const Triangle& t : part.triangles) {
    const Eigen::Vector3d normal = mesh.normal(t).normalized();
    const Eigen::Vector3d along = (axes.transpose() * normal).cwiseAbs();
    if (along.maxCoeff() > 1.0 - kSameTurn * kSameTurn) continue;
    if (found == 3 || along.maxCoeff() > kSameTurn) return false;
    axes.col(found++) = normal;
  }
  if (found != 3) return false;
  // The nearest to the mesh's own axes, so that an upright box is not turned.
  Eigen::Matrix3d sorted = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    int nearest = 0;
    axes.row(i).cwiseAbs().maxCoeff(&nearest);
    sorted.col(i) = (axes(i, nearest) < 0.0 ? -1.0 : 1.0) * axes.col(nearest);
    axes.col(nearest).setZero();
  }
  if (std::abs(std::abs(sorted.determinant()) - 1.0) > 1e-2) return false;
  sorted.col(1) = (sorted.col(1) - sorted.col(0) * sorted.col(0).dot(sorted.col(1))).normalized();
  sorted.col(2) = sorted.col(0).cross(sorted.col(1));
  Eigen::AlignedBox3d extent_m;
  for (const auto& p_m : corners_of(mesh, part)) extent_m.extend(sorted.transpose() * p_m);
  box.half_m = 0.5 * extent_m.sizes();
  box.T_mesh_box.linear() = sorted;
  box.T_mesh_box.translation() = sorted * extent_m.center();
  return true;
}

}  // namespace vantage
