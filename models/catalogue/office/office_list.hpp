/// The offices that are checked in under models/scenes.
#pragma once

#include <vector>

#include "vantage/models/catalogue/office/office_scene.hpp"

namespace vantage {

/// office_{small,large}_{1..4}, which options are chosen on; _{a,b}_{1..4}, furnished afresh, and
/// _{c,d}_{1..4}, each with walls and furniture of its own, which results are reported on.
std::vector<OfficeOptions> office_scenes();
/// office_doors_1 and _80_1, which options are chosen on, and office_doors_{a,b}_1 and _80_a_1,
/// which results are reported on: doors of 0.85 m and 0.80 m.
std::vector<OfficeOptions> door_scenes();

}  // namespace vantage
