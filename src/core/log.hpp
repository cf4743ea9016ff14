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

/// Progress of long work: a bar on a terminal, else a line every few seconds. Honours NO_COLOR and
/// -q.
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
  double last_shown_s_ = -1.0;
  bool bar_shown_ = false;
};

}  // namespace vantage
