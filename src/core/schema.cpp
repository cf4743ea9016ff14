#include "vantage/core/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <sstream>

#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

struct UnitSuffix {
  std::string_view suffix;
  std::string_view unit;
};

/// Longest first where one ends another.
constexpr auto kUnits = std::to_array<UnitSuffix>({
    {"_m_per_m", "m/m"},  {"_rad_per_m", "rad/m"},
    {"_per_s2", "1/s^2"}, {"_rad_s2", "rad/s^2"},
    {"_rad_s", "rad/s"},  {"_m_s2", "m/s^2"},
    {"_m_s", "m/s"},      {"_per_m", "1/m"},
    {"_per_s", "1/s"},    {"_per_j", "1/J"},
    {"_kg_m2", "kg m^2"}, {"_m3", "m^3"},
    {"_m2", "m^2"},       {"_rad", "rad"},
    {"_deg", "deg"},      {"_m", "m"},
    {"_ms", "ms"},        {"_s", "s"},
    {"_hz", "Hz"},        {"_px", "px"},
    {"_bits", "bits"},    {"_nats", "nats"},
    {"_kg", "kg"},        {"_nm", "N m"},
    {"_n", "N"},          {"_j", "J"},
    {"_w", "W"},          {"_mb", "MB"},
});

/// Whether `root` chose every strategy that has the key.
bool belongs(const KeyDescription& key, const ConfigNode& root) {
  return std::ranges::all_of(key.owners, [&](const KeyDescription::Owner& owner) {
    const ConfigNode* node = find_value(root, owner.key);
    if (node != nullptr && node->kind == ConfigNode::Kind::map) node = node->find("name");
    return node != nullptr && node->scalar == owner.strategy;
  });
}

std::string comment_of(const KeyDescription& key) {
  std::vector<std::string> facts;
  for (const std::string* fact : {&key.unit, &key.range}) {
    if (!fact->empty()) facts.push_back(*fact);
  }
  if (key.type.starts_with("one of ")) facts.push_back(key.type);
  return facts.empty() ? key.text : fmt::format("{} ({})", key.text, fmt::join(facts, ", "));
}

/// Follows which key a line of block YAML sets.
class KeyOfLine {
 public:
  /// Empty: none, or one inside a list.
  std::string operator()(std::string_view line) {
    const auto indent = line.find_first_not_of(" -");
    const auto colon = line.find(':');
    if (indent == line.npos || colon == line.npos || colon < indent) return {};
    while (!open_.empty() && open_.back().indent >= indent) open_.pop_back();
    open_.push_back({indent, std::string(line.substr(indent, colon - indent))});
    if (list_indent_ != kNone && indent < list_indent_) list_indent_ = kNone;
    if (line.substr(0, indent).find('-') != line.npos) list_indent_ = indent;
    if (list_indent_ != kNone) return {};
    std::vector<std::string_view> names;
    for (const Open& open : open_) names.emplace_back(open.name);
    return fmt::format("{}", fmt::join(names, "."));
  }

 private:
  struct Open {
    std::size_t indent;
    std::string name;
  };
  std::vector<Open> open_;
  static constexpr std::size_t kNone = std::string_view::npos;
  std::size_t list_indent_ = kNone;  ///< of the keys of the list that the line is in
};

/// `text` in comment lines of at most 100 characters.
std::string comment_lines(std::string_view text, std::size_t indent) {
  const std::string front = std::string(indent, ' ') + "# ";
  std::string lines;
  for (std::string_view line : wrapped(text, 100 - std::min<std::size_t>(indent + 2, 60))) {
    lines += fmt::format("{}{}\n", front, line);
  }
  return lines;
}

}  // namespace

std::vector<std::string_view> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    std::size_t end = text.size();
    if (end > width) {
      end = text.rfind(' ', width);
      if (end == text.npos) end = std::min(text.find(' '), text.size());
    }
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string commented_yaml(const ConfigNode& root, const std::vector<KeyDescription>& keys) {
  std::istringstream lines(to_yaml(root));
  std::string text;
  KeyOfLine key_of;
  for (std::string line; std::getline(lines, line);) {
    const std::string path = key_of(line);
    const auto key = std::ranges::find_if(keys, [&](const KeyDescription& candidate) {
      return candidate.key == path && belongs(candidate, root);
    });
    if (!path.empty() && key != keys.end()) {
      text += comment_lines(comment_of(*key), line.find_first_not_of(' '));
    }
    text += line + '\n';
  }
  return text;
}

std::string unit_in_name(std::string_view name) {
  for (const auto& [suffix, unit] : kUnits) {
    if (name.size() > suffix.size() && name.ends_with(suffix)) return std::string(unit);
  }
  return {};
}

namespace detail {

std::string value_text(const ConfigNode& node) {
  std::vector<std::string> parts;
  switch (node.kind) {
    case ConfigNode::Kind::null: return "null";
    case ConfigNode::Kind::scalar: return node.quoted ? '"' + node.scalar + '"' : node.scalar;
    case ConfigNode::Kind::list:
      for (const ConfigNode& item : node.items) parts.push_back(value_text(item));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    case ConfigNode::Kind::map: break;
  }
  const ConfigNode* name = node.find("name");
  if (name != nullptr && node.entries.size() == 1) return value_text(*name);
  for (const auto& [key, value] : node.entries) {
    parts.push_back(fmt::format("{}: {}", key, value_text(value)));
  }
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

std::string list_type(std::string_view element, std::size_t size) {
  const bool plural = element == "number" || element == "whole number";
  const std::string of = fmt::format("{}{}", element, plural ? "s" : "");
  return size == 0 ? fmt::format("list of {}", of) : fmt::format("list of {} {}", size, of);
}

std::string choice_type(const std::vector<std::string_view>& names) {
  return fmt::format("one of {}", fmt::join(names, ", "));
}

}  // namespace detail
}  // namespace vantage
