// Scenes from meshes, as a user makes them.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>
#include <utility>

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
  EXPECT_EQ(json["geoms"]["planes"], 0);
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

/// The room as it is, and on its side.
TEST_F(SceneFromMesh, EitherAxisMayPointUp) {
  house();
  std::istringstream lines(test::room_with_door(0.85).obj());
  std::string lying;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    double x = 0.0, y = 0.0, z = 0.0;
    if (words >> kind >> x >> y >> z && kind == "v") line = fmt::format("v {} {} {}", x, z, -y);
    lying += fmt::format("{}\n", line);
  }
  file("lying.obj", lying);
  const auto free_area_m2 = [&](const std::string& mesh) {
    const Result made = vantage("scene from-mesh " + mesh + " --out a.xml --overwrite --json -q");
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return nlohmann::json::parse(made.output).at("free_area_m2").get<double>();
  };
  const double area_m2 = free_area_m2("house.obj");
  EXPECT_NEAR(free_area_m2("house.obj --up z"), area_m2, 1e-6);
  EXPECT_NEAR(free_area_m2("lying.obj --up y"), area_m2, 1e-6);
}

TEST_F(SceneFromMesh, AFloorIsLaidWhereItIsSaidToBe) {
  test::DrawnBuilding walls;
  walls.box({-3.1, -2.1, 0}, {3.1, -2.0, 2.5});
  walls.box({-3.1, 2.0, 0}, {3.1, 2.1, 2.5});
  file("walls.obj", walls.obj());
  expect_error(vantage("scene from-mesh walls.obj --out a.xml -q"), 3, {"--floor"});
  const Result made = vantage("scene from-mesh walls.obj --out a.xml --floor 0 --json -q");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_EQ(nlohmann::json::parse(made.output)["geoms"]["planes"], 1);
}

TEST_F(SceneFromMesh, WhatBeginsAboveTheHeightIsLeftOut) {
  test::DrawnBuilding building = test::room_with_door(0.85);
  building.box({-0.5, -0.5, 2.6}, {0.5, 0.5, 2.8});  // a lamp
  file("lit.obj", building.obj());
  for (const auto& [height, boxes] : {std::pair("", 2), {" --height 2.5", 1}}) {
    const Result made =
        vantage("scene from-mesh lit.obj --out a.xml --overwrite --json -q" + std::string(height));
    ASSERT_EQ(made.exit_code, 0) << made.output;
    EXPECT_EQ(nlohmann::json::parse(made.output)["geoms"]["boxes"], boxes) << height;
  }
}

TEST_F(SceneFromMesh, TellsTheSameInWordsAndAsJson) {
  house();
  const auto json =
      nlohmann::json::parse(vantage("scene from-mesh house.obj --out a.xml --json -q").output);
  const auto number = [&](const char* key) { return json[key].get<double>(); };
  const auto count = [&](const char* key) { return json["geoms"][key].get<int>(); };
  const auto start = json["start"].get<std::vector<double>>();
  ASSERT_EQ(start.size(), 3U);
  EXPECT_LT(std::abs(start[0]), 3.0);
  EXPECT_LT(std::abs(start[1]), 2.0);
  const auto T = json["T_scene_mesh"].get<std::vector<double>>();  // row by row
  EXPECT_EQ(std::vector(T.begin() + 12, T.end()), (std::vector{0.0, 0.0, 0.0, 1.0}));
  std::string sets;
  for (const auto& set : json["set"]) sets += " --set '" + set.get<std::string>() + "'";
  const std::string words =
      vantage("scene from-mesh house.obj --out a.xml --overwrite -q 2>/dev/null").output;
  EXPECT_THAT(words, testing::StartsWith(fmt::format(
                         "a.xml: {} boxes and {} other convex shapes as the mesh has them, {} "
                         "boxes for the rest, whose surfaces are off by {:g} m at most\n"
                         "{:.3g} x {:.3g} m; start_0 at ({:.2f}, {:.2f}), {:.2f} m clear, {:.3g} "
                         "m2 of floor about it\nits map: ",
                         count("boxes"), count("hulls"), count("cell_boxes"), number("cell_m"),
                         json["size_m"][0].get<double>(), json["size_m"][1].get<double>(), start[0],
                         start[1], number("start_clearance_m"), number("free_area_m2"))));
  EXPECT_THAT(words, testing::EndsWith("explore it: vantage run assets/episodes/office_small.yaml "
                                       "--set scene=a.xml" +
                                       sets + "\n"));
}

TEST_F(SceneFromMesh, AMeshInMillimetresIsScaled) {
  std::istringstream lines(test::room_with_door(0.85).obj());
  std::string large;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    double x = 0.0, y = 0.0, z = 0.0;
    if (words >> kind >> x >> y >> z && kind == "v") {
      line = fmt::format("v {} {} {}", 1000.0 * x, 1000.0 * y, 1000.0 * z);
    }
    large += line + "\n";
  }
  file("large.obj", large);
  house();
  const auto size_m = [&](const std::string& mesh) {
    const Result made = vantage("scene from-mesh " + mesh + " --out a.xml --overwrite --json -q");
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return nlohmann::json::parse(made.output).at("size_m").get<std::vector<double>>();
  };
  const std::vector<double> metres = size_m("house.obj");
  const std::vector<double> millimetres = size_m("large.obj --scale 0.001");
  EXPECT_NEAR(millimetres.at(0), metres.at(0), 1e-4);
  EXPECT_NEAR(millimetres.at(1), metres.at(1), 1e-4);
}

TEST_F(SceneFromMesh, TellsTheMapThatItsEpisodeHas) {
  house();
  const auto json =
      nlohmann::json::parse(vantage("scene from-mesh house.obj --out a.xml --json -q").output);
  const auto numbers = [&](std::size_t i) {
    const auto set = json["set"].at(i).get<std::string>();
    return nlohmann::json::parse(set.substr(set.find('=') + 1)).get<std::vector<double>>();
  };
  const std::vector<double> size_m = numbers(1);
  const std::vector<double> cells = numbers(2);
  const Result told = vantage("scene from-mesh house.obj --out a.xml --overwrite -q");
  EXPECT_THAT(told.output, HasSubstr(fmt::format(
                               "\nits map: {:g} x {:g} m, {:g} x {:g} x {:g} cells of {:.1f} cm\n",
                               size_m.at(0), size_m.at(1), cells.at(0), cells.at(1), cells.at(2),
                               100.0 * size_m.at(0) / cells.at(0))));
}

TEST_F(SceneFromMesh, AnEpisodeIsToldAndNotReplacedUnasked) {
  house();
  const std::string make = "scene from-mesh house.obj --out a.xml --episode -q";
  file("a.yaml", "scans: 1\n");
  expect_error(vantage(make), 2, {"--episode a.yaml", "--overwrite"});
  EXPECT_FALSE(fs::exists(folder_ / "a.xml"));
  const Result made = vantage(make + " --overwrite --json");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_EQ(nlohmann::json::parse(made.output)["episode"], "a.yaml");
}

}  // namespace
}  // namespace vantage
