/// How calls from Python are made: without the lock of the interpreter while C++ works, with Ctrl-C
/// looked for now and then.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <utility>

namespace vantage::python {

namespace py = pybind11;

/// The result of `work`, during which other Python threads run. It must not touch Python objects.
template <class Work>
auto without_lock(Work&& work) {
  const py::gil_scoped_release released;
  return std::forward<Work>(work)();
}

/// @throws error_already_set (KeyboardInterrupt, as a rule) if a signal came whose handler raises.
/// Any thread may call it, with or without the lock; Python handles signals in its main thread.
void throw_if_signalled();

/// Signals are looked for every so many calls of this.
class SignalPoll {
 public:
  explicit SignalPoll(int every) : every_(every) {}
  void operator()() {
    if (++calls_ % every_ == 0) throw_if_signalled();
  }

 private:
  int every_;
  int calls_ = 0;
};

}  // namespace vantage::python
