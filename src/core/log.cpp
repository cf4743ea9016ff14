#include "vantage/core/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

Verbosity g_verbosity = Verbosity::normal;
std::filesystem::path g_file;

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
    const auto colour = std::getenv("NO_COLOR") != nullptr ? spdlog::color_mode::never
                                                           : spdlog::color_mode::automatic;
    auto console = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(colour);
    console->set_pattern("%^%l%$: %v");
    console->set_level(console_level());
    spdlog::logger made("vantage", {console});
    made.set_level(spdlog::level::debug);
    return made;
  }();
  return instance;
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

void log_debug(std::string_view message) { logger().debug(message); }
void log_info(std::string_view message) { logger().info(message); }
void log_warning(std::string_view message) { logger().warn(message); }
void log_error(std::string_view message) { logger().error(message); }

Progress::Progress(std::string label, double total) : label_(std::move(label)), total_(total) {}

Progress::~Progress() {
  if (bar_shown_) std::fputc('\n', stderr);
}

void Progress::update(double done, std::string_view note) {
  if (g_verbosity == Verbosity::quiet) return;
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  const double now_s = wall_s();
  const bool finished = done >= total_;
  if (last_shown_s_ >= 0.0 && !finished && now_s - last_shown_s_ < (terminal ? 0.1 : 5.0)) return;
  last_shown_s_ = now_s;
  const double fraction = std::clamp(total_ > 0.0 ? done / total_ : 1.0, 0.0, 1.0);
  if (terminal) {
    const auto filled = static_cast<std::size_t>(fraction * 30.0);
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3.0f} % {}\x1b[K", label_, "", filled, "",
               30 - filled, 100.0 * fraction, note);
    std::fflush(stderr);
    bar_shown_ = true;
  } else {
    fmt::print(stderr, "{}: {:.0f} % {}\n", label_, 100.0 * fraction, note);
  }
}

}  // namespace vantage
