#include "vantage/building/scene_text.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <fstream>
#include <regex>

#include "vantage/core/atomic_file.hpp"
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

using testing::HasSubstr;

BuildingScene hall_of(double x_m, double y_m) {
  BuildingScene scene;
  const Eigen::Vector2d half_m(0.5 * x_m, 0.5 * y_m);
  scene.extent_m = Eigen::AlignedBox2d(Eigen::Vector2d(-half_m), half_m);
  return scene;
}

TEST(BuildingMap, IsLargeEnoughAndOfCellsThatAreFewEnough) {
  const BuildingMap small = map_of(hall_of(8.0, 6.0));
  EXPECT_NEAR(small.size_m.x(), 8.5, 1e-9);
  EXPECT_NEAR(small.size_m.y(), 6.5, 1e-9);
  EXPECT_EQ(small.cells.x(), 146);
  EXPECT_EQ(small.cells.y(), 112);
  EXPECT_EQ(small.cells.z(), 65);
  EXPECT_NEAR(small.half_size_m, 4.5, 1e-9);
  const BuildingMap large = map_of(hall_of(40.0, 30.0));
  EXPECT_NEAR(large.size_m.x(), 40.5, 1e-9);
  EXPECT_NEAR(large.size_m.y(), 30.5, 1e-9);
  EXPECT_TRUE((large.cells == Eigen::Array3i(405, 305, 33)).all()) << "cells of 10 cm at most";
  EXPECT_NEAR(large.half_size_m, 20.5, 1e-9);
  const BuildingMap vast = map_of(hall_of(199.5, 149.5));
  EXPECT_GT(vast.cells.cast<double>().prod(), 0.99 * 67108864.0) << "as fine as memory allows";
  EXPECT_LT(vast.cells.cast<double>().prod(), 1.01 * 67108864.0);
  const BuildingMap even = map_of(hall_of(7.75, 5.75));
  EXPECT_NEAR(even.size_m.x(), 8.0, 1e-9) << "whole halves stay";
  EXPECT_NEAR(even.size_m.y(), 6.0, 1e-9);
  EXPECT_NEAR(even.half_size_m, 4.5, 1e-9);
}

TEST(SceneText, EpisodesHaveTheMapAndScansByArea) {
  EXPECT_THAT(episode_overrides(hall_of(8.0, 6.0)),
              testing::ElementsAre("scans=22", "map.size_m=[8.5, 6.5, 2]",
                                   "map.cells=[146, 112, 65]", "floor_map.half_size_m=4.5"));
  const std::string episode = to_episode(hall_of(8.0, 6.0), "hall.xml");
  EXPECT_THAT(episode, HasSubstr("\nscans: 22\n"));
  EXPECT_THAT(episode, HasSubstr("size_m: [8.5, 6.5, 2], cells: [146, 112, 65]"));
  EXPECT_THAT(episode, HasSubstr("half_size_m: 4.5"));
  EXPECT_THAT(episode, HasSubstr("range_max_m: 30}"));
  EXPECT_THAT(to_episode(hall_of(4.0, 4.0), "hall.xml"), HasSubstr("\nscans: 20\n"));
}

/// The finer map of the floor has at most 2^13 cells along an edge, three to each of 0.05 m.
TEST(SceneText, AVastFloorHasLargerCells) {
  EXPECT_THAT(to_episode(hall_of(134.5, 20.0), "hall.xml"), HasSubstr("{half_size_m: 68}"));
  EXPECT_THAT(to_episode(hall_of(140.0, 20.0), "hall.xml"),
              HasSubstr("{half_size_m: 70.5, cell_m: 0.055}"));
  EXPECT_THAT(episode_overrides(hall_of(140.0, 20.0)), testing::Contains("floor_map.cell_m=0.055"));
}

/// What a line of an episode says, without remark.
std::string said(const std::string& episode, const std::string& key) {
  const std::size_t from = episode.find("\n" + key + ": ") + 1;
  const std::string line = episode.substr(from, episode.find('\n', from) - from);
  return line.substr(0, line.find("    #"));
}

