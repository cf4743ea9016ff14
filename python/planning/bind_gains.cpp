#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "python/planning/grids.hpp"
#include "vantage/geometry/rgbd_camera.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/views/score_views.hpp"

namespace vantage::python {
namespace {

/// Of cells that each have a transmission and a utility of their own, given by the caller.
struct GivenCells {
  static constexpr bool unobserved_only = false;
  using Ray = AttenuatedRay;
  std::vector<float> utility;
  std::vector<float> transmission;

  [[nodiscard]] CellTables prepare(const GainContext&) const {
    return {.state = {},
            .p_occupied = {},
            .entropy_bits = {},
            .utility = utility,
            .transmission = transmission};
  }
  [[nodiscard]] Ray ray(const CellTables& tables) const { return AttenuatedRay(tables); }
  [[nodiscard]] static bool counts(const CellTables& tables, std::size_t cell) {
    return tables.utility[cell] != 0.0F;
  }
};

std::vector<float> cells_of(const Cells& cells, const GridFrame& frame, const char* argument,
                            float most) {
  const bool fits = cells.ndim() == 3 && cells.shape(0) == frame.cells.x() &&
                    cells.shape(1) == frame.cells.y() && cells.shape(2) == frame.cells.z();
  if (!fits) {
    refuse(argument, fmt::format("shape {} is not the grid's ({}, {}, {})", shape_text(cells),
                                 frame.cells.x(), frame.cells.y(), frame.cells.z()));
  }
  std::vector<float> values(cells.data(), cells.data() + cells.size());
  for (const float value : values) {
    if (!(value >= 0.0F && value <= most))
      refuse(argument, fmt::format("{} is out of range", value));
  }
  return values;
}

/// A number for all cells, or an array of blocks of them.
std::optional<BlockField> transmission_of(const py::object& given, const Eigen::Array3i& cells) {
  if (given.is_none()) return std::nullopt;
  const auto values =
      py::cast<py::array_t<double, py::array::f_style | py::array::forcecast>>(given);
  BlockField field;
  if (values.ndim() == 0) {
    field = uniform_field(cells, values.data()[0]);
  } else {
    if (values.ndim() != 3) refuse("transmission", "neither a number nor an array (bx, by, bz)");
    field.layout.cells = cells;
    for (int axis = 0; axis < 3; ++axis) {
      field.layout.blocks[axis] = static_cast<int>(values.shape(axis));
    }
    if ((field.layout.blocks < 1).any() || (field.layout.blocks > cells).any()) {
      refuse("transmission",
             fmt::format("shape {}: at least one block and at most one for each cell "
                         "along each axis",
                         shape_text(values)));
    }
    field.per_block.assign(values.data(), values.data() + values.size());
  }
  for (const double share : field.per_block) {
    if (!(share >= 0.0 && share <= 1.0))
      refuse("transmission", fmt::format("{} is not in [0, 1]", share));
  }
  return field;
}

Gain gain_of(const py::object& given) { return options_of<Gain>(given, "gain", BeerLambertGain{}); }

py::array_t<double> gains(const OccupancyGrid& grid, const Doubles& rows, const py::object& sensor,
                          const py::object& given, const py::object& transmission,
                          const std::string& method, int threads) {
  require_threads(threads);
  require_cells(grid, "grid");
  const auto views = views_of(rows);
  const FieldOfView field = options_of<FieldOfView>(sensor, "sensor", kRgbdCamera);
  const Gain gain = gain_of(given);
  const auto learnt = transmission_of(transmission, grid.frame.cells);
  if (std::holds_alternative<AdaptiveGain>(gain) && !learnt) {
    refuse("transmission", "the gain adaptive needs it: the share of a beam that passes a cell");
  }
  if (method != "auto" && method != "swept" && method != "exact") {
    refuse("method", fmt::format("'{}' is none of auto, swept, exact", method));
  }
  if (method == "swept" && !can_sweep(gain)) {
    refuse("method", fmt::format("the gain {} cannot be swept", strategy_name_of(gain)));
  }
  const GainContext context{grid, learnt ? &*learnt : nullptr};
  return array_of(interruptibly([&] {
    return method == "exact" ? exact_gains_bits(gain, context, views, field, threads)
                             : view_gains_bits(gain, context, views, field, threads);
  }));
}

py::array_t<double> own_gains(const OccupancyGrid& grid, const Doubles& rows, const Cells& utility,
                              const Cells& transmission, const py::object& sensor, int threads) {
  require_threads(threads);
  const auto views = views_of(rows);
  const FieldOfView field = options_of<FieldOfView>(sensor, "sensor", kRgbdCamera);
  const GivenCells gain{cells_of(utility, grid.frame, "utility", 1e30F),
                        cells_of(transmission, grid.frame, "transmission", 1.0F)};
  return array_of(
      interruptibly([&] { return exact_gains_bits(gain, {grid}, views, field, threads); }));
}

py::array_t<double> map_gains(const OctomapFile& map, const Doubles& rows, const py::object& sensor,
                              const py::object& given, const py::object& region, int threads) {
  require_threads(threads);
  const auto views = views_of(rows);
  const FieldOfView field = options_of<FieldOfView>(sensor, "sensor", kRgbdCamera);
  const Gain gain = gain_of(given);
  const auto part = options_of<ScoredRegion>(region, "region");
  if (std::holds_alternative<AdaptiveGain>(gain)) {
    refuse("gain",
           "adaptive learns on a run how far beams reach, and a map does not tell; take "
           "beer_lambert with `a` = share per metre ** cell edge in m");
  }
  if (part.cells(map).empty()) refuse("region", "no cell of the map lies in it");
  return array_of(
      interruptibly([&] { return score_views(map, part, gain, views, field, threads); }));
}

constexpr auto kGainsText = R"(What each view is worth on a grid.

Parameters
----------
grid : Grid
views : array (n, 4), (n, 5) or (n, 4, 4)
    Sensor poses in the world, x forward, z up: x, y, z (m), yaw[, pitch] (rad; pitch looks down),
    or transforms T_world_sensor.
sensor : dict
    Field of view: half_width_rad, tilt_min_rad, tilt_max_rad, range_min_m, range_max_m, panorama.
    Default: an RGB-D camera, 57.8 x 45 deg, 0.8 to 3.5 m.
gain : str or dict
    A name of `strategies('gains')`, or {'name': ..., option: value}.
transmission : float or array (bx, by, bz)
    Share of a beam that passes an unobserved cell, one for all or one for each block of cells; of
    the gain `adaptive` alone.
method : 'auto', 'swept' or 'exact'
    Exact walks a ray to every cell in view; swept does the same by one outward sweep a position,
    several ten times faster. Auto sweeps where the gain allows it.
threads : int
    Results do not depend on it.

Returns
-------
array (n,) : in bits, or the unit that the gain names.
)";

}  // namespace

