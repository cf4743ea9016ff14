#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

#include "vantage/cli/hindsight/hindsight_commands.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/hindsight/run_bound.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/report/report.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

struct BoundArguments {
  fs::path directory;
  bool oracle_tour = false;
  bool json = false;
};

/// To run it takes a whole episode.
void keep_former_tour(const fs::path& file, RunBound& bound) {
  if (!fs::exists(file)) return;
  try {
    keep_oracle_tour(json_object_or_null<nlohmann::ordered_json>(read_file(file)), bound);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

ExitCode bound_command(const BoundArguments& arguments) {
  require_run_folder(arguments.directory);
  catch_interrupts();
  const RecordedRun run = read_recorded_run(arguments.directory);
  RunBound bound = bound_of_run(run);
  throw_if_interrupted();
  if (arguments.oracle_tour) {
    add_oracle_tour(run, bound);
  } else {
    keep_former_tour(run.directory / "bound.json", bound);
  }
  throw_if_interrupted();
  const std::string text = json_text(run_bound_json(bound));
  write_file(run.directory / "bound.json", text);
  if (fs::exists(run.directory / "report.html")) {
    write_report(run.directory, report_sections(run.episode.task));
  }
  fmt::print("{}", arguments.json ? text : run_bound_text(bound));
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_bound(CLI::App& app) {
  auto arguments = std::make_shared<BoundArguments>();
  app.add_option("dir", arguments->directory, "run folder of a mapping task")->required();
  app.add_flag("--oracle-tour", arguments->oracle_tour,
               "run the episode with the choice oracle_tour too, and compare");
  app.add_flag("--json", arguments->json, "print one JSON object");
  app.footer("Writes bound.json into the folder, and its report again.");
  return [arguments] { return bound_command(*arguments); };
}

}  // namespace vantage
