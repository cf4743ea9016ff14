/// Which parts of a floor are worth a search over headings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vantage/belief/map/floor_map.hpp"

namespace vantage {

enum class Leeway : std::uint8_t {
  none,     ///< the robot's middle cannot be there, or has no reason to
  open,     ///< it can turn there
  passage,  ///< it may fit at some heading, on the way between open places
  nook,     ///< the same, and far from what is open: a place to go to
};

/// Connected parts of the cells with a flag, each in the order it is found.
/// @param flags of each cell of `floor`
/// @param neighbours that a cell is connected to, 4 or 8
std::vector<std::vector<std::size_t>> connected_parts(const FloorMap& floor,
                                                      std::span<const std::uint8_t> flags,
                                                      int neighbours);

/// Tells passages from the seam along every wall, where the robot fits at some heading too, but
/// which leads nowhere: seams from two open places meet in a passage, or a seam is so wide that
/// what is in it is far from any open place.
/// @param open, may_stand a flag per cell of `floor`; where both are set the cell is open
/// @param least_area_m2 of an open place or a nook, below which it is not worth going there
/// @param start_cell of a robot that stands in a passage
/// @return per cell; open cells always, the others only if there is a passage or a nook at all
std::vector<Leeway> find_narrow_places(const FloorMap& floor, std::span<const std::uint8_t> open,
                                       std::span<const std::uint8_t> may_stand,
                                       double least_area_m2,
                                       std::optional<std::size_t> start_cell = std::nullopt);

}  // namespace vantage
