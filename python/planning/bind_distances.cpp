#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "python/planning/grids.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/planners/trajectory/esdf.hpp"
#include "vantage/planners/travel/path_lengths.hpp"

namespace vantage::python {
namespace {

std::shared_ptr<Esdf> esdf_of(const OccupancyGrid& grid, double reach_m) {
  if (!(reach_m > 0.0 && reach_m <= kMaxCoordinate_m)) refuse("reach_m", "not in (0, 1e6]");
  return without_lock(
      [&] { return std::make_shared<Esdf>(make_esdf(grid, grid.frame.box(), reach_m)); });
}

py::array_t<double> distances(const Esdf& field, const Doubles& points) {
  const Eigen::MatrixXd p_m = rows_of(points, 3, "points");
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < p_m.rows(); ++i)
    distances.push_back(field.distance_m(p_m.row(i).transpose()));
  return array_of(std::move(distances));
}

py::array_t<double> gradients(const Esdf& field, const Doubles& points) {
  const Eigen::MatrixXd p_m = rows_of(points, 3, "points");
  std::vector<double> rows;
  for (Eigen::Index i = 0; i < p_m.rows(); ++i) {
    const Eigen::Vector3d g = field.sample(p_m.row(i).transpose()).gradient;
    rows.insert(rows.end(), {g.x(), g.y(), g.z()});
  }
  return array_of(std::move(rows), {p_m.rows(), 3});
}

using FloorCells = py::array_t<std::uint8_t, py::array::f_style | py::array::forcecast>;

PathField ways_of(const FloorCells& states, const Doubles& pose, const Eigen::Vector2d& corner_m,
                  double cell_m, const py::kwargs& options) {
  constexpr py::ssize_t kMaxFloor = 1 << 26;
  if (states.ndim() != 2 || states.size() == 0 || states.size() > kMaxFloor) {
    refuse("floor", "shape " + shape_text(states) + " is not (nx, ny) of 1 to 2^26 cells");
  }
  if (!(cell_m >= 1e-6 && cell_m <= kMaxCoordinate_m)) refuse("cell_m", "not in [1e-6, 1e6]");
  if (!(corner_m.cwiseAbs().maxCoeff() <= kMaxCoordinate_m)) refuse("min_corner_m", "not finite");
  FloorMap floor(corner_m, cell_m, static_cast<int>(states.shape(0)),
                 static_cast<int>(states.shape(1)));
  for (std::size_t i = 0; i < floor.size(); ++i) {
    constexpr std::array<float, 3> kLogOdds{-3.0F, 0.0F, 3.0F};
    const std::uint8_t state = states.data()[i];
    if (state > 2) refuse("floor", fmt::format("{} is none of FREE, UNOBSERVED, OCCUPIED", state));
    floor.log_odds[i] = kLogOdds[state];
  }
  const auto navigation = options_of<NavigationOptions>(options, "");
  const Pose2 start = pose2_of(pose, "pose");
  return interruptibly([&] { return make_path_field(floor, start, navigation); });
}

/// (nx, ny)
template <class T>
py::array_t<T> floor_array(const FloorMap& map, std::vector<T> values) {
  return array_of(std::move(values), {map.nx, map.ny}, true);
}

py::array_t<std::uint8_t> floor_states(const PathField& ways) {
  std::vector<std::uint8_t> states(ways.map.size());
  for (std::size_t i = 0; i < states.size(); ++i)
    states[i] = static_cast<std::uint8_t>(ways.map.state(i));
  return floor_array(ways.map, std::move(states));
}

py::array_t<bool> reachable(const PathField& ways) {
  py::array_t<bool, py::array::f_style> flags({ways.map.nx, ways.map.ny});
  for (std::size_t i = 0; i < ways.map.size(); ++i) flags.mutable_data()[i] = ways.reachable(i);
  return flags;
}

py::tuple path(const PathField& ways, const Doubles& goal) {
  const PlannedPath planned = plan_path(ways, pose2_of(goal, "goal"));
  return py::make_tuple(pose2_rows(planned.waypoints), planned.length_m, planned.reaches_goal);
}

py::array_t<double> lengths(const PathField& ways, const Doubles& goals) {
  const Eigen::MatrixXd rows = rows_of(goals, 3, "goals");
  std::vector<double> lengths_m;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    lengths_m.push_back(path_length_m(ways, {rows(i, 0), rows(i, 1), rows(i, 2)}));
  }
  return array_of(std::move(lengths_m));
}

