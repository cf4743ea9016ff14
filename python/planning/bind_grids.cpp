#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/planning/grids.hpp"
#include "vantage/belief/map/block_field.hpp"
#include "vantage/belief/map/octomap_file.hpp"
#include "vantage/belief/map/octomap_io.hpp"

namespace vantage::python {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxCells = 268435456.0;

std::array<double, 3> edges_of(const py::object& cell_size_m) {
  const auto edges = Doubles::ensure(cell_size_m);
  if (edges && edges.ndim() == 0) return {*edges.data(), *edges.data(), *edges.data()};
  if (!edges || edges.ndim() != 1 || edges.shape(0) != 3) {
    PyErr_Clear();
    refuse("cell_size_m", "neither a number nor three");
  }
  return {edges.at(0), edges.at(1), edges.at(2)};
}

GridFrame frame_of(const Cells& cells, const std::array<double, 3>& corner_m,
                   const std::array<double, 3>& edges_m, const std::string& argument) {
  if (cells.ndim() != 3 || cells.size() == 0) {
    refuse(argument, "shape " + shape_text(cells) + " is not (nx, ny, nz), each at least 1");
  }
  if (static_cast<double>(cells.size()) > kMaxCells) refuse(argument, "more than 2^28 cells");
  GridFrame frame;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (!(std::abs(corner_m[i]) <= kMaxCoordinate_m)) {
      refuse("min_corner_m", fmt::format("{} is no finite number up to 1e6", corner_m[i]));
    }
    if (!(edges_m[i] >= 1e-6 && edges_m[i] <= kMaxCoordinate_m)) {
      refuse("cell_size_m", fmt::format("{} is not in [1e-6, 1e6]", edges_m[i]));
    }
    frame.min_corner_m[axis] = corner_m[i];
    frame.cell_size_m[axis] = edges_m[i];
    frame.cells[axis] = static_cast<int>(cells.shape(axis));
  }
  return frame;
}

std::shared_ptr<OccupancyGrid> grid_of(const Cells& log_odds, const std::array<double, 3>& corner_m,
                                       const py::object& cell_size_m) {
  auto grid = std::make_shared<OccupancyGrid>(
      frame_of(log_odds, corner_m, edges_of(cell_size_m), "log_odds"));
  std::memcpy(grid->log_odds.data(), log_odds.data(), grid->size() * sizeof(float));
  require_cells(*grid, "log_odds");
  return grid;
}

std::shared_ptr<OccupancyGrid> grid_of_p(const Cells& p, const std::array<double, 3>& corner_m,
                                         const py::object& cell_size_m) {
  auto grid =
      std::make_shared<OccupancyGrid>(frame_of(p, corner_m, edges_of(cell_size_m), "p_occupied"));
  for (std::size_t i = 0; i < grid->size(); ++i) {
    const float p_cell = p.data()[i];
    if (!(p_cell >= 0.0F && p_cell <= 1.0F)) {
      refuse("p_occupied", fmt::format("{} is no probability", p_cell));
    }
    constexpr double kSure = 1e-7;
    grid->log_odds[i] = static_cast<float>(
        log_odds_of(std::clamp(static_cast<double>(p_cell), kSure, 1.0 - kSure)));
  }
  return grid;
}

py::array_t<float> probabilities(const OccupancyGrid& grid) {
  std::vector<float> p(grid.size());
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = static_cast<float>(grid.p_occupied(i));
  return array_of(std::move(p), shape_of(grid.frame), true);
}

py::array_t<std::uint8_t> states(const OccupancyGrid& grid) {
  std::vector<std::uint8_t> states(grid.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i] = static_cast<std::uint8_t>(grid.state(i));
  }
  return array_of(std::move(states), shape_of(grid.frame), true);
}

