/// Ctrl-C and termination: the episode ends at the next control tick, what there is is written.
#pragma once

#include "vantage/core/error.hpp"

namespace vantage {

/// Ends an episode from within; its code is that of the signal.
struct Interrupted : Error {
  explicit Interrupted(int signal);
};

/// Catches SIGINT and SIGTERM from now on and says so on stderr, unless quiet; a second signal ends
/// the process at once, with the code of the signal and nothing more written.
void catch_interrupts();
/// @throws Interrupted if a signal was caught. Called once per control tick and part of the loop.
void throw_if_interrupted();
/// The signal caught; 0 if none was.
int interrupt_signal();

}  // namespace vantage
