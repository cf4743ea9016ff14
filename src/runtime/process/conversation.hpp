/// Asking a program a line at a time: one line there, one line back, each within a time. Nothing
/// that the program does or leaves undone blocks for longer, or takes more than bounded memory.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "vantage/core/error.hpp"
#include "vantage/runtime/process/isolated_process.hpp"
#include "vantage/runtime/process/line_buffer.hpp"

namespace vantage {

/// The program did not answer as it should. It is no more.
struct ConversationFailed : Error {
  explicit ConversationFailed(const std::string& why) : Error(ExitCode::goal_failed, why) {}
};

inline constexpr std::size_t kMaxAnswerBytes = 65536;
inline constexpr std::size_t kMaxErrorBytes = 65536;  ///< of all that is passed on

class Conversation {
 public:
  /// @param on_error is told each line of its standard error, up to kMaxErrorBytes in all
  /// @param on_wait is called while it is waited for, several times a second; may throw
  /// @throws OutputError if it cannot be started
  Conversation(const ProgramToRun& program, std::function<void(std::string_view)> on_error,
               std::function<void()> on_wait);

  /// The line that it answers, without its end. @throws ConversationFailed with the reason, of a
  /// program that has ended with the last line of its standard error; what on_wait throws
  std::string ask(std::string_view line, double timeout_s);
  /// Tells it a last line and gives it that long to end by itself. It need not listen.
  void part(std::string_view line, double grace_s);

  [[nodiscard]] const IsolatedProcess& process() const { return process_; }

 private:
  [[noreturn]] void fail_ended();
  void send();
  void hear();
  void hear_errors();
  void remember_error(std::string_view bytes);
  [[nodiscard]] std::string last_error() const;
  void exchange_for(double at_most_s);

  std::string working_directory_;
  IsolatedProcess process_;
  std::function<void(std::string_view)> on_error_;
  std::function<void()> on_wait_;
  std::string unsent_;
  LineBuffer heard_{kMaxAnswerBytes};
  LineBuffer errors_{kMaxErrorBytes};
  bool was_asked_ = false;
  std::size_t errors_told_ = 0;
  std::string last_errors_;  ///< the end of its standard error, however much there was
  bool hears_ = true;        ///< its output is open
  bool hears_errors_ = true;
};

}  // namespace vantage