void bind_gains(py::module_& module) {
  module.def("gains", &gains, py::arg("grid"), py::arg("views"), py::arg("sensor") = py::none(),
             py::arg("gain") = "beer_lambert", py::arg("transmission") = py::none(),
             py::arg("method") = "auto", py::arg("threads") = 1, kGainsText);
  module.def(
      "own_gains", &own_gains, py::arg("grid"), py::arg("views"), py::arg("utility"),
      py::arg("transmission"), py::arg("sensor") = py::none(), py::arg("threads") = 1,
      "A gain of your own, (n,): the sum over the cells in view of `utility`, weighed by the "
      "product of `transmission` along the ray to each.\n\nBoth are (nx, ny, nz) as the "
      "grid: utility at least 0, in any unit; transmission, the share of a beam that passes "
      "a cell, in [0, 1]. A ray is walked to every cell with utility.");
  module.def(
      "map_gains", &map_gains, py::arg("map"), py::arg("views"), py::arg("sensor") = py::none(),
      py::arg("gain") = "beer_lambert", py::arg("region") = py::none(), py::arg("threads") = 1,
      "As gains(), on an OctoMap of any extent: only what the views can reach becomes a "
      "grid. `region`: dict of min_m, max_m (world) and coarsen; outside it nothing counts.");
}

}  // namespace vantage::python
