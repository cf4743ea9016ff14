/// Logging and progress, all on stderr; stdout is for results.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vantage {

enum class Verbosity { quiet, normal, verbose };

void set_verbosity(Verbosity verbosity);
Verbosity verbosity();
/// Also writes every line, debug included, beside `path` until the next call, which puts the file
/// under its name; empty stops it.
/// @throws OutputError if the file cannot be made.
void log_to_file(const std::filesystem::path& path);
void log_debug(std::string_view message);
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

/// Wall time from some fixed moment on.
double wall_s();

/// Progress of long work: on a terminal, if NO_COLOR is unset or empty, a bar in one line, else a
/// line every two seconds at most, whatever makes progress, and the end of what was told of.
/// Nothing with -q.
class Progress {
 public:
  Progress(std::string label, double total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double done, std::string_view note = {});

 private:
  std::string label_;
  double total_;
  bool shown_ = false;
  bool finished_ = false;
};

}  // namespace vantage
