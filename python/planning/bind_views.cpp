#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "python/planning/grids.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/views/frontiers.hpp"
#include "vantage/planners/views/sampled_views.hpp"
#include "vantage/planners/views/view_candidates.hpp"

namespace vantage::python {
namespace {

py::array_t<double> ring(const Eigen::Vector3d& centre_m, const py::kwargs& options) {
  const auto ring = options_of<RingOfViews>(options, "");
  if (!(centre_m.cwiseAbs().maxCoeff() <= kMaxCoordinate_m)) refuse("centre_m", "not finite");
  constexpr double kMaxViews = 20'000.0;
  if (static_cast<double>(ring.positions) * static_cast<double>(ring.yaw_offsets_rad.size()) >
      kMaxViews) {
    refuse("positions", "more than 20 000 views");
  }
  return view_rows(ring_of_views(ring, centre_m));
}

py::array_t<double> sampled(const OctomapFile& map, std::uint64_t seed, const py::kwargs& options) {
  const auto views = options_of<SampledViews>(options, "");
  Rng rng = Rng::stream(seed, "sampled views");
  return view_rows(
      without_lock([&] { return sample_views(views, map, map.box_of(map.known()), rng); }));
}

py::list frontiers(const OccupancyGrid& grid, const py::kwargs& options) {
  require_cells(grid, "grid");
  const auto wanted = options_of<FrontierOptions>(options, "");
  const auto found = without_lock([&] { return find_frontiers(grid, wanted); });
  py::list list;
  for (const Frontier& frontier : found) {
    std::vector<std::int32_t> cells;
    for (const std::size_t index : frontier.cells) {
      const Eigen::Array3i cell = grid.frame.cell(index);
      cells.insert(cells.end(), {cell.x(), cell.y(), cell.z()});
    }
    list.append(py::dict(
        py::arg("p_m") = frontier.p_m,
        py::arg("cells") =
            array_of(std::move(cells), {static_cast<py::ssize_t>(frontier.cells.size()), 3})));
  }
  return list;
}

}  // namespace

void bind_views(py::module_& module) {
  module.def("ring_of_views", &ring, py::arg("centre_m"),
             "Level sensor poses on a ring round (x, y) of `centre_m`, (n, 5): x, y, z (m, world), "
             "yaw, pitch (rad).\n\nOptions: positions, radius_m, height_m, start_angle_rad, "
             "yaw_offsets_rad. [Potthast2016, 3.3.3]");
  module.def("sample_views", &sampled, py::arg("map"), py::arg("seed") = 1,
             "Sensor poses spread out over the free cells of an OctoMap, (n, 5) as in "
             "ring_of_views.\n\nOptions: positions, headings, height_m, clearance_m, pitch_rad. "
             "Raises InputError if no place will do.");
  module.def("find_frontiers", &frontiers, py::arg("grid"),
             "Where known free space ends in the unknown, the largest frontiers first: dicts of "
             "`p_m` (3,), where to look at it from, and `cells` (n, 3), indices.\n\nOptions: "
             "min_cells, max_extent_m, height_m, height_band_m. [Yamauchi1997]");
}

}  // namespace vantage::python
