/// What values of a study's file mean that an episode's do not have: seeds, and files that are
/// found from the study's folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vantage/core/config_node.hpp"

namespace vantage {

/// `1..20`, or a list of whole numbers.
/// @throws ConfigError naming file, line, key and value
std::vector<std::uint64_t> read_seeds(const ConfigNode& node);

/// Files that `overrides` name are found as an episode's own are, from `base`, the working
/// directory or the data root, and named so that they are found again from any directory. A model
/// that is not there yet keeps its name: it is missed where it is needed.
/// @param overrides keys as those of --set, or maps of keys
/// @throws InputError naming the first file that is missing
void settle_files(ConfigNode& overrides, const std::filesystem::path& base);

}  // namespace vantage
