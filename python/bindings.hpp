/// A file a topic of the Python package; each adds its names to the module.
#pragma once

#include <pybind11/pybind11.h>

namespace vantage::python {

namespace py = pybind11;

void bind_calls(py::module_& module);  ///< errors, verbosity, what there is to choose from
void bind_grids(py::module_& module);
void bind_gains(py::module_& module);
void bind_views(py::module_& module);
void bind_distances(py::module_& module);
void bind_tours(py::module_& module);
void bind_intervals(py::module_& module);
void bind_trajectory(py::module_& module);
void bind_information(py::module_& module);
void bind_recognition(py::module_& module);
void bind_situations(py::module_& module);
void bind_episodes(py::module_& module);

}  // namespace vantage::python
