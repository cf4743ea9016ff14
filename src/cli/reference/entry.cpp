#include "vantage/cli/reference/entry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "vantage/core/names.hpp"

namespace vantage {
namespace {

/// "whole number, default 10, [1, 10000]", of an entry or a key.
std::string facts(const auto& entry) {
  std::vector<std::string> parts;
  if (!entry.type.empty()) parts.push_back(entry.type);
  if (!entry.unit.empty()) parts.push_back(entry.unit);
  if (!entry.default_value.empty()) parts.push_back("default " + entry.default_value);
  if (!entry.range.empty()) parts.push_back(entry.range);
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// `text` in lines of at most 100 characters, each two spaces in.
std::string indented(std::string_view text) {
  std::string lines;
  for (const std::string_view line : wrapped(text, 98)) lines += fmt::format("  {}\n", line);
  return lines;
}

/// Of map.cells and map, or of the commands sweep run and sweep.
bool is_or_is_in(std::string_view name, std::string_view group) {
  if (!name.starts_with(group)) return false;
  return name.size() == group.size() || name[group.size()] == '.' || name[group.size()] == ' ';
}

std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

}  // namespace

std::vector<ReferenceEntry> entries_of(const std::vector<KeyDescription>& keys,
                                       const std::string& place) {
  std::vector<ReferenceEntry> entries;
  for (const KeyDescription& key : keys) {
    ReferenceEntry entry{
        .name = key.key,
        .place = place,
        .type = key.type,
        .unit = key.unit,
        .default_value = key.default_value,
        .range = key.range,
        .text = key.text,
    };
    for (const auto& owner : key.owners) {
      entry.applies.push_back(fmt::format("{}: {}", owner.key, owner.strategy));
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<ReferenceEntry> find_entries(const std::vector<ReferenceEntry>& all,
                                         std::string_view name) {
  std::vector<ReferenceEntry> found;
  const auto take = [&](auto&& wanted) {
    if (found.empty()) std::ranges::copy_if(all, std::back_inserter(found), wanted);
  };
  take([&](const ReferenceEntry& entry) { return entry.name == name; });
  take([&](const ReferenceEntry& entry) { return entry.name.ends_with("." + std::string(name)); });
  take([&](const ReferenceEntry& entry) { return entry.place == name; });
  if (names_beginning(all, name).size() == 1) {
    const std::string whole = names_beginning(all, name).front();
    take([&](const ReferenceEntry& entry) { return entry.name == whole; });
  }
  return found;
}

std::vector<std::string> names_beginning(const std::vector<ReferenceEntry>& all,
                                         std::string_view name) {
  std::vector<std::string> names;
  for (const ReferenceEntry& entry : all) {
    if (name.empty() || !entry.name.starts_with(name)) continue;
    const bool told = std::ranges::any_of(
        names, [&](const std::string& other) { return is_or_is_in(entry.name, other); });
    if (!told) names.push_back(entry.name);
  }
  return names;
}

void add_keys_below(std::vector<ReferenceEntry>& all) {
  for (ReferenceEntry& section : all) {
    if (!section.type.starts_with("section")) continue;
    for (const ReferenceEntry& entry : all) {
      if (entry.place != section.place || !entry.name.starts_with(section.name + ".")) continue;
      if (!section.applies.empty() && !entry.applies.empty() &&
          section.applies.front() != entry.applies.front()) {
        continue;  // of another task's section of the same name
      }
      if (std::ranges::find(section.keys_below, entry.name) == section.keys_below.end()) {
        section.keys_below.push_back(entry.name);
      }
    }
  }
}

std::vector<std::string> nearest_names(const std::vector<ReferenceEntry>& all,
                                       std::string_view name, std::size_t count) {
  std::vector<std::pair<std::size_t, std::string>> by_distance;
  for (const ReferenceEntry& entry : all) {
    const std::size_t distance =
        std::min(letters_off(name, entry.name), letters_off(name, last_part(entry.name)));
    by_distance.emplace_back(distance, entry.name);
  }
  std::ranges::sort(by_distance);
  std::vector<std::string> names;
  for (const auto& [distance, near] : by_distance) {
    if (names.size() == count || distance > std::max<std::size_t>(2, name.size() / 2)) break;
    if (std::ranges::find(names, near) == names.end()) names.push_back(near);
  }
  return names;
}

std::string entry_text(const ReferenceEntry& entry) {
  std::string text = fmt::format("{} ({})", entry.name, entry.place);
  if (const std::string known = facts(entry); !known.empty()) text += ": " + known;
  text += '\n';
  text += indented(entry.text);
  if (!entry.formula.empty()) text += indented(entry.formula);
  if (!entry.source.empty()) text += indented("[" + entry.source + "]");
  for (const KeyDescription& key : entry.parameters) {
    const std::string known = facts(key);
    text += indented(fmt::format("{}{}: {}", key.key,
                                 known.empty() ? "" : fmt::format(" ({})", known), key.text));
  }
  if (!entry.applies.empty()) {
    text += indented(fmt::format("with {}", fmt::join(entry.applies, ", ")));
  }
  if (!entry.keys_below.empty()) {
    text += indented(fmt::format("keys: {}", fmt::join(entry.keys_below, ", ")));
  }
  return text;
}

nlohmann::ordered_json entry_json(const ReferenceEntry& entry) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
  for (const KeyDescription& key : entry.parameters) {
    parameters.push_back({{"name", key.key},
                          {"type", key.type},
                          {"unit", key.unit},
                          {"default", key.default_value},
                          {"range", key.range},
                          {"text", key.text}});
  }
  return {{"name", entry.name},       {"place", entry.place},           {"type", entry.type},
          {"unit", entry.unit},       {"default", entry.default_value}, {"range", entry.range},
          {"text", entry.text},       {"formula", entry.formula},       {"source", entry.source},
          {"parameters", parameters}, {"applies", entry.applies},       {"keys", entry.keys_below}};
}

}  // namespace vantage
