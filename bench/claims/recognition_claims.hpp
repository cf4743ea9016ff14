/// Claims about recognition, held against what `vantage evaluate` wrote.
#pragma once

#include <string>
#include <vector>

#include "bench/claims/claims.hpp"

namespace vantage::bench {

/// @param study summary.json of the study with simple features
std::vector<Finding> recognition_findings(const Json& study);

/// @param study summary.json of the study of changes
std::vector<Finding> change_findings(const Json& study);

/// @param kernel summary.json of the study with kernel descriptors
/// @param simple the same of simple features on the same objects
std::vector<Finding> kernel_findings(const Json& kernel, const Json& simple);

/// @param study summary.json of a study with unknown objects
/// @param which those were
std::vector<Finding> unknown_findings(const Json& study, const std::string& which);
/// @param study summary.json of a study with `reliability`
std::vector<Finding> reliability_findings(const Json& study);

}  // namespace vantage::bench
