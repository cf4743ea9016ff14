#include "vantage/models/catalogue/shapes/solid_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;

constexpr double kRaster_m = 0.01;

double area_m2(const Outline& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// How far `p` lies outside a convex outline; exact beside its edges, less than the distance beside
/// its corners. Negative inside.
double outside_m(const Outline& outline, const Vector2d& p) {
  double farthest = -1e9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    const Vector2d normal = Vector2d(edge.y(), -edge.x()).normalized();
    farthest = std::max(farthest, normal.dot(p - outline[i]));
  }
  return farthest;
}

/// The parts of the mesh that no edge connects, in order of their first vertices.
std::vector<TriangleMesh> connected_parts(const TriangleMesh& mesh) {
  const std::vector<int> point = weld(mesh);
  std::vector<int> root(point.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int p) {
    while (root[static_cast<std::size_t>(p)] != p) p = root[static_cast<std::size_t>(p)];
    return p;
  };
  for (const auto& triangle : mesh.triangles) {
    const int first = find(point[static_cast<std::size_t>(triangle[0])]);
    for (const int vertex : triangle) {
      root[static_cast<std::size_t>(find(point[static_cast<std::size_t>(vertex)]))] = first;
    }
  }
  std::map<int, std::size_t> part_of;
  std::vector<TriangleMesh> parts;
  std::vector<int> renumbered(point.size());
  const auto part_at = [&](std::size_t vertex) {
    return part_of.try_emplace(find(point[vertex]), part_of.size()).first->second;
  };
  for (std::size_t v = 0; v < point.size(); ++v) {
    const std::size_t part = part_at(v);
    if (part == parts.size()) parts.emplace_back();
    renumbered[v] = parts[part].add_vertex(mesh.positions_m[v], mesh.normals[v], mesh.uvs[v]);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto new_number = [&](int v) { return renumbered[static_cast<std::size_t>(v)]; };
    parts[part_at(static_cast<std::size_t>(a))].triangles.push_back(
        {new_number(a), new_number(b), new_number(c)});
  }
  return parts;
}

/// Whether every point of `outline` is within the slack of one of the parts' outlines.
bool is_covered(const Outline& outline, const std::vector<Outline>& parts, double slack_m) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& p : outline) box.extend(p);
  std::size_t last = 0;  // neighbours are mostly covered by the same part
  for (double y = box.min().y() + 0.5 * kRaster_m; y < box.max().y(); y += kRaster_m) {
    for (double x = box.min().x() + 0.5 * kRaster_m; x < box.max().x(); x += kRaster_m) {
      const Vector2d p(x, y);
      if (outside_m(outline, p) > 0.0 || outside_m(parts[last], p) <= slack_m) continue;
      const auto found = std::ranges::find_if(
          parts, [&](const Outline& part) { return outside_m(part, p) <= slack_m; });
      if (found == parts.end()) return false;
      last = static_cast<std::size_t>(found - parts.begin());
    }
  }
  return true;
}

struct Piece {
  TriangleMesh mesh;
  Outline outline;
};

Outline joined(const Piece& a, const Piece& b) {
  Outline points = a.outline;
  points.insert(points.end(), b.outline.begin(), b.outline.end());
  return convex_outline(std::move(points));
}

}  // namespace

std::vector<TriangleMesh> solid_pieces(const TriangleMesh& mesh, double slack_m) {
  expects(slack_m >= 0.0 && !mesh.triangles.empty(), "a mesh and a slack of at least 0");
  std::vector<Piece> pieces;
  std::vector<Outline> covered;
  for (TriangleMesh& part : connected_parts(mesh)) {
    covered.push_back(convex_footprint(part));
    pieces.push_back({std::move(part), covered.back()});
  }
  std::ranges::stable_sort(pieces, std::ranges::greater{},
                           [](const Piece& piece) { return area_m2(piece.outline); });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size();) {
      Outline both = joined(pieces[i], pieces[j]);
      if (!is_covered(both, covered, slack_m)) {
        ++j;
        continue;
      }
      append(pieces[i].mesh, pieces[j].mesh);
      pieces[i].outline = std::move(both);
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;  // what did not fit before may fit now
    }
  }
  std::vector<TriangleMesh> meshes;
  for (Piece& piece : pieces) meshes.push_back(std::move(piece.mesh));
  return meshes;
}

}  // namespace vantage
