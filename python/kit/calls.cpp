#include "python/kit/calls.hpp"

namespace vantage::python {

void throw_if_signalled() {
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void SignalPoll::operator()() {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kBetween;
  throw_if_signalled();
}

}  // namespace vantage::python
