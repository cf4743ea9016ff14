/// Readings of sensors that may fail: which of them say anything. Nothing else goes into a belief.
#pragma once

#include <cstddef>
#include <span>

#include "vantage/geometry/range_scan.hpp"

namespace vantage {

/// Makes readings that say nothing say so: those that are not numbers, not above 0, or at the end
/// of the range, where a sensor saturates: one that finds no surface there says infinity. @return
/// how many there were
std::size_t discard_unusable(CameraImages& images);  ///< to 0
std::size_t discard_unusable(RangeScan& scan);       ///< to NaN
std::size_t discard_unusable(PlanarScan& scan);      ///< to NaN

/// Whether an image has the depth of the one before, to the bit, and there is some: no sensor with
/// noise measures twice the same, so this one is stale.
bool is_repeated(const CameraImages& before, const CameraImages& now);

/// Makes lines invalid that repeat the line before, likewise; lost ones, all NaN, are no lines.
/// @return how many there were
/// @param last the last line that was not lost of the scan before, as it came, then of this one;
/// empty: there is none
std::size_t discard_repeated_lines(RangeScan& scan, std::vector<float>& last);

/// Share of the lines with at least one valid beam, no return being one; 0 without lines.
double share_of_valid_lines(const RangeScan& scan);

}  // namespace vantage
