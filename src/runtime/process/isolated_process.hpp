/// A program that is not ours, at the other ends of three pipes.
#pragma once

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vantage {

struct ProgramToRun {
  std::vector<std::string> command;  ///< the program by its path, and its arguments
  std::filesystem::path working_directory;
  std::vector<std::string> environment;  ///< NAME=value, all there is
};

/// In namespaces of its own where the system allows that: it has no network, and nothing that it
/// starts outlives it. In any case it is killed, with its process group, when this is destroyed,
/// and the program itself when the thread that started it ends, however it ends. It holds no other
/// open file of ours.
class IsolatedProcess {
 public:
  /// @throws OutputError if the system refuses a process or cannot run the program.
  explicit IsolatedProcess(const ProgramToRun& program);
  IsolatedProcess(const IsolatedProcess&) = delete;
  IsolatedProcess& operator=(const IsolatedProcess&) = delete;
  ~IsolatedProcess();

  [[nodiscard]] int input() const { return input_; }    ///< to write to, does not block
  [[nodiscard]] int output() const { return output_; }  ///< to read from, does not block
  [[nodiscard]] int errors() const { return errors_; }  ///< likewise
  void close_input();

  /// Whether it has namespaces of its own; if not, why.
  [[nodiscard]] bool is_isolated() const { return refusal_.empty(); }
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

  /// Waits no longer than that. @returns "exit code 1", "signal 9 (Killed)"; none: it runs still
  std::optional<std::string> wait_for_end(double at_most_s);

 private:
  void start(const ProgramToRun& program, const std::array<std::array<int, 2>, 4>& pipes);
  void end() noexcept;

  pid_t pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  int errors_ = -1;
  std::string refusal_;
};

}  // namespace vantage
