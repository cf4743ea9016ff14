#include "vantage/cli/common_flags.hpp"

#include <CLI/CLI.hpp>

#include "vantage/core/log.hpp"

namespace vantage {

void add_common_flags(CLI::App& app) {
  auto* quiet = app.add_flag_callback(
      "-q,--quiet", [] { set_verbosity(Verbosity::quiet); },
      "results only; warnings and errors on stderr");
  app.add_flag_callback(
         "-v,--verbose", [] { set_verbosity(Verbosity::verbose); },
         "debug messages too; list: what each does")
      ->excludes(quiet);
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) option->disable_flag_override();
  }
  for (CLI::App* part : app.get_subcommands({})) add_common_flags(*part);
}

void add_json(CLI::App& app, bool& json) { app.add_flag("--json", json, "print one JSON object"); }

void add_overwrite(CLI::App& app, bool& overwrite) {
  app.add_flag("--overwrite", overwrite, "replace a result that is there");
}

std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

}  // namespace vantage
