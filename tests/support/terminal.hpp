/// What progress looks like on a terminal.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <string>

#include "vantage/core/log.hpp"

namespace vantage::support {

inline bool has_terminals() {
  const int screen = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (screen >= 0) ::close(screen);
  return screen >= 0;
}

/// @param step makes progress. It is shown every now and then, so that this may do it several times
/// @param columns of the terminal; 0: it does not tell
inline std::string shown_progress(const std::function<void()>& step, unsigned short columns = 250) {
  const int screen = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  ::grantpt(screen);
  ::unlockpt(screen);
  const int terminal = ::open(::ptsname(screen), O_RDWR | O_NOCTTY);
  winsize size{};
  size.ws_col = columns;
  ::ioctl(terminal, TIOCSWINSZ, &size);
  const int before = ::dup(STDERR_FILENO);
  ::dup2(terminal, STDERR_FILENO);
  set_verbosity(Verbosity::normal);
  pollfd shown{screen, POLLIN, 0};
  for (int i = 0; i < 1000 && ::poll(&shown, 1, 10) == 0; ++i) step();
  set_verbosity(Verbosity::quiet);
  ::dup2(before, STDERR_FILENO);
  std::array<char, 512> text{};
  const ssize_t read = ::read(screen, text.data(), text.size());
  for (const int file : {before, terminal, screen}) ::close(file);
  return {text.data(), read > 0 ? static_cast<std::size_t>(read) : 0U};
}

}  // namespace vantage::support