TEST(SceneText, EpisodesAreTheSmallOfficesButForSceneAndMap) {
  const std::string office =
      read_file(std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml");
  const std::string episode = to_episode(hall_of(8.0, 6.0), "hall.xml");
  for (const auto& entry : parse_yaml(office, "office_small.yaml").entries) {
    const std::string& key = entry.first;
    if (key == "scene" || key == "scans" || key == "map" || key == "floor_map") continue;
    EXPECT_EQ(said(episode, key), said(office, key));
  }
}

TEST(SceneText, ShapesAreWrittenWithSixDigits) {
  BuildingScene scene = hall_of(8.0, 6.0);
  BoxShape box{{}, {0.1F, 0.25F, 0.5F}};
  box.box.half_m = {0.5, 1.25, 2.0};
  box.box.T_mesh_box.translation() = Eigen::Vector3d(1234.5678912, -2.5, -1e-9);
  scene.boxes.push_back(box);
  box.box.T_mesh_box.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
  box.box.T_mesh_box.linear() = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  scene.cell_boxes.push_back(box);
  scene.hulls.push_back({{{0.0, 1.0, 2.0}, {3.25, 4.0, 5.0}}, {0.0F, 1.0F, 0.625F}});
  scene.floor.start = {1.5, -0.25, 0.75};
  const std::string mjcf = to_mjcf(scene, "hall", "by hand");
  EXPECT_THAT(mjcf, HasSubstr("      <geom type=\"box\" pos=\"1234.568 -2.5 0\" "
                              "size=\"0.5 1.25 2\" rgba=\"0.10 0.25 0.50 1\"/>\n"));
  EXPECT_THAT(mjcf, HasSubstr("      <geom type=\"box\" pos=\"1 2 3\" size=\"0.5 1.25 2\" "
                              "quat=\"0.955336 0 0 0.29552\" rgba=\"0.10 0.25 0.50 1\"/>\n"));
  EXPECT_THAT(mjcf, HasSubstr("  <asset>\n    <mesh name=\"hull_0\" vertex=\"0 1 2  3.25 4 5  "
                              "\"/>\n  </asset>\n"));
  EXPECT_THAT(mjcf, HasSubstr("      <geom type=\"mesh\" mesh=\"hull_0\" rgba=\"0.00 1.00 "));
  EXPECT_THAT(mjcf, HasSubstr("<site name=\"start_0\" pos=\"1.5 -0.25 0\" euler=\"0 0 0.75\""));
  EXPECT_THAT(mjcf, testing::Not(HasSubstr("plane")));
  EXPECT_EQ(scene.geoms(), 3U);
}

TEST(SceneText, AFloorThatIsLaidReachesBeyondTheBuilding) {
  EXPECT_THAT(to_mjcf(empty_hall(), "hall", "by hand"),
              HasSubstr("<geom type=\"plane\" size=\"10 8 0.1\""));
  EXPECT_THAT(to_mjcf(empty_hall(), "hall", "by hand"), testing::Not(HasSubstr("<asset>")));
  EXPECT_EQ(empty_hall().geoms(), 1U);
}

TEST(BuildingMap, HasAMarginOfAQuarterOfAMetre) {
  const BuildingMap map = map_of(hall_of(7.8, 5.7));
  EXPECT_NEAR(map.size_m.x(), 8.5, 1e-9) << "8.05 m";
  EXPECT_NEAR(map.size_m.y(), 6.0, 1e-9) << "5.95 m";
}

TEST(BuildingMap, HasHalfTheLayersAboveTwoHundredAndFiftySquareMetres) {
  const BuildingMap least = map_of(hall_of(19.75, 12.25));
  EXPECT_TRUE((least.cells == Eigen::Array3i(335, 210, 65)).all()) << "70000 columns of 250 m^2";
  EXPECT_EQ(map_of(hall_of(20.0, 12.25)).cells.z(), 33) << "256.25 m^2";
}

/// But that their lights have names.
TEST(SceneText, ScenesAreLitAndDrawnAsTheOfficesAre) {
  const std::string mjcf = to_mjcf(hall_of(8.0, 6.0), "hall", "by hand");
  const std::regex drawn("^ *<(statistic|map|global|quality|headlight|light|geom conaffinity)\\b");
  std::ifstream office(VANTAGE_SOURCE_DIR "/models/scenes/office_small_1/scene.xml");
  int lines = 0;
  for (std::string line; std::getline(office, line);) {
    if (!std::regex_search(line, drawn, std::regex_constants::match_continuous)) continue;
    EXPECT_THAT(mjcf,
                HasSubstr(std::regex_replace(line, std::regex(" name=\"[a-z]+\""), "") + "\n"));
    ++lines;
  }
  EXPECT_EQ(lines, 8) << "two of them lights";
}

}  // namespace
}  // namespace vantage
