// The files of a run folder as the page takes them, each for itself.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/clouds/ply.hpp"
#include "vantage/report/drawn_scene.hpp"
#include "vantage/report/former_run.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/report/page.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/report/report_embed.hpp"
#include "vantage/report/run_plans.hpp"

namespace vantage {
namespace {
using nlohmann::json;

class ReportFile : public testing::Test {
 protected:
  std::filesystem::path with(const std::string& text) {
    write_file(folder_ / "file", text);
    return folder_ / "file";
  }
  /// What a reader says of such a file, from its name on.
  template <class Read>
  std::string error_of(const std::string& text, Read&& read) {
    try {
      read(with(text));
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.substr(std::min(what.find("file:"), what.size()));
    }
    return "no error";
  }
  support::TemporaryDirectory folder_;
};

TEST_F(ReportFile, OfATrajectoryIsRoundedAndThinned) {
  const json one = trajectory_json(with("1.23456 0.123456 -2.34567 3.45678 0 0 0 1\n"));
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(one[0][0].get<double>(), 1.235, 1e-12);
  EXPECT_NEAR(one[0][1].get<double>(), 0.1235, 1e-12);
  EXPECT_NEAR(one[0][2].get<double>(), -2.3457, 1e-12);
  EXPECT_NEAR(one[0][3].get<double>(), 3.4568, 1e-12);
  EXPECT_EQ(one[0][4], 0.0);
  const auto times = [&](int samples) {
    std::string text;
    for (int i = 0; i < samples; ++i) text += fmt::format("{} 0 0 0 0 0 0 1\n", i);
    return trajectory_json(with(text));
  };
  EXPECT_EQ(times(4000).size(), 4000U);
  EXPECT_EQ(times(4001).size(), 2001U);
  const json third = times(8001);
  ASSERT_EQ(third.size(), 2668U);
  EXPECT_NEAR(third[1][0].get<double>(), 3.0, 1e-9);
  EXPECT_NEAR(third[2666][0].get<double>(), 7998.0, 1e-9);
  EXPECT_NEAR(third[2667][0].get<double>(), 8000.0, 1e-9) << "the last one is always there";
}

TEST_F(ReportFile, OfATrajectoryNamesItsLine) {
  const auto error = [&](const std::string& text) { return error_of(text, read_tum); };
  EXPECT_EQ(error("# c\n\n0 0 0 0 0 0 0 1\n1 2 3\n"),
            "file:4: expected 8 numbers: time x y z qx qy qz qw");
  EXPECT_EQ(error("0 0 0 0 0 0 0 0\n"), "file:1: the quaternion is zero");
  EXPECT_EQ(error(""), "file:1: the file is empty");
  const auto samples = read_tum(with("1 2 3 4 0 0 3 4\n"));
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(samples[0].yaw_rad, 2.0 * std::atan2(3.0, 4.0), 1e-12);
  EXPECT_NEAR(samples[0].q_world_body.norm(), 1.0, 1e-12);
  EXPECT_NEAR(samples[0].q_world_body.z(), 0.6, 1e-12);
}

TEST_F(ReportFile, OfCommaSeparatedValuesNamesItsLine) {
  const auto error = [&](const std::string& text) { return error_of(text, read_csv); };
  EXPECT_EQ(error("a,b\n\n1,2\n3\n"), "file:4: 1 fields, the header has 2");
  EXPECT_EQ(error("a,b\n1,\"2\n"), "file:2: a quote is not closed");
  EXPECT_EQ(error("\n"), "file:1: no header line");
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(csv_field("a\nb,\r"), "\"a b, \"") << "a line is a record";
}

constexpr const char* kPlanColumns =
    "scan,time_s,change,saved_s,stop,candidate,x_m,y_m,yaw_rad,arrival_s,departure_s,gain,beyond,"
    "gain_unit\n";

TEST_F(ReportFile, OfPlansHoldsTheirStops) {
  const auto file = with(std::string(kPlanColumns) +
                         "2,14.5,first,,1,7,1,2,0.5,3,13,900,4,cells\n"
                         "2,14.5,first,,2,,1.5,2.5,0.75,23,33,90,5,cells\n"
                         "4,40,first,6.5,1,0,3,4,1,5,6,8,0,bits\n");
  const std::vector<RecordedPlan> plans = read_plans(file);
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0].scan, 2U);
  EXPECT_EQ(plans[0].time_s, 14.5);
  EXPECT_EQ(plans[0].gain_unit, "cells");
  ASSERT_EQ(plans[0].tour.stops.size(), 2U);
  const PlannedStop& stop = plans[0].tour.stops[1];
  EXPECT_EQ(stop.id, -1) << "of no candidate";
  EXPECT_EQ(stop.place_m, Eigen::Vector2d(1.5, 2.5));
  EXPECT_EQ(stop.yaw_rad, 0.75);
  EXPECT_EQ(stop.arrival_s, 23.0);
  EXPECT_EQ(stop.departure_s, 33.0);
  EXPECT_EQ(stop.gain, 90.0);
  EXPECT_EQ(stop.beyond, 5.0);
  EXPECT_EQ(plans[0].tour.stops[0].id, 7);
  EXPECT_EQ(plans[1].scan, 4U);
  EXPECT_EQ(plans[1].tour.stops[0].id, 0);
  const json page = plans_json(file);
  EXPECT_EQ(page[0]["ends_s"], 33.0);
  EXPECT_EQ(page[0]["unit"], "cells");
  EXPECT_EQ(page[0]["change"], "first");
  EXPECT_EQ(page[0]["stops"][1], json({{"id", -1},
                                       {"x", 1.5},
                                       {"y", 2.5},
                                       {"yaw", 0.75},
                                       {"arrival_s", 23.0},
                                       {"departure_s", 33.0},
                                       {"gain", 90.0},
                                       {"beyond", 5.0}}));
}

