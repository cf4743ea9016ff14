// Files are looked for where MuJoCo looks for them.
#include "vantage/sim/world/mjcf_files.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tests/sim/test_world.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// By their names beside the scene, which names `files` and has them.
std::vector<std::string> found(const std::string& mjcf,
                               const std::vector<std::pair<std::string, std::string>>& files) {
  const test::SceneFolder scene(mjcf);
  for (const auto& [name, content] : files) scene.add(name, content);
  std::vector<std::string> names;
  for (const auto& file : mjcf_files(scene.path())) {
    names.push_back(file.lexically_relative(scene.path().parent_path()).string());
  }
  return names;
}

TEST(MjcfAttributes, AreReadHoweverTheyAreWritten) {
  const std::string mjcf =
      "<?xml version='1.0'?><!-- <a b='c'> --><mesh name = \"it's > a\"\n\tfile='x'/><b/>"
      "<c d=''e=\"f\"></c><g h=\"";
  std::vector<std::string> read;
  for (const MjcfAttribute& attribute : mjcf_attributes(mjcf)) {
    std::string text(attribute.element);
    read.push_back(text.append(" ").append(attribute.name).append("=").append(attribute.value));
  }
  EXPECT_THAT(
      read, ElementsAre("?xml version=1.0", "mesh name=it's > a", "mesh file=x", "c d=", "c e=f"));
}

TEST(MjcfFiles, OfIncludedOnesLieBesideTheMainFile) {
  EXPECT_THAT(found("<mujoco><compiler meshdir='meshes'/><include file='parts/a.xml'/></mujoco>",
                    {{"parts/a.xml",
                      "<mujoco><include file='parts/b.xml'/><asset><mesh file='m.obj'/>"
                      "<texture file='t.png'/></asset></mujoco>"},
                     {"parts/b.xml", "<mujoco><compiler texturedir='pictures'/></mujoco>"},
                     {"parts/parts/b.xml", ""},
                     {"meshes/m.obj", ""},
                     {"parts/m.obj", ""},
                     {"pictures/t.png", ""}}),
              UnorderedElementsAre("scene.xml", "parts/a.xml", "parts/b.xml", "meshes/m.obj",
                                   "pictures/t.png"));
}

TEST(MjcfFiles, AreTheSidesOfCubesToo) {
  EXPECT_THAT(found("<mujoco><asset><texture type='skybox' fileright='r.png' fileleft = 'l.png'"
                    "\n fileup= \"a &amp; b.png\"/></asset></mujoco>",
                    {{"r.png", ""}, {"l.png", ""}, {"a & b.png", ""}}),
              UnorderedElementsAre("scene.xml", "r.png", "l.png", "a & b.png"));
}

TEST(MjcfFiles, AreWhatTheStrippedNameSays) {
  EXPECT_THAT(found("<mujoco><compiler strippath='true' meshdir='meshes'/><asset>"
                    "<mesh file='/home/a/m.obj'/></asset></mujoco>",
                    {{"meshes/m.obj", ""}}),
              UnorderedElementsAre("scene.xml", "meshes/m.obj"));
}

TEST(MjcfFiles, ThatIncludeEachOtherAreReadOnce) {
  EXPECT_THAT(found("<mujoco><include file='a.xml'/></mujoco>",
                    {{"a.xml", "<mujoco><include file='scene.xml'/></mujoco>"}}),
              UnorderedElementsAre("scene.xml", "a.xml"));
  EXPECT_TRUE(mjcf_files("nowhere/scene.xml").empty());
}

TEST(MjcfAttributes, AreNoneInWhatIsNoTag) {
  EXPECT_TRUE(mjcf_attributes("a='b' <![CDATA[<mesh file='x'/>]]> <!-- <a b='c'/>").empty());
  const std::string mjcf = "<![CDATA[ > ]]><mesh file='x'/>";
  const auto read = mjcf_attributes(mjcf);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_TRUE(read[0].names_file());
  EXPECT_FALSE((MjcfAttribute{"geom", "profile", "x"}.names_file()));
}

TEST(MjcfFiles, EntitiesAreReadOnce) {
  EXPECT_THAT(found("<mujoco><asset><mesh file='a&amp;lt;b.obj'/>"
                    "<mesh file='&apos;&quot;&lt;&gt;&amp;&amp;.obj'/></asset></mujoco>",
                    {{"a&lt;b.obj", ""}, {"a<b.obj", ""}, {"'\"<>&&.obj", ""}}),
              UnorderedElementsAre("scene.xml", "a&lt;b.obj", "'\"<>&&.obj"));
}

TEST(MjcfFiles, KeepTheirFoldersUnlessTheyAreStripped) {
  EXPECT_THAT(found("<mujoco><compiler strippath='false' assetdir='things'/><asset>"
                    "<mesh file='deep/m.obj'/></asset></mujoco>",
                    {{"things/m.obj", ""}, {"things/deep/m.obj", ""}, {"deep/m.obj", ""}}),
              UnorderedElementsAre("scene.xml", "things/deep/m.obj", "deep/m.obj"));
}

TEST(MjcfFiles, AnAmpersandThatWasAnEntityBeginsNone) {
  EXPECT_THAT(found("<mujoco><asset><mesh file='c&amp;amp;d.obj'/></asset></mujoco>",
                    {{"c&amp;d.obj", ""}, {"c&d.obj", ""}}),
              UnorderedElementsAre("scene.xml", "c&amp;d.obj"));
}

TEST(MjcfAttributes, EndWithTheirTag) {
  const std::string mjcf = "<a b='c'><d e='f'/></a>";
  const auto read = mjcf_attributes(mjcf);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].element, "a");
  EXPECT_EQ(read[1].element, "d");
}

}  // namespace
}  // namespace vantage
