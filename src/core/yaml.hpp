/// YAML in and out. Stricter than yaml-cpp: a duplicate key, an anchor or alias, a tag or a second
/// document is an error; what a scalar means is decided by the field that reads it, not by YAML.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/config_node.hpp"

namespace vantage {

/// @throws InputError if the file cannot be read, ConfigError with file and line if it is not
/// valid.
ConfigNode read_yaml(const std::filesystem::path& path);
/// `name` stands for the file in error messages.
ConfigNode parse_yaml(std::string_view text, const std::string& name);

/// What stands under the dotted `key`; null if nothing does.
const ConfigNode* find_value(const ConfigNode& root, std::string_view key);

/// A value for a dotted key, from wherever its origin says.
using KeyValue = std::pair<std::string, ConfigNode>;

/// "a.b.c=value" (the value is YAML).
/// @throws ConfigError if the assignment has no '=' or no key.
KeyValue parse_override(const std::string& assignment);

/// Puts each value under its key, replacing what is there; maps on the way are made as needed. The
/// order does not matter: what holds others comes before them, so `gain` before `gain.a`. A value
/// keeps its origin, and so do errors about it.
/// @throws ConfigError if `root` is not a map, or one key has two values.
void set_values(ConfigNode& root, std::vector<KeyValue> values);

/// The same of the command line's assignments.
void apply_overrides(ConfigNode& root, const std::vector<std::string>& assignments);

std::string to_yaml(const ConfigNode& root);

}  // namespace vantage
