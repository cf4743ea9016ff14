#include "vantage/cli/doctor.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include <filesystem>
#include <memory>
#include <thread>

#include "vantage/cli/common_flags.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/render/window.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

std::string attempt(auto&& action) {
  try {
    return action();
  } catch (const std::exception& error) {
    return fmt::format("does NOT work: {}", error.what());
  }
}

std::string video_text() {
  const std::string missing = missing_video_codec();
  return missing.empty() ? "H.264 in MP4 works" : "does NOT work: " + missing;
}

}  // namespace

DoctorReport examine() {
  DoctorReport report;
  const std::string renderer = attempt([] { return renderer_name(); });
  report.renderer_works = !renderer.starts_with("does NOT");
  const auto line = [&](const char* what, std::string text) {
    report.lines.emplace_back(what, std::move(text));
  };
  line("vantage", version_text());
  line("mujoco", mujoco_version());
  line("renderer", renderer);
  line("window", attempt(Window::display_renderer_name));
  line("opencv", CV_VERSION);
  line("video", attempt(video_text));
  line("data",
       fs::is_directory(data_root() / "models" / "scenes")
           ? data_root().string()
           : fmt::format("does NOT work: no models in {}; set VANTAGE_DATA", data_root().string()));
  line("threads", fmt::format("{}", std::thread::hardware_concurrency()));
  return report;
}

std::function<ExitCode()> declare_doctor(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  add_json(app, *json);
  return [json] {
    const DoctorReport report = examine();
    nlohmann::ordered_json found;
    for (const auto& [what, text] : report.lines) {
      found[what] = text;
      if (!*json) fmt::print("{:<10} {}\n", what, text);
    }
    if (*json) fmt::print("{}", json_text(found));
    return report.renderer_works ? ExitCode::done : ExitCode::no_renderer;
  };
}

}  // namespace vantage
