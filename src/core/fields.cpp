#include "vantage/core/fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "vantage/core/names.hpp"

namespace vantage {

std::string unknown_strategy(std::string_view family, std::string_view name,
                             const std::vector<std::string_view>& known) {
  return fmt::format("unknown {} '{}'; {}known: {}", family, name, did_you_mean(name, known),
                     fmt::join(known, ", "));
}

std::string range_text(const Range& range) {
  if (std::isfinite(range.min) && std::isfinite(range.max)) {
    return fmt::format("{}{}, {}]", range.min_excluded ? "(" : "[", range.min, range.max);
  }
  if (std::isfinite(range.min)) {
    return fmt::format("{} {}", range.min_excluded ? ">" : ">=", range.min);
  }
  return std::isfinite(range.max) ? fmt::format("<= {}", range.max) : std::string();
}

namespace detail {
namespace {

[[noreturn]] void wrong_type(const ConfigNode& node, std::string_view expected) {
  const std::string got = node.kind == ConfigNode::Kind::scalar ? fmt::format("'{}'", node.scalar)
                                                                : std::string(kind_name(node.kind));
  throw ConfigError(fmt::format("{}: expected {}, got {}", node.where(), expected, got));
}

const std::string& scalar_of(const ConfigNode& node, std::string_view expected) {
  if (node.kind != ConfigNode::Kind::scalar) wrong_type(node, expected);
  return node.scalar;
}

/// Octal-looking numbers (010) mean different things to different YAML readers: not accepted.
bool has_leading_zero(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return text.size() > 1 && text[0] == '0' && text[1] >= '0' && text[1] <= '9';
}

template <class T>
T parse_number(const ConfigNode& node, std::string_view expected) {
  const std::string& text = scalar_of(node, expected);
  T value{};
  const auto* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (node.quoted || error != std::errc{} || stopped != end || has_leading_zero(text)) {
    wrong_type(node, expected);
  }
  return value;
}

/// The keys below `node` that were set by overrides and that `message` names.
void add_overrides(const ConfigNode& node, std::string_view message,
                   std::vector<std::string>& keys) {
  for (const auto& [name, child] : node.entries) {
    if (child.kind == ConfigNode::Kind::map) {
      add_overrides(child, message, keys);
    } else if (child.origin == kOverrideOrigin && message.find(name) != message.npos) {
      keys.push_back(child.key);
    }
  }
}

/// Text that every YAML reader gives back as the same text, without quotes.
bool is_plain_text(const std::string& text) {
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '/'; };
  if (text.empty() || !is_word(static_cast<unsigned char>(text.front()))) return false;
  if (text == "null" || text == "Null" || text == "NULL") return false;
  return std::ranges::all_of(text,
                             [&](unsigned char c) { return is_word(c) || c == '.' || c == '-'; });
}

}  // namespace

void read_value(const ConfigNode& node, double& target) {
  const auto value = parse_number<double>(node, "a number");
  if (!std::isfinite(value)) wrong_type(node, "a finite number");
  target = value;
}

void read_value(const ConfigNode& node, int& target) {
  target = parse_number<int>(node, "a whole number");
}

void read_value(const ConfigNode& node, std::uint64_t& target) {
  target = parse_number<std::uint64_t>(node, "a whole number >= 0");
}

void read_value(const ConfigNode& node, bool& target) {
  const std::string& text = scalar_of(node, "true or false");
  if (node.quoted || (text != "true" && text != "false")) wrong_type(node, "true or false");
  target = text == "true";
}

void read_value(const ConfigNode& node, std::string& target) { target = scalar_of(node, "text"); }

ConfigNode write_value(double value) { return ConfigNode::make_scalar(fmt::format("{}", value)); }
ConfigNode write_value(int value) { return ConfigNode::make_scalar(fmt::format("{}", value)); }
ConfigNode write_value(std::uint64_t value) {
  return ConfigNode::make_scalar(fmt::format("{}", value));
}
ConfigNode write_value(bool value) { return ConfigNode::make_scalar(value ? "true" : "false"); }
ConfigNode write_value(const std::string& value) {
  return ConfigNode::make_scalar(value, !is_plain_text(value));
}

void require_range(const std::string& where, double value, const Range& range) {
  const bool low = range.min_excluded ? value <= range.min : value < range.min;
  if (std::isfinite(value) && !low && value <= range.max) return;
  std::string allowed = range_text(range);
  if (allowed.empty()) allowed = "a finite number";
  throw ConfigError(fmt::format("{}: {} is out of range, allowed: {}", where, value, allowed));
}

void require_kind(const ConfigNode& node, ConfigNode::Kind kind) {
  if (node.kind != kind) wrong_type(node, kind_name(kind));
}

void require_size(const ConfigNode& node, std::size_t size) {
  if (node.kind != ConfigNode::Kind::list) wrong_type(node, fmt::format("a list of {}", size));
  if (node.items.size() == size) return;
  throw ConfigError(
      fmt::format("{}: expected a list of {}, got {}", node.where(), size, node.items.size()));
}

namespace {

/// "gain beer_lambert" of a map that names a strategy at that key; empty of another.
std::string strategy_text(const ConfigNode& node, const std::vector<std::string_view>& known) {
  const ConfigNode* name = node.find("name");
  const bool may = std::ranges::find(known, "name") != known.end();
  if (!may || name == nullptr || name->kind != ConfigNode::Kind::scalar) return {};
  return fmt::format("{} {}", node.key.substr(node.key.rfind('.') + 1), name->scalar);
}

}  // namespace

void reject_unknown(const ConfigNode& node, const std::vector<std::string_view>& known,
                    KeyOwners owners) {
  std::vector<std::string> problems;
  const std::string strategy = strategy_text(node, known);
  std::vector<std::string_view> own_keys = known;
  std::erase(own_keys, "name");
  const std::string own_text =
      own_keys.empty() ? "none" : fmt::format("{}", fmt::join(own_keys, ", "));
  for (const auto& [name, child] : node.entries) {
    if (std::ranges::find(known, name) != known.end()) continue;
    std::string message = strategy.empty()
                              ? fmt::format("{}: unknown key '{}'; {}known here: {}", child.where(),
                                            name, did_you_mean(name, known), fmt::join(known, ", "))
                              : fmt::format("{}: {} has no key '{}'; {}it has {}", child.where(),
                                            strategy, name, did_you_mean(name, own_keys), own_text);
    if (const auto names = owners == nullptr ? std::vector<std::string_view>{} : owners(name);
        !names.empty()) {
      message += fmt::format("; it belongs to {}", fmt::join(names, ", "));
    }
    problems.push_back(std::move(message));
  }
  if (!problems.empty()) throw ConfigError(problems);
}

std::string place_of(const ConfigNode& node, std::string_view message) {
  std::vector<std::string> keys;
  add_overrides(node, message, keys);
  std::string place = node.where();
  if (!keys.empty()) {
    place = fmt::format("{} {}", kOverrideOrigin, fmt::join(keys, ", "));
    if (!node.key.empty()) place += ": " + node.key;
  }
  return place.empty() ? place : place + ": ";
}

std::string strategy_name(const ConfigNode& node) {
  if (node.kind == ConfigNode::Kind::scalar) return node.scalar;
  if (node.kind != ConfigNode::Kind::map) wrong_type(node, "a name or a map with 'name'");
  const ConfigNode* name = node.find("name");
  if (name == nullptr) throw ConfigError(node.where() + ": missing key 'name'");
  return scalar_of(*name, "a name");
}

}  // namespace detail
}  // namespace vantage
