#include "vantage/runtime/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>

#include "vantage/core/log.hpp"

namespace vantage {
namespace {

/// Any thread may look.
std::atomic<int> g_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "as a signal handler needs");
timespec g_first{};

/// One Ctrl-C can arrive twice, at the process and at its group; nobody is that fast.
bool is_echo() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const double later_s = static_cast<double>(now.tv_sec - g_first.tv_sec) +
                         1e-9 * static_cast<double>(now.tv_nsec - g_first.tv_nsec);
  return later_s < 0.15;
}

/// As a signal handler may.
void say(std::string_view text) {
  const int before = errno;
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
  errno = before;
}

extern "C" void remember_signal(int signal) {
  if (g_signal == 0) {
    clock_gettime(CLOCK_MONOTONIC, &g_first);
    g_signal = signal;
    if (verbosity() == Verbosity::quiet) return;
    say("\nstopping, and writing what there is; once more ends it at once\n");
  } else if (!is_echo()) {
    ::_exit(128 + signal);
  }
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  std::signal(SIGPIPE, SIG_IGN);  // nobody reads the progress any more: that ends no run
}

Interrupted::Interrupted(int signal)
    : Error(static_cast<ExitCode>(128 + signal), signal == SIGTERM ? "terminated" : "interrupted") {
}

void throw_if_interrupted() {
  if (const int signal = g_signal; signal != 0) throw Interrupted(signal);
}

int interrupt_signal() { return g_signal; }

}  // namespace vantage
