#include "vantage/runtime/manifest.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

using testing::Pair;
using testing::UnorderedElementsAre;

std::string hash_of(const std::string& content) { return hash_text(hash_bytes(content)); }

/// A scene and a robot, each in a folder of its own.
class AssetHashes : public testing::Test {
 protected:
  AssetHashes() {
    setup_.scene = file("scene/model.xml", kScene);
    setup_.robot.description = file("robot/robot.yaml", "kind: quadrotor");
    file("scene/floor.png", "floor");
  }
  std::filesystem::path file(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, content);
    return folder_ / name;
  }

  static constexpr auto kScene = "<mujoco><texture file='floor.png'/></mujoco>";
  support::TemporaryDirectory folder_;
  EpisodeSetup setup_;
};

TEST_F(AssetHashes, GoByTheNamesOfTheFiles) {
  setup_.robot.mjcf = file("robot/robot.xml", "<mujoco/>");
  EXPECT_THAT(
      asset_hashes(setup_, {{"model", folder_ / "robot/robot.yaml"}, {"none", "nowhere"}}),
      UnorderedElementsAre(Pair("model.xml", hash_of(kScene)), Pair("floor.png", hash_of("floor")),
                           Pair("robot.xml", hash_of("<mujoco/>")),
                           Pair("robot.yaml", hash_of("kind: quadrotor")),
                           Pair("model", hash_of("kind: quadrotor"))));
}

TEST_F(AssetHashes, HoldBothFilesOfOneName) {
  setup_.robot.mjcf = file("robot/model.xml", "<mujoco/>");
  EXPECT_THAT(asset_hashes(setup_, {}),
              UnorderedElementsAre(Pair("model.xml", hash_of(kScene)),
                                   Pair("robot:model.xml", hash_of("<mujoco/>")),
                                   Pair("floor.png", hash_of("floor")),
                                   Pair("robot.yaml", hash_of("kind: quadrotor"))));
}

TEST(CpuName, IsTheOneThatTheSystemTells) {
  EXPECT_THAT(read_file("/proc/cpuinfo"),
              testing::AnyOf(testing::HasSubstr("model name\t: " + cpu_name() + "\n"),
                             testing::Not(testing::HasSubstr("model name"))));
}

TEST_F(AssetHashes, AManifestSaysWhatRanOnWhat) {
  setup_.robot.mjcf = file("robot/robot.xml", "<mujoco/>");
  setup_.options.threads = 3;
  setup_.options.seed = 9;
  const std::vector<InputFile> model{{"model", setup_.scene}};
  RunRequest request{setup_, "exploration", "greedy", "a: 1\n", input_hashes(setup_, model), {}};
  request.options.command = {"vantage", "run"};
  RunSummary summary;
  summary.status = EpisodeStatus::diverged;
  summary.simulated_time_s = 5.5;
  summary.wall_time_s = 2.5;
  auto manifest = nlohmann::json::parse(manifest_json(request, summary));
  EXPECT_EQ(manifest["command"], nlohmann::json({"vantage", "run"}));
  EXPECT_EQ(manifest["versions"]["vantage"], version_text());
  EXPECT_EQ(manifest["versions"]["mujoco"], mujoco_version());
  EXPECT_EQ(manifest["versions"].size(), 5U);
  EXPECT_EQ(manifest["cpu"], cpu_name());
  for (const char* feature : {"sse4_2", "avx", "avx2", "fma", "avx512f"}) {
    const auto& features = manifest["cpu_features"];
    EXPECT_EQ(
        std::count(features.begin(), features.end(), feature) == 1,
        (read_file("/proc/cpuinfo") + " ").find(fmt::format(" {} ", feature)) != std::string::npos)
        << feature;
  }
  EXPECT_EQ(manifest["threads"], 3);
  EXPECT_EQ(manifest["seed"], 9);
  EXPECT_EQ(manifest["status"], "diverged");
  EXPECT_EQ(manifest["config_hash"], hash_of("a: 1\n"));
  EXPECT_EQ(manifest["scene_hash"], hash_of(kScene));
  EXPECT_EQ(manifest["assets"], nlohmann::json(asset_hashes(setup_, model)));
  EXPECT_EQ(manifest["assets"]["model"], hash_of(kScene));
  EXPECT_EQ(manifest["wall_time_s"], 2.5);
  EXPECT_EQ(manifest["simulated_time_s"], 5.5);
  EXPECT_FALSE(manifest.contains("planner")) << "nobody chooses from outside";
  request.options.outside.emplace();
  EXPECT_FALSE(nlohmann::json::parse(manifest_json(request, summary)).contains("planner"));
  request.options.outside->facts = [] { return PlannerFacts{{"model", "mine"}, {"rate", "2"}}; };
  manifest = nlohmann::json::parse(manifest_json(request, summary));
  EXPECT_EQ(manifest["planner"], nlohmann::json({{"model", "mine"}, {"rate", "2"}}));
}

}  // namespace
}  // namespace vantage
