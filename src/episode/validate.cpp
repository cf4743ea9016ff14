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

Problems validate_episode(const fs::path& file) {
  const ResolvedEpisode resolved = load_episode(file, {});
  Problems problems = validate_file(resolved.scene);
  try {
    const World world({resolved.scene, resolved.robot}, resolved.episode.simulation);
  } catch (const Error& error) {
    if (problems.empty()) problems.emplace_back(error.what());
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

bool is_configuration(const fs::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

Problems validate_file(const fs::path& file) {
  const std::string type = file.extension().string();
  try {
    if (!fs::exists(file)) return {file.string() + ": no such file"};
    if (is_configuration(file)) return validate_episode(file);
    if (type == ".xml" || type == ".mjcf") return validate_scene(file);
    if (type == ".bt" || type == ".ot") return validate_map(file);
  } catch (const ConfigError& error) {
    return error.problems();
  } catch (const Error& error) {
    return {error.what()};
  }
  return {fmt::format("{}: unknown kind of file '{}'; known: .yaml, .xml, .bt, .ot", file.string(),
                      type)};
}

}  // namespace vantage
