// Lines of the protocol: what is told, and that no answer, however it is made, does harm.
#include "vantage/tasks/mapping/external/planner_protocol.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/mapping/external/asked_planner.hpp"
#include "tests/tasks/mapping/external/made_up_answer.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/tasks/mapping/external/planner_grids.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;
using support::made_up_answer;

template <class T>
std::vector<T> read_as(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

TEST(PlannerProtocol, TellsWhatTheRobotKnows) {
  const support::AskedSituation situation;
  const std::string line = request_line(situation.request(), 7, {{"occupancy", "here"}});
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const Json json = Json::parse(line);
  EXPECT_EQ(json["type"], "decide");
  EXPECT_EQ(json["decision"], 7);
  EXPECT_EQ(json["scans_left"], 4);
  EXPECT_EQ(json["time_s"], 12.5);
  EXPECT_TRUE(json["time_left_s"].is_null());  // no budget
  EXPECT_EQ(json["pose"], (Json{0.0, 0.0, 0.25}));
  EXPECT_EQ(json["grids"]["occupancy"], "here");
  ASSERT_EQ(json["candidates"].size(), 3U);
  const Json& view = json["candidates"][1];
  EXPECT_EQ(view["view"], 1);
  EXPECT_EQ(view["gain"], 10.0);
  EXPECT_EQ(view["interval"], (Json{5.0, 20.0}));
  EXPECT_TRUE(view["path_length_m"].is_null());
  EXPECT_TRUE(view["travel_s"].is_null());
  EXPECT_EQ(view["sensor"].size(), 5U);
  EXPECT_TRUE(json["candidates"][2]["exhausted"].get<bool>());
}

TEST(PlannerProtocol, IntroducesTheEpisode) {
  const PlannerIntroduction introduction{.task = "tabletop",
                                         .seed = 7,
                                         .scans = 4,
                                         .gain = "simple",
                                         .gain_unit = "cells",
                                         .budget = {.energy_j = 12.5}};
  EXPECT_EQ(
      introduction_line(introduction),
      R"({"type":"hello","protocol":"vantage-planner","version":1,"task":"tabletop","seed":7,)"
      R"("scans":4,"time_s":null,"energy_j":12.5,"gain":"simple","gain_unit":"cells"})");
  EXPECT_EQ(end_line(), R"({"type":"end"})");
}

TEST(PlannerProtocol, TakesTheNameThatAPlannerGivesItself) {
  const std::string speaks = R"({"protocol": "vantage-planner", "version": 1)";
  EXPECT_EQ(read_introduction(speaks + R"(, "name": "mine"})"), "mine");
  EXPECT_EQ(read_introduction(speaks + R"(, "name": 3})"), "");
  EXPECT_EQ(read_introduction(speaks + "}"), "");
  EXPECT_THROW(read_introduction(R"({"protocol": "vantage-planner", "version": "1"})"),
               BadDecision);
  EXPECT_THROW(read_introduction(R"({"protocol": "another", "version": 1})"), BadDecision);
}

void spend_some_and_see(MapSituation& now) {
  now.energy_j = 340.0;
  now.left = {.time_s = 81.5, .energy_j = 660.0};
  now.scan_s = 20.5;
  now.field_of_view = {.half_width_rad = 0.5,
                       .tilt_min_rad = -0.25,
                       .tilt_max_rad = 0.75,
                       .range_min_m = 0.125,
                       .range_max_m = 8.0};
}

TEST(PlannerProtocol, TellsWhatIsSpentAndWhatIsSeen) {
  const support::AskedSituation situation;
  DecisionRequest request = situation.request();
  MapSituation& now = request.situation;
  spend_some_and_see(now);
  const Json json = Json::parse(request_line(request, 1, {}));
  EXPECT_EQ(json["energy_j"], 340.0);
  EXPECT_EQ(json["time_left_s"], 81.5);
  EXPECT_EQ(json["energy_left_j"], 660.0);
  EXPECT_EQ(json["scan_s"], 20.5);
  EXPECT_EQ(json["scans"], 1);
  EXPECT_EQ(json["field_of_view"]["half_width_rad"], 0.5);
  EXPECT_EQ(json["field_of_view"]["tilt_min_rad"], -0.25);
  EXPECT_EQ(json["field_of_view"]["range_max_m"], 8.0);
  now.field_of_view.panorama = true;
  const Json all_round = Json::parse(request_line(request, 1, {}));
  EXPECT_NEAR(all_round["field_of_view"]["half_width_rad"].get<double>(), std::acos(-1.0), 1e-12);
}

TEST(PlannerProtocol, SensorsLookWhereTheyLook) {
  support::AskedSituation situation;
  situation.candidates[0].T_world_sensor =
      Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());  // 0.3 rad down
  const Json json = Json::parse(request_line(situation.request(), 1, {}));
  const Json& sensor = json["candidates"][0]["sensor"];
  EXPECT_EQ(sensor[1], 2.0);
  EXPECT_NEAR(sensor[3].get<double>(), 0.7, 1e-12);
  EXPECT_NEAR(sensor[4].get<double>(), 0.3, 1e-12);
}

