#include "vantage/dataset/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// For execve; the strings outlive it.
std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// Ours, but that llvmpipe draws in the thread that asks it to: workers are as many as there are
/// processors to draw with. The images are the same.
std::vector<std::string> environment_of_worker() {
  constexpr std::string_view kThreads = "LP_NUM_THREADS=";
  std::vector<std::string> environment{std::string(kThreads) + "0"};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!std::string_view(*entry).starts_with(kThreads)) environment.emplace_back(*entry);
  }
  return environment;
}

/// Between fork and exec: system calls only.
[[noreturn]] void become(char* const* program, char* const* environment, int socket, pid_t parent) {
  ::setpgid(0, 0);  // Ctrl-C reaches the parent, which ends this
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before the line above
  if (socket == STDIN_FILENO) {
    ::fcntl(socket, F_SETFD, 0);
  } else {
    ::dup2(socket, STDIN_FILENO);
  }
  ::dup2(STDERR_FILENO, STDOUT_FILENO);  // stdout is for results
  ::execve(program[0], program, environment);
  ::_exit(127);
}

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& program) {
  expects(!program.empty(), "a program to start");
  const std::vector<std::string> environment = environment_of_worker();
  const std::vector<char*> arguments = pointers_to(program);
  const std::vector<char*> variables = pointers_to(environment);
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw OutputError(fmt::format("cannot make a socket: {}", std::strerror(errno)));
  }
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(arguments.data(), variables.data(), ends[1], parent);
  const int error = errno;
  ::close(ends[1]);
  socket_ = ends[0];
  if (pid_ < 0) {
    ::close(socket_);
    throw OutputError(fmt::format("cannot start a process: {}", std::strerror(error)));
  }
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), socket_(std::exchange(other.socket_, -1)) {}

WorkerProcess& WorkerProcess::operator=(WorkerProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(socket_, other.socket_);
  return *this;
}

WorkerProcess::~WorkerProcess() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  wait_for_end();
}

std::string WorkerProcess::wait_for_end() {
  ::close(std::exchange(socket_, -1));
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  return fmt::format("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
}

}  // namespace vantage
