#include "python/kit/calls.hpp"

namespace vantage::python {

void throw_if_signalled() {
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace vantage::python