TEST(PlannerGrids, HoldWhatTheirHeadersSay) {
  const support::TemporaryDirectory folder;
  support::AskedSituation situation;
  for (std::size_t i = 0; i < situation.grid.size(); ++i) {
    situation.grid.log_odds[i] = 0.5F * static_cast<float>(i);
  }
  const Json grids = write_planner_grids(situation.request(), folder.path());
  EXPECT_EQ(grids["occupancy"]["shape"], (Json{4, 3, 2}));
  EXPECT_EQ(grids["occupancy"]["min_corner_m"], (Json{-0.5, -0.5, 0.0}));
  EXPECT_EQ(grids["occupancy"]["cell_m"][2], 0.5);
  EXPECT_EQ(read_as<float>(folder / grids["occupancy"]["file"]), situation.grid.log_odds);
  const auto floor = read_as<std::uint8_t>(folder / grids["floor"]["file"]);
  const auto ways = read_as<double>(folder / grids["ways"]["file"]);
  const FloorMap& map = situation.paths.map;
  ASSERT_EQ(floor.size(), map.size());
  const auto at = [&](double x_m, double y_m) { return map.index(map.cell_at({x_m, y_m})); };
  EXPECT_EQ(floor[at(0.0, 0.0)], 0);
  EXPECT_EQ(floor[at(1.1, 0.0)], 2);
  EXPECT_EQ(ways, situation.paths.cost);
  EXPECT_TRUE(std::isinf(ways[at(1.7, 0.0)]));
  // The next decision's are in the same files.
  situation.grid.log_odds[5] = -3.0F;
  write_planner_grids(situation.request(), folder.path());
  EXPECT_EQ(read_as<float>(folder / "occupancy.raw")[5], -3.0F);
}

TEST(PlannerGrids, AreNotWrittenThroughALinkOfThePlanners) {
  const support::TemporaryDirectory folder;
  std::ofstream(folder / "precious") << "kept";
  std::filesystem::create_symlink(folder / "precious", folder / "occupancy.raw");
  const support::AskedSituation situation;
  EXPECT_THROW(write_planner_grids(situation.request(), folder.path()), OutputError);
  EXPECT_EQ(std::filesystem::file_size(folder / "precious"), 4U);
}

TEST(PlannerGrids, DoNotWaitForAPipeOfThePlanners) {
  const support::TemporaryDirectory folder;
  ASSERT_EQ(::mkfifo((folder / "occupancy.raw").c_str(), 0600), 0);
  const support::AskedSituation situation;
  EXPECT_THROW(write_planner_grids(situation.request(), folder.path()), OutputError);
}

TEST(LineBuffer, PutsPiecesTogetherAndKeepsItsBound) {
  LineBuffer buffer(8);
  EXPECT_TRUE(buffer.add("ab"));
  EXPECT_FALSE(buffer.take());
  EXPECT_TRUE(buffer.add("c\nd\n"));
  EXPECT_EQ(buffer.take(), "abc");
  EXPECT_EQ(buffer.take(), "d");
  EXPECT_FALSE(buffer.take());
  EXPECT_TRUE(buffer.add("12345678"));
  EXPECT_FALSE(buffer.add("9"));
  EXPECT_EQ(buffer.waiting(), 8U);
}

