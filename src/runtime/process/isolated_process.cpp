#include "vantage/runtime/process/isolated_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Pipes = std::array<std::array<int, 2>, 4>;  ///< input, output, errors, and how exec failed
constexpr std::size_t kInput = 0;
constexpr std::size_t kOutput = 1;
constexpr std::size_t kErrors = 2;
constexpr std::size_t kExec = 3;

/// Everything that the child needs, made before it is there.
struct Start {
  char* const* arguments;
  char* const* environment;
  const char* working_directory;
  const char* uid_map;  ///< null: it keeps the user namespace
  const char* gid_map;
  bool is_first;  ///< of a namespace of processes
  const Pipes& pipes;
};

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// From here to become(): system calls only.
void write_all(const char* file, const char* text) {
  const int opened = ::open(file, O_WRONLY | O_CLOEXEC);
  [[maybe_unused]] const auto written = ::write(opened, text, ::strlen(text));
  ::close(opened);
}

void keep_own_user(const Start& start) {
  if (start.uid_map == nullptr) return;
  write_all("/proc/self/setgroups", "deny");
  write_all("/proc/self/gid_map", start.gid_map);
  write_all("/proc/self/uid_map", start.uid_map);
}

[[noreturn]] void give_up(const Start& start) {
  const int error = errno;
  [[maybe_unused]] const auto told = ::write(start.pipes[kExec][1], &error, sizeof error);
  ::_exit(127);
}

/// Whether who started this has ended before prctl() was heard: nobody holds the other end.
bool is_left_alone() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return ::poll(&input, 1, 0) > 0 && (input.revents & POLLHUP) != 0;
}

void reset_signals() {
  for (const int signal : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGCHLD}) {
    ::signal(signal, SIG_DFL);
  }
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// As fork(), into namespaces of these kinds.
pid_t fork_into(unsigned long namespaces) {
  return static_cast<pid_t>(
      ::syscall(SYS_clone, namespaces | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

/// The first process of a namespace of processes: the program is the second, for which signals are
/// what they are elsewhere. Whatever it leaves behind ends with this one.
[[noreturn]] void wait_as_first(pid_t program) {
  ::close_range(0, ~0U, 0);
  while (true) {
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, 0);
    if (ended == program)
      ::_exit(WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status));
    if (ended < 0 && errno != EINTR) ::_exit(127);
  }
}

[[noreturn]] void become(const Start& start) {
  ::setpgid(0, 0);  // Ctrl-C reaches the episode, which ends this
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  keep_own_user(start);
  ::dup2(start.pipes[kInput][0], STDIN_FILENO);
  ::dup2(start.pipes[kOutput][1], STDOUT_FILENO);
  ::dup2(start.pipes[kErrors][1], STDERR_FILENO);
  ::close(start.pipes[kInput][1]);
  if (is_left_alone()) ::_exit(1);
  reset_signals();
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (start.is_first) {
    const pid_t program = fork_into(0);
    if (program < 0) give_up(start);
    if (program > 0) wait_as_first(program);
  }
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  if (::chdir(start.working_directory) != 0) give_up(start);
  ::execve(start.arguments[0], start.arguments, start.environment);
  give_up(start);
}

void close_both(std::array<int, 2>& ends) {
  for (int& end : ends) {
    if (end >= 0) ::close(std::exchange(end, -1));
  }
}

/// Ends that are none of the standard streams, which may be closed here.
bool make_pipe(std::array<int, 2>& ends) {
  std::array<int, 2> made{};
  if (::pipe2(made.data(), O_CLOEXEC) != 0) return false;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    ends[i] = ::fcntl(made[i], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  }
  const int error = errno;
  close_both(made);
  errno = error;
  return ends[0] >= 0 && ends[1] >= 0;
}

Pipes make_pipes() {
  Pipes pipes;
  for (auto& ends : pipes) ends = {-1, -1};
  for (auto& ends : pipes) {
    if (make_pipe(ends)) continue;
    const int error = errno;
    for (auto& made : pipes) close_both(made);
    throw OutputError(fmt::format("cannot make a pipe: {}", std::strerror(error)));
  }
  return pipes;
}

/// None: the program runs.
std::optional<int> exec_error(int told) {
  int error = 0;
  ssize_t got = 0;
  do {
    got = ::read(told, &error, sizeof error);
  } while (got < 0 && errno == EINTR);
  return got == sizeof error ? std::optional(error) : std::nullopt;
}

/// The first process of a namespace tells a signal as shells do. Greater exit codes are a program's
/// own.
std::string end_text(const siginfo_t& info) {
  const bool exited = info.si_code == CLD_EXITED;
  const int signal = exited ? info.si_status - 128 : info.si_status;
  if (signal < 1 || signal > SIGRTMAX) return fmt::format("exit code {}", info.si_status);
  return fmt::format("signal {} ({})", signal, ::strsignal(signal));
}

}  // namespace