std::shared_ptr<OccupancyGrid> part_of(const OctomapFile& map,
                                       const std::optional<Eigen::Vector3d>& min_m,
                                       const std::optional<Eigen::Vector3d>& max_m, int coarsen) {
  if (coarsen < 1 || coarsen > 1024)
    refuse("coarsen", fmt::format("{} is not in [1, 1024]", coarsen));
  CellBlock block = map.known();
  if (min_m || max_m) {
    const Eigen::AlignedBox3d all = map.box_of(map.known());
    const Eigen::Vector3d low =
        min_m.value_or(map.known().empty() ? Eigen::Vector3d::Zero() : all.min());
    const Eigen::Vector3d high =
        max_m.value_or(map.known().empty() ? Eigen::Vector3d::Zero() : all.max());
    if (!low.allFinite() || !high.allFinite()) refuse("min_m, max_m", "not finite");
    if ((low.array() < high.array()).all()) {
      block = map.cells_in({low, high});
    } else {
      block = {};
    }
  }
  if (block.empty()) throw ConfigError(map.name() + ": no cell lies between min_m and max_m");
  if (block.coarsened(coarsen).count() > kMaxCells) {
    refuse("min_m, max_m", "more than 2^28 cells; coarsen makes fewer");
  }
  return without_lock([&] { return std::make_shared<OccupancyGrid>(map.grid_of(block, coarsen)); });
}

py::object box_rows(const Eigen::AlignedBox3d& box) {
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> rows;
  rows << box.min().transpose(), box.max().transpose();
  return py::cast(rows);
}

constexpr auto kGridText = R"(An occupancy grid: one probability per cell, kept as log odds.

Cells are indexed [x, y, z]; the box of the grid is axis-aligned in the world, z up. Cells with
0.4 < p(occupied) < 0.6 are unobserved.

Parameters
----------
log_odds : array (nx, ny, nz) of float
    ln(p / (1 - p)) of each cell, 0 where nothing was measured. Copied once, as float32.
min_corner_m : (3,)
    Lowest corner of the grid, world, m.
cell_size_m : float or (3,)
    Edge of a cell, m.
)";

}  // namespace

std::vector<py::ssize_t> shape_of(const GridFrame& frame) {
  return {frame.cells.x(), frame.cells.y(), frame.cells.z()};
}

void require_cells(const OccupancyGrid& grid, const std::string& argument) {
  for (const float odds : grid.log_odds) {
    if (std::isnan(odds)) refuse(argument, "a cell is NaN");
  }
}

py::array_t<float> shares(const OccupancyGrid& grid, const std::array<int, 3>& blocks) {
  const BlockLayout layout{grid.frame.cells, {blocks[0], blocks[1], blocks[2]}};
  if ((layout.blocks < 1).any() || (layout.blocks > layout.cells).any()) {
    refuse("blocks", fmt::format("({}) is not from 1 to the ({}) cells of the map along each axis",
                                 fmt::join(blocks, ", "),
                                 fmt::join(std::span(layout.cells.data(), 3), ", ")));
  }
  std::vector<float> counts(3 * layout.size(), 0.0F);
  std::vector<float> cells(layout.size(), 0.0F);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::size_t block = layout.index_of_cell(grid.frame.cell(i));
    counts[3 * block + static_cast<std::size_t>(grid.state(i))] += 1.0F;
    cells[block] += 1.0F;
  }
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] /= cells[i / 3];
  return array_of(std::move(counts), {3, blocks[0], blocks[1], blocks[2]}, true);
}

