/// Point clouds as binary little-endian PLY files, as other programs read them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "vantage/perception/clouds/point_cloud.hpp"

namespace vantage {

using Rgb = std::array<std::uint8_t, 3>;

struct ColouredCloud {
  PointCloud cloud;
  std::vector<Rgb> rgb;  ///< empty or one per point
};

/// Vertices with float x y z, nx ny nz if the cloud has normals, uchar red green blue if `rgb` is
/// not empty (then one per point).
/// @throws OutputError; nothing is left under `path` then.
void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               const std::vector<Rgb>& rgb = {});

/// Reads files with one element, `vertex`, of scalar properties; those it does not know are
/// skipped.
/// @throws InputError naming the file and what is wrong with it.
ColouredCloud read_ply(const std::filesystem::path& path);

}  // namespace vantage
