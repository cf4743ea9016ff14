/// A process of a program of ours at the other end of a socket.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace vantage {

/// Started with its standard input as the socket; it is killed when this is destroyed, and when the
/// process that started it ends, however it ends. Ctrl-C does not reach it.
class WorkerProcess {
 public:
  /// @param program its file and arguments
  /// @throws OutputError if the system refuses a process.
  explicit WorkerProcess(const std::vector<std::string>& program);
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&& other) noexcept;
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess();

  [[nodiscard]] int socket() const { return socket_; }
  /// Of one that has closed its end of the socket. @returns "signal 11 (Segmentation fault)", "exit
  /// code 127"
  std::string wait_for_end();

 private:
  pid_t pid_ = -1;
  int socket_ = -1;
};

}  // namespace vantage
