#include "src/episode/validate.hpp"

#include <fmt/format.h>

#include <functional>

#include "sim/ray_scene.hpp"
#include "sim/world.hpp"
#include "src/belief/octomap_io.hpp"
#include "src/core/atomic_file.hpp"
#include "src/core/error.hpp"
#include "src/episode/scenario.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Problems = std::vector<std::string>;

const GeomFilter kWithoutRobot{.exclude_body_prefix = "robot/", .max_group = 5};

Problems episode_problems(const fs::path& file, const std::vector<std::string>& overrides) {
  const ResolvedEpisode resolved = load_episode(file, overrides);
  const World world({resolved.scene, resolved.robot}, resolved.episode.simulation);
  if (has_table(world, resolved.episode)) return {};
  return {fmt::format("{}: scene: {}: no table in the region round map.centre_m", file.string(),
                      resolved.scene.string())};
}

Problems validate_scene(const fs::path& file) {
  const World world({file, {}}, {});
  return {};
}

Problems validate_map(const fs::path& file) {
  const OctomapContent content = read_octomap(file);
  if (content.occupied + content.free == 0) return {file.string() + ": the map holds no cells"};
  return {};
}

Validation collect(const std::function<Problems()>& check) {
  try {
    Problems problems = check();
    const ExitCode code = problems.empty() ? ExitCode::done : ExitCode::bad_input;
    return {std::move(problems), code};
  } catch (const ConfigError& error) {
    return {error.problems(), error.code()};
  } catch (const Error& error) {
    return {{error.what()}, error.code()};
  }
}

}  // namespace

bool has_table(const World& world, const Episode& episode) {
  const RayScene geometry(world.model(), world.snapshot(), kWithoutRobot);
  const Eigen::AlignedBox3d region = episode.grid_frame().box();
  for (int i = 0; i < 25; ++i) {
    const Eigen::Array3d share(0.1 + 0.2 * (i % 5), 0.1 + 0.2 * (i / 5), 1.0);
    const Eigen::Vector3d p_above = region.min().array() + share * region.sizes().array();
    const RayHit hit = geometry.cast(p_above, -Eigen::Vector3d::UnitZ(), p_above.z());
    if (p_above.z() - hit.distance_m >= episode.table.min_height_m) return true;
  }
  return false;
}

Validation validate_episode(const fs::path& file, const std::vector<std::string>& overrides) {
  return collect([&] { return episode_problems(file, overrides); });
}

Validation validate_file(const fs::path& file) {
  return collect([&]() -> Problems {
    const std::string type = file.extension().string();
    std::error_code error;
    if (!fs::exists(file, error)) return {file.string() + ": no such file"};
    if (type == ".yaml" || type == ".yml") return episode_problems(file, {});
    if (type == ".xml" || type == ".mjcf") return validate_scene(file);
    if (type == ".bt" || type == ".ot") return validate_map(file);
    return {fmt::format("{}: unknown kind of file '{}'; known: .yaml, .xml, .bt, .ot",
                        file.string(), type)};
  });
}

}  // namespace vantage
