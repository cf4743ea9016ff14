#include "vantage/building/scene_text.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "vantage/core/yaml.hpp"
#include "vantage/sim/world/scene.hpp"

namespace vantage {
namespace {

BuildingScene empty_hall() {
  BuildingScene scene;
  scene.extent_m = Eigen::AlignedBox2d(Eigen::Vector2d(-4.0, -3.0), Eigen::Vector2d(4.0, 3.0));
  scene.laid_floor = true;
  return scene;
}

TEST(SceneText, AnEpisodeNamesAnyFile) {
  EXPECT_THAT(to_episode(empty_hall(), "hall.xml"), testing::HasSubstr("\nscene: hall.xml\n"));
  for (const char* name : {"flat #2.xml", "a: b.xml", "[x].xml", "it's \"a\".xml", "a\nb.xml"}) {
    const ConfigNode episode = parse_yaml(to_episode(empty_hall(), name), "hall.yaml");
    ASSERT_NE(episode.find("scene"), nullptr) << name;
    EXPECT_EQ(episode.find("scene")->scalar, name);
  }
}

TEST(SceneText, MjcfIsXmlWhateverTheFilesAreCalled) {
  const std::string mjcf = to_mjcf(empty_hall(), "a \"<b>\" & c", "of my---house--.obj");
  EXPECT_THAT(mjcf, testing::StartsWith("<!-- of my- - -house- -.obj -->\n<mujoco model=\"a "
                                        "&quot;&lt;b&gt;&quot; &amp; c\">\n"));
  EXPECT_STREQ(load_model(mjcf, {}, "hall.xml").model->names, "a \"<b>\" & c");
}

}  // namespace
}  // namespace vantage