void bind_grids(py::module_& module) {
  using Grid = OccupancyGrid;
  const std::array<double, 3> kOrigin{0.0, 0.0, 0.0};
  py::class_<Grid, std::shared_ptr<Grid>>(module, "Grid", kGridText)
      .def(py::init(&grid_of), py::arg("log_odds"), py::arg("min_corner_m") = kOrigin,
           py::arg("cell_size_m") = 0.1)
      .def_static(
          "from_probabilities", &grid_of_p, py::arg("p_occupied"),
          py::arg("min_corner_m") = kOrigin, py::arg("cell_size_m") = 0.1,
          "The grid of probabilities (nx, ny, nz) in [0, 1]; 0.5 where nothing was measured.")
      .def_static(
          "read",
          [](const fs::path& path) {
            return without_lock([&] { return std::make_shared<Grid>(read_octomap_grid(path)); });
          },
          py::arg("path"),
          "The box of the known cells of an OctoMap file, .bt or .ot. Raises InputError.")
      .def(
          "write",
          [](const Grid& grid, const fs::path& path) {
            without_lock([&] { write_octomap(grid, path); });
          },
          py::arg("path"),
          "Writes the known cells as an OctoMap file: .bt free/occupied, .ot log odds. Raises "
          "OutputError.")
      .def_property_readonly(
          "log_odds",
          [](const py::object& self) {
            auto& grid = self.cast<Grid&>();
            return cells_view(grid.frame, grid.log_odds.data(), self, true);
          },
          "(nx, ny, nz) float32, Fortran-ordered: the grid's own memory, writable.")
      .def("probabilities", &probabilities, "p(occupied) of each cell, (nx, ny, nz) float32.")
      .def("states", &states,
           "(nx, ny, nz) uint8: FREE, UNOBSERVED or OCCUPIED, by the thresholds 0.4 and 0.6.")
      .def(
          "count",
          [](const Grid& grid, int state) {
            if (state < 0 || state > 2) refuse("state", "none of FREE, UNOBSERVED, OCCUPIED");
            return grid.count(static_cast<CellState>(state));
          },
          py::arg("state"), "Cells of that state.")
      .def("shares", &shares, py::arg("blocks"),
           "(3, bx, by, bz) float32: the shares of free, unobserved and occupied cells in each "
           "block "
           "when the grid is divided into (bx, by, bz) of them.")
      .def_property_readonly(
          "shape",
          [](const Grid& g) {
            return py::make_tuple(g.frame.cells.x(), g.frame.cells.y(), g.frame.cells.z());
          },
          "(nx, ny, nz)")
      .def_property_readonly(
          "min_corner_m", [](const Grid& g) { return Eigen::Vector3d(g.frame.min_corner_m); },
          "Lowest corner, world, (3,) m.")
      .def_property_readonly(
          "cell_size_m", [](const Grid& g) { return Eigen::Vector3d(g.frame.cell_size_m); },
          "Edges of a cell, (3,) m.")
      .def("__repr__", [](const Grid& g) {
        return fmt::format("<vantage.Grid {} x {} x {} at ({:g}, {:g}, {:g}) m>", g.frame.cells.x(),
                           g.frame.cells.y(), g.frame.cells.z(), g.frame.min_corner_m.x(),
                           g.frame.min_corner_m.y(), g.frame.min_corner_m.z());
      });
  module.attr("FREE") = static_cast<int>(CellState::free);
  module.attr("UNOBSERVED") = static_cast<int>(CellState::unobserved);
  module.attr("OCCUPIED") = static_cast<int>(CellState::occupied);

  py::class_<OctomapFile, std::shared_ptr<OctomapFile>>(
      module, "OctoMap",
      "An OctoMap file (.bt, .ot) of any extent, read whole and looked at box by box. Raises "
      "InputError.")
      .def(py::init([](const fs::path& path) {
             return without_lock([&] { return std::make_shared<OctomapFile>(path); });
           }),
           py::arg("path"))
      .def_property_readonly("resolution_m", &OctomapFile::resolution_m, "Edge of a cell, m.")
      .def_property_readonly("occupied", &OctomapFile::occupied, "Occupied cells.")
      .def_property_readonly("free", &OctomapFile::free, "Free cells.")
      .def_property_readonly(
          "known_m",
          [](const OctomapFile& map) -> py::object {
            if (map.known().empty()) return py::none();
            return box_rows(map.box_of(map.known()));
          },
          "Box of the known cells, world, (2, 3) m: lowest corner, highest corner. None if none "
          "is.")
      .def(
          "grid", &part_of, py::arg("min_m") = py::none(), py::arg("max_m") = py::none(),
          py::arg("coarsen") = 1,
          "The cells between two corners (world, m; default: the known ones) as a Grid; of "
          "`coarsen` cells along each axis one is made, known if at least half of its part between "
          "the corners is.");
}

}  // namespace vantage::python
