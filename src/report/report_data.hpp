/// The files of a run folder that the report reads, as values; and `voxels.bin`, which only the
/// report needs.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

/// A cell of the map: its centre in the world and the scan (0 = first) since which it is occupied.
struct VoxelRecord {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  std::uint16_t step = 0;
  std::uint8_t kind = 0;  ///< 0 occupied, 1 unobserved at the end (`step` means nothing then)
};
inline constexpr std::uint8_t kVoxelOccupied = 0;
inline constexpr std::uint8_t kVoxelUnobserved = 1;

struct VoxelMap {
  Eigen::Vector3d cell_size_m = Eigen::Vector3d::Ones();
  Eigen::AlignedBox3d box_m;  ///< of the grid, world
  std::vector<VoxelRecord> voxels;
};

/// `voxels.bin`, little-endian: "VTGVOX01", cell size (3 x f64), box minimum and maximum (6 x f64),
/// count (u64), then per voxel x, y, z (f32), step (u16), kind (u8), 0 (u8).
/// @throws OutputError
void write_voxels(const std::filesystem::path& path, const VoxelMap& map);
/// @throws InputError naming the file if it is missing, truncated or not of this format.
VoxelMap read_voxels(const std::filesystem::path& path);

/// A voxel as the page holds it: cell indices, and the step with the kind in its highest bit.
struct PackedVoxel {
  std::array<std::uint16_t, 3> cell{};
  std::uint16_t step_and_kind = 0;
};
struct PackedVoxels {
  Eigen::Array3i cells = Eigen::Array3i::Zero();  ///< of the grid
  std::array<std::size_t, 2> total{};             ///< per kind, in the file
  std::array<std::size_t, 2> surface{};           ///< per kind, ever visible from outside
  std::array<std::size_t, 2> kept{};              ///< per kind, in `voxels`
  std::vector<PackedVoxel> voxels;                ///< occupied first, in order of their step
};
/// What a viewer needs of `map`: cells that are hidden at every step are dropped, which changes
/// nothing to see; above `limit` every n-th of the rest is left out, unobserved cells before
/// occupied ones. Deterministic.
PackedVoxels pack_voxels(const VoxelMap& map, std::size_t limit);

/// One line of a `.tum` file: time, and pose of the body in the world with the heading of its x
/// axis.
struct TrajectorySample {
  double time_s = 0.0;
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  Eigen::Quaterniond q_world_body = Eigen::Quaterniond::Identity();
};
/// @throws InputError naming file and line.
std::vector<TrajectorySample> read_tum(const std::filesystem::path& path);

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`
};
/// Comma-separated, first line the header, quotes as in RFC 4180 but no line breaks inside them.
/// @throws InputError naming file and line.
CsvTable read_csv(const std::filesystem::path& path);
/// A field as read_csv() takes it: in quotes where it has a comma or a quote, line breaks as
/// spaces.
std::string csv_field(std::string_view text);

std::string base64(std::string_view bytes);

}  // namespace vantage
