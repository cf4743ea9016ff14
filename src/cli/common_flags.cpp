#include "vantage/cli/common_flags.hpp"

#include <CLI/CLI.hpp>

#include <cmath>

#include "vantage/core/log.hpp"

namespace vantage {
namespace {

/// NaN is within every range.
std::string finite_number(const std::string& text) {
  double number = 0.0;
  const bool good = !CLI::detail::lexical_cast(text, number) || std::isfinite(number);
  return good ? "" : text + " is not a finite number";
}

}  // namespace

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
    if (option->get_type_name().starts_with("FLOAT")) option->check(finite_number);
  }
  for (CLI::App* part : app.get_subcommands({})) add_common_flags(*part);
}

void add_json(CLI::App& app, bool& json) { app.add_flag("--json", json, "print one JSON object"); }

void add_overwrite(CLI::App& app, bool& overwrite) {
  app.add_flag("--overwrite", overwrite, "replace a result that is there");
}

}  // namespace vantage
