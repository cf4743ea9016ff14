/// YAML in and out. Stricter than yaml-cpp: a duplicate key, an anchor or alias, a tag or a second
/// document is an error; what a scalar means is decided by the field that reads it, not by YAML.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/config_node.hpp"

namespace vantage {

/// @throws InputError if the file cannot be read, ConfigError with file and line if it is not
/// valid.
ConfigNode read_yaml(const std::filesystem::path& path);
/// `name` stands for the file in error messages.
ConfigNode parse_yaml(std::string_view text, const std::string& name);

/// Applies "a.b.c=value" (the value is YAML) on top of `root`; maps on the way are made as needed.
/// @throws ConfigError if the assignment has no '=' or no key, or `root` is not a map.
void apply_override(ConfigNode& root, const std::string& assignment);

/// Puts `value` under the dotted `key`, replacing what is there; maps on the way are made as
/// needed. The value keeps its origin, and so do errors about it.
/// @throws ConfigError if `root` is not a map.
void set_value(ConfigNode& root, const std::string& key, ConfigNode value);

std::string to_yaml(const ConfigNode& root);

}  // namespace vantage
