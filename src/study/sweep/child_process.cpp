#include "vantage/study/sweep/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Between fork and exec: system calls only.
[[noreturn]] void become(char* const* arguments, int output, pid_t parent) {
  ::setpgid(0, 0);  // Ctrl-C reaches the sweep, which passes it on
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before the line above
  const int kept = ::fcntl(output, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);  // of a service it may be 0
  ::close(STDIN_FILENO);
  ::dup2(kept, STDOUT_FILENO);
  ::dup2(kept, STDERR_FILENO);
  ::execv("/proc/self/exe", arguments);
  ::_exit(127);
}

}  // namespace

pid_t start_self(const std::vector<std::string>& arguments, const std::filesystem::path& output) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (const auto& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) {
    throw OutputError(fmt::format("{}: cannot write: {}", output.string(), std::strerror(errno)));
  }
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) become(pointers.data(), file, parent);
  const int error = errno;
  ::close(file);
  if (child < 0) {
    throw OutputError(fmt::format("cannot start a process: {}", std::strerror(error)));
  }
  return child;
}

std::optional<ChildEnd> poll_child() {
  int status = 0;
  const pid_t pid = ::waitpid(-1, &status, WNOHANG);
  if (pid <= 0) return std::nullopt;
  return ChildEnd{pid, WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status)};
}

}  // namespace vantage
