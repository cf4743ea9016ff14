#include "vantage/sim/sensors/ground_truth.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "vantage/geometry/view_cone.hpp"

namespace vantage {
namespace {

bool sees_cell(const RayScene& scene, const GridFrame& grid, const Eigen::Array3i& cell,
               const Eigen::Vector3d& p_world_sensor, int exclude_body, int& blocker_id) {
  constexpr double contact_m = 1e-6;
  const Eigen::Vector3d centre = grid.centre(cell);
  const Eigen::Vector3d to_centre = centre - p_world_sensor;
  const double distance = to_centre.norm();
  const Eigen::Vector3d half = 0.5 * grid.cell_size_m;
  const SegmentClip inside =
      clip_segment(Eigen::AlignedBox3d(centre - half, centre + half), p_world_sensor, centre);
  const double entry = inside.enter * distance;
  if (entry == 0.0) return true;
  return !scene.blocks(p_world_sensor, to_centre / distance, entry + contact_m, exclude_body,
                       blocker_id);
}

/// Marks the cells that a surface passes by cutting its triangles until they are smaller than half
/// a cell, and dropping on the way what lies outside the grid or in cells that are marked already.
class SurfaceMarker {
 public:
  explicit SurfaceMarker(const GridFrame& grid)
      : grid_(grid),
        box_(grid.box()),
        max_edge_m_(0.45 * grid.cell_size_m.minCoeff()),
        marked_(grid.size(), 0) {}

  [[nodiscard]] double max_edge_m() const { return max_edge_m_; }

  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    Eigen::AlignedBox3d bounds(a);
    bounds.extend(b);
    bounds.extend(c);
    if (!bounds.intersects(box_)) return;
    const double ab = (b - a).squaredNorm();
    const double bc = (c - b).squaredNorm();
    const double ca = (a - c).squaredNorm();
    const double longest = std::max({ab, bc, ca});
    if (longest <= max_edge_m_ * max_edge_m_) {
      for (const Eigen::Vector3d& p : {a, b, c, centroid(a, b, c)}) mark(p);
    } else if (is_marked(bounds)) {
      return;
    } else if (ab == longest) {
      split(a, b, c);
    } else if (bc == longest) {
      split(b, c, a);
    } else {
      split(c, a, b);
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(marked_); }

 private:
  static Eigen::Vector3d centroid(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
    return (a + b + c) / 3.0;
  }

  /// Whether all cells that a box touches are marked; false of a large box, where asking costs more
  /// than it saves. A centroid is rounded, and may lie outside where the box is flat.
  [[nodiscard]] bool is_marked(const Eigen::AlignedBox3d& bounds) const {
    constexpr int kMaxCells = 256;
    const Eigen::Vector3d least = centroid(bounds.min(), bounds.min(), bounds.min());
    const Eigen::Vector3d greatest = centroid(bounds.max(), bounds.max(), bounds.max());
    const Eigen::Array3i low = grid_.cell_at(bounds.min().cwiseMin(least)).max(0);
    const Eigen::Array3i high = grid_.cell_at(bounds.max().cwiseMax(greatest)).min(grid_.cells - 1);
    if ((high - low + 1).cast<double>().prod() > kMaxCells) return false;
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          if (marked_[grid_.index({x, y, z})] == 0) return false;
        }
      }
    }
    return true;
  }

  void split(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d middle = 0.5 * (a + b);
    triangle(a, middle, c);
    triangle(middle, b, c);
  }

  void mark(const Eigen::Vector3d& p_world) {
    const Eigen::Array3i cell = grid_.cell_at(p_world);
    if (grid_.contains(cell)) marked_[grid_.index(cell)] = 1;
  }

  const GridFrame& grid_;
  Eigen::AlignedBox3d box_;
  double max_edge_m_;
  std::vector<std::uint8_t> marked_;
};

/// The part of a plane geom that can lie inside the grid: bounded by its own size where it has one.
void mark_plane(const mjModel& model, const mjData& data, int geom_id, const GridFrame& grid,
                SurfaceMarker& marker) {
  const Eigen::Isometry3d T = T_world_geom(data, geom_id);
  const Eigen::Vector3d centre = T.inverse() * grid.box().center();
  const double reach = 0.5 * grid.box().diagonal().norm();
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  for (int axis = 0; axis < 2; ++axis) {
    const double size = model.geom_size[3 * geom_id + axis];
    low[axis] = size > 0.0 ? std::max(-size, centre[axis] - reach) : centre[axis] - reach;
    high[axis] = size > 0.0 ? std::min(size, centre[axis] + reach) : centre[axis] + reach;
    if (low[axis] >= high[axis]) return;
  }
  const auto corner = [&](double x, double y) { return T * Eigen::Vector3d(x, y, 0.0); };
  const Eigen::Vector3d a = corner(low.x(), low.y());
  const Eigen::Vector3d c = corner(high.x(), high.y());
  marker.triangle(a, corner(high.x(), low.y()), c);
  marker.triangle(a, c, corner(low.x(), high.y()));
}

std::size_t count(std::span<const std::uint8_t> flags) {
  return static_cast<std::size_t>(
      std::ranges::count_if(flags, [](std::uint8_t flag) { return flag != 0; }));
}

