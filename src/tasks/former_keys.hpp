/// Keys that episodes of older versions have: an error says what to write instead.
#pragma once

#include "vantage/core/config_node.hpp"

namespace vantage {

/// @throws ConfigError naming every former key in `root`, where it is, and what is written now.
void reject_former_keys(const ConfigNode& root);

}  // namespace vantage
