// The files of a run folder where they just are what they should be, or just are not.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/report/drawn_scene.hpp"
#include "vantage/report/former_run.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/report/report_embed.hpp"
#include "vantage/report/report_sections.hpp"
#include "vantage/report/run_plans.hpp"

namespace vantage {
namespace {
using nlohmann::json;

class ReportLimits : public testing::Test {
 protected:
  std::filesystem::path holding(const std::string& text) {
    write_file(folder_ / "file", text);
    return folder_ / "file";
  }
  /// What the reader says of such a file, behind its name.
  template <class Read>
  std::string refusal_of(const std::string& text, Read&& read) {
    try {
      read(holding(text));
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.substr(std::min(what.find("file:"), what.size()));
    }
    return "none";
  }
  support::TemporaryDirectory folder_;
};

TEST_F(ReportLimits, ATrajectoryHasEveryPartOfItsQuaternion) {
  const auto samples = read_tum(holding("4.5 1 2 3 0.1 0.3 0.5 -0.8\n"));
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].time_s, 4.5);
  const double length = std::sqrt(0.01 + 0.09 + 0.25 + 0.64);
  EXPECT_NEAR(samples[0].q_world_body.x(), 0.1 / length, 1e-12);
  EXPECT_NEAR(samples[0].q_world_body.y(), 0.3 / length, 1e-12);
  EXPECT_NEAR(samples[0].q_world_body.z(), 0.5 / length, 1e-12);
  EXPECT_NEAR(samples[0].q_world_body.w(), -0.8 / length, 1e-12);
}

TEST_F(ReportLimits, AQuaternionIsZeroBelowAMillionth) {
  EXPECT_EQ(refusal_of("0 0 0 0 0 0 0 1.5e-6\n", read_tum), "none");
  EXPECT_EQ(refusal_of("0 0 0 0 0 0 0 7e-7\n", read_tum), "file:1: the quaternion is zero");
}

TEST_F(ReportLimits, ATrajectoryIsRoundedToTenthsOfMillimetresAndMilliradians) {
  const json found = trajectory_json(holding("0 0 0 5.123456 0 0 1 4\n"));
  EXPECT_NEAR(found[0][3].get<double>(), 5.1235, 1e-9);
  EXPECT_NEAR(found[0][4].get<double>(), 0.4900, 1e-9) << "0.48996 of 2 atan(1 / 4)";
}

/// The header says how many voxels there are in cells of that size from the origin to there: none.
TEST_F(ReportLimits, AGridHasNoMoreThanSoManyCellsOfItsOwnSize) {
  const auto refusal = [&](double cell_m, double x_m, double y_m, double z_m) {
    std::string bytes = "VTGVOX01";
    const auto put = [&](auto number) {
      bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
    };
    for (const double number : {cell_m, cell_m, cell_m, 0.0, 0.0, 0.0, x_m, y_m, z_m}) put(number);
    put(std::uint64_t{0});
    return refusal_of(bytes, read_voxels);
  };
  const auto too_many = testing::HasSubstr("the grid has too many cells");
  EXPECT_EQ(refusal(0.5, 32767.5, 0.5, 0.5), "none");
  EXPECT_THAT(refusal(0.5, 32768.0, 0.5, 0.5), too_many);
  EXPECT_EQ(refusal(2.0, 131070.0, 2.0, 2.0), "none");
  EXPECT_THAT(refusal(1.0, 4128.0, 4096.0, 4.0), too_many) << "little more than 2^26";
  EXPECT_THAT(refusal(1.0, 8192.0, 8200.0, 0.5), too_many) << "one layer, however thin";
}

TEST(ReportLimitsOfVoxels, AThinMapIsOneLayer) {
  const VoxelMap map{{0.5, 0.5, 0.5},
                     {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.1, 0.1, 0.1)},
                     {{0.05F, 0.05F, 0.05F, 3, kVoxelOccupied}}};
  const PackedVoxels packed = pack_voxels(map, 10);
  EXPECT_TRUE((packed.cells == Eigen::Array3i::Ones()).all());
  EXPECT_EQ(packed.voxels.size(), 1U);
}

/// Cells of 2 m, of which two beside the grid are not in it.
TEST(ReportLimitsOfVoxels, WhatIsJustBesideTheGridIsLeftOut) {
  const VoxelMap map{{2.0, 2.0, 2.0},
                     {Eigen::Vector3d::Zero(), Eigen::Vector3d(8.0, 4.0, 2.0)},
                     {{-1.0F, 1.0F, 1.0F, 1, kVoxelOccupied},
                      {9.0F, 3.0F, 1.0F, 1, kVoxelOccupied},
                      {7.0F, 3.0F, 1.0F, 5, kVoxelOccupied}}};
  const PackedVoxels packed = pack_voxels(map, 10);
  EXPECT_EQ(packed.total[0], 3U);
  ASSERT_EQ(packed.voxels.size(), 1U);
  EXPECT_THAT(packed.voxels[0].cell, testing::ElementsAre(3, 1, 0));
  EXPECT_EQ(packed.voxels[0].step_and_kind, 5);
}

TEST_F(ReportLimits, ASceneMayHaveVerticesAlone) {
  DrawnScene scene;
  scene.extent_m = {Eigen::Vector3f(-5.0F, -6.0F, 0.5F), Eigen::Vector3f(5.0F, 6.0F, 2.5F)};
  scene.vertices_m = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
  scene.colours = {{7, 8, 9}, {10, 11, 12}};
  write_drawn_scene(folder_ / "scene.bin", scene);
  EXPECT_EQ(read_drawn_scene(folder_ / "scene.bin").vertices_m, scene.vertices_m);
}

