// Scenes from meshes, as a user makes them.
#include <nlohmann/json.hpp>

#include "tests/building/drawn_building.hpp"
#include "tests/cli/command_line.hpp"

namespace vantage {
namespace {

class SceneFromMesh : public CommandLine {
 protected:
  std::string house() { return file("house.obj", test::room_with_door(0.85).obj()); }
};

TEST_F(SceneFromMesh, MakesASceneThatCanBeExplored) {
  house();
  const Result made = vantage("scene from-mesh house.obj --out house.xml --episode -q");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_THAT(made.output, HasSubstr("explore it: vantage run house.yaml"));
  const Result validated = vantage("validate house.yaml house.xml");
  EXPECT_EQ(validated.exit_code, 0) << validated.output;
  EXPECT_THAT(validated.output, HasSubstr("house.yaml: good"));
  const Result in_office =
      vantage("run assets/episodes/office_small.yaml --set scene=house.xml --dry-run");
  EXPECT_EQ(in_office.exit_code, 0) << in_office.output;
}

TEST_F(SceneFromMesh, IsExplored) {
  house();
  vantage("scene from-mesh house.obj --out house.xml --episode -q");
  const Result run = vantage("run house.yaml --set scans=3 --lean --out run --json -q");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto metrics = nlohmann::json::parse(run.output.substr(run.output.find('{')));  // warnings
  EXPECT_EQ(metrics["collisions"], 0);
  ASSERT_GE(metrics["scans"].size(), 2U) << metrics["reason"];
  EXPECT_LT(metrics["scans"].back()["observable_unobserved_cells"].get<double>(),
            0.05 * metrics["observable_cells"].get<double>());
  for (const auto& scan : metrics["scans"]) {
    EXPECT_GT(scan["view"]["y_m"].get<double>(), -2.0) << "not out of the door";
  }
  EXPECT_GT(metrics["map"]["precision"].get<double>(), 0.95);
}

TEST_F(SceneFromMesh, TellsWhatItMadeAsJson) {
  house();
  const Result made = vantage("scene from-mesh house.obj --out a.xml --json -q");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  const auto json = nlohmann::json::parse(made.output);
  EXPECT_EQ(json["geoms"]["boxes"], 1);
  EXPECT_EQ(json["T_scene_mesh"].size(), 16U);
  ASSERT_EQ(json["set"].size(), 4U);
  EXPECT_EQ(json["set"][0], "scans=20");
  EXPECT_GT(json["free_area_m2"].get<double>(), 8.0);
  EXPECT_EQ(json.value("episode", ""), "");
}

TEST_F(SceneFromMesh, SaysInOneLineWhatIsWrong) {
  house();
  file("broken.ply", "ply\nformat none\n");
  expect_error(vantage("scene from-mesh absent.obj --out a.xml -q"), 3,
               {"absent.obj: no such file"});
  expect_error(vantage("scene from-mesh broken.ply --out a.xml -q"), 3, {"broken.ply: "});
  expect_error(vantage("scene from-mesh house.obj --out a.xml --cell 0.005 -q"), 2,
               {"--cell 0.005"});
  expect_error(vantage("scene from-mesh house.obj --out a.xml --max-geoms 2 -q"), 2,
               {"--max-geoms 2"});
  expect_error(vantage("scene from-mesh house.obj --out a.xml --clearance 3 -q"), 3,
               {"no free start"});
  expect_error(vantage("scene from-mesh house.obj --out absent/a/../../house.obj/a.xml -q"), 5, {});
  EXPECT_EQ(vantage("scene from-mesh house.obj --out a.stl -q").exit_code, 2);
  ASSERT_EQ(vantage("scene from-mesh house.obj --out a.xml -q").exit_code, 0);
  expect_error(vantage("scene from-mesh house.obj --out a.xml -q"), 2, {"--overwrite replaces it"});
  EXPECT_EQ(vantage("scene from-mesh house.obj --out a.xml --overwrite -q").exit_code, 0);
}

}  // namespace
}  // namespace vantage
