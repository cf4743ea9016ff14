#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>

#include "python/bindings.hpp"
#include "python/episodes/situations.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/options.hpp"
#include "python/planning/grids.hpp"

namespace vantage::python {
namespace {

template <class T>
const T& of(const Lent<T>& lent) {
  if (lent.value == nullptr) {
    throw Error(ExitCode::usage,
                "the episode has gone on: what it asked may no longer be looked at");
  }
  return *lent.value;
}
const MapSituation& situation_of(const LentSituation& lent) { return of(lent); }
const MapSituation& situation_of(const LentRequest& lent) { return of(lent).situation; }

template <class Value>
py::array_t<Value> of_views(const LentRequest& lent, Value (*value)(const Candidate&)) {
  const auto candidates = of(lent).candidates;
  py::array_t<Value> values(static_cast<py::ssize_t>(candidates.size()));
  for (std::size_t i = 0; i < candidates.size(); ++i)
    values.mutable_data()[i] = value(candidates[i]);
  return values;
}

/// Low and high end of each; NaN where the gain has no interval.
py::array_t<double> interval(const LentRequest& lent) {
  const DecisionRequest& request = of(lent);
  std::vector<double> ends(2 * request.candidates.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < request.interval_cells.size(); ++i)
    std::ranges::copy(request.interval_cells[i], &ends[2 * i]);
  return array_of(std::move(ends), {static_cast<py::ssize_t>(request.candidates.size()), 2});
}

py::array_t<double> transmission(const MapSituation& now) {
  const BlockField& field = now.transmission;
  const Eigen::Array3i& n = field.layout.blocks;
  return array_of(field.per_block, {n.x(), n.y(), n.z()}, true);
}

/// What request and situation have both.
template <class Lent>
void add_situation(py::class_<Lent, std::shared_ptr<Lent>>& type) {
  const auto number = [&](const char* name, auto value, const char* text) {
    type.def_property_readonly(
        name, [value](const Lent& lent) { return value(situation_of(lent)); }, text);
  };
  using Now = MapSituation;
  number(
      "scans", [](const Now& s) { return s.scans; }, "Scans taken so far.");
  number(
      "scans_left", [](const Now& s) { return s.scans_left; }, "Scans that may still be taken.");
  number(
      "time_s", [](const Now& s) { return s.time_s; }, "Simulated time since the start, s.");
  number(
      "energy_j", [](const Now& s) { return s.energy_j; }, "Energy used since the start, J.");
  number(
      "time_left_s", [](const Now& s) { return s.left.time_s; },
      "Of the budget, s; inf without one.");
  number(
      "energy_left_j", [](const Now& s) { return s.left.energy_j; },
      "Of the budget, J; inf without one.");
  number(
      "scan_s", [](const Now& s) { return s.scan_s; }, "Time that the last scan took, s.");
  number(
      "pose", [](const Now& s) { return pose2_row(s.T_world_base); },
      "x, y (m, world), yaw (rad) of the base, as the robot believes.");
  number(
      "sensor", [](const Now& s) { return object_of(write_node(s.field_of_view)); },
      "Field of view of one scan, the dict that gains() takes.");
  number(
      "grid", [](const Now& s) { return std::make_shared<OccupancyGrid>(s.grid); },
      "The map as the robot knows it, a copy.");
  number(
      "transmission", &transmission,
      "(bx, by, bz): share of a beam that passes an unobserved cell, block by block, as learnt so "
      "far; what the gain `adaptive` takes.");
  number(
      "unobserved_share",
      [](const Now& s) {
        return static_cast<double>(s.grid.count(CellState::unobserved)) /
               static_cast<double>(s.grid.size());
      },
      "Of the map's cells.");
  type.def(
      "coarse",
      [](const Lent& lent, const std::array<int, 3>& blocks) {
        return shares(situation_of(lent).grid, blocks);
      },
      py::arg("blocks"), "grid.shares(blocks) without the copy of the grid.");
}

}  // namespace

void bind_situations(py::module_& module) {
  py::class_<LentSituation, std::shared_ptr<LentSituation>> situation(
      module, "Situation",
      "What a robot that maps knows after its last scan. It lasts until the episode goes on.");
  add_situation(situation);
  py::class_<LentRequest, std::shared_ptr<LentRequest>> request(
      module, "Request",
      "What a planner is asked: which view next? All of it is what the "
      "robot believes; none is ground "
      "truth. It lasts until the answer.");
  add_situation(request);
  request.def("__len__", [](const LentRequest& r) { return of(r).candidates.size(); })
      .def_property_readonly(
          "views", [](const LentRequest& r) { return view_rows(of(r).candidates); },
          "(n, 5): x, y, z (m, world), yaw, pitch (rad) of the sensor.")
      .def_property_readonly(
          "gain",
          [](const LentRequest& r) {
            return of_views<double>(r, [](auto& c) { return c.gain_bits; });
          },
          "(n,): what each view promises by the episode's gain, in `gain_unit`.")
      .def_property_readonly(
          "gain_unit", [](const LentRequest& r) { return std::string(unit_of(of(r).gain)); },
          "bits, or the gain's own.")
      .def_property_readonly(
          "interval", &interval,
          "(n, 2): low and high end of what the robot holds the truth of each gain to be, in "
          "`gain_unit`, by its forecasts so far (see ForecastInterval). NaN where the episode's "
          "gain forecasts nothing that scans tell: all but `adaptive`.")
      .def_property_readonly(
          "path_length_m",
          [](const LentRequest& r) {
            return of_views<double>(r, [](auto& c) { return c.path_length_m; });
          },
          "(n,) m of way to each; inf where out of reach.")
      .def_property_readonly(
          "travel_s", [](const LentRequest& r) { return array_of(of(r).travel_s); },
          "(n,) s to drive to each, by the robot's drives so far.")
      .def_property_readonly(
          "reachable",
          [](const LentRequest& r) {
            return of_views<bool>(r, [](auto& c) { return c.reachable; });
          },
          "(n,) bool")
      .def_property_readonly(
          "exhausted",
          [](const LentRequest& r) {
            return of_views<bool>(r, [](auto& c) { return c.exhausted; });
          },
          "(n,) bool: tried before and out of reach, or beyond the budget. Not to be chosen while "
          "others are left.")
      .def_property_readonly(
          "ways", [](const LentRequest& r) { return std::make_shared<PathField>(of(r).paths); },
          "The known floor and the ways over it from here, a Ways.")
      .def(
          "own_choice", [](const LentRequest& r) { return of(r).own_choice(); },
          "Index of the view that the episode's own choice would take. It may draw random numbers: "
          "ask once.");
}

}  // namespace vantage::python
