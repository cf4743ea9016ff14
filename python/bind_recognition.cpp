#include "python/bindings.hpp"

namespace vantage::python {

void bind_recognition(py::module_&) {}

}  // namespace vantage::python
