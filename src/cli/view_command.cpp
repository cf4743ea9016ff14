#include "vantage/cli/view_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <string>
#include <vector>

#include "vantage/cli/commands.hpp"
#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/hints/episode_file.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/cli/hints/text_check.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/view/view.hpp"

namespace vantage {
namespace {

constexpr const char* kFooter =
    "In the window: space pauses, . steps, + - set the pace, c changes the camera, m shows the "
    "map,\ng the gains, s takes a screenshot, h lists everything else, q closes.";

struct ViewArguments {
  std::string target = "assets/episodes/tabletop.yaml";
  std::vector<std::string> overrides;
  std::string seed;
  std::string size = "1280x720";
  std::string camera = "overview";
  double at_s = 0.0;
  ViewOptions view;
  RunOptions run;
};

/// "1280x720". @throws ConfigError
PixelSize parse_size(const std::string& text) {
  PixelSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width_px);
  const bool has_height = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = std::from_chars(has_height ? width.ptr + 1 : end, end, size.height_px);
  const auto good = [](int px) { return px >= 64 && px <= 8192; };
  if (height.ec != std::errc{} || height.ptr != end || !good(size.width_px) ||
      !good(size.height_px)) {
    throw ConfigError(
        fmt::format("--size: '{}' is not WIDTHxHEIGHT, each from 64 to 8192 px", text));
  }
  return size;
}

/// What was written is the result of the command.
ExitCode told(ExitCode code, const ViewOptions& view) {
  if (!view.screenshot.empty()) fmt::print("{}\n", view.screenshot.string());
  return code;
}

void require_png(const std::filesystem::path& screenshot) {
  if (screenshot.empty() || screenshot.extension() == ".png") return;
  throw ConfigError(
      fmt::format("--screenshot: {}: expected a file name that ends in .png", screenshot.string()));
}

ExitCode view_command(const CLI::App& app, ViewArguments arguments) {
  ViewOptions& view = arguments.view;
  view.size = parse_size(arguments.size);
  if (arguments.camera == "follow") view.camera = ViewCamera::follow;
  if (arguments.camera == "robot") view.camera = ViewCamera::robot;
  if (app.count("--at") > 0) view.at_s = arguments.at_s;
  require_png(view.screenshot);
  require_absent(view.screenshot, arguments.run.overwrite, "--screenshot");
  std::error_code ignored;  // what cannot be looked into is no episode either
  if (std::filesystem::is_directory(arguments.target, ignored)) {
    for (const char* option : {"--set", "--seed", "--out"}) {
      if (app.count(option) == 0) continue;
      throw ConfigError(
          fmt::format("{}: {} is a run folder, it has happened already", option, arguments.target));
    }
    require_run_folder(arguments.target);
    return told(view_recording(arguments.target, view), view);
  }
  if (!arguments.seed.empty()) arguments.overrides.push_back("seed=" + arguments.seed);
  arguments.run.command = command_line();
  const auto episode = find_episode(arguments.target);
  return told(view_live(load_episode(episode, arguments.overrides), view, arguments.run), view);
}

}  // namespace

std::function<ExitCode()> declare_view(CLI::App& app) {
  auto arguments = std::make_shared<ViewArguments>();
  app.add_option("episode", arguments->target, "episode file, or a run folder")
      ->capture_default_str();
  app.add_option("--set", arguments->overrides, "key=value, same keys as the file")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--seed", arguments->seed, "seed of every random stream")->check(whole_number);
  app.add_option("--out", arguments->run.directory,
                 "run folder of an episode that runs; without it nothing is kept")
      ->check(not_empty);
  add_overwrite(app, arguments->run.overwrite);
  app.add_option("--size", arguments->size, "of the window, px")->capture_default_str();
  app.add_option("--camera", arguments->camera,
                 "overview, follow (circles the robot) or robot (what its own camera sees)")
      ->check(CLI::IsMember({"overview", "follow", "robot"}))
      ->type_name("NAME")
      ->capture_default_str();
  app.add_flag("--map", arguments->view.map, "begin with the map shown");
  app.add_flag("--gains", arguments->view.gains, "begin with the gains shown");
  auto* screenshot = app.add_option("--screenshot", arguments->view.screenshot,
                                    "PNG of the window, then exit; of the end, or --at")
                         ->check(not_empty);
  app.add_option("--at", arguments->at_s, "simulated time of the screenshot, s")
      ->check(CLI::NonNegativeNumber)
      ->needs(screenshot);
  app.footer(kFooter);
  return [&app, arguments] { return view_command(app, *arguments); };
}

}  // namespace vantage
