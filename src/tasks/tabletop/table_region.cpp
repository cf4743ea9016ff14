#include "vantage/tasks/tabletop/table_region.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

double in_millimetres(double length_m) { return std::round(1e3 * length_m) / 1e3; }

/// Cells as large as the default's, but no more of them than these.
std::array<int, 3> cells_for(const std::array<double, 3>& size_m) {
  constexpr double kMaxCells = 4194304.0;
  std::array<double, 3> wanted{};
  double count = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    wanted[i] = size_m[i] * MapOptions::kCells[i] / MapOptions::kSize_m[i];
    count *= wanted[i];
  }
  const double coarser = std::cbrt(std::max(1.0, count / kMaxCells));
  std::array<int, 3> cells{};
  for (std::size_t i = 0; i < 3; ++i) {
    cells[i] = std::max(1, static_cast<int>(std::lround(wanted[i] / coarser)));
  }
  return cells;
}

std::optional<LevelSurface> read_table(const fs::path& scene, const LevelSurfaceOptions& options) {
  const World world(ModelSource{.scene = scene, .robot = {}});
  return table_among(level_surfaces(world.model(), world.snapshot(), options));
}

}  // namespace

LevelSurfaceOptions table_surfaces(const TableOptions& options) {
  return {.min_height_m = options.min_height_m,
          .max_height_m = options.max_height_m,
          .max_tilt_rad = options.max_tilt_rad,
          .min_area_m2 = options.min_area_m2};
}

std::string no_table_text(const mjModel& model, const mjData& data, const TableOptions& options) {
  const auto near = nearest_to_level(model, data, table_surfaces(options));
  if (!near) {
    return fmt::format(
        "no table: no level surface of {} m^2 between table.min_height_m {} and "
        "table.max_height_m {}",
        options.min_area_m2, options.min_height_m, options.max_height_m);
  }
  std::vector<std::string> faults;
  if (near->height_m < options.min_height_m) {
    faults.push_back(fmt::format("below table.min_height_m {}", options.min_height_m));
  }
  if (near->height_m > options.max_height_m) {
    faults.push_back(fmt::format("above table.max_height_m {}", options.max_height_m));
  }
  if (near->tilt_rad > options.max_tilt_rad) {
    faults.push_back(fmt::format("tilted by {:.3f} rad, more than table.max_tilt_rad {}",
                                 near->tilt_rad, options.max_tilt_rad));
  }
  if (near->area_m2 < options.min_area_m2) {
    faults.push_back(fmt::format("smaller than table.min_area_m2 {}", options.min_area_m2));
  }
  return fmt::format(
      "no table: the nearest to one, '{}' of {:.3g} m^2 at a height of {:.3f} m, is {}", near->name,
      near->area_m2, near->height_m, fmt::join(faults, " and "));
}

std::optional<LevelSurface> table_among(const std::vector<LevelSurface>& surfaces) {
  if (surfaces.empty()) return std::nullopt;
  const auto over_origin = std::ranges::find_if(surfaces, [](const LevelSurface& surface) {
    return surface.extent_m.contains(Eigen::Vector2d(0.0, 0.0));
  });
  return over_origin == surfaces.end() ? surfaces.front() : *over_origin;
}

std::optional<LevelSurface> scene_table(const fs::path& scene, const TableOptions& options) {
  using Key = std::tuple<std::string, fs::file_time_type, double, double, double, double>;
  static std::mutex mutex;
  static std::map<Key, std::optional<LevelSurface>> known;
  const LevelSurfaceOptions wanted = table_surfaces(options);
  std::error_code error;
  const Key key{scene.string(),      fs::last_write_time(scene, error),
                wanted.min_height_m, wanted.max_height_m,
                wanted.max_tilt_rad, wanted.min_area_m2};
  const std::scoped_lock lock(mutex);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known.emplace(key, read_table(scene, wanted)).first->second;
}

void follow_table(MapOptions& map, const LevelSurface& table) {
  const bool follows = !map.centre_m.has_value();
  const Eigen::Vector2d extent_m = table.extent_m.sizes();
  if (follows && !map.size_m) {
    map.size_m = {in_millimetres(extent_m.x()), in_millimetres(extent_m.y()),
                  MapOptions::kSize_m[2]};
    if (!map.cells) map.cells = cells_for(*map.size_m);
  }
  if (follows) {
    const Eigen::Vector2d middle_m = table.extent_m.center();
    map.centre_m = {in_millimetres(middle_m.x()), in_millimetres(middle_m.y()),
                    in_millimetres(table.height_m + kAboveTable_m + 0.5 * map.size().z())};
  }
  map.fill_in();
}

}  // namespace vantage
