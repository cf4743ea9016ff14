/// Which levels of a study are run, and which of them go by one name.
#pragma once

#include <string>
#include <vector>

#include "vantage/core/config_node.hpp"
#include "vantage/study/kit/problems.hpp"
#include "vantage/study/study.hpp"

namespace vantage {

/// Leaves the levels of the split: the one named `wanted`, else that of the key `split`, else the
/// first of the file; all levels where the file has none. The split that was taken is noted in
/// `study` and as the key `split`, so that the file can be read again.
void take_split(ConfigNode& root, const std::string& wanted, Study& study, Problems& problems);

/// The key `draws` is one that some level, or every episode, sets to a number.
void require_drawn(const ConfigNode& root, const Study& study, Problems& problems);

/// Reads `report.groups`. @return `root` without them
ConfigNode take_groups(const ConfigNode& root, std::vector<LevelGroup>& groups, Problems& problems);

/// Each group is of levels of one factor, each level of one group at most.
void check_groups(const ConfigNode& root, const Study& study, Problems& problems);

}  // namespace vantage
