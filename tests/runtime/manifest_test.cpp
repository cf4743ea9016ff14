#include "vantage/runtime/manifest.hpp"

#include <gmock/gmock.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"

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

}  // namespace
}  // namespace vantage