TEST_F(ReportFile, OfPlansIsInOrder) {
  const auto error = [&](const std::string& rows) {
    return error_of(kPlanColumns + rows, read_plans);
  };
  const auto row = [](const char* scan, const char* stop, const char* candidate = "7") {
    return fmt::format("{},1,first,,{},{},1,2,3,4,5,6,7,cells\n", scan, stop, candidate);
  };
  EXPECT_EQ(error(row("2", "1") + row("3", "1")), "no error");
  EXPECT_EQ(error(row("2", "1") + row("2", "1")), "file:3: scan: not in order");
  EXPECT_EQ(error(row("2", "1") + row("2", "3")), "file:3: stop: does not follow the row before");
  EXPECT_EQ(error(row("2", "1") + row("3", "2")), "file:3: stop: does not follow the row before");
  EXPECT_EQ(error(row("2", "2")), "file:2: stop: does not follow the row before");
  EXPECT_EQ(error(row("2", "0")), "file:2: stop: expected a whole number from 1 on");
  EXPECT_EQ(error(row("0", "1")), "file:2: scan: expected a whole number from 1 on");
  EXPECT_EQ(error(row("1.5", "1")), "file:2: scan: expected a whole number from 1 on");
  EXPECT_EQ(error(row("2e9", "1")), "file:2: scan: expected a whole number from 1 on");
  EXPECT_EQ(error(row("2", "1", "-1")), "file:2: candidate: expected a whole number from 0 on");
  EXPECT_EQ(error(row("2x", "1")), "file:2: scan: expected a number");
}

TEST_F(ReportFile, OfACloudIsQuantisedInItsBox) {
  PointCloud cloud;
  cloud.points = {{-1.0F, 2.0F, 3.0F}, {1.0F, 6.0F, 11.0F}};
  write_ply(folder_ / "cloud.ply", cloud);
  const json found = cloud_json(folder_ / "cloud.ply");
  EXPECT_EQ(found["total"], 2);
  EXPECT_EQ(found["kept"], 2);
  EXPECT_EQ(found["min_m"], json({-1.0, 2.0, 3.0}));
  EXPECT_NEAR(found["scale_m"][0].get<double>(), 2.0 / 65535.0, 1e-10);
  EXPECT_NEAR(found["scale_m"][1].get<double>(), 4.0 / 65535.0, 1e-10);
  EXPECT_NEAR(found["scale_m"][2].get<double>(), 8.0 / 65535.0, 1e-10);
  EXPECT_EQ(found["data"], base64(std::string(6, '\0') + std::string(6, '\xff')));
}