Eigen::MatrixXd lengths_between(const PathField& ways, const Doubles& places, int threads) {
  require_threads(threads);
  const Eigen::MatrixXd rows = rows_of(places, 2, "places");
  std::vector<Eigen::Vector2d> places_m;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) places_m.emplace_back(rows(i, 0), rows(i, 1));
  return interruptibly([&] { return path_lengths_m(ways, places_m, threads); });
}

}  // namespace

void bind_distances(py::module_& module) {
  py::class_<Esdf, std::shared_ptr<Esdf>>(
      module, "DistanceField",
      "Signed distance to the surface of a grid's occupied cells: above 0 outside, below 0 inside, "
      "at "
      "most `reach_m`. What was never observed is not occupied.")
      .def(py::init(&esdf_of), py::arg("grid"), py::arg("reach_m") = 1.5)
      .def("distance_m", &distances, py::arg("points"), "At points (n, 3), world, m; (n,) m.")
      .def("gradient", &gradients, py::arg("points"),
           "Of distance_m at points (n, 3); (n, 3), world.")
      .def_property_readonly(
          "at_centres_m",
          [](const py::object& self) {
            const auto& field = self.cast<const Esdf&>();
            return cells_view(field.frame(), field.at_centres_m().data(), self, false);
          },
          "(nx, ny, nz) float32 m at the cells' centres; read-only, no copy.");

  py::class_<PathField, std::shared_ptr<PathField>>(
      module, "Ways",
      "The ways of a disc-shaped robot over a known floor, from one pose to everywhere.\n\n`floor` "
      "is "
      "(nx, ny) of FREE, UNOBSERVED, OCCUPIED; `pose` (3,): x, y (m, world), yaw (rad). Only free "
      "cells "
      "are driven on. Options: footprint_radius_m, margin_m, clearance_weight, comfort_m, "
      "escape_radius_m.")
      .def(py::init(&ways_of), py::arg("floor"), py::arg("pose"),
           py::arg("min_corner_m") = Eigen::Vector2d(0.0, 0.0), py::arg("cell_m") = 0.05)
      .def_property_readonly("floor", &floor_states,
                             "(nx, ny) uint8 of FREE, UNOBSERVED, OCCUPIED.")
      .def_property_readonly("reachable", &reachable,
                             "(nx, ny) bool: cells the robot can drive to.")
      .def_property_readonly(
          "clearance_m", [](const PathField& w) { return floor_array(w.map, w.clearance_m); },
          "(nx, ny) float32 m to the nearest cell that is not free.")
      .def_property_readonly(
          "cost", [](const PathField& w) { return floor_array(w.map, w.cost); },
          "(nx, ny) m of way from the pose, weighted by clearance; inf where it cannot go.")
      .def_property_readonly(
          "min_corner_m", [](const PathField& w) { return Eigen::Vector2d(w.map.min_corner_m); },
          "Lowest corner of the floor, world, (2,) m.")
      .def_property_readonly(
          "cell_m", [](const PathField& w) { return w.map.cell_m; }, "Edge of a cell, m.")
      .def("path", &path, py::arg("goal"),
           "(waypoints (k, 3), length in m, whether it reaches the goal) to a pose (3,); where it "
           "cannot be reached, as near as possible.")
      .def("lengths_m", &lengths, py::arg("goals"),
           "Of the ways to poses (n, 3); (n,) m, inf where out of reach.")
      .def("lengths_between_m", &lengths_between, py::arg("places"), py::arg("threads") = 1,
           "Of the ways between places (n, 2); (n, n) m, inf where there is none.");
}

}  // namespace vantage::python
