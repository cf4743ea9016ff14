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
#include <sstream>

#include "vantage/cli/commands.hpp"
#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/listing.hpp"
#include "vantage/cli/manual/command_text.hpp"
#include "vantage/cli/manual/completion.hpp"
#include "vantage/cli/manual/man_page.hpp"
#include "vantage/cli/recognise_options.hpp"
#include "vantage/cli/reference/entry.hpp"
#include "vantage/cli/reference/pages.hpp"
#include "vantage/cli/schema/file_schemas.hpp"
#include "vantage/cli/view_scoring.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMostNames = 20;  ///< of those that begin alike

struct ExplainArguments {
  std::vector<std::string> names;
  std::filesystem::path pages;
  std::filesystem::path manual;
  std::filesystem::path completion;
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
void add_command(std::vector<ReferenceEntry>& entries, const CommandText& command) {
  ReferenceEntry entry{.name = command.name, .place = "command", .text = command.text};
  for (const OptionText& option : command.options) {
    if (option.names.back() == "--help") continue;
    entry.parameters.push_back({.key = option.names.back(), .text = option.text});
  }
  for (const CommandText& part : command.parts) {
    entry.parameters.push_back(
        {.key = part.name.substr(command.name.size() + 1), .text = part.text});
  }
  entries.push_back(std::move(entry));
  for (const CommandText& part : command.parts) add_command(entries, part);
}

std::vector<CommandText> command_texts() {
  std::vector<CommandText> texts;
  for (const Command& command : commands()) {
    CLI::App app{std::string(command.help)};
    const auto action = command.declare(app);  // keeps what the options are written to
    add_common_flags(app);
    texts.push_back(command_text(std::string(command.name), app));
  }
  return texts;
}

std::vector<ReferenceEntry> command_entries() {
  std::vector<ReferenceEntry> entries;
  for (const CommandText& command : command_texts()) add_command(entries, command);
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

ManualFrame manual_frame() {
  ManualFrame frame{.version = version_text(),
                    .summary = "robots that choose their next action by how much they learn"};
  for (const ReferenceEntry& entry : record_entries()) {
    if (entry.place == "exit codes") frame.exit_status.emplace_back(entry.name, entry.text);
  }
  return frame;
}

/// "a, b" as words.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) {
    if (word.ends_with(',')) word.pop_back();
    words.push_back(word);
  }
  return words;
}

void write_completion(const std::filesystem::path& file) {
  const auto names = strategy_names<Gain>();
  const std::vector<Completions> words{
      {.command = "list", .words = words_of(listing_topics_text())},
      {.command = "schema", .words = words_of(schema_kinds_text())},
      {.command = "view", .option = "--camera", .words = {"overview", "follow", "robot"}},
      {.option = "--gain", .words = {names.begin(), names.end()}}};
  std::vector<KeyDescription> keys;
  for (const ReferenceEntry& entry : all_keys()) {
    keys.push_back({.key = entry.name, .type = entry.type});
  }
  write_file(file, bash_completion(command_texts(), words, keys));
}

/// Whether files were asked for, which are written then.
bool write_files(const ExplainArguments& arguments) {
  if (!arguments.pages.empty()) write_reference_pages(all_keys(), arguments.pages);
  if (!arguments.manual.empty()) {
    write_manual(command_texts(), manual_frame(), arguments.manual);
  }
  if (!arguments.completion.empty()) write_completion(arguments.completion);
  return !arguments.pages.empty() || !arguments.manual.empty() || !arguments.completion.empty();
}

ExitCode explain(const ExplainArguments& arguments) {
  const bool wrote = write_files(arguments);
  if (wrote && arguments.names.empty()) return ExitCode::done;
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
  auto arguments = std::make_shared<ExplainArguments>();
  app.add_option(
      "names", arguments->names,
      "keys (gain.a), gains, features ..., columns, files, commands, exit codes; or how one "
      "begins, if nothing else begins so");
  app.add_option("--pages", arguments->pages, "write the whole reference there, as Markdown");
  app.add_option("--manual", arguments->manual, "write the pages of the manual (man) there");
  app.add_option("--completion", arguments->completion,
                 "write a script there that completes the command line, for bash to source");
  add_json(app, arguments->json);
  return [arguments] { return explain(*arguments); };
}

}  // namespace vantage
