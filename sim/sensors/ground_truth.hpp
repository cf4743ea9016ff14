/// What the true scene looks like on a grid. For metrics, and for gains and studies that are meant
/// to know the truth (`oracle`); no perception or belief may use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"

namespace vantage {

/// 1 for each cell that a noise-free sensor at that pose sees: the centre lies in its field of view
/// and the ray towards the centre reaches the cell (enters its box by more than a micrometre,
/// within range) before it meets a surface. Free cells in front of a surface and the cell the ray
/// meets it in count; cells behind it do not, nor does a cell that the surface only touches from
/// the front. `scene` should leave out the robot (GeomFilter). Order of `grid.index`; the result
/// does not depend on `threads` (>= 1).
std::vector<std::uint8_t> visible_cells(const RayScene& scene, const GridFrame& grid,
                                        const Pose& T_world_sensor,
                                        const FieldOfView& field_of_view, int exclude_body = -1,
                                        int threads = 1);

/// The same, added to `visible` (one flag a cell): cells flagged already are not looked at again.
void add_visible_cells(const RayScene& scene, const GridFrame& grid, const Pose& T_world_sensor,
                       const FieldOfView& field_of_view, std::vector<std::uint8_t>& visible,
                       int exclude_body = -1, int threads = 1);

/// 1 for each cell that a surface of a solid geom passes through, seen or not, sampled more densely
/// than half a cell. A surface exactly between two cells belongs to one of them.
std::vector<std::uint8_t> surface_cells(const mjModel& model, const mjData& data,
                                        const GridFrame& grid, const GeomFilter& filter = {});

struct MapScore {
  double precision = 1.0;  ///< of the occupied cells, the share near a surface; 1 if there are none
  double recall = 1.0;  ///< of the observable surface cells, the share near an occupied cell; or 1
  std::size_t occupied_cells = 0;
  std::size_t correct_cells = 0;             ///< occupied, and near a surface
  std::size_t observable_surface_cells = 0;  ///< surface, and observable
  std::size_t found_cells = 0;               ///< of those, near an occupied cell
};

/// Body id of each pixel of a camera's image, row-major from the top; -1: nothing. The image is of
/// the renderer's size.
/// @throws RendererError if OpenGL fails.
std::vector<int> body_ids(Renderer& renderer, const mjModel& model, const mjData& data,
                          int camera_id, double fovy_rad);

/// Compares a map's occupied cells with the truth; flags (0 or not) in `grid.index` order. Near is
/// within `tolerance_cells` along every axis (Chebyshev distance).
MapScore score_map(const GridFrame& grid, std::span<const std::uint8_t> occupied,
                   std::span<const std::uint8_t> surface, std::span<const std::uint8_t> observable,
                   int tolerance_cells);

}  // namespace vantage
