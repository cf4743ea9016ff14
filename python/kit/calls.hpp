/// How calls from Python are made: without the lock of the interpreter while C++ works, with Ctrl-C
/// looked for now and then.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <utility>

#include "vantage/core/cancellation/stop_poll.hpp"

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

/// Called as often as you like, looks for signals twenty times a second.
class SignalPoll {
 public:
  void operator()();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kBetween{50};
  Clock::time_point next_ = Clock::now() + kBetween;
};

/// The result of `work` as by without_lock(), ended by a signal where it asks poll_stop().
template <class Work>
auto interruptibly(Work&& work) {
  const StopPoll poll{SignalPoll()};
  return without_lock(std::forward<Work>(work));
}

}  // namespace vantage::python
