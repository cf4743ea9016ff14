#include "vantage/runtime/manifest.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include <algorithm>
#include <fstream>
#include <set>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string renderer_text() {
  try {
    return renderer_name();
  } catch (const RendererError& error) {
    return std::string("none: ") + error.what();
  }
}

/// The texts of every attribute of that name, name="text", in an XML file.
std::vector<std::string> attributes(const std::string& xml, const std::string& name) {
  std::vector<std::string> found;
  for (const char quote : {'"', '\''}) {
    const std::string opening = name + "=" + quote;
    for (auto at = xml.find(opening); at != std::string::npos; at = xml.find(opening, at + 1)) {
      const auto begin = at + opening.size();
      found.push_back(xml.substr(begin, xml.find(quote, begin) - begin));
    }
  }
  return found;
}

void collect_files(const fs::path& file, std::set<fs::path>& found) {
  if (!fs::is_regular_file(file) || !found.insert(file).second) return;
  if (file.extension() != ".xml") return;
  const std::string xml = read_file(file);
  std::vector<std::string> folders = {""};
  for (const char* kind : {"meshdir", "texturedir", "assetdir"}) {
    for (auto& folder : attributes(xml, kind)) folders.push_back(std::move(folder));
  }
  for (const std::string& name : attributes(xml, "file")) {
    for (const std::string& folder : folders) {
      collect_files((file.parent_path() / folder / name).lexically_normal(), found);
    }
  }
}

}  // namespace

std::string version_text() { return VANTAGE_VERSION " (" VANTAGE_GIT_COMMIT ")"; }

std::vector<fs::path> scene_files(const fs::path& scene) {
  std::set<fs::path> found;
  collect_files(scene.lexically_normal(), found);
  return {found.begin(), found.end()};
}

std::map<std::string, std::string> asset_hashes(const EpisodeSetup& setup,
                                                const std::vector<InputFile>& inputs) {
  std::map<std::string, std::string> hashes;
  for (const fs::path& root : {setup.scene, setup.robot.mjcf, setup.robot.description}) {
    const fs::path folder = fs::absolute(root).parent_path();
    for (const fs::path& file : scene_files(root)) {
      hashes[fs::relative(file, folder).string()] = hash_text(hash_file(file));
    }
  }
  for (const InputFile& input : inputs) {
    if (fs::exists(input.path)) hashes[input.key] = hash_text(hash_file(input.path));
  }
  return hashes;
}

std::string manifest_json(const RunRequest& request, const RunSummary& summary) {
  const EpisodeSetup& setup = request.setup;
  Json json = {
      {"command", request.options.command},
      {"versions",
       {{"vantage", version_text()},
        {"mujoco", mujoco_version()},
        {"renderer", renderer_text()},
        {"opencv", CV_VERSION},
        {"compiler", "g++ " __VERSION__}}},
      {"cpu", cpu_name()},
      {"threads", setup.options.threads},
      {"seed", setup.options.seed},
      {"status", status_name(summary.status)},
      {"config_hash", hash_text(hash_bytes(request.config))},
      {"scene_hash", hash_text(hash_file(setup.scene))},
      {"assets", asset_hashes(setup, request.inputs)},
      {"wall_time_s", summary.wall_time_s},
      {"simulated_time_s", summary.simulated_time_s},
  };
  const auto& outside = request.options.outside;
  if (outside && outside->facts) {
    for (const auto& [name, value] : outside->facts()) json["planner"][name] = value;
  }
  return json_text(json);
}

}  // namespace vantage
