/// Offices whose walls are drawn: each a building of its own.
#pragma once

#include <cstdint>

#include "vantage/models/catalogue/office/plans/floor_plan.hpp"

namespace vantage {

/// As small_office(), but for where the wall between the rooms, its door, the pillars and the
/// starts are.
FloorPlan drawn_small_office(std::uint64_t seed);
/// The same of large_office(), of whose walls and doors each is elsewhere; east may be west and
/// north south.
FloorPlan drawn_large_office(std::uint64_t seed);

}  // namespace vantage
