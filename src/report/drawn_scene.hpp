/// The scene of a run as the page draws it: `scene.bin`.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace vantage {

/// Coloured triangles. Those of an outer wall or the ceiling are apart from the others: they are
/// left out as long as the eye is beyond that side of the extent.
struct DrawnScene {
  static constexpr std::size_t kParts = 6;  ///< always drawn; -x, +x, -y, +y, above
  using Triangle = std::array<std::uint32_t, 3>;

  Eigen::AlignedBox3f extent_m;  ///< world
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< rgb, one a vertex
  std::array<std::vector<Triangle>, kParts> triangles;
};

/// Little-endian: "VTGSCN01", extent (6 x f32), vertices (u64), triangles of each part (6 x u64),
/// then per vertex x, y, z (f32), red, green, blue, 0 (u8), then the triangles (3 x u32).
/// @throws OutputError
void write_drawn_scene(const std::filesystem::path& path, const DrawnScene& scene);
/// @throws InputError naming the file if it is missing, truncated or not of this format.
DrawnScene read_drawn_scene(const std::filesystem::path& path);

}  // namespace vantage
