#include "vantage/cli/reference/pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using Entries = std::vector<ReferenceEntry>;

constexpr std::string_view kMadeBy =
    "Written by `vantage explain --pages docs/reference`; a test holds it against the code. On a "
    "terminal: `vantage explain NAME`.\n";

std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    if (c == '<') {
      escaped += "&lt;";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string code(const std::string& text) { return text.empty() ? "" : fmt::format("`{}`", text); }

std::string with_unit(const ReferenceEntry& entry) {
  if (entry.unit.empty()) return entry.type;
  return entry.type.empty() ? entry.unit : fmt::format("{}, {}", entry.type, entry.unit);
}

std::string key_row(const ReferenceEntry& entry) {
  std::string text = entry.text;
  if (!entry.applies.empty()) text += fmt::format(" ({})", fmt::join(entry.applies, ", "));
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", entry.name, cell(with_unit(entry)),
                     code(cell(entry.default_value)), cell(entry.range), cell(text));
}

std::string first_part(const std::string& name) { return name.substr(0, name.find('.')); }

/// One table for what stands at the top, one for each section.
std::string key_tables(const Entries& entries) {
  constexpr std::string_view kHead =
      "\n| key | type | default | range | |\n|---|---|---|---|---|\n";
  std::string top(kHead);
  std::string sections;
  std::string open;
  for (const ReferenceEntry& entry : entries) {
    const std::string first = first_part(entry.name);
    if (first == entry.name) {
      top += key_row(entry);
      continue;
    }
    if (first != open) sections += fmt::format("\n### {}\n{}", first, kHead);
    open = first;
    sections += key_row(entry);
  }
  return top + sections;
}

std::string strategy_text(const ReferenceEntry& entry) {
  std::string text = fmt::format("\n### {}\n\n{}\n", entry.name, cell(entry.text));
  if (!entry.formula.empty()) text += fmt::format("\n`{}`\n", entry.formula);
  std::vector<std::string> facts;
  if (!entry.unit.empty()) facts.push_back("Unit: " + entry.unit + ".");
  if (!entry.source.empty()) facts.push_back("Source: [" + entry.source + "].");
  if (!facts.empty()) text += fmt::format("\n{}\n", fmt::join(facts, " "));
  if (entry.parameters.empty()) return text;
  text += "\n| key | type | default | range | |\n|---|---|---|---|---|\n";
  for (const KeyDescription& key : entry.parameters) {
    text += key_row(entries_of({key}, entry.place).front());
  }
  return text;
}

std::string record_table(const Entries& entries) {
  std::string text = "\n| name | unit | |\n|---|---|---|\n";
  for (const ReferenceEntry& entry : entries) {
    std::string meaning = entry.text;
    if (!entry.applies.empty()) meaning += fmt::format(" ({})", fmt::join(entry.applies, ", "));
    text += fmt::format("| `{}` | {} | {} |\n", entry.name, cell(with_unit(entry)), cell(meaning));
  }
  return text;
}

/// A heading for each place, in order, and under it what `body` makes of its entries.
std::string by_place(const Entries& entries,
                     const std::function<std::string(const Entries&)>& body) {
  std::vector<std::string> places;
  for (const ReferenceEntry& entry : entries) {
    if (std::ranges::find(places, entry.place) == places.end()) places.push_back(entry.place);
  }
  std::string text;
  for (const std::string& place : places) {
    Entries there;
    std::ranges::copy_if(entries, std::back_inserter(there),
                         [&](const ReferenceEntry& entry) { return entry.place == place; });
    text += fmt::format("\n## {}\n{}", place, body(there));
  }
  return text;
}

std::string strategy_texts(const Entries& entries) {
  std::string text;
  for (const ReferenceEntry& entry : entries) text += strategy_text(entry);
  return text;
}

}  // namespace

void write_reference_pages(const std::vector<ReferenceEntry>& keys,
                           const std::filesystem::path& directory) {
  make_writable_directory(directory);
  const auto write = [&](const char* name, std::string_view title, const std::string& body) {
    write_file(directory / name, fmt::format("# {}\n\n{}{}", title, kMadeBy, body));
  };
  write("keys.md", "Keys", by_place(keys, key_tables));
  write("strategies.md", "Strategies", by_place(strategy_entries(), strategy_texts));
  write("files.md", "Files, columns, exit codes", by_place(record_entries(), record_table));
}

}  // namespace vantage