TEST_F(ReportLimits, ASceneSaysWhatItHasTooFewOf) {
  DrawnScene scene;
  scene.extent_m = {Eigen::Vector3f(-5.0F, -6.0F, 0.5F), Eigen::Vector3f(5.0F, 6.0F, 2.5F)};
  scene.vertices_m = {{1.0F, 2.0F, 3.0F}};
  scene.colours = {{7, 8, 9}};
  scene.triangles[1] = {{0, 0, 0}, {0, 0, 0}};
  write_drawn_scene(folder_ / "scene.bin", scene);
  const std::string bytes = read_file(folder_ / "scene.bin");
  EXPECT_THAT(refusal_of(bytes.substr(0, bytes.size() - 1), read_drawn_scene),
              testing::HasSubstr("ends within the triangles"));
  EXPECT_THAT(refusal_of(bytes.substr(0, bytes.size() - 24 - 1), read_drawn_scene),
              testing::HasSubstr("ends within the vertices"));
}

constexpr const char* kStopColumns =
    "scan,time_s,change,saved_s,stop,candidate,x_m,y_m,yaw_rad,arrival_s,departure_s,gain,beyond,"
    "gain_unit\n";

TEST_F(ReportLimits, PlansBeginWithTheFirstScanAndGoOnInOrder) {
  const auto refusal = [&](const std::vector<std::pair<int, int>>& scans_and_stops) {
    std::string text = kStopColumns;
    for (const auto& [scan, stop] : scans_and_stops) {
      text += fmt::format("{},1,first,,{},7,1,2,3,4,5,6,7,cells\n", scan, stop);
    }
    return refusal_of(text, read_plans);
  };
  EXPECT_EQ(refusal({{1, 1}, {1, 2}}), "none");
  EXPECT_EQ(refusal({{2, 1}, {4, 1}, {3, 1}}), "file:4: scan: not in order");
  EXPECT_EQ(refusal({{2, 1}, {0, 2}}), "file:3: scan: expected a whole number from 1 on");
}

TEST(FormerRuns, KeepObjectsOfWhichSomeAreOdd) {
  json odd = json::parse(R"({"mean_entropy_nats": 1.0,
    "objects": [{"observations": 2, "entropy_nats": 0.5}, {"observations": 2}]})");
  const json before = odd;
  bring_up_to_date(odd);
  EXPECT_EQ(odd, before);
  json no_objects = json::parse(R"({"mean_entropy_nats": 1.0})");
  bring_up_to_date(no_objects);
  EXPECT_EQ(no_objects, json::parse(R"({"mean_entropy_nats": 1.0})"));
  json none = json::parse(R"({"mean_entropy_nats": null, "objects": []})");
  bring_up_to_date(none);
  EXPECT_EQ(none["objects_unseen"], 0);
  json one = json::parse(R"({"mean_entropy_nats": 0.5,
    "objects": [{"observations": 1, "entropy_nats": 0.5}]})");
  bring_up_to_date(one);
  EXPECT_EQ(one["objects_unseen"], 0);
  EXPECT_EQ(one["mean_entropy_observed_nats"], 0.5);
}

TEST(FormerRuns, KeepListsOfSomethingElse) {
  for (const char* text :
       {R"({"scans": 3})", R"({"scans": {"first": {"path_length_m": 2.0}}})",
        R"({"scans": [1, null, "x", {"flight": 7}, {"path_length_m": "far"}]})", "[1]", "null"}) {
    json metrics = json::parse(text);
    bring_up_to_date(metrics);
    EXPECT_EQ(metrics, json::parse(text)) << text;
  }
  json mixed = json::parse(R"({"scans": [{"path_length_m": 1.0, "leg_length_m": 1.0},
    {"path_length_m": 2.0}]})");
  bring_up_to_date(mixed);
  EXPECT_EQ(mixed["scans"][1]["leg_length_m"], 2.0) << "behind one of this version";
}

TEST(FormerRuns, OfNoStepsHaveNoNumbers) {
  CsvTable steps{{"time_s", "scan", "path_length_m"}, {}};
  bring_up_to_date(steps);
  EXPECT_TRUE(steps.rows.empty());
}

TEST(ReportDefaults, AreOfNothing) {
  EXPECT_EQ(VoxelRecord{}.x, 0.0F);
  EXPECT_EQ(VoxelRecord{}.y, 0.0F);
  EXPECT_EQ(VoxelRecord{}.z, 0.0F);
  EXPECT_EQ(VoxelRecord{}.step, 0);
  EXPECT_EQ(VoxelRecord{}.kind, kVoxelOccupied);
  EXPECT_EQ(PackedVoxel{}.step_and_kind, 0);
  EXPECT_EQ(TrajectorySample{}.time_s, 0.0);
  EXPECT_EQ(TrajectorySample{}.yaw_rad, 0.0);
  EXPECT_EQ(RecordedPlan{}.scan, 0U);
  EXPECT_EQ(RecordedPlan{}.time_s, 0.0);
  EXPECT_FALSE(ReportSections{}.map);
  EXPECT_FALSE(ReportSections{}.scene);
}

}  // namespace
}  // namespace vantage
