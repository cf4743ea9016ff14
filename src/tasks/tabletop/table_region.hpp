/// The region of interest follows the table of the scene, before anything runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/perception/table_extraction.hpp"
#include "vantage/sim/world/level_surfaces.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {

/// Of the surfaces that may be a table, the largest first: the one over the world's origin, or if
/// there is none the largest.
std::optional<LevelSurface> table_among(const std::vector<LevelSurface>& surfaces);

/// What is as high and large as the options want a table to be.
LevelSurfaceOptions table_surfaces(const TableOptions& options);

/// "no table: ...": which surface comes nearest to one, and the key that it fails by.
std::string no_table_text(const mjModel& model, const mjData& data, const TableOptions& options);

/// The table of a scene as its file has it; read once as long as the file stays the same.
/// @throws InputError if MuJoCo does not load the scene.
std::optional<LevelSurface> scene_table(const std::filesystem::path& scene,
                                        const TableOptions& options);

/// The lower face of the map lies that far over the table top, so that noise on it is no clutter.
inline constexpr double kAboveTable_m = 0.01;

/// Fills in what `map` leaves open: the centre over the table's, its lower face kAboveTable_m above
/// the top; the table's extent; cells as large as those of the default. In whole millimetres.
void follow_table(MapOptions& map, const LevelSurface& table);

}  // namespace vantage