IsolatedProcess::IsolatedProcess(const ProgramToRun& program) {
  expects(!program.command.empty(), "a program to start");
  Pipes pipes = make_pipes();
  start(program, pipes);
  const int error = errno;
  input_ = std::exchange(pipes[kInput][1], -1);
  output_ = std::exchange(pipes[kOutput][0], -1);
  errors_ = std::exchange(pipes[kErrors][0], -1);
  const int told = std::exchange(pipes[kExec][0], -1);
  for (auto& ends : pipes) close_both(ends);
  for (const int end : {input_, output_, errors_}) ::fcntl(end, F_SETFL, O_NONBLOCK);
  const auto failed = pid_ < 0 ? std::optional(error) : exec_error(told);
  ::close(told);
  if (!failed) return;
  end();
  throw OutputError(
      fmt::format("cannot run {}: {}", program.command.front(), std::strerror(*failed)));
}

void IsolatedProcess::start(const ProgramToRun& program, const Pipes& pipes) {
  const std::vector<char*> arguments = pointers_to(program.command);
  const std::vector<char*> environment = pointers_to(program.environment);
  const std::string uid_map = fmt::format("{0} {0} 1\n", ::geteuid());
  const std::string gid_map = fmt::format("{0} {0} 1\n", ::getegid());
  Start start{.arguments = arguments.data(),
              .environment = environment.data(),
              .working_directory = program.working_directory.c_str(),
              .uid_map = uid_map.c_str(),
              .gid_map = gid_map.c_str(),
              .is_first = true,
              .pipes = pipes};
  pid_ = fork_into(CLONE_NEWUSER | CLONE_NEWNET | CLONE_NEWPID);
  if (pid_ == 0) become(start);
  if (pid_ > 0) return;
  refusal_ = std::strerror(errno);
  start.uid_map = nullptr;
  pid_ = fork_into(CLONE_NEWNET | CLONE_NEWPID);  // as root may
  if (pid_ == 0) become(start);
  if (pid_ > 0) {
    refusal_.clear();
    return;
  }
  start.is_first = false;
  pid_ = fork_into(0);
  if (pid_ == 0) become(start);
}

IsolatedProcess::~IsolatedProcess() { end(); }

void IsolatedProcess::end() noexcept {
  if (pid_ > 0) {
    ::kill(-pid_, SIGKILL);
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
  }
  for (int* end : {&input_, &output_, &errors_}) {
    if (*end >= 0) ::close(std::exchange(*end, -1));
  }
}

void IsolatedProcess::close_input() {
  if (input_ >= 0) ::close(std::exchange(input_, -1));
}

std::optional<std::string> IsolatedProcess::wait_for_end(double at_most_s) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(at_most_s);
  while (true) {
    siginfo_t info{};
    const int told = ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (told == 0 && info.si_pid == pid_) {
      return end_text(info);
    }
    if (Clock::now() >= until) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace vantage
