#include "vantage/cli/explain_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/recognise_options.hpp"
#include "vantage/cli/reference/entry.hpp"
#include "vantage/cli/reference/pages.hpp"
#include "vantage/cli/view_scoring.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

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

std::vector<ReferenceEntry> all_entries() {
  std::vector<ReferenceEntry> all = all_keys();
  append(all, strategy_entries());
  append(all, record_entries());
  return all;
}

/// @throws ConfigError if there is nothing of that name
std::vector<ReferenceEntry> found(const std::vector<ReferenceEntry>& all, const std::string& name) {
  auto entries = find_entries(all, name);
  if (!entries.empty()) return entries;
  const auto near = nearest_names(all, name, 3);
  throw ConfigError(fmt::format("explain: nothing is called '{}'{}", name,
                                near.empty()
                                    ? std::string("; vantage list and --print-config say "
                                                  "what there is")
                                    : fmt::format("; near it: {}", fmt::join(near, ", "))));
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
  for (const std::string& name : arguments.names) {
    for (const ReferenceEntry& entry : found(all, name)) {
      json.push_back(entry_json(entry));
      text += entry_text(entry);
    }
  }
  fmt::print("{}", arguments.json ? json_text({{"entries", json}}) : text);
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_explain(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.add_option("names", arguments->names,
                 "keys (gain.a), gains, features ..., columns, files, exit codes");
  app.add_option("--pages", arguments->pages, "write the whole reference there, as Markdown");
  add_json(app, arguments->json);
  return [arguments] { return explain(*arguments); };
}

}  // namespace vantage
