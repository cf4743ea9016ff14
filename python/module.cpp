#include "python/bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of the package vantage; import vantage instead.";
  namespace python = vantage::python;
  python::bind_calls(module);
  python::bind_grids(module);
  python::bind_views(module);
  python::bind_gains(module);
  python::bind_distances(module);
  python::bind_tours(module);
  python::bind_intervals(module);
  python::bind_trajectory(module);
  python::bind_information(module);
  python::bind_recognition(module);
  python::bind_situations(module);
  python::bind_episodes(module);
}