/// 1 for each cell with a flag within `reach` cells along every axis.
std::vector<std::uint8_t> dilate(const GridFrame& grid, std::span<const std::uint8_t> flags,
                                 int reach) {
  std::vector<std::uint8_t> wide(flags.begin(), flags.end());
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t line = stride * static_cast<std::size_t>(grid.cells[axis]);
    const std::vector<std::uint8_t> narrow = wide;
    for (std::size_t first = 0; first < wide.size(); first += line) {
      for (int away = 1; away <= std::min(reach, grid.cells[axis] - 1); ++away) {
        const std::size_t offset = stride * static_cast<std::size_t>(away);
        for (std::size_t i = first + offset; i < first + line; ++i) {
          wide[i] |= narrow[i - offset];
          wide[i - offset] |= narrow[i];
        }
      }
    }
    stride = line;
  }
  return wide;
}

std::size_t count_both(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  std::size_t both = 0;
  for (std::size_t i = 0; i < a.size(); ++i) both += a[i] != 0 && b[i] != 0 ? 1 : 0;
  return both;
}

}  // namespace

std::vector<std::uint8_t> visible_cells(const RayScene& scene, const GridFrame& grid,
                                        const Pose& T_world_sensor,
                                        const FieldOfView& field_of_view, int exclude_body,
                                        int threads) {
  std::vector<std::uint8_t> visible(grid.size(), 0);
  add_visible_cells(scene, grid, T_world_sensor, field_of_view, visible, exclude_body, threads);
  return visible;
}

void add_visible_cells(const RayScene& scene, const GridFrame& grid, const Pose& T_world_sensor,
                       const FieldOfView& field_of_view, std::vector<std::uint8_t>& visible,
                       int exclude_body, int threads) {
  expects(threads >= 1 && visible.size() == grid.size(), "at least one thread, one flag per cell");
  const ViewCone cone(T_world_sensor, field_of_view);
  const auto unknown = [&](std::size_t index) { return visible[index] == 0; };
  const auto slices = [&](int begin, int end) {
    int blocker_id = -1;
    for_each_cell_in_view(
        grid, cone, begin, end, unknown, [&](const auto& cell, std::size_t index) {
          visible[index] =
              sees_cell(scene, grid, cell, cone.apex_m(), exclude_body, blocker_id) ? 1 : 0;
        });
  };
  std::vector<std::jthread> workers;
  const int nz = grid.cells.z();
  for (int part = 1; part < threads; ++part) {
    workers.emplace_back(slices, nz * part / threads, nz * (part + 1) / threads);
  }
  slices(0, nz / threads);
  workers.clear();
}

std::vector<std::uint8_t> surface_cells(const mjModel& model, const mjData& data,
                                        const GridFrame& grid, const GeomFilter& filter) {
  SurfaceMarker marker(grid);
  for (const int geom_id : solid_geoms(model, filter)) {
    if (model.geom_type[geom_id] == mjGEOM_PLANE) {
      mark_plane(model, data, geom_id, grid, marker);
      continue;
    }
    SurfaceMesh mesh = geom_triangles(model, geom_id, marker.max_edge_m());
    const Eigen::Isometry3d T = T_world_geom(data, geom_id);
    for (Eigen::Vector3d& p : mesh.vertices_m) p = T * p;
    for (const auto& [a, b, c] : mesh.triangles) {
      marker.triangle(mesh.vertices_m[static_cast<std::size_t>(a)],
                      mesh.vertices_m[static_cast<std::size_t>(b)],
                      mesh.vertices_m[static_cast<std::size_t>(c)]);
    }
  }
  return marker.take();
}

MapScore score_map(const GridFrame& grid, std::span<const std::uint8_t> occupied,
                   std::span<const std::uint8_t> surface, std::span<const std::uint8_t> observable,
                   int tolerance_cells) {
  expects(occupied.size() == grid.size() && surface.size() == grid.size() &&
              observable.size() == grid.size(),
          "one flag per cell");
  expects(tolerance_cells >= 0, "tolerance of at least 0 cells");
  std::vector<std::uint8_t> wanted(grid.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i] = surface[i] != 0 && observable[i] != 0 ? 1 : 0;
  }
  MapScore score;
  score.occupied_cells = count(occupied);
  score.correct_cells = count_both(occupied, dilate(grid, surface, tolerance_cells));
  score.observable_surface_cells = count(wanted);
  score.found_cells = count_both(wanted, dilate(grid, occupied, tolerance_cells));
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
  };
  score.precision = share(score.correct_cells, score.occupied_cells);
  score.recall = share(score.found_cells, score.observable_surface_cells);
  return score;
}

std::vector<int> body_ids(Renderer& renderer, const mjModel& model, const mjData& data,
                          int camera_id, double fovy_rad) {
  RenderRequest request;
  request.rgb = false;
  RenderedImages drawn;
  renderer.render(model, data, FixedCamera{camera_id, fovy_rad}, request, drawn);
  for (int& id : drawn.segmentation) id = id < 0 ? -1 : model.geom_bodyid[id];
  return std::move(drawn.segmentation);
}

}  // namespace vantage
