#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "vantage/cli/hints/text_check.hpp"
#include "vantage/cli/pictures/picture_commands.hpp"
#include "vantage/core/log.hpp"
#include "vantage/dataset/pictures/import_pictures.hpp"
#include "vantage/dataset/pictures/intrinsics_file.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ImportArguments {
  ImportOptions options;
  ImportRun run{.from = {},
                .root = {},
                .jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))};
  std::string depth_unit = "auto";
  fs::path intrinsics;
  std::vector<std::string> view_yaws;
};

double number_of(const std::string& text, const std::string& option) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw ConfigError(fmt::format("{}: '{}' is no number", option, text));
  }
  return value;
}

double unit_of(const std::string& text) {
  if (text == "auto") return 0.0;
  if (text == "mm") return 0.001;
  if (text == "m") return 1.0;
  const double unit_m = number_of(text, "--depth-unit");
  if (!(unit_m > 0.0 && unit_m <= 1.0)) {
    throw ConfigError(fmt::format("--depth-unit: {} m is not in (0, 1]", text));
  }
  return unit_m;
}

ImportOptions options_of(const ImportArguments& arguments) {
  ImportOptions options = arguments.options;
  options.depth_unit_m = unit_of(arguments.depth_unit);
  for (const std::string& given : arguments.view_yaws) {
    const auto equals = given.rfind('=');
    if (equals == std::string::npos || equals == 0) {
      throw ConfigError(fmt::format("--view-yaw: '{}' is not NAME=DEG", given));
    }
    options.yaw_deg[given.substr(0, equals)] = number_of(given.substr(equals + 1), "--view-yaw");
  }
  if (!arguments.intrinsics.empty()) {
    const Intrinsics intrinsics = read_intrinsics(arguments.intrinsics);
    options.focal_px = intrinsics.focal_px;
    options.centre_px = intrinsics.centre_px;
  }
  return options;
}

Json outcome_json(const fs::path& root, const ImportOutcome& outcome) {
  Json units = Json::object();
  for (const auto& [unit_m, pictures] : outcome.units) units[fmt::format("{}", unit_m)] = pictures;
  return {{"root", root.string()},
          {"objects", outcome.objects},
          {"pictures", outcome.pictures},
          {"recordings", outcome.notes.recordings},
          {"views", outcome.views},
          {"bins", outcome.notes.bins},
          {"degrees", outcome.notes.degrees},
          {"cut", outcome.notes.cut},
          {"focal_px", outcome.notes.focal_px},
          {"depth_units_m", units},
          {"layouts", outcome.layouts},
          {"notices", outcome.notices},
          {"left_out", outcome.left_out}};
}

void print_outcome(const fs::path& root, const ImportOutcome& outcome) {
  fmt::print("{}: {} pictures of {} objects in {} recording{}, cut by {}\n", root.string(),
             outcome.pictures, outcome.objects, outcome.notes.recordings.size(),
             outcome.notes.recordings.size() == 1 ? "" : "s", outcome.notes.cut);
  fmt::print("paths were read as {}\n", fmt::join(outcome.layouts, " and "));
  fmt::print("{} viewing directions{}{}\n", outcome.notes.bins, outcome.views.empty() ? "" : ": ",
             fmt::join(outcome.views, ", "));
  for (const auto& [unit_m, pictures] : outcome.units) {
    fmt::print("depth: 1 is {} of {} pictures\n",
               unit_m == 0.001 ? std::string("a millimetre")
               : unit_m == 1.0 ? std::string("a metre")
                               : fmt::format("{} m", unit_m),
               pictures);
  }
}

ExitCode import_command(const ImportArguments& arguments, const PictureFlags& flags) {
  ImportRun run = arguments.run;
  run.overwrite = flags.overwrite;
  run.poll = throw_if_interrupted;
  catch_interrupts();
  const ImportOutcome outcome = import_pictures(options_of(arguments), run);
  for (const std::string& notice : outcome.notices) log_info(notice);
  for (const std::string& file : outcome.left_out) log_warning(file);
  if (flags.json) {
    fmt::print("{}", json_text(outcome_json(run.root, outcome)));
  } else {
    print_outcome(run.root, outcome);
  }
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_import(CLI::App& app,
                                         const std::shared_ptr<const PictureFlags>& flags) {
  auto arguments = std::make_shared<ImportArguments>();
  ImportOptions& options = arguments->options;
  app.add_option("folder", arguments->run.from,
                 "folders of pictures, colour and depth beside each other; of several each is a "
                 "recording")
      ->required();
  app.add_option("--out", arguments->run.root, "folder of the dataset")
      ->required()
      ->check(not_empty);
  app.add_option("--layout", options.layout,
                 "how paths are read, such as '{recording}/{object}/{view}_{kind}'; also "
                 "{category}, {yaw}, {elevation}, {frame}, {*}; default: found out and told");
  app.add_option("--depth-unit", arguments->depth_unit,
                 "what 1 in a depth file stands for: mm, m or a number of metres; auto: integers "
                 "are mm, floats by their size")
      ->capture_default_str();
  app.add_option("--cut", options.cut,
                 "how the object is told from its surroundings: mask, depth, whole; auto: by masks "
                 "if all pictures have one, else by depth")
      ->check(CLI::IsMember({"auto", "mask", "depth", "whole"}))
      ->capture_default_str();
  app.add_option("--focal-px", options.focal_px, "focal length of the camera; default 570.3")
      ->check(CLI::Range(10.0, 1e5));
  app.add_option("--intrinsics", arguments->intrinsics,
                 "file with fx, fy, cx, cy or a 3 x 3 matrix, instead of --focal-px; pictures with "
                 "that point far from their middle are taken for crops of the image's middle")
      ->excludes("--focal-px");
  app.add_option("--elevation-deg", options.elevation_deg,
                 "how far the camera looks down, where no pose tells; default: from the table that "
                 "pictures show, else 45")
      ->check(CLI::Range(-90.0, 90.0));
  app.add_option("--view-yaw", arguments->view_yaws,
                 "NAME=DEG: yaw of the object in views of that name, beside or instead of the "
                 "usual ones; front is 0, the camera at its left 270")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--bins", options.bins,
                 "viewing directions that are told apart; default: as the pictures have them")
      ->check(CLI::Range(2, 3600));
  app.add_option("--jobs", arguments->run.jobs, "threads")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--skip-bad", arguments->run.skip_bad, "leave out pictures that cannot be used");
  return [arguments, flags] { return import_command(*arguments, *flags); };
}

}  // namespace vantage
