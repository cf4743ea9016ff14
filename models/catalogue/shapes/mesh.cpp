#include "vantage/models/catalogue/shapes/mesh.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

int TriangleMesh::add_vertex(const Eigen::Vector3d& p_m, const Eigen::Vector3d& normal,
                             const Eigen::Vector2d& uv) {
  positions_m.push_back(p_m);
  normals.push_back(normal.normalized());
  uvs.push_back(uv);
  return static_cast<int>(positions_m.size()) - 1;
}

void TriangleMesh::add_quad(int a, int b, int c, int d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

void append(TriangleMesh& mesh, const TriangleMesh& part, const Pose& T_mesh_part) {
  const int first = static_cast<int>(mesh.positions_m.size());
  for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
    mesh.add_vertex(T_mesh_part * part.positions_m[i], T_mesh_part.linear() * part.normals[i],
                    part.uvs[i]);
  }
  for (const auto& [a, b, c] : part.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

void transform(TriangleMesh& mesh, const Pose& T_new_old) {
  for (auto& p : mesh.positions_m) p = T_new_old * p;
  for (auto& n : mesh.normals) n = T_new_old.linear() * n;
}

void scale(TriangleMesh& mesh, const Eigen::Vector3d& factors) {
  expects((factors.array() > 0.0).all(), "scale factors are positive");
  for (auto& p : mesh.positions_m) p = p.cwiseProduct(factors);
  for (auto& n : mesh.normals) n = n.cwiseQuotient(factors).normalized();
}

Eigen::AlignedBox3d bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& p : mesh.positions_m) box.extend(p);
  return box;
}

double signed_volume_m3(const TriangleMesh& mesh) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& p = mesh.positions_m;
    six_volumes += p[static_cast<std::size_t>(a)].dot(
        p[static_cast<std::size_t>(b)].cross(p[static_cast<std::size_t>(c)]));
  }
  return six_volumes / 6.0;
}

std::vector<int> weld(const TriangleMesh& mesh) {
  std::map<std::array<long, 3>, int> points;
  std::vector<int> point_of_vertex;
  point_of_vertex.reserve(mesh.positions_m.size());
  for (const auto& p : mesh.positions_m) {
    const std::array<long, 3> key{std::lround(p.x() / kWeld_m), std::lround(p.y() / kWeld_m),
                                  std::lround(p.z() / kWeld_m)};
    const auto next = static_cast<int>(points.size());
    point_of_vertex.push_back(points.try_emplace(key, next).first->second);
  }
  return point_of_vertex;
}

bool is_watertight(const TriangleMesh& mesh) {
  const std::vector<int> point = weld(mesh);
  std::map<std::pair<int, int>, int> uses;
  for (const auto& triangle : mesh.triangles) {
    const int a = point[static_cast<std::size_t>(triangle[0])];
    const int b = point[static_cast<std::size_t>(triangle[1])];
    const int c = point[static_cast<std::size_t>(triangle[2])];
    if (a == b || b == c || c == a) continue;  // welded to a line
    ++uses[{a, b}];
    ++uses[{b, c}];
    ++uses[{c, a}];
  }
  for (const auto& [edge, count] : uses) {
    const auto reverse = uses.find({edge.second, edge.first});
    if (count != 1 || reverse == uses.end()) return false;
  }
  return !uses.empty();
}

}  // namespace vantage
