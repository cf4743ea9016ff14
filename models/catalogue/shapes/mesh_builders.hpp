/// Closed surfaces, and strips that close when put together: positions computed from the same
/// numbers are bit-identical, so parts of one profile weld.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "vantage/models/catalogue/shapes/mesh.hpp"
#include "vantage/models/catalogue/shapes/uv_rect.hpp"

namespace vantage {

/// One smooth strip of a surface of revolution about z, from a profile of (r, z) in metres. The
/// outside lies to the right of the direction of travel: outer walls go up, inner walls down, a
/// base from the axis outward, a top from the rim to the axis. u runs counter-clockwise round z, v
/// along the profile by arc length. Edges stay sharp between strips.
void add_lathe(TriangleMesh& mesh, std::span<const Eigen::Vector2d> profile_m, int segments,
               const UvRect& uv);

/// A closed tube with flat ends along `path_m`. `radii_m[i]` are the half axes of the elliptic
/// section at node i: x along `side` (made perpendicular to the path), y perpendicular to both.
/// u runs round the section, v along the path.
TriangleMesh make_tube(std::span<const Eigen::Vector3d> path_m,
                       std::span<const Eigen::Vector2d> radii_m, const Eigen::Vector3d& side,
                       int sides, const UvRect& uv);

/// Texture of the six faces of a box in the order +x, -x, +y, -y, +z, -z. Seen from outside with z
/// up (+y up on the top), images stand upright.
using BoxUv = std::array<UvRect, 6>;
/// An unfolded box whose faces keep their proportions: -y, +x, +y, -x side by side, top and bottom
/// below them, fitted into `region`.
BoxUv unfold_box(const Eigen::Vector3d& size_m, const UvRect& region = {});

/// A box with rounded edges, centred at the origin. `edge_steps` >= 1 facets per rounded edge half.
TriangleMesh make_rounded_box(const Eigen::Vector3d& size_m, double edge_radius_m, int edge_steps,
                              const BoxUv& uv);

/// [Barr1981]; exponents 1 give an ellipsoid, towards 0 a box, 2 a double cone. `squareness_z`
/// shapes the vertical section, `squareness_xy` the horizontal one. Centred at the origin.
TriangleMesh make_superellipsoid(const Eigen::Vector3d& radii_m, double squareness_z,
                                 double squareness_xy, int around, int along, const UvRect& uv);

struct ExtrusionUv {
  UvRect top;
  UvRect bottom;
  UvRect side;  ///< u along the outline, v along z
};
/// A simple polygon (counter-clockwise, metres) swept from z = 0 to `height_m`; its horizontal
/// edges are cut by `bevel_m` >= 0, which must be small against the outline's features.
TriangleMesh make_extrusion(std::span<const Eigen::Vector2d> outline_m, double height_m,
                            double bevel_m, const ExtrusionUv& uv);

/// A Catmull-Rom curve through the control points, `steps` pieces between two of them.
template <class Point>
std::vector<Point> smooth_curve(std::span<const Point> control, int steps) {
  std::vector<Point> curve;
  const auto count = static_cast<int>(control.size());
  const auto node = [&](int i) -> const Point& {
    return control[static_cast<std::size_t>(i < 0 ? 0 : (i >= count ? count - 1 : i))];
  };
  for (int i = 0; i + 1 < count; ++i) {
    const Point tangent_a = 0.5 * (node(i + 1) - node(i - 1));
    const Point tangent_b = 0.5 * (node(i + 2) - node(i));
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const double t2 = t * t;
      const double t3 = t2 * t;
      curve.push_back((2 * t3 - 3 * t2 + 1) * node(i) + (t3 - 2 * t2 + t) * tangent_a +
                      (3 * t2 - 2 * t3) * node(i + 1) + (t3 - t2) * tangent_b);
    }
  }
  curve.push_back(control.back());
  return curve;
}

}  // namespace vantage
