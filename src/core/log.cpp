#include "vantage/core/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <mutex>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

Verbosity g_verbosity = Verbosity::normal;
std::filesystem::path g_file;
std::mutex g_mutex;  ///< of `g_file` and of which sinks there are

constexpr double kBarEvery_s = 0.1;
constexpr double kLineEvery_s = 2.0;
double g_progress_s = -std::numeric_limits<double>::infinity();  ///< when any was shown last
bool g_bar_shown = false;                                        ///< in the terminal's last line

/// As no-color.org has it.
bool no_colour() {
  const char* wish = std::getenv("NO_COLOR");
  return wish != nullptr && *wish != '\0';
}

spdlog::level::level_enum console_level() {
  switch (g_verbosity) {
    case Verbosity::quiet: return spdlog::level::warn;
    case Verbosity::normal: return spdlog::level::info;
    case Verbosity::verbose: return spdlog::level::debug;
  }
  return spdlog::level::info;
}

spdlog::logger& logger() {
  static spdlog::logger instance = [] {
    const auto colour = no_colour() ? spdlog::color_mode::never : spdlog::color_mode::automatic;
    auto console = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(colour);
    console->set_pattern("%^%l%$: %v");
    console->set_level(console_level());
    spdlog::logger made("vantage", {console});
    made.set_level(spdlog::level::debug);
    return made;
  }();
  return instance;
}

/// A line of its own, where a bar is shown in its place.
void write_line(spdlog::level::level_enum level, std::string_view message) {
  const std::scoped_lock lock(g_mutex);
  if (g_bar_shown && level >= console_level()) {
    std::fputs("\r\x1b[K", stderr);
    g_bar_shown = false;
  }
  logger().log(level, message);
}

std::size_t terminal_columns() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

/// fmt::print throws where stderr is full, which is no reason to end the work.
void tell(const std::string& text) { std::fputs(text.c_str(), stderr); }

/// In the line where it was shown before, which it must not outgrow.
void show_bar(const std::string& label, double fraction, std::string_view note) {
  const auto filled = static_cast<std::size_t>(fraction * 30.0);
  std::string line = fmt::format("{} [{:#<{}}{:.<{}}] {:3.0f} % {}", label, "", filled, "",
                                 30 - filled, 100.0 * fraction, note);
  line.resize(std::min(line.size(), terminal_columns() - 1));
  tell(fmt::format("\r{}\x1b[K", line));
  std::fflush(stderr);
  g_bar_shown = true;
}

}  // namespace

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void set_verbosity(Verbosity verbosity) {
  g_verbosity = verbosity;
  logger().sinks().front()->set_level(console_level());
}

Verbosity verbosity() { return g_verbosity; }

void log_to_file(const std::filesystem::path& path) {
  const std::scoped_lock lock(g_mutex);
  auto& sinks = logger().sinks();
  sinks.resize(1);
  if (!g_file.empty()) {
    std::error_code ignored;  // a log is no result
    std::filesystem::rename(part_name(g_file), g_file, ignored);
  }
  g_file = path;
  if (path.empty()) return;
  try {
    auto file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(part_name(path).string(), true);
    file->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    sinks.push_back(std::move(file));
  } catch (const spdlog::spdlog_ex& error) {
    throw OutputError(fmt::format("{}: cannot write: {}", path.string(), error.what()));
  }
}

void log_debug(std::string_view message) { write_line(spdlog::level::debug, message); }
void log_info(std::string_view message) { write_line(spdlog::level::info, message); }
void log_warning(std::string_view message) { write_line(spdlog::level::warn, message); }
void log_error(std::string_view message) { write_line(spdlog::level::err, message); }

Progress::Progress(std::string label, double total) : label_(std::move(label)), total_(total) {}

Progress::~Progress() {
  if (g_bar_shown) std::fputc('\n', stderr);
  g_bar_shown = false;
}

void Progress::update(double done, std::string_view note) {
  if (g_verbosity == Verbosity::quiet || finished_) return;
  finished_ = done >= total_;
  const double fraction = std::clamp(total_ > 0.0 ? done / total_ : 1.0, 0.0, 1.0);
  const bool with_bar = ::isatty(STDERR_FILENO) == 1 && !no_colour();
  const double now_s = wall_s();
  const bool due = now_s - g_progress_s >= (with_bar ? kBarEvery_s : kLineEvery_s);
  if (!due && !(finished_ && shown_)) return;
  shown_ = true;
  g_progress_s = now_s;
  if (with_bar) {
    show_bar(label_, fraction, note);
  } else {
    tell(fmt::format("{}: {:.0f} % {}\n", label_, 100.0 * fraction, note));
  }
}

}  // namespace vantage
