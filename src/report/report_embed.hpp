/// Files of a run folder as the page embeds them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace vantage {

/// [[t, x, y, z, yaw], ...], thinned evenly, the last sample always kept.
nlohmann::json trajectory_json(const std::filesystem::path& path);
/// Cell indices and steps as base64 of little-endian u16 quadruples.
nlohmann::json voxels_json(const std::filesystem::path& path);
/// Every n-th point, n such that there are not too many, quantised to 16 bits inside their box.
nlohmann::json cloud_json(const std::filesystem::path& path);
/// Positions of 16 bits inside their box, colours, and the triangles of all parts in a row.
nlohmann::json scene_json(const std::filesystem::path& path);
/// The first or the last image of `frames/` by number, as a data URI; null if there is none.
nlohmann::json frame_of(const std::filesystem::path& folder, bool first);

}  // namespace vantage
