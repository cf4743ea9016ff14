#include "vantage/building/fitted_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kMostCells = 1e8;
constexpr std::size_t kMostPlanes = 1500;
constexpr double kLeastPlane_m2 = 0.002;
constexpr double kSamePlane_m = 1e-4;

struct Plane {
  double at_m;
  double area_m2;
};

/// Of all faces square to the axis, those in one plane together; the largest first.
std::vector<Plane> planes_across(const BuildingMesh& mesh, int axis) {
  constexpr double kSquare = 1.0 - 1e-6;
  std::vector<Plane> faces;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d normal = mesh.normal(t);
    if (std::abs(normal[axis]) < kSquare * normal.norm()) continue;
    const double sum_m =
        mesh.corner(t, 0)[axis] + mesh.corner(t, 1)[axis] + mesh.corner(t, 2)[axis];
    faces.push_back({sum_m / 3.0, 0.5 * normal.norm()});
  }
  std::ranges::sort(faces, {}, &Plane::at_m);
  std::vector<Plane> planes;
  for (const Plane& face : faces) {
    if (planes.empty() || face.at_m - planes.back().at_m > kSamePlane_m)
      planes.push_back({face.at_m, 0.0});
    planes.back().area_m2 += face.area_m2;
  }
  std::erase_if(planes, [](const Plane& plane) { return plane.area_m2 < kLeastPlane_m2; });
  std::ranges::stable_sort(planes, std::ranges::greater(), &Plane::area_m2);
  if (planes.size() > kMostPlanes) planes.resize(kMostPlanes);
  return planes;
}

/// Adds a line unless another is too near.
void add_line(std::set<double>& lines, double at_m, double nearest_m) {
  const auto after = lines.lower_bound(at_m);
  if (after != lines.end() && *after - at_m < nearest_m) return;
  if (after != lines.begin() && at_m - *std::prev(after) < nearest_m) return;
  lines.insert(after, at_m);
}

std::vector<double> subdivided(const std::set<double>& lines, double cell_m) {
  std::vector<double> all;
  for (const double line : lines) {
    if (!all.empty()) {
      const double from_m = all.back();
      const int parts = std::max(1, static_cast<int>(std::ceil((line - from_m) / cell_m - 1e-9)));
      for (int i = 1; i < parts; ++i) all.push_back(from_m + (line - from_m) * i / parts);
    }
    all.push_back(line);
  }
  return all;
}

std::vector<double> lines_along(const BuildingMesh& mesh, int axis, double low_m, double high_m,
                                double cell_m) {
  std::set<double> lines;
  if (axis == 2 && low_m - cell_m < 0.0 && high_m + cell_m > 0.0) lines.insert(0.0);
  for (const Plane& plane : planes_across(mesh, axis)) {
    if (plane.at_m < low_m || plane.at_m > high_m) continue;
    const bool at_floor = axis == 2 && std::abs(plane.at_m) < kFloorCells * cell_m;
    if (!at_floor) add_line(lines, plane.at_m, kNearestLines * cell_m);
  }
  lines.insert(std::min(low_m, lines.empty() ? low_m : *lines.begin()) - cell_m);
  lines.insert(std::max(high_m, *lines.rbegin()) + cell_m);
  return subdivided(lines, cell_m);
}

void require_few_cells(double cells, const Eigen::AlignedBox3d& box_m, double cell_m) {
  if (cells <= kMostCells) return;
  const Eigen::Vector3d size_m = box_m.sizes();
  throw ConfigError(fmt::format(
      "--cell {:g}: too many cells, {:.3g} of {:.3g} x {:.3g} x {:.3g} m; {:.2g} m would do, or "
      "is --scale wrong?",
      cell_m, cells, size_m.x(), size_m.y(), size_m.z(),
      std::ceil(100.0 * cell_m * std::cbrt(cells / kMostCells)) / 100.0));
}

}  // namespace

std::vector<double> FittedGrid::centres_m(int axis) const {
  std::vector<double> centres;
  for (int i = 0; i < cells(axis); ++i) {
    centres.push_back(0.5 * (line_m(axis, i) + line_m(axis, i + 1)));
  }
  return centres;
}

int FittedGrid::cell_at(int axis, double at_m) const {
  const auto& lines = lines_m[static_cast<std::size_t>(axis)];
  const auto after = std::ranges::upper_bound(lines, at_m) - lines.begin();
  return std::clamp(static_cast<int>(after) - 1, 0, cells(axis) - 1);
}

FittedGrid fit_grid(const BuildingMesh& mesh, const Eigen::AlignedBox3d& box_m, double cell_m) {
  const Eigen::Array3d across = box_m.sizes().array() / cell_m + 2.0;
  require_few_cells(across.prod(), box_m, cell_m);
  FittedGrid grid;
  grid.cell_m = cell_m;
  for (int axis = 0; axis < 3; ++axis) {
    grid.lines_m[static_cast<std::size_t>(axis)] =
        lines_along(mesh, axis, box_m.min()[axis], box_m.max()[axis], cell_m);
  }
  // Planes of the mesh make lines of their own.
  require_few_cells(Eigen::Array3d(grid.cells(0), grid.cells(1), grid.cells(2)).prod(), box_m,
                    cell_m);
  return grid;
}

}  // namespace vantage
