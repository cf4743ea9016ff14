/// Errors that a user can cause, each with the exit code the command line ends with.
/// They are thrown with context where they happen and caught once, in main.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

enum class ExitCode : int {
  done = 0,
  goal_failed = 1,    ///< a comparison or goal failed
  usage = 2,          ///< usage or configuration
  bad_input = 3,      ///< a file given by the user cannot be used
  diverged = 4,       ///< the simulation diverged
  output = 5,         ///< output could not be written
  no_renderer = 6,    ///< no OpenGL context could be made
  internal = 70,      ///< a bug of ours
  interrupted = 130,  ///< SIGINT; results so far are written
  terminated = 143,   ///< SIGTERM; results so far are written
};

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// One line per problem; what() is the first and says how many more there are.
class ConfigError : public Error {
 public:
  explicit ConfigError(const std::string& message)
      : Error(ExitCode::usage, message), problems_{message} {}
  explicit ConfigError(std::vector<std::string> problems);
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::bad_input, message) {}
};
struct DivergedError : Error {
  explicit DivergedError(const std::string& message) : Error(ExitCode::diverged, message) {}
};
struct OutputError : Error {
  explicit OutputError(const std::string& message) : Error(ExitCode::output, message) {}
};
struct RendererError : Error {
  explicit RendererError(const std::string& message) : Error(ExitCode::no_renderer, message) {}
};

/// Programmer errors: prints `what` and the place, then ends the process. Always on.
/// The builtins are std::source_location in a form that clang 14 reads too.
[[noreturn]] void assertion_failed(std::string_view what, const char* file = __builtin_FILE(),
                                   int line = __builtin_LINE());

inline void expects(bool condition, std::string_view what, const char* file = __builtin_FILE(),
                    int line = __builtin_LINE()) {
  if (!condition) assertion_failed(what, file, line);
}

}  // namespace vantage
