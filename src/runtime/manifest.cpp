#include "vantage/runtime/manifest.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>
#include <vantage_commit.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/world/mjcf_files.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

#ifdef __clang__
constexpr const char* kCompiler = __VERSION__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string renderer_text() {
  try {
    return renderer_name();
  } catch (const RendererError& error) {
    return std::string("none: ") + error.what();
  }
}

using Hashes = std::map<std::string, std::string>;

/// By their names beside `root`.
void add_hashes(const fs::path& root, Hashes& hashes) {
  const fs::path folder = fs::absolute(root).parent_path();
  for (const fs::path& file : mjcf_files(root)) {
    const std::string name = fs::relative(file, folder).string();
    const std::string hash = hash_text(hash_file(file));
    const auto [of_name, is_new] = hashes.try_emplace(name, hash);
    if (!is_new && of_name->second != hash) hashes["robot:" + name] = hash;
  }
}

/// What libraries choose other code by: the C library computes sin with other last digits without
/// `fma`.
std::vector<std::string> cpu_features() {
  std::vector<std::string> features;
  const auto add = [&](const char* name, int supported) {
    if (supported != 0) features.emplace_back(name);
  };
  add("sse4_2", __builtin_cpu_supports("sse4.2"));
  add("avx", __builtin_cpu_supports("avx"));
  add("avx2", __builtin_cpu_supports("avx2"));
  add("fma", __builtin_cpu_supports("fma"));
  add("avx512f", __builtin_cpu_supports("avx512f"));
  return features;
}

}  // namespace

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string version_text() { return VANTAGE_VERSION " (" VANTAGE_GIT_COMMIT ")"; }

std::map<std::string, std::string> asset_hashes(const EpisodeSetup& setup,
                                                const std::vector<InputFile>& inputs) {
  Hashes hashes;
  for (const fs::path& root : {setup.scene, setup.robot.mjcf, setup.robot.description}) {
    add_hashes(root, hashes);
  }
  for (const InputFile& input : inputs) {
    if (fs::exists(input.path)) hashes[input.key] = hash_text(hash_file(input.path));
  }
  return hashes;
}

InputHashes input_hashes(const EpisodeSetup& setup, const std::vector<InputFile>& inputs) {
  return {hash_text(hash_file(setup.scene)), asset_hashes(setup, inputs)};
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
        {"compiler", kCompiler}}},
      {"cpu", cpu_name()},
      {"cpu_features", cpu_features()},
      {"threads", setup.options.threads},
      {"seed", setup.options.seed},
      {"status", status_name(summary.status)},
      {"config_hash", hash_text(hash_bytes(request.config))},
      {"scene_hash", request.inputs.scene},
      {"assets", request.inputs.assets},
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
