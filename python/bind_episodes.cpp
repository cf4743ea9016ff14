#include "python/bindings.hpp"

namespace vantage::python {

void bind_episodes(py::module_&) {}

}  // namespace vantage::python
