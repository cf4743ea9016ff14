#include "vantage/models/catalogue/shapes/mesh_builders.hpp"

#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

/// Fraction of the arc length at each node, 0 at the first and 1 at the last.
template <class Point>
std::vector<double> arc_fractions(std::span<const Point> nodes) {
  std::vector<double> fractions{0.0};
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    fractions.push_back(fractions.back() + (nodes[i] - nodes[i - 1]).norm());
  }
  for (double& fraction : fractions) fraction /= fractions.back();
  return fractions;
}

/// Unit tangent at node i: the mean of the directions of the two pieces that meet there.
template <class Point>
Point tangent_at(std::span<const Point> nodes, std::size_t i) {
  Point sum = Point::Zero();
  if (i > 0) sum += (nodes[i] - nodes[i - 1]).normalized();
  if (i + 1 < nodes.size()) sum += (nodes[i + 1] - nodes[i]).normalized();
  return sum.normalized();
}

/// Angle of column j of a ring of n; column n repeats column 0 bit for bit.
double ring_angle(int j, int n) { return 2.0 * pi * (j % n) / n; }

double signed_power(double x, double exponent) {
  return std::copysign(std::pow(std::abs(x), exponent), x);
}

/// Joins two rows of n + 1 vertices; `next` lies further along than `row`. A row shrunk to a point
/// contributes one triangle a column instead of two.
void join_rows(TriangleMesh& mesh, int row, int next, int n, bool row_is_point,
               bool next_is_point) {
  for (int j = 0; j < n; ++j) {
    if (!row_is_point) mesh.triangles.push_back({row + j, row + j + 1, next + j + 1});
    if (!next_is_point) mesh.triangles.push_back({row + j, next + j + 1, next + j});
  }
}

void add_cap(TriangleMesh& mesh, const std::vector<Vector3d>& ring_m, const Vector3d& centre_m,
             const Vector3d& normal, bool ring_is_clockwise, const Vector2d& uv) {
  const int centre = mesh.add_vertex(centre_m, normal, uv);
  const auto n = static_cast<int>(ring_m.size());
  for (const Vector3d& p : ring_m) mesh.add_vertex(p, normal, uv);
  for (int j = 0; j < n; ++j) {
    const int a = centre + 1 + j;
    const int b = centre + 1 + (j + 1) % n;
    if (ring_is_clockwise) {
      mesh.triangles.push_back({centre, b, a});
    } else {
      mesh.triangles.push_back({centre, a, b});
    }
  }
}

}  // namespace

void add_lathe(TriangleMesh& mesh, std::span<const Vector2d> profile_m, int segments,
               const UvRect& uv) {
  expects(profile_m.size() >= 2 && segments >= 3, "a lathe has a profile and sides");
  const std::vector<double> along = arc_fractions(profile_m);
  const int first = static_cast<int>(mesh.positions_m.size());
  const int stride = segments + 1;
  for (std::size_t i = 0; i < profile_m.size(); ++i) {
    const double r = profile_m[i].x();
    const Vector2d tangent = tangent_at(profile_m, i);
    for (int j = 0; j <= segments; ++j) {
      const double angle = ring_angle(j, segments);
      const Vector3d radial(std::cos(angle), std::sin(angle), 0.0);
      const Vector3d normal = r > 0.0
                                  ? Vector3d(tangent.y() * radial - tangent.x() * Vector3d::UnitZ())
                                  : Vector3d(0.0, 0.0, tangent.x() > 0.0 ? -1.0 : 1.0);
      mesh.add_vertex(r * radial + profile_m[i].y() * Vector3d::UnitZ(), normal,
                      uv.at(static_cast<double>(j) / segments, along[i]));
    }
  }
  for (std::size_t i = 0; i + 1 < profile_m.size(); ++i) {
    const int row = first + static_cast<int>(i) * stride;
    join_rows(mesh, row, row + stride, segments, profile_m[i].x() <= 0.0,
              profile_m[i + 1].x() <= 0.0);
  }
}

TriangleMesh make_tube(std::span<const Vector3d> path_m, std::span<const Vector2d> radii_m,
                       const Vector3d& side, int sides, const UvRect& uv) {
  expects(path_m.size() >= 2 && path_m.size() == radii_m.size(), "a tube has a radius per node");
  TriangleMesh mesh;
  const std::vector<double> along = arc_fractions(path_m);
  std::vector<Vector3d> ring_m(static_cast<std::size_t>(sides));
  std::vector<Vector3d> first_ring_m;
  for (std::size_t i = 0; i < path_m.size(); ++i) {
    const Vector3d t = tangent_at(path_m, i);
    const Vector3d a = (side - side.dot(t) * t).normalized();
    const Vector3d b = t.cross(a);
    for (int j = 0; j <= sides; ++j) {
      const double angle = ring_angle(j, sides);
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      const Vector3d p = path_m[i] + radii_m[i].x() * c * a + radii_m[i].y() * s * b;
      mesh.add_vertex(p, c / radii_m[i].x() * a + s / radii_m[i].y() * b,
                      uv.at(static_cast<double>(j) / sides, along[i]));
      if (j < sides) ring_m[static_cast<std::size_t>(j)] = p;
    }
    if (i == 0) first_ring_m = ring_m;
  }
  for (std::size_t i = 0; i + 1 < path_m.size(); ++i) {
    const int row = static_cast<int>(i) * (sides + 1);
    join_rows(mesh, row, row + sides + 1, sides, false, false);
  }
  add_cap(mesh, first_ring_m, path_m.front(), -tangent_at(path_m, 0), true, uv.at(0.5, 0.0));
  add_cap(mesh, ring_m, path_m.back(), tangent_at(path_m, path_m.size() - 1), false,
          uv.at(0.5, 1.0));
  return mesh;
}

