/// Intrinsics as users keep them.
#pragma once

#include <array>
#include <filesystem>

namespace vantage {

struct Intrinsics {
  double focal_px = 0.0;  ///< mean of both axes
  std::array<double, 2> centre_px{};
};

/// `fx`, `fy`, `cx`, `cy` as keys of YAML or JSON; or a 3 x 3 matrix, or these four, as numbers.
/// @throws InputError naming the file if it is none of these or a number makes no sense.
Intrinsics read_intrinsics(const std::filesystem::path& file);

}  // namespace vantage
