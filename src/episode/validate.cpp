#include "src/episode/validate.hpp"

#include <fmt/format.h>

#include <functional>

#include "sim/world.hpp"
#include "src/belief/octomap_io.hpp"
#include "src/core/atomic_file.hpp"
#include "src/core/error.hpp"
#include "src/episode/tabletop_rig.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Problems = std::vector<std::string>;

Problems episode_problems(const fs::path& file, const std::vector<std::string>& overrides) {
  const ResolvedEpisode resolved = load_episode(file, overrides);
  try {
    const TabletopRig rig(resolved);
    return {};
  } catch (const ConfigError& error) {
    throw ConfigError(file.string() + ": " + error.what());
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
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