TEST_F(ReportFile, OfNoPointsThereIsNothingToDraw) {
  write_ply(folder_ / "cloud.ply", {});
  EXPECT_TRUE(cloud_json(folder_ / "cloud.ply").is_null());
  DrawnScene scene;
  scene.extent_m = {Eigen::Vector3f(-5.0F, -6.0F, 0.0F), Eigen::Vector3f(5.0F, 6.0F, 2.5F)};
  write_drawn_scene(folder_ / "scene.bin", scene);
  EXPECT_TRUE(scene_json(folder_ / "scene.bin").is_null());
}

TEST(PackedVoxels, KeepWhatFillsAtTheLastStepThatAFileCanTell) {
  const VoxelMap map{{0.1, 0.1, 0.1},
                     {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.1, 0.1, 0.1)},
                     {{0.05F, 0.05F, 0.05F, 65535, kVoxelOccupied}}};
  ASSERT_EQ(pack_voxels(map, 1).voxels.size(), 1U);
  EXPECT_EQ(pack_voxels(map, 1).voxels[0].step_and_kind, 0x7FFF);
}

/// Every second of ten cells in a row, of which four are kept.
TEST(PackedVoxelsOfARow, AreSpreadEvenly) {
  VoxelMap map{{0.1, 0.1, 0.1}, {Eigen::Vector3d::Zero(), Eigen::Vector3d(2.0, 0.3, 0.2)}, {}};
  for (int i = 0; i < 10; ++i) {
    map.voxels.push_back({0.2F * static_cast<float>(i) + 0.05F, 0.15F, 0.05F, 3, kVoxelOccupied});
  }
  map.voxels.push_back({0.05F, 0.15F, 0.05F, 2, kVoxelOccupied});
  const PackedVoxels all = pack_voxels(map, 100);
  EXPECT_TRUE((all.cells == Eigen::Array3i(20, 3, 2)).all());
  EXPECT_EQ(all.total[0], 11U);
  EXPECT_EQ(all.surface[0], 10U);
  ASSERT_EQ(all.voxels.size(), 10U);
  EXPECT_EQ(all.voxels[0].step_and_kind, 2) << "the first scan that found it";
  EXPECT_EQ(all.voxels[1].step_and_kind, 3);
  const PackedVoxels some = pack_voxels(map, 4);
  EXPECT_EQ(some.kept[0], 4U);
  std::vector<int> columns;
  for (const PackedVoxel& voxel : some.voxels) {
    columns.push_back(voxel.cell[0]);
    EXPECT_EQ(voxel.cell[1], 1);
    EXPECT_EQ(voxel.cell[2], 0);
  }
  EXPECT_THAT(columns, testing::ElementsAre(0, 4, 10, 14));
}

TEST(FormerRuns, TellUnseenObjectsApart) {
  json flight = {{"mean_entropy_nats", 1.0},
                 {"objects",
                  {{{"observations", 2}, {"entropy_nats", 0.5}},
                   {{"observations", 0}, {"entropy_nats", 3.0}},
                   {{"observations", 4}, {"entropy_nats", 2.0}}}}};
  bring_up_to_date(flight);
  EXPECT_EQ(flight["objects_unseen"], 1);
  EXPECT_EQ(flight["mean_entropy_observed_nats"], 1.25);
  json unseen = {{"mean_entropy_nats", 1.0},
                 {"objects", json::array({{{"observations", 0}, {"entropy_nats", 3.0}}})}};
  bring_up_to_date(unseen);
  EXPECT_EQ(unseen["objects_unseen"], 1);
  EXPECT_TRUE(unseen["mean_entropy_observed_nats"].is_null());
}

