#include "python/bindings.hpp"

namespace vantage::python {

void bind_situations(py::module_&) {}

}  // namespace vantage::python
