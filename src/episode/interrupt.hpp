/// Ctrl-C and termination: the step under way is finished, what there is is written.
#pragma once

namespace vantage {

/// Catches SIGINT and SIGTERM from now on; a second signal, a second or
/// more after the first, ends the process at once.
void catch_interrupts();
/// The signal caught, 0 if none.
int interrupt_signal();

}  // namespace vantage