TEST(FormerRuns, CountedStepsFromZero) {
  CsvTable views{{"time_s", "view", "path_length_m"}, {{"1", "0", "2"}, {"2", "1", "3"}}};
  bring_up_to_date(views);
  EXPECT_THAT(views.columns, testing::ElementsAre("time_s", "view", "leg_length_m"));
  EXPECT_EQ(views.rows[0][1], "1");
  EXPECT_EQ(views.rows[1][1], "2");
  CsvTable waypoints{{"time_s", "waypoint", "path_length_m"}, {{"1", "0", "2"}}};
  bring_up_to_date(waypoints);
  EXPECT_EQ(waypoints.columns[2], "path_length_m") << "it was the way there all along";
  EXPECT_EQ(waypoints.rows[0][1], "1");
  CsvTable present{{"time_s", "scan", "path_length_m", "leg_length_m"}, {{"1", "1", "2", "2"}}};
  bring_up_to_date(present);
  EXPECT_EQ(present.columns[2], "path_length_m");
  EXPECT_EQ(present.rows[0][1], "1");
}

TEST(JsonFiles, AreNoDeeperThanSixtyFourLevels) {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '[') + "1" + std::string(levels, ']');
  };
  EXPECT_NO_THROW((void)parsed_json<json>(nested(64), "x"));
  EXPECT_THROW((void)parsed_json<json>(nested(65), "x"), InputError);
  EXPECT_TRUE(json_object_or_null<json>("[1]").is_null());
  EXPECT_TRUE(json_object_or_null<json>("{").is_null());
  EXPECT_EQ(json_object_or_null<json>(R"({"a": 1})")["a"], 1);
}

TEST(HtmlText, HasNoSignsOfItsOwn) {
  EXPECT_EQ(html_escaped("a & b <c> \"d\" 'e'"), "a &amp; b &lt;c&gt; &quot;d&quot; &#39;e&#39;");
}

