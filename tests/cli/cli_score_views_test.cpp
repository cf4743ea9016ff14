// `vantage score-views` as the owner of a robot meets it.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "tests/cli/command_line.hpp"
#include "tests/support/octomap_bytes.hpp"
#include "vantage/belief/map/octomap_io.hpp"

namespace vantage {
namespace {

using nlohmann::json;

class ScoreViewsCommand : public CommandLine {
 protected:
  /// A room of 4 x 4 x 2 m: known and free where x < 0 but for a wall at x = -1.6, unknown beyond.
  void SetUp() override {
    CommandLine::SetUp();
    OccupancyGrid grid(make_grid_frame({0.0, 0.0, 1.0}, {4.0, 4.0, 2.0}, {40, 40, 20}));
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const Eigen::Array3i cell = grid.frame.cell(i);
      if (cell.x() < 20) grid.log_odds[i] = cell.x() == 4 ? 3.0F : -3.0F;
    }
    grid.log_odds.back() = -3.0F;  // the box of the known cells is the room
    for (const char* name : {"room.bt", "room.ot"}) write_octomap(grid, folder_ / name);
    views_ = file("views.csv",
                  "x_m,y_m,z_m,yaw_rad,id\n-1,0,1,3.14159,10\n-1,0,1,0,11\n-1,0,1,1.5708,12\n");
  }
  Result score(const std::string& arguments) { return vantage("score-views " + arguments); }
  json scored(const std::string& arguments) {
    const Result result = score(arguments + " --json 2>/dev/null");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    json parsed = json::parse(result.output, nullptr, false);
    EXPECT_TRUE(parsed.is_object()) << result.output;
    return parsed;
  }
  std::string views_;
};

TEST_F(ScoreViewsCommand, RanksTheViewOfTheUnknownFirst) {
  const json result = scored("--map room.bt --views views.csv --gain simple");
  EXPECT_NEAR(result["map"]["resolution_m"].get<double>(), 0.1, 1e-9);
  EXPECT_EQ(result["map"]["occupied_cells"], 800);
  EXPECT_EQ(result["gain"]["name"], "simple");
  EXPECT_EQ(result["unit"], "bits");
  EXPECT_NEAR(result["region"]["max_m"][0].get<double>(), 2.0, 1e-9);
  EXPECT_DOUBLE_EQ(result["sensor"]["range_max_m"].get<double>(), 3.5);
  ASSERT_EQ(result["views"].size(), 3U);
  const json& best = result["views"][0];
  EXPECT_EQ(best["rank"], 1);
  EXPECT_EQ(best["id"], 11);
  EXPECT_DOUBLE_EQ(best["x_m"].get<double>(), -1.0);
  EXPECT_GT(best["gain"].get<double>(), 1000.0);
  EXPECT_EQ(result["views"][1]["id"], 12);
  EXPECT_EQ(result["views"][2]["id"], 10);  // sees the wall, and what is known in front of it
  EXPECT_EQ(result["views"][2]["gain"], 0.0);
}

TEST_F(ScoreViewsCommand, TableAndBothFormatsAgree) {
  const Result binary = score("--map room.bt --views views.csv");
  EXPECT_EQ(binary.exit_code, 0);
  EXPECT_THAT(binary.output, HasSubstr("gain [bits]"));
  EXPECT_EQ(std::count(binary.output.begin(), binary.output.end(), '\n'), 4);
  EXPECT_EQ(score("--map room.ot --views views.csv").output, binary.output);
  EXPECT_EQ(score("--map room.ot --views views.csv --set threads=1").output, binary.output);
}

TEST_F(ScoreViewsCommand, EveryGainOfTheListRanks) {
  for (const char* gain :
       {"posterior_chain", "visibility_weighted", "occlusion_aware", "unobserved_voxel",
        "rear_side_entropy", "proximity_count", "average_entropy", "area_factor", "fsmi",
        "unmapped_volume", "frontier_cells"}) {
    const json result = scored("--map room.bt --views views.csv --gain " + std::string(gain));
    EXPECT_EQ(result["views"].size(), 3U) << gain;
  }
  EXPECT_EQ(scored("--map room.bt --views views.csv --gain unmapped_volume")["unit"], "m3");
  EXPECT_EQ(scored("--map room.bt --views views.csv --gain rear_side_voxel")["unit"], "beams");
}

TEST_F(ScoreViewsCommand, TransmissionIsPerMetreUnlessGivenPerCell) {
  const auto a_of = [&](const std::string& arguments) {
    return scored("--map room.bt --views views.csv " + arguments)["gain"]["a"].get<double>();
  };
  EXPECT_NEAR(a_of(""), std::pow(0.5, 0.1), 1e-9);
  EXPECT_NEAR(a_of("--gain beer_lambert --set region.coarsen=2"), std::pow(0.5, 0.2), 1e-9);
  EXPECT_NEAR(a_of("--set transmission_per_m=0.9"), std::pow(0.9, 0.1), 1e-9);
  EXPECT_EQ(a_of("--gain beer_lambert --set gain.a=0.99"), 0.99);
  EXPECT_NEAR(a_of("--gain adaptive --set transmission_per_m=0.5"), std::pow(0.5, 0.1), 1e-9);
  const std::string score_these = "--map room.bt --views views.csv ";
  expect_error(score(score_these + "--gain adaptive"), 2, {"adaptive", "transmission_per_m"});
  expect_error(score(score_these + "--gain simple --set transmission_per_m=0.5"), 2,
               {"transmission_per_m", "simple", "beer_lambert"});
  expect_error(score(score_these + "--set gain=beer_lambert --set gain.a=1 "
                                   "--set transmission_per_m=0.5"),
               2, {"transmission_per_m", "gain.a"});
}

TEST_F(ScoreViewsCommand, SensorsFromAFile) {
  const auto sensor = file("narrow.yaml", "half_width_rad: 0.1\nrange_max_m: 2.5\n");
  const std::string arguments = "--map room.bt --views views.csv --gain simple";
  const json narrow = scored(arguments + " --sensor " + sensor);
  EXPECT_DOUBLE_EQ(narrow["sensor"]["range_max_m"].get<double>(), 2.5);
  EXPECT_LT(narrow["views"][0]["gain"].get<double>(),
            0.5 * scored(arguments)["views"][0]["gain"].get<double>());
  EXPECT_DOUBLE_EQ(scored(arguments + " --sensor " + sensor +
                          " --set sensor.range_max_m=3")["sensor"]["range_max_m"]
                       .get<double>(),
                   3.0);
}

TEST_F(ScoreViewsCommand, SampledViewsAreWrittenAndReadBack) {
  const std::string sampled = "--map room.bt --set views.height_m=1.05 --set views.positions=5 ";
  const Result first = score(sampled + "--seed 3 --write-views mine.csv");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_EQ(std::count(first.output.begin(), first.output.end(), '\n'), 1 + 5 * 8);
  EXPECT_EQ(score(sampled + "--seed 3").output, first.output);
  EXPECT_NE(score(sampled + "--seed 4").output, first.output);
  EXPECT_EQ(score("--map room.bt --views mine.csv").output, first.output);
  const json views = scored("--map room.bt --views mine.csv")["views"];
  EXPECT_TRUE(std::ranges::any_of(views, [](const json& view) { return view["x_m"] > -1.5; }))
      << "all about the region";
  expect_error(score(sampled + "--write-views none/mine.csv"), 5, {"none/mine.csv"});
  expect_error(score(sampled + "--write-views mine.csv"), 2, {"--write-views", "--overwrite"});
  EXPECT_EQ(score(sampled + "--write-views mine.csv --overwrite").exit_code, 0);
}

TEST_F(ScoreViewsCommand, ExamplesOfTheRepository) {
  const json result = scored(
      "--map room.bt --views assets/views/tabletop.csv "
      "--sensor assets/sensors/tilting_laser.yaml");
  EXPECT_EQ(result["views"].size(), 30U);
  EXPECT_EQ(scored("--map room.bt --views views.csv --sensor assets/sensors/rgbd.yaml"),
            scored("--map room.bt --views views.csv"));
}

TEST_F(ScoreViewsCommand, MapsThatCannotBeUsed) {
  const auto map_error = [&](const std::string& map, const std::vector<std::string>& parts) {
    expect_error(score("--views views.csv --map " + map), 3, parts);
  };
  map_error("none.bt", {"none.bt"});
  map_error(".", {"directory"});
  map_error("/dev/zero", {"/dev/zero", "regular file"});
  map_error(file("zero.bt", ""), {"zero.bt: is empty"});
  map_error(file("text.bt", "hello\nworld\n"), {"text.bt: not an OctoMap file"});
  map_error(file("noise.ot", std::string(5000, '\xa5')), {"noise.ot: not an OctoMap file"});
  map_error("views.csv", {"views.csv: not an OctoMap file"});
  const std::string header = "# Octomap OcTree binary file\nid OcTree\nres 0.1\n";
  map_error(file("claims.bt", header + "size 99999999999\ndata\n"), {"claims.bt: cut short"});
  map_error(file("deep.bt", header + "size 9\ndata\n" + std::string(100'000, '\xff')),
            {"deep.bt: damaged: more than 16 levels"});
  map_error(file("none_known.bt", header + "size 0\ndata\n"), {"none_known.bt", "no known cell"});
  const std::string whole = shell("cat '" + folder_.string() + "/room.ot'").output;
  map_error(file("cut.ot", whole.substr(0, whole.size() / 2)), {"cut.ot: cut short"});
}

TEST_F(ScoreViewsCommand, ViewsAndSensorsThatCannotBeUsed) {
  const auto views_error = [&](const std::string& views, const std::vector<std::string>& parts) {
    expect_error(score("--map room.bt --views " + views), 3, parts);
  };
  views_error("none.csv", {"--views", "none.csv"});
  views_error(file("empty.csv", ""), {"empty.csv: is empty", "x_m,y_m,z_m,yaw_rad"});
  views_error(file("bad.csv", "x_m,y_m,z_m,yaw_rad\n1,2,nan,0\n"), {"bad.csv:2", "z_m", "nan"});
  const auto sensor_error = [&](const std::string& sensor, int code,
                                const std::vector<std::string>& parts) {
    expect_error(score("--map room.bt --views views.csv --sensor " + sensor), code, parts);
  };
  sensor_error("none.yaml", 3, {"--sensor", "none.yaml"});
  sensor_error(file("empty.yaml", ""), 2, {"empty.yaml: empty"});
  sensor_error(file("key.yaml", "range: 3\n"), 2, {"key.yaml:1", "range", "range_max_m"});
  sensor_error(file("order.yaml", "range_min_m: 9\n"), 2, {"order.yaml", "range_min_m", "below"});
}

TEST_F(ScoreViewsCommand, OptionsThatDoNotGoTogether) {
  const std::string these = "--map room.bt --views views.csv ";
  expect_error(score(these + "--gain simpel"), 2, {"--gain", "simpel", "simple"});
  expect_error(score(these + "--set gain.b=1"), 2, {"gain"});
  expect_error(score(these + "--set foo=1"), 2, {"--set: foo: unknown key 'foo'"});
  expect_error(score(these + "--set views.positions=3"), 2, {"views", "--views"});
  expect_error(score(these + "--set region.min_m=[9,9,9]"), 2, {"region", "room.bt", "[2, 2, 2]"});
  expect_error(score("--map room.bt --set views.height_m=7"), 3, {"room.bt", "views.height_m"});
  const Result seed = score("--map room.bt --seed x");
  EXPECT_EQ(seed.exit_code, 2);
  EXPECT_THAT(seed.output, AllOf(HasSubstr("--seed: "), HasSubstr("'x'")));
  EXPECT_EQ(score("").exit_code, 2);
  EXPECT_EQ(score("--map room.bt --views ''").exit_code, 2);
}

TEST_F(ScoreViewsCommand, WarnsWhereNoViewSeesAnything) {
  const auto away = file("away.csv", "x_m,y_m,z_m,yaw_rad\n500,0,0,0\n");
  const Result result = score("--map room.bt --views " + away);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("no view sees anything"));
}

TEST_F(ScoreViewsCommand, MapsWiderThanAnyMemory) {
  file("far.bt", support::octomap_bytes({{{-32768, 0, 0}, 1, false},
                                         {{32767, 0, 0}, 1, false},
                                         {{0, 0, 0}, 8, true},
                                         {{-32, 0, 32767}, 8, false}},
                                        0.05));
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  const std::string limit;  // their shadow memory is larger than any limit
#else
  const std::string limit = "ulimit -v 4000000 && ";
#endif
  const Result limited = shell("cd '" + folder_.string() + "' && " + limit +
                               VANTAGE_BINARY " score-views --map far.bt --views views.csv");
  EXPECT_EQ(limited.exit_code, 0) << limited.output;
  expect_error(score("--map far.bt --views views.csv --set sensor.range_max_m=1000"), 3,
               {"far.bt", "view 10", "sensor.range_max_m", "region.min_m", "region.coarsen"});
}

TEST_F(ScoreViewsCommand, TheSeedIsOneUnlessOneIsGiven) {
  const std::string sampled = "--map room.bt --set views.height_m=1.05 --set views.positions=5";
  const Result result = score(sampled);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, score(sampled + " --seed 1").output);
  EXPECT_NE(result.output, score(sampled + " --seed 0").output);
}

/// Of equal ones the lower id comes first.
TEST_F(ScoreViewsCommand, TheTableIsThatOfTheJson) {
  file("four.csv",
       "x_m,y_m,z_m,yaw_rad,pitch_rad,id\n500,0,0,1,0.5,9\n-1,0.5,1.25,0.25,0.125,12\n"
       "500,1,0,2,0.25,4\n500,2,0,3,0.25,7\n");
  const std::string question = "--map room.bt --views four.csv --gain simple";
  const json result = scored(question);
  ASSERT_EQ(result["views"].size(), 4U);
  const json& best = result["views"][0];
  const char* keys[] = {"x_m", "y_m", "z_m", "yaw_rad", "pitch_rad"};
  const double values[] = {-1.0, 0.5, 1.25, 0.25, 0.125};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(best[keys[i]].get<double>(), values[i], 1e-9) << keys[i];
  }
  const auto gap = [](std::size_t blanks) { return std::string(blanks, ' '); };
  std::string text = " rank     id" + gap(8) + "x_m" + gap(8) + "y_m" + gap(8) + "z_m" + gap(2) +
                     "yaw_rad pitch_rad" + gap(4) + "gain [bits]\n";
  const int ids[] = {12, 4, 7, 9};
  for (std::size_t i = 0; i < 4; ++i) {
    const json& view = result["views"][i];
    EXPECT_EQ(view["rank"], i + 1);
    EXPECT_EQ(view["id"], ids[i]);
    const auto of = [&](const char* key) { return view[key].get<double>(); };
    text += fmt::format("{:>5} {:>6} {:>10.3f} {:>10.3f} {:>10.3f} {:>8.3f} {:>9.3f} {:>14.6g}\n",
                        i + 1, ids[i], of("x_m"), of("y_m"), of("z_m"), of("yaw_rad"),
                        of("pitch_rad"), of("gain"));
  }
  EXPECT_EQ(score(question + " 2>/dev/null").output, text);
}

/// 20 x 40 x 20 cells are known, 40 x 20 of them a wall, and one in the far corner.
TEST_F(ScoreViewsCommand, TheMapAndWhatCountsAreTold) {
  const std::string question = "--map room.bt --views views.csv ";
  const json result = scored(question);
  EXPECT_EQ(result["map"]["free_cells"], 20 * 40 * 20 - 40 * 20 + 1);
  EXPECT_NEAR(result["cell_m"].get<double>(), 0.1, 1e-9);
  EXPECT_NEAR(scored(question + "--set region.coarsen=2")["cell_m"].get<double>(), 0.2, 1e-9);
  const double least_m[] = {-2.0, -2.0, 0.0};
  const double most_m[] = {2.0, 2.0, 2.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(result["region"]["min_m"][axis].get<double>(), least_m[axis], 1e-9);
    EXPECT_NEAR(result["region"]["max_m"][axis].get<double>(), most_m[axis], 1e-9);
  }
  const json part = scored(question + "--set 'region.min_m=[0,0,0]'");
  EXPECT_NEAR(part["region"]["min_m"][0].get<double>(), 0.0, 1e-9);
}

}  // namespace
}  // namespace vantage
