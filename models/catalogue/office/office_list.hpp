/// The offices that are checked in under models/scenes.
#pragma once

#include <vector>

#include "vantage/models/catalogue/office/office_scene.hpp"

namespace vantage {

/// office_{small,large}_{1..4}, which options are chosen on; _b_{1..4}, furnished afresh; _e_{1..4}
/// and _f_{1..4}, each with walls and furniture of its own, which results are reported on.
std::vector<OfficeOptions> office_scenes();
/// Doors of 0.85 m and, in _80, of 0.80 m: office_doors_1, _80_1 and _80_a_1, which options are
/// chosen on, and office_doors_{e,f}_1 and _80_c_1, which results are reported on.
std::vector<OfficeOptions> door_scenes();

}  // namespace vantage
