#include "vantage/cli/export/export_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

#include "vantage/cli/hints/folder.hpp"
#include "vantage/cli/hints/text_check.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/mcap/export_run.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

struct ExportArguments {
  std::filesystem::path directory;
  std::filesystem::path file;
  ExportOptions options;
  bool overwrite = false;
  bool json = false;
};

ExitCode export_command(const ExportArguments& arguments) {
  require_run_folder(arguments.directory);
  require_absent(arguments.file, arguments.overwrite, "--mcap");
  catch_interrupts();
  const ExportedRun run = export_run(arguments.directory, arguments.file, arguments.options);
  const auto bytes = std::filesystem::file_size(arguments.file);
  if (arguments.json) {
    fmt::print("{}", json_text({{"file", arguments.file.string()},
                                {"channels", run.channels},
                                {"messages", run.messages},
                                {"simulated_time_s", run.end_s},
                                {"bytes", bytes}}));
  } else {
    fmt::print("{}: {} messages in {} channels, {:.1f} s, {:.1f} MB\n", arguments.file.string(),
               run.messages, run.channels, run.end_s, 1e-6 * static_cast<double>(bytes));
  }
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_export(CLI::App& app) {
  auto arguments = std::make_shared<ExportArguments>();
  app.add_option("dir", arguments->directory, "run folder")->required();
  app.add_option("--mcap", arguments->file, "MCAP file to write, for Foxglove and the like")
      ->check(not_empty)
      ->required();
  app.add_option("--image-period", arguments->options.image_period_s,
                 "simulated time between images, s; 0: no images")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app.add_option("--image-height", arguments->options.image_height_px, "of images, px; 4:3")
      ->check(CLI::Range(60, 2160))
      ->capture_default_str();
  app.add_flag("--overwrite", arguments->overwrite, "replace a file that is there");
  app.add_flag("--json", arguments->json, "print one JSON object");
  return [arguments] { return export_command(*arguments); };
}

}  // namespace vantage