TEST(LineBuffer, ShowsWhatIsNoText) {
  EXPECT_EQ(printable("a\tb\xc3\xa4"), "a\\x09b\\xc3\\xa4");
  EXPECT_EQ(printable("abcdef", 3), "abc ...");
}

/// @return whether it was a decision that can be carried out
bool hold_against(const std::string& line, const DecisionRequest& request) {
  try {
    const OutsideDecision decision = read_answer(line);
    check_decision(decision, request);
    if (const auto* view = std::get_if<std::size_t>(&decision)) {
      EXPECT_LT(*view, 2U);
    }
    return true;
  } catch (const BadDecision& error) {
    EXPECT_LT(std::strlen(error.what()), 400U);
    for (const char* c = error.what(); *c != 0; ++c) EXPECT_TRUE(*c >= 0x20 && *c < 0x7f);
    return false;
  }
}

TEST(PlannerProtocol, ReadsAnythingWithoutHarm) {
  const support::AskedSituation situation;
  const DecisionRequest request = situation.request();
  Rng rng(24);
  LineBuffer buffer(4096);
  std::size_t lines = 0;
  std::size_t good = 0;
  std::size_t floods = 0;
  for (int message = 0; message < 100'000; ++message) {
    if (!buffer.add(made_up_answer(rng))) {
      ++floods;
      buffer = LineBuffer(4096);
    }
    while (const auto line = buffer.take()) {
      ++lines;
      good += hold_against(*line, request) ? 1U : 0U;
      if (rng.uniform() < 0.1) {
        try {
          read_introduction(*line);
        } catch (const BadDecision&) {
        }
      }
    }
  }
  EXPECT_GT(lines, 50'000U);
  EXPECT_GT(good, 100U);  // it comes to what is right as well
  EXPECT_LT(good, lines);
  EXPECT_GT(floods, 10U);
}

TEST(PlannerProtocol, TellsAllOfARequest) {
  support::AskedSituation situation;
  Candidate view;
  view.id = 5;  // its own, not that of the protocol
  view.T_world_sensor = make_pose({1.5, -2.5, 1.25}, 0.0);
  view.path_length_m = 3.5;
  view.gain_bits = 12.5;
  view.reachable = false;
  view.exhausted = true;
  situation.candidates = {view};
  DecisionRequest request = situation.request();
  request.travel_s = {7.5};
  request.interval_cells = {};
  MapSituation& now = request.situation;
  now.T_world_base = {0.5, -0.75, 0.25};
  now.scans = 3;
  spend_some_and_see(now);
  EXPECT_EQ(Json::parse(request_line(request, 2, Json::object())), Json::parse(R"({
    "type": "decide", "decision": 2, "scans": 3, "scans_left": 4, "time_s": 12.5,
    "time_left_s": 81.5, "energy_j": 340, "energy_left_j": 660, "scan_s": 20.5,
    "pose": [0.5, -0.75, 0.25],
    "field_of_view": {"panorama": false, "half_width_rad": 0.5, "tilt_min_rad": -0.25,
                      "tilt_max_rad": 0.75, "range_min_m": 0.125, "range_max_m": 8},
    "candidates": [{"view": 0, "sensor": [1.5, -2.5, 1.25, 0, 0], "gain": 12.5,
                    "path_length_m": 3.5, "travel_s": 7.5, "reachable": false,
                    "exhausted": true}],
    "grids": {}})"));
}

TEST(PlannerProtocol, TakesNoPoseThatIsNotThreeNumbers) {
  for (const char* pose : {"[]", "[1, 2]", "[1, 2, 3, 4]", "[1, \"2\", 3]", "[1, 2, null]", "null",
                           "3", R"({"x": 1, "y": 2, "yaw": 3})"}) {
    EXPECT_THROW(read_answer(std::string(R"({"pose": )") + pose + "}"), BadDecision) << pose;
  }
  const auto whole = std::get<Pose2>(read_answer(R"({"pose": [1, -2, 3]})"));
  EXPECT_EQ(whole.x_m, 1.0);
  EXPECT_EQ(whole.y_m, -2.0);
  EXPECT_EQ(whole.yaw_rad, 3.0);
}

TEST(PlannerProtocol, HasAVersionThatIsAWholeNumber) {
  EXPECT_THROW(read_introduction(R"({"protocol": "vantage-planner", "version": 1.0})"),
               BadDecision);
  EXPECT_THROW(read_introduction(R"({"protocol": "vantage-planner", "version": 0})"), BadDecision);
  EXPECT_EQ(read_introduction(R"({"protocol": "vantage-planner", "version": 1, "name": "a\tb"})"),
            "a\\x09b")
      << "fit to be shown";
}

TEST(PlannerGrids, HaveHeadersThatSayWhereTheyLie) {
  const support::TemporaryDirectory folder;
  support::AskedSituation situation;
  situation.grid = OccupancyGrid(make_grid_frame({1.0, 2.0, 0.5}, {2.0, 3.0, 1.0}, {4, 3, 2}));
  FloorMap floor({-1.5, -0.5}, 0.25, 12, 4);
  floor.log_odds.assign(floor.size(), -2.0F);
  situation.paths =
      make_path_field(floor, {0.0, 0.0, 0.0}, {.footprint_radius_m = 0.2, .margin_m = 0.05});
  std::ofstream(folder / "floor.raw") << std::string(1000, 'x');  // longer than it will be
  const Json grids = write_planner_grids(situation.request(), folder.path());
  Json occupancy = Json::parse(R"({
    "file": "occupancy.raw", "dtype": "float32", "order": "x fastest", "shape": [4, 3, 2],
    "min_corner_m": [0, 0.5, 0], "cell_m": [0.5, 1, 0.5]})");
  occupancy["free_at_most"] = kFreeLogOdds;
  occupancy["occupied_at_least"] = kOccupiedLogOdds;
  EXPECT_EQ(grids["occupancy"], occupancy);
  EXPECT_EQ(grids["floor"], Json::parse(R"({
    "file": "floor.raw", "dtype": "uint8", "order": "x fastest", "shape": [12, 4],
    "min_corner_m": [-1.5, -0.5], "cell_m": [0.25, 0.25]})"));
  EXPECT_EQ(grids["ways"], Json::parse(R"({
    "file": "ways.raw", "dtype": "float64", "order": "x fastest", "shape": [12, 4],
    "min_corner_m": [-1.5, -0.5], "cell_m": [0.25, 0.25]})"));
  EXPECT_EQ(std::filesystem::file_size(folder / "floor.raw"), 48U);
  EXPECT_EQ(std::filesystem::status(folder / "ways.raw").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

/// Of the other errors the planner is not to blame.
TEST(PlannerGrids, AreSpoiltByWhatAPlannerDoesToItsFolder) {
  const auto is_spoilt = [](const std::filesystem::path& folder) {
    const support::AskedSituation situation;
    try {
      write_planner_grids(situation.request(), folder);
    } catch (const SpoiltFolder&) {
      return true;
    }
    return false;
  };
  const support::TemporaryDirectory folder;
  const auto path = folder / "occupancy.raw";
  EXPECT_FALSE(is_spoilt(folder.path()));
  EXPECT_TRUE(is_spoilt(folder / "gone"));
  EXPECT_TRUE(is_spoilt(path)) << "no folder";
  std::filesystem::remove(path);
  std::filesystem::create_symlink(folder / "floor.raw", path);
  EXPECT_TRUE(is_spoilt(folder.path())) << "a link";
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  EXPECT_TRUE(is_spoilt(folder.path())) << "a folder";
  std::filesystem::remove(path);
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_TRUE(is_spoilt(folder.path())) << "a pipe that nobody reads";
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  EXPECT_TRUE(is_spoilt(folder.path())) << "a pipe that is read";
  ::close(reader);
}

}  // namespace
}  // namespace vantage