TEST_F(ReportFile, OfACloudHasHalfAHundredThousandPointsAtMost) {
  const auto embedded = [&](std::size_t points) {
    PointCloud cloud;
    for (std::size_t i = 0; i < points; ++i) {
      cloud.points.emplace_back(static_cast<float>(i), static_cast<float>(i % 3), 2.0F);
    }
    write_ply(folder_ / "cloud.ply", cloud);
    return cloud_json(folder_ / "cloud.ply");
  };
  EXPECT_EQ(embedded(50'000)["kept"], 50'000);
  const json thinned = embedded(50'001);
  EXPECT_EQ(thinned["total"], 50'001);
  EXPECT_EQ(thinned["kept"], 25'001);
  EXPECT_NEAR(thinned["scale_m"][0].get<double>(), 50'000.0 / 65535.0, 1e-6);
  EXPECT_NEAR(thinned["scale_m"][2].get<double>(), 1e-6 / 65535.0, 1e-15) << "it is flat";
}

TEST_F(ReportFile, OfASceneIsQuantisedInItsBox) {
  DrawnScene scene;
  scene.extent_m = {Eigen::Vector3f(-5.0F, -6.0F, 0.0F), Eigen::Vector3f(5.0F, 6.0F, 2.5F)};
  scene.vertices_m = {
      {-1.0F, -2.0F, 0.0F}, {1.0F, -2.0F, 0.0F}, {1.0F, 2.0F, 0.0F}, {1.0F, 2.0F, 3.0F}};
  scene.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
  scene.triangles[0] = {{0, 1, 2}};
  scene.triangles[5] = {{1, 2, 3}, {0, 2, 3}};
  write_drawn_scene(folder_ / "scene.bin", scene);
  const json found = scene_json(folder_ / "scene.bin");
  EXPECT_EQ(found["min_m"], json({-1.0, -2.0, 0.0}));
  EXPECT_NEAR(found["scale_m"][0].get<double>(), 2.0 / 65535.0, 1e-10);
  EXPECT_NEAR(found["scale_m"][1].get<double>(), 4.0 / 65535.0, 1e-10);
  EXPECT_NEAR(found["scale_m"][2].get<double>(), 3.0 / 65535.0, 1e-10);
  EXPECT_EQ(found["extent"]["min"], json({-5.0, -6.0, 0.0}));
  EXPECT_EQ(found["extent"]["max"], json({5.0, 6.0, 2.5}));
  EXPECT_EQ(found["parts"], json({1, 0, 0, 0, 0, 2}));
  const std::string low(2, '\0');
  const std::string high(2, '\xff');
  EXPECT_EQ(found["positions"],
            base64(low + low + low + high + low + low + high + high + low + high + high + high));
  EXPECT_EQ(found["colours"], base64("\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b\x0c"));
  std::string corners;
  for (const char corner : {'\0', '\1', '\2', '\1', '\2', '\3', '\0', '\2', '\3'}) {
    corners += corner + std::string(3, '\0');
  }
  EXPECT_EQ(found["triangles"], base64(corners));
}

/// Of no voxels, in cells of that size from the origin to there.
TEST_F(ReportFile, OfVoxelsHasAGridOfSoManyCells) {
  const auto error = [&](double cell_m, const std::array<double, 3>& to_m) {
    std::string bytes = "VTGVOX01";
    const auto put = [&](auto number) {
      bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
    };
    for (const double size_m : {cell_m, cell_m, cell_m, 0.0, 0.0, 0.0}) put(size_m);
    for (const double end_m : to_m) put(end_m);
    put(std::uint64_t{0});
    return error_of(bytes, read_voxels);
  };
  const auto too_many = testing::HasSubstr("the grid has too many cells");
  EXPECT_EQ(error(1.0, {65535.0, 1.0, 1.0}), "no error");
  EXPECT_THAT(error(1.0, {65536.0, 1.0, 1.0}), too_many);
  EXPECT_EQ(error(1.0, {4096.0, 4096.0, 4.0}), "no error") << "2^26";
  EXPECT_THAT(error(1.0, {4096.0, 4096.0, 5.0}), too_many);
  EXPECT_EQ(error(1.0, {8192.0, 8192.0, 0.5}), "no error") << "one layer";
  const auto empty = testing::HasSubstr("cell size or box is empty");
  EXPECT_THAT(error(0.0, {1.0, 1.0, 1.0}), empty);
  EXPECT_THAT(error(-1.0, {1.0, 1.0, 1.0}), empty);
  EXPECT_THAT(error(1.0, {1.0, -1.0, 1.0}), empty);
  const auto not_finite = testing::HasSubstr("cell size or box is not finite");
  EXPECT_THAT(error(std::nan(""), {1.0, 1.0, 1.0}), not_finite);
  EXPECT_THAT(error(1.0, {1.0, HUGE_VAL, 1.0}), not_finite);
}

TEST(FormerRuns, CalledTheLengthOfALegThatOfThePath) {
  json metrics = json::parse(R"({"observations": [
    {"path_length_m": 2.0, "flight": {"path_length_m": 7.0}}, {"path_length_m": 3.0}]})");
  bring_up_to_date(metrics);
  const json& steps = metrics["observations"];
  EXPECT_EQ(steps[0]["leg_length_m"], 2.0);
  EXPECT_EQ(steps[0]["path_length_m"], 2.0);
  EXPECT_EQ(steps[0]["flight"], json({{"leg_length_m", 7.0}}));
  EXPECT_EQ(steps[1]["leg_length_m"], 3.0);
  EXPECT_EQ(steps[1]["path_length_m"], 5.0) << "all the way from the start";
  EXPECT_FALSE(metrics.contains("objects_unseen"));
  const json present = metrics;
  bring_up_to_date(metrics);
  EXPECT_EQ(metrics, present);
  json told = json::parse(R"({"mean_entropy_nats": 1.0, "objects_unseen": 9,
    "objects": [{"observations": 0, "entropy_nats": 3.0}]})");
  bring_up_to_date(told);
  EXPECT_EQ(told["objects_unseen"], 9);
  json apart = json::parse(R"({"objects": [{"observations": 0, "entropy_nats": 3.0}]})");
  bring_up_to_date(apart);
  EXPECT_FALSE(apart.contains("objects_unseen")) << "of another task";
}

/// Two occupied voxels in the last cell of the grid, one in the first of which nothing is known.
TEST_F(ReportFile, OfVoxelsIsPackedWithItsGrid) {
  VoxelMap map{{0.5, 0.25, 1.0}, {Eigen::Vector3d(-1, -2, 0), Eigen::Vector3d(1, 2, 3)}, {}};
  map.voxels.push_back({0.75F, 1.875F, 2.5F, 6, kVoxelOccupied});
  map.voxels.push_back({0.8F, 1.9F, 2.6F, 4, kVoxelOccupied});
  map.voxels.push_back({-0.75F, -1.875F, 0.5F, 9, kVoxelUnobserved});
  write_voxels(folder_ / "voxels.bin", map);
  const json found = voxels_json(folder_ / "voxels.bin");
  EXPECT_EQ(found["cell_size_m"], json({0.5, 0.25, 1.0}));
  EXPECT_EQ(found["min_m"], json({-1.0, -2.0, 0.0}));
  EXPECT_EQ(found["max_m"], json({1.0, 2.0, 3.0}));
  EXPECT_EQ(found["cells"], json({4, 16, 3}));
  EXPECT_EQ(found["total"], json({2, 1}));
  EXPECT_EQ(found["surface"], json({1, 1}));
  EXPECT_EQ(found["kept"], json({1, 1}));
  EXPECT_EQ(found["data"], base64(std::string("\3\0\17\0\2\0\4\0"
                                              "\0\0\0\0\0\0\0\x80",
                                              16)));
  map.voxels.front().step = map.voxels[1].step = 40'000;
  EXPECT_EQ(pack_voxels(map, 10).voxels.front().step_and_kind, 0x7FFF) << "as late as there is";
}

TEST_F(ReportFile, OfVoxelsHasSixteenBytesAVoxel) {
  VoxelMap map{{0.5, 0.25, 1.0}, {Eigen::Vector3d(-1, -2, 0), Eigen::Vector3d(1, 2, 3)}, {}};
  map.voxels.push_back({0.75F, 1.875F, 2.5F, 4, kVoxelUnobserved});
  write_voxels(folder_ / "voxels.bin", map);
  std::string bytes = "VTGVOX01";
  const auto put = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  for (const double value : {0.5, 0.25, 1.0, -1.0, -2.0, 0.0, 1.0, 2.0, 3.0}) put(value);
  put(std::uint64_t{1});
  for (const float value : {0.75F, 1.875F, 2.5F}) put(value);
  put(std::uint16_t{4});
  put(std::uint8_t{1});
  put(std::uint8_t{0});
  EXPECT_EQ(read_file(folder_ / "voxels.bin"), bytes);
  EXPECT_EQ(error_of(bytes, read_voxels), "no error");
  EXPECT_THAT(error_of(bytes + std::string(16, '\0'), read_voxels),
              testing::HasSubstr("header says 1 voxels, the file holds 2.0"));
  EXPECT_THAT(error_of(bytes.substr(0, bytes.size() - 8), read_voxels),
              testing::HasSubstr("header says 1 voxels, the file holds 0.5"));
  const auto out_of_range = testing::HasSubstr("a voxel is out of range");
  std::string odd = bytes;
  odd[7] = '2';
  EXPECT_THAT(error_of(odd, read_voxels), testing::HasSubstr("bad header"));
  EXPECT_THAT(error_of(bytes.substr(0, 87), read_voxels), testing::HasSubstr("bad header"));
  odd = bytes;
  odd[odd.size() - 2] = 2;
  EXPECT_THAT(error_of(odd, read_voxels), out_of_range) << "of neither kind";
  for (const std::size_t from_end : {16U, 12U, 8U}) {
    odd = bytes;
    odd.replace(odd.size() - from_end, 4, std::string("\0\0\xc0\x7f", 4));  // not a number
    EXPECT_THAT(error_of(odd, read_voxels), out_of_range) << from_end;
  }
}

TEST_F(ReportFile, OfASceneHoldsItsVerticesThenItsTriangles) {
  DrawnScene scene;
  scene.extent_m = {Eigen::Vector3f(-5.0F, -6.0F, 0.5F), Eigen::Vector3f(5.0F, 6.0F, 2.5F)};
  scene.vertices_m = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
  scene.colours = {{7, 8, 9}, {10, 11, 12}};
  scene.triangles[2] = {{0, 1, 0}};
  write_drawn_scene(folder_ / "scene.bin", scene);
  std::string bytes = "VTGSCN01";
  const auto put = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  for (const float value : {-5.0F, -6.0F, 0.5F, 5.0F, 6.0F, 2.5F}) put(value);
  for (const int count : {2, 0, 0, 1, 0, 0, 0}) put(static_cast<std::uint64_t>(count));
  for (const float value : {1.0F, 2.0F, 3.0F}) put(value);
  bytes += std::string("\7\10\11\0", 4);
  for (const float value : {4.0F, 5.0F, 6.0F}) put(value);
  bytes += std::string("\12\13\14\0", 4);
  for (const int vertex : {0, 1, 0}) put(static_cast<std::uint32_t>(vertex));
  EXPECT_EQ(read_file(folder_ / "scene.bin"), bytes);
  EXPECT_EQ(error_of(bytes, read_drawn_scene), "no error");
  EXPECT_EQ(read_drawn_scene(folder_ / "scene.bin").extent_m.min(), scene.extent_m.min());
  std::string odd = bytes;
  odd[7] = '2';
  EXPECT_THAT(error_of(odd, read_drawn_scene), testing::HasSubstr("bad header"));
  for (const std::size_t coordinate : {0U, 4U, 8U}) {
    odd = bytes;
    odd.replace(8 + 24 + 56 + 16 + coordinate, 4, std::string("\0\0\x80\x7f", 4));  // infinite
    EXPECT_THAT(error_of(odd, read_drawn_scene), testing::HasSubstr("a vertex is out of range"))
        << coordinate;
  }
}

TEST_F(ReportFile, OfPlansHasTheirReasons) {
  const auto file = with(std::string(kPlanColumns) +
                         "2,14.5,first,,1,7,1,2,0.5,3,13,900,4,cells\n"
                         "1000000000,40,cheaper,6.5,1,0,3,4,1,5,6,8,0,bits\n");
  const std::vector<RecordedPlan> plans = read_plans(file);
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0].tour.reason.change, PlanChange::first);
  EXPECT_TRUE(std::isnan(plans[0].tour.reason.saved_s));
  EXPECT_EQ(plans[1].tour.reason.change, PlanChange::cheaper);
  EXPECT_EQ(plans[1].tour.reason.saved_s, 6.5);
  const json page = plans_json(file);
  ASSERT_EQ(page.size(), 2U);
  EXPECT_EQ(page[0]["why"], "the first plan");
  EXPECT_EQ(page[1]["why"], sentence_of({PlanChange::cheaper, 6.5}));
  EXPECT_EQ(page[0]["scan"], 2);
  EXPECT_EQ(page[1]["scan"], 1'000'000'000);
  EXPECT_EQ(page[1]["time_s"], 40.0);
  EXPECT_EQ(page[1]["ends_s"], 6.0);
  EXPECT_EQ(page[1]["unit"], "bits");
  const auto error = [&](const char* row) {
    return error_of(kPlanColumns + std::string(row), read_plans);
  };
  EXPECT_EQ(error("2,1,guessed,,1,7,1,2,3,4,5,6,7,cells\n"), "file:2: change: guessed is none");
  EXPECT_EQ(error("2,inf,first,,1,7,1,2,3,4,5,6,7,cells\n"), "file:2: time_s: expected a number");
  EXPECT_EQ(error("2,,first,,1,7,1,2,3,4,5,6,7,cells\n"), "file:2: time_s: expected a number");
  EXPECT_EQ(error_of("scan,stop\n2,1\n", read_plans), "file:2: no column change");
}

TEST_F(ReportFile, OfATrajectoryHasItsHeadingToATenthOfAMilliradian) {
  const json found = trajectory_json(with("0 0 0 0 0 0 1 2\n"));
  EXPECT_NEAR(found[0][4].get<double>(), 0.9273, 1e-9) << "0.92730 of 2 atan(1 / 2)";
}

}  // namespace
}  // namespace vantage
