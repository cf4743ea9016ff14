#include "src/episode/validate.hpp"

#include <fmt/format.h>

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

/// Whether anything in the region of interest is as high as a table: rays from above, 5 x 5.
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

Problems validate_episode(const fs::path& file) {
  const ResolvedEpisode resolved = load_episode(file, {});
  Problems problems = validate_file(resolved.scene).problems;
  if (!problems.empty()) return problems;
  const World world({resolved.scene, resolved.robot}, resolved.episode.simulation);
  if (!has_table(world, resolved.episode)) {
    problems.push_back(fmt::format("{}: scene: {}: no table in the region round map.centre_m",
                                   file.string(), resolved.scene.string()));
  }
  return problems;
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

}  // namespace

Validation validate_file(const fs::path& file) {
  const std::string type = file.extension().string();
  const auto checked = [](Problems problems) {
    const ExitCode code = problems.empty() ? ExitCode::done : ExitCode::bad_input;
    return Validation{std::move(problems), code};
  };
  try {
    if (!fs::exists(file)) return checked({file.string() + ": no such file"});
    if (type == ".yaml" || type == ".yml") return checked(validate_episode(file));
    if (type == ".xml" || type == ".mjcf") return checked(validate_scene(file));
    if (type == ".bt" || type == ".ot") return checked(validate_map(file));
  } catch (const ConfigError& error) {
    return {error.problems(), error.code()};
  } catch (const Error& error) {
    return {{error.what()}, error.code()};
  }
  return checked({fmt::format("{}: unknown kind of file '{}'; known: .yaml, .xml, .bt, .ot",
                              file.string(), type)});
}

}  // namespace vantage