BoxUv unfold_box(const Vector3d& size_m, const UvRect& region) {
  const double x = size_m.x();
  const double y = size_m.y();
  const double z = size_m.z();
  const double split = y / (y + z);  // height of the strip of top and bottom
  const double u_x = x / (2.0 * (x + y));
  const double margin = 0.004;
  BoxUv uv{UvRect{u_x, split, 0.5, 1.0},       UvRect{0.5 + u_x, split, 1.0, 1.0},
           UvRect{0.5, split, 0.5 + u_x, 1.0}, UvRect{0.0, split, u_x, 1.0},
           UvRect{0.0, 0.0, 0.5, split},       UvRect{0.5, 0.0, 1.0, split}};
  for (UvRect& rect : uv) {
    rect = shrink(part_of(region, rect.u0, rect.v0, rect.u1, rect.v1), margin);
  }
  return uv;
}

TriangleMesh make_rounded_box(const Vector3d& size_m, double edge_radius_m, int edge_steps,
                              const BoxUv& uv) {
  const Vector3d half = 0.5 * size_m;
  expects(edge_radius_m > 0.0 && edge_radius_m < half.minCoeff(), "edge radius fits the box");
  const Vector3d core = half.array() - edge_radius_m;
  // Offsets from the end of a face's flat part, as fractions of the radius, at equal angles.
  const auto node = [&](int axis, int k) {
    const int last = 2 * edge_steps + 1;
    const int from_end = k <= edge_steps ? k : last - k;
    const double angle = (pi / 4.0) * (edge_steps - from_end) / edge_steps;
    const double reach = from_end == 0 ? half[axis] : core[axis] + edge_radius_m * std::tan(angle);
    return k <= edge_steps ? -reach : reach;
  };
  struct Face {
    int axis, right, up;
    double sign, right_sign, up_sign;
  };
  constexpr std::array<Face, 6> faces{{{0, 1, 2, 1, 1, 1},
                                       {0, 1, 2, -1, -1, 1},
                                       {1, 0, 2, 1, -1, 1},
                                       {1, 0, 2, -1, 1, 1},
                                       {2, 0, 1, 1, 1, 1},
                                       {2, 0, 1, -1, 1, -1}}};
  TriangleMesh mesh;
  const int n = 2 * edge_steps + 2;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f];
    const int first = static_cast<int>(mesh.positions_m.size());
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        Vector3d hard;  // on the box with sharp edges
        hard[face.axis] = face.sign * half[face.axis];
        hard[face.right] = face.right_sign * node(face.right, column);
        hard[face.up] = face.up_sign * node(face.up, row);
        const Vector3d inner = hard.cwiseMax(-core).cwiseMin(core);
        const Vector3d normal = (hard - inner).normalized();
        mesh.add_vertex(inner + edge_radius_m * normal, normal,
                        uv[f].at(0.5 + 0.5 * node(face.right, column) / half[face.right],
                                 0.5 + 0.5 * node(face.up, row) / half[face.up]));
      }
    }
    for (int row = 0; row + 1 < n; ++row) {
      join_rows(mesh, first + row * n, first + (row + 1) * n, n - 1, false, false);
    }
  }
  return mesh;
}

TriangleMesh make_superellipsoid(const Vector3d& radii_m, double squareness_z, double squareness_xy,
                                 int around, int along, const UvRect& uv) {
  TriangleMesh mesh;
  for (int i = 0; i <= along; ++i) {
    const bool pole = i == 0 || i == along;
    const double latitude = pi * (static_cast<double>(i) / along - 0.5);
    const double cz = pole ? 0.0 : std::cos(latitude);
    const double sz = std::sin(latitude);
    for (int j = 0; j <= around; ++j) {
      const double longitude = ring_angle(j, around);
      const double c = std::cos(longitude);
      const double s = std::sin(longitude);
      const double ring = signed_power(cz, squareness_z);
      const Vector3d unit(ring * signed_power(c, squareness_xy),
                          ring * signed_power(s, squareness_xy), signed_power(sz, squareness_z));
      const double ring_normal = signed_power(cz, 2.0 - squareness_z);
      const Vector3d normal(ring_normal * signed_power(c, 2.0 - squareness_xy),
                            ring_normal * signed_power(s, 2.0 - squareness_xy),
                            signed_power(sz, 2.0 - squareness_z));
      mesh.add_vertex(unit.cwiseProduct(radii_m), normal.cwiseQuotient(radii_m),
                      uv.at(static_cast<double>(j) / around, 0.5 + 0.5 * unit.z()));
    }
  }
  for (int i = 0; i < along; ++i) {
    const int row = i * (around + 1);
    join_rows(mesh, row, row + around + 1, around, i == 0, i + 1 == along);
  }
  return mesh;
}

}  // namespace vantage
