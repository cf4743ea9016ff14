#include "vantage/cli/explain_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>

#include "vantage/cli/commands.hpp"
#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/recognise_options.hpp"
#include "vantage/cli/reference/entry.hpp"
#include "vantage/cli/reference/pages.hpp"
#include "vantage/cli/view_scoring.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMostNames = 20;  ///< of those that begin alike

struct Arguments {
  std::vector<std::string> names;
  std::filesystem::path pages;
  bool json = false;
};

void append(std::vector<ReferenceEntry>& all, std::vector<ReferenceEntry> more) {
  for (ReferenceEntry& entry : more) all.push_back(std::move(entry));
}

/// Those of the commands included.
std::vector<ReferenceEntry> all_keys() {
  std::vector<ReferenceEntry> keys = key_entries();
  append(keys, entries_of(describe_fields(ViewScoring{}), "score-views"));
  append(keys, entries_of(describe_fields(RecogniseOptions{}), "recognise"));
  return keys;
}

/// A command and its options; those below it follow.
void add_command(std::vector<ReferenceEntry>& entries, const std::string& name, CLI::App& app) {
  ReferenceEntry entry{.name = name, .place = "command", .text = app.get_description()};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_name() == "--help") continue;
    entry.parameters.push_back({.key = option->get_name(), .text = option->get_description()});
  }
  const auto subcommands = app.get_subcommands({});
  for (const CLI::App* sub : subcommands) {
    entry.parameters.push_back({.key = sub->get_name(), .text = sub->get_description()});
  }
  entries.push_back(std::move(entry));
  for (CLI::App* sub : subcommands) add_command(entries, name + " " + sub->get_name(), *sub);
}

std::vector<ReferenceEntry> command_entries() {
  std::vector<ReferenceEntry> entries;
  for (const Command& command : commands()) {
    CLI::App app{std::string(command.help)};
    const auto action = command.declare(app);  // keeps what the options are written to
    add_common_flags(app);
    add_command(entries, std::string(command.name), app);
  }
  return entries;
}

std::vector<ReferenceEntry> all_entries() {
  std::vector<ReferenceEntry> all = all_keys();
  append(all, strategy_entries());
  append(all, record_entries());
  append(all, command_entries());
  add_keys_below(all);
  return all;
}

/// Why nothing is said of a name.
std::string unknown_text(const std::vector<ReferenceEntry>& all, const std::string& name) {
  if (const auto begin = names_beginning(all, name); !begin.empty()) {
    const auto told = std::span(begin).first(std::min(begin.size(), kMostNames));
    return fmt::format("explain: {} begin with '{}': {}{}", begin.size(), name,
                       fmt::join(told, ", "), told.size() < begin.size() ? ", ..." : "");
  }
  const auto near = nearest_names(all, name, 3);
  return fmt::format("explain: nothing is called '{}'; {}", name,
                     near.empty() ? std::string("vantage list and --print-config say what there is")
                                  : fmt::format("near it: {}", fmt::join(near, ", ")));
}

ExitCode explain(const Arguments& arguments) {
  if (!arguments.pages.empty()) {
    write_reference_pages(all_keys(), arguments.pages);
    return ExitCode::done;
  }
  const auto all = all_entries();
  if (arguments.names.empty()) throw ConfigError("explain: say what, as in: explain gain.a");
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::string text;
  std::vector<std::string> unknown;
  for (const std::string& name : arguments.names) {
    const auto entries = find_entries(all, name);
    if (entries.empty()) unknown.push_back(unknown_text(all, name));
    for (const ReferenceEntry& entry : entries) {
      json.push_back(entry_json(entry));
      text += entry_text(entry);
    }
  }
  if (unknown.size() < arguments.names.size()) {
    fmt::print("{}", arguments.json ? json_text({{"entries", json}}) : text);
    std::fflush(stdout);  // before what is said of the others
  }
  for (const std::string& problem : unknown) log_error(problem);
  return unknown.empty() ? ExitCode::done : ExitCode::usage;
}

}  // namespace

std::function<ExitCode()> declare_explain(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.add_option(
      "names", arguments->names,
      "keys (gain.a), gains, features ..., columns, files, commands, exit codes; or how one "
      "begins, if nothing else begins so");
  app.add_option("--pages", arguments->pages, "write the whole reference there, as Markdown");
  add_json(app, arguments->json);
  return [arguments] { return explain(*arguments); };
}

}  // namespace vantage
