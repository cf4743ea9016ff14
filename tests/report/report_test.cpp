#include "vantage/report/report.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <regex>

#include "tests/report/sample_run.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/report/drawn_scene.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using support::TemporaryDirectory;

/// The data between the tags that hold it, as a browser would find it.
json embedded_data(const std::string& page) {
  const std::string open = R"(<script type="application/json" id="run-data">)";
  const std::size_t begin = page.find(open) + open.size();
  return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

std::string page_of(const TemporaryDirectory& run,
                    const ReportSections& sections = Tabletop::report()) {
  write_report(run.path(), sections);
  return read_file(run / "report.html");
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The message write_report fails with.
std::string input_error(const TemporaryDirectory& run) {
  try {
    write_report(run.path(), Tabletop::report());
  } catch (const InputError& error) {
    EXPECT_FALSE(std::filesystem::exists(run / "report.html"));
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

/// A solid block of n^3 cells that all came with scan `step`.
VoxelMap block(int n, std::uint16_t step, std::uint8_t kind = kVoxelOccupied) {
  VoxelMap map{{0.1, 0.1, 0.1}, {Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(4, 4, 5)}, {}};
  for (int i = 0; i < n * n * n; ++i) {
    const Eigen::Array3i cell(i % n, i / n % n, i / (n * n));
    const Eigen::Array3f p =
        map.box_m.min().cast<float>().array() + 0.1F * (cell.cast<float>() + 0.5F);
    map.voxels.push_back({p.x(), p.y(), p.z(), step, kind});
  }
  return map;
}

TEST(Report, HoldsTheWholeRunInOneFile) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  const std::string page = page_of(run);
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("{{"), page.npos);
  const std::regex outside(R"((\ssrc=|\shref="[^#]|@import|url\(|<link))");
  EXPECT_FALSE(std::regex_search(page, outside));
  EXPECT_EQ(count(page, "<script"), 2U);
  EXPECT_EQ(count(page, "</script"), 2U);
}

TEST(Report, EmbedsTheMeasurements) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  const json data = embedded_data(page_of(run));
  EXPECT_EQ(data["metrics"], support::sample_metrics());
  EXPECT_EQ(data["config"], read_file(run / "config.yaml"));
  EXPECT_EQ(data["steps"]["rows"].size(), 9U);
  EXPECT_EQ(data["steps"]["columns"][1], "scan");
  EXPECT_EQ(data["trajectory"]["truth"].size(), 480U);
  EXPECT_NEAR(data["trajectory"]["truth"][0][1].get<double>(), 1.15, 1e-3);
  EXPECT_EQ(data["voxels"]["cells"], json({129, 129, 65}));
  EXPECT_TRUE(data["cloud"].is_null());
  EXPECT_TRUE(data["media"]["frame"].is_null());
  EXPECT_TRUE(data["plans"].is_null());
}

TEST(Report, HoldsThePlansWhereThereAreSome) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  write_file(run / "plans.csv",
             "scan,time_s,change,saved_s,stop,candidate,x_m,y_m,yaw_rad,arrival_s,departure_s,gain,"
             "beyond,gain_unit\n2,14.5,first,,1,7,1,2,0.5,3,13,900,0,cells\n");
  const json plans = embedded_data(page_of(run))["plans"];
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0]["why"], "the first plan");
  EXPECT_EQ(plans[0]["stops"][0]["x"], 1.0);
  EXPECT_TRUE(embedded_data(page_of(run, RecognitionTask::report()))["plans"].is_null());
}

/// Then `path_length_m` of a scan was the length of its leg, and scans counted from 0.
TEST(Report, BringsARunOfAFormerVersionUpToDate) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  const json present = support::sample_metrics();
  json former = present;
  for (json& scan : former["scans"]) {
    scan["path_length_m"] = scan["leg_length_m"];
    scan.erase("leg_length_m");
  }
  write_file(run / "metrics.json", former.dump());
  write_file(run / "steps.csv", "time_s,scan,path_length_m\n1,0,0.0\n2,1,1.5\n3,2,2.0\n");
  const json data = embedded_data(page_of(run));
  for (int scan = 0; scan < support::kSampleScans; ++scan) {
    const json& now = present["scans"][scan];
    EXPECT_EQ(data["metrics"]["scans"][scan]["leg_length_m"], now["leg_length_m"]);
    EXPECT_NEAR(data["metrics"]["scans"][scan]["path_length_m"].get<double>(),
                now["path_length_m"].get<double>(), 1e-12);
  }
  EXPECT_EQ(data["steps"]["columns"], json({"time_s", "scan", "leg_length_m"}));
  EXPECT_EQ(data["steps"]["rows"][0][1], "1");
  EXPECT_EQ(data["steps"]["rows"][2], json({"3", "3", "2.0"}));
}

/// Flights told the mean entropy of all objects alone once; what is no flight's is left as it is.
TEST(Report, ObjectsOfAnotherKindAreNoFormerFlight) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  for (const char* object :
       {"{}", R"({"observations": "many"})", R"({"observations": 1, "entropy_nats": null})"}) {
    json odd = support::sample_metrics();
    odd["mean_entropy_nats"] = 1.0;
    odd["objects"] = json::array({json::parse(object)});
    write_file(run / "metrics.json", odd.dump());
    EXPECT_FALSE(embedded_data(page_of(run))["metrics"].contains("objects_unseen")) << object;
  }
}

TEST(Report, IsTheSameFileForTheSameRun) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  EXPECT_EQ(page_of(run), page_of(run));
}

TEST(Report, RefersToTheVideoByNameIfThereIsOne) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  write_file(run / "video.mp4", "mp4");
  EXPECT_EQ(embedded_data(page_of(run))["media"]["video"], "video.mp4");
}

TEST(Report, EmbedsTheLastFrameWithoutVideo) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  std::filesystem::create_directory(run / "frames");
  write_file(run / "frames" / "scan_99.png", "a");
  write_file(run / "frames" / "scan_100.png", "bc");
  write_file(run / "frames" / "scan_101.part.png", "unfinished");
  EXPECT_EQ(embedded_data(page_of(run))["media"]["frame"], "data:image/png;base64,YmM=");
}

TEST(Report, AVideoShowsTheFirstFrameUntilItPlays) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  write_file(run / "video.mp4", "mp4");
  std::filesystem::create_directory(run / "frames");
  write_file(run / "frames" / "scan_00.png", "a");
  write_file(run / "frames" / "scan_01.png", "bc");
  const std::string page = page_of(run);
  EXPECT_EQ(embedded_data(page)["media"]["frame"], "data:image/png;base64,YQ==");
  EXPECT_NE(page.find("poster: frame"), page.npos);
}

TEST(Report, TitlesAreNamesAndNoPaths) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  json metrics = support::sample_metrics();
  metrics["scene"] = "models/scenes/office_small_2/scene.xml";
  write_file(run / "metrics.json", metrics.dump());
  const std::string page = page_of(run);
  EXPECT_NE(page.find("<title>office_small_2 · adaptive · Vantage</title>"), page.npos);
  EXPECT_EQ(embedded_data(page)["title"], "office_small_2");
  EXPECT_NE(page.find("at(\"heading\").textContent = DATA.title"), page.npos);
}

/// A triangle that is always drawn, and one of the north wall.
DrawnScene two_triangles() {
  DrawnScene scene;
  scene.extent_m = {Eigen::Vector3f(-1, -2, 0), Eigen::Vector3f(1, 2, 3)};
  scene.vertices_m = {{-1, -2, 0}, {1, -2, 0}, {1, 2, 0}, {1, 2, 3}};
  scene.colours = {{255, 0, 0}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
  scene.triangles[0] = {{0, 1, 2}};
  scene.triangles[4] = {{1, 2, 3}};
  return scene;
}

TEST(Report, AFlightShowsItsRoom) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  write_drawn_scene(run / "scene.bin", two_triangles());
  for_each_task([&](const auto& task) {
    const ReportSections sections = task.report();
    const json scene = embedded_data(page_of(run, sections))["scene"];
    ASSERT_EQ(scene.is_null(), !sections.scene) << task.name;
    if (scene.is_null()) return;
    EXPECT_EQ(scene["parts"], json({1, 0, 0, 0, 1, 0}));
    EXPECT_EQ(scene["extent"]["max"], json({1.0, 2.0, 3.0}));
    EXPECT_EQ(scene["positions"].get<std::string>().size(), (4 * 6 + 2) / 3 * 4U);
    EXPECT_EQ(scene["colours"].get<std::string>().size(), (4 * 3 + 2) / 3 * 4U);
    EXPECT_EQ(scene["triangles"], base64(std::string("\0\0\0\0\1\0\0\0\2\0\0\0"
                                                     "\1\0\0\0\2\0\0\0\3\0\0\0",
                                                     24)));
  });
  EXPECT_TRUE(TrajectoryFlight::report().scene);
  EXPECT_TRUE(RecognitionTask::report().scene);
  EXPECT_TRUE(ChangeDetectionTask::report().scene);
}

TEST(DrawnSceneFile, ComesBackAsItWasAndIsNotBelievedDamaged) {
  const TemporaryDirectory folder;
  const DrawnScene written = two_triangles();
  write_drawn_scene(folder / "scene.bin", written);
  const DrawnScene read = read_drawn_scene(folder / "scene.bin");
  EXPECT_EQ(read.extent_m.max(), written.extent_m.max());
  EXPECT_EQ(read.vertices_m, written.vertices_m);
  EXPECT_EQ(read.colours, written.colours);
  EXPECT_EQ(read.triangles, written.triangles);
  const std::string bytes = read_file(folder / "scene.bin");
  const std::string damaged[] = {"", bytes.substr(0, bytes.size() - 1), bytes + "x",
                                 bytes.substr(0, bytes.size() - 4) + std::string("\4\0\0\0", 4)};
  for (const std::string& content : damaged) {
    write_file(folder / "scene.bin", content);
    EXPECT_THROW(read_drawn_scene(folder / "scene.bin"), InputError) << content.size();
  }
}

TEST(Report, NamesCannotInject) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  json metrics = support::sample_metrics();
  const std::string evil = R"("</title></script><script>alert(1)</script><!--{{data}})";
  metrics["scene"] = evil;
  write_file(run / "metrics.json", metrics.dump());
  write_file(run / "config.yaml", "# </script><script>alert(2)</script>\n");
  const std::string page = page_of(run);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_EQ(embedded_data(page)["metrics"]["scene"], evil);
}

TEST(Report, BytesThatAreNotUtf8DoNotStopIt) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  write_file(run / "config.yaml", "name: caf\xe9\n");
  EXPECT_EQ(embedded_data(page_of(run))["config"], "name: caf\xef\xbf\xbd\n");
}

TEST(Report, CopesWithoutTheOptionalFields) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  write_file(run / "metrics.json", R"({"task": "recognition", "status": "failed"})");
  std::filesystem::remove(run / "voxels.bin");
  EXPECT_TRUE(embedded_data(page_of(run, RecognitionTask::report()))["voxels"].is_null());
}

/// Metrics that have the lists of every task, and the name of none.
json metrics_of_no_task() {
  json metrics = support::sample_metrics();
  metrics["task"] = "made_up";
  metrics["observations"] = json::array({{{"time_s", 1.0}, {"entropy_bits", 2.0}}});
  metrics["objects"] = json::array({{{"truth", "mug_1"}, {"looks", json::array()}}});
  metrics["path"] = metrics["plan"] = json::array({{0.0, 0.0, 1.0, 0.0}});
  metrics["change_probability"] = 0.5;
  return metrics;
}

TEST(Report, HasTheSectionsOfTheTaskWhateverTheMetricsSay) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  write_file(run / "metrics.json", metrics_of_no_task().dump());
  for_each_task([&](const auto& task) {
    const ReportSections sections = task.report();
    const json data = embedded_data(page_of(run, sections));
    EXPECT_EQ(data["sections"]["figures"], sections.figures) << task.name;
    EXPECT_EQ(data["sections"]["steps"], sections.steps) << task.name;
    EXPECT_EQ(data["sections"]["step_word"], sections.step_word) << task.name;
    EXPECT_EQ(data["sections"]["view_heading"], sections.view_heading) << task.name;
    EXPECT_EQ(data["voxels"].is_null(), !sections.map && !sections.scene) << task.name;
    EXPECT_EQ(data["metrics"], metrics_of_no_task()) << task.name;
  });
}

TEST(Report, OnlyATaskWithAMapNeedsItsFiles) {
  for_each_task([](const auto& task) {
    const TemporaryDirectory run;
    support::write_sample_run(run.path());
    std::filesystem::remove(run / "voxels.bin");
    write_file(run / "metrics.json", R"({"task": "made_up", "status": "completed"})");
    const ReportSections sections = task.report();
    if (sections.map) {
      EXPECT_THROW(write_report(run.path(), sections), InputError) << task.name;
    } else {
      EXPECT_NO_THROW(write_report(run.path(), sections)) << task.name;
    }
  });
}

TEST(Report, ThePageKnowsTheFiguresOfEveryTask) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  const std::string page = page_of(run);
  for_each_task([&](const auto& task) {
    const std::string name(task.report().figures);
    ASSERT_FALSE(name.empty()) << task.name;
    EXPECT_NE(page.find("FIGURES." + name + " ="), std::string::npos) << task.name;
  });
  EXPECT_EQ(count(page, "METRICS.task"), 1U) << "in its heading alone";
}

TEST(Report, MissingFilesAreNamed) {
  for (const std::string name : {"metrics.json", "manifest.json", "config.yaml", "steps.csv",
                                 "trajectory.tum", "trajectory_estimated.tum", "voxels.bin"}) {
    const TemporaryDirectory run;
    support::write_sample_run(run.path());
    std::filesystem::remove(run / name);
    EXPECT_NE(input_error(run).find(name), std::string::npos) << name;
  }
}

TEST(Report, MalformedFilesAreNamed) {
  const std::string kDeep =
      R"({"a":)" + std::string(200'000, '[') + std::string(200'000, ']') + "}";
  const std::pair<const char*, const char*> broken[] = {
      {"metrics.json", "{"},
      {"metrics.json", "[1]"},
      {"metrics.json", R"({"task": "next_best_view"})"},
      {"metrics.json", R"({"task": "next_best_view", "status": "completed", "scans": [1]})"},
      {"metrics.json", R"({"task": "t", "status": "completed", "path_length_m": "far"})"},
      {"metrics.json", R"({"task": "t", "status": "completed", "scans": [{"chosen_view": []}]})"},
      {"manifest.json", "nonsense"},
      {"manifest.json", kDeep.c_str()},
      {"config.yaml", "\"open"},
      {"config.yaml", "garbage"},
      {"steps.csv", "garbage\n"},
      {"trajectory.tum", ""},
      {"steps.csv", "a,b\n1\n"},
      {"steps.csv", ""},
      {"trajectory.tum", "1 2 3\n"},
      {"trajectory.tum", "0 0 0 0 0 0 0 0\n"},
      {"trajectory_estimated.tum", "0 x 0 0 0 0 0 1\n"},
      {"voxels.bin", "VTGVOX01"},
      {"plans.csv", "scan,stop\n2,1\n"},
      {"cloud.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"},
      {"cloud.ply", "solid\n"}};
  for (const auto& [name, content] : broken) {
    const TemporaryDirectory run;
    support::write_sample_run(run.path());
    write_file(run / name, content);
    EXPECT_NE(input_error(run).find(name), std::string::npos) << name << ": " << content;
  }
}

TEST(Report, VoxelCapHolds) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  VoxelMap map{{0.01, 0.01, 0.01}, {Eigen::Vector3d::Zero(), Eigen::Vector3d(8, 8, 1)}, {}};
  for (int i = 0; i < 160'000; ++i) {
    const int row = i / 400;
    map.voxels.push_back({0.02F * static_cast<float>(i % 400) + 0.005F,
                          0.02F * static_cast<float>(row) + 0.005F, 0.005F,
                          static_cast<std::uint16_t>(i / 20'000), kVoxelOccupied});
  }
  write_voxels(run / "voxels.bin", map);
  const json voxels = embedded_data(page_of(run))["voxels"];
  EXPECT_EQ(voxels["total"][0], 160'000);
  EXPECT_EQ(voxels["surface"][0], 160'000);
  EXPECT_EQ(voxels["kept"][0], kMaxReportVoxels);
  EXPECT_EQ(voxels["data"].get<std::string>().size(), (8 * kMaxReportVoxels + 2) / 3 * 4);
}

TEST(Voxels, SurviveTheFile) {
  const TemporaryDirectory folder;
  const VoxelMap written = block(3, 4, kVoxelUnobserved);
  write_voxels(folder / "voxels.bin", written);
  const VoxelMap read = read_voxels(folder / "voxels.bin");
  EXPECT_EQ(read.cell_size_m, written.cell_size_m);
  EXPECT_EQ(read.box_m.min(), written.box_m.min());
  EXPECT_EQ(read.box_m.max(), written.box_m.max());
  ASSERT_EQ(read.voxels.size(), 27U);
  EXPECT_EQ(read.voxels[5].y, written.voxels[5].y);
  EXPECT_EQ(read.voxels[5].step, 4);
  EXPECT_EQ(read.voxels[5].kind, kVoxelUnobserved);
  const std::string bytes = read_file(folder / "voxels.bin");
  write_file(folder / "voxels.bin", bytes.substr(0, bytes.size() - 1));
  EXPECT_THROW(read_voxels(folder / "voxels.bin"), InputError);
}

// 4^3 cells: 64 - 2^3 = 56 of them have a face outside.
TEST(Voxels, OnlyTheSurfaceIsKept) {
  const PackedVoxels packed = pack_voxels(block(4, 0), 1000);
  EXPECT_EQ(packed.total[0], 64U);
  EXPECT_EQ(packed.surface[0], 56U);
  EXPECT_EQ(packed.kept[0], 56U);
  EXPECT_EQ((packed.cells == Eigen::Array3i(50, 50, 50)).all(), true);
}

/// Found by ./fuzz: a cell's number there is none that an int can hold.
TEST(Voxels, FarBeyondTheGridAreLeftOut) {
  VoxelMap map;
  map.cell_size_m = {0.1, 0.1, 0.1};
  map.box_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  map.voxels = {{0.55F, 0.55F, 0.55F}, {1e30F, 0.5F, 0.5F}, {0.5F, -1e30F, 0.5F}};
  EXPECT_EQ(pack_voxels(map, 10).voxels.size(), 1U);
}

/// A core cell found before its neighbours was to be seen then, and stays.
TEST(Voxels, CellsHiddenOnlyLaterAreKept) {
  VoxelMap map = block(3, 5);
  map.voxels[13].step = 2;
  EXPECT_EQ(pack_voxels(map, 1000).kept[0], 27U);
  map.voxels[13].step = 5;
  EXPECT_EQ(pack_voxels(map, 1000).kept[0], 26U);
}

TEST(Voxels, OccupiedCellsComeFirstAndInOrderOfTheirStep) {
  VoxelMap map = block(3, 0, kVoxelUnobserved);
  for (std::size_t i = 0; i < 9; ++i) {
    map.voxels[i].kind = kVoxelOccupied;
    map.voxels[i].step = static_cast<std::uint16_t>(8 - i);
  }
  const PackedVoxels packed = pack_voxels(map, 12);
  ASSERT_EQ(packed.voxels.size(), 12U);
  EXPECT_EQ(packed.kept[0], 9U);
  EXPECT_EQ(packed.kept[1], 3U);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(packed.voxels[i].step_and_kind, i);
  for (std::size_t i = 9; i < 12; ++i) EXPECT_EQ(packed.voxels[i].step_and_kind, 0x8000);
}

TEST(ReportData, TumHeadingComesFromTheQuaternion) {
  const TemporaryDirectory folder;
  write_file(folder / "t.tum", "# comment\n1.5 1 2 3 0 0 0.70710678 0.70710678\r\n");
  const auto samples = read_tum(folder / "t.tum");
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].p_world_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(samples[0].yaw_rad, std::numbers::pi / 2, 1e-6);
}

TEST(ReportData, CsvQuotes) {
  const TemporaryDirectory folder;
  write_file(folder / "t.csv", "a,\"b,c\"\r\n\"x \"\"y\"\"\",\n");
  const CsvTable table = read_csv(folder / "t.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b,c"}));
  EXPECT_EQ(table.rows.at(0), (std::vector<std::string>{"x \"y\"", ""}));
}

TEST(ReportData, CsvFieldsComeBackAsTheyWere) {
  const TemporaryDirectory folder;
  for (const std::string field : {"plain", "a, b", "say \"x\"", "\"", ""}) {
    write_file(folder / "t.csv", "a,b\n" + csv_field(field) + "," + csv_field("1") + "\n");
    EXPECT_EQ(read_csv(folder / "t.csv").rows.at(0), (std::vector<std::string>{field, "1"}));
  }
}

// The test vectors of RFC 4648.
TEST(ReportData, Base64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Report, AFrameMayBeAJpeg) {
  const TemporaryDirectory run;
  support::write_sample_run(run.path());
  std::filesystem::create_directory(run / "frames");
  write_file(run / "frames" / "scan_02.jpg", "a");
  write_file(run / "frames" / "scan_03.txt", "b");
  EXPECT_EQ(embedded_data(page_of(run))["media"]["frame"], "data:image/jpeg;base64,YQ==");
}

}  // namespace
}  // namespace vantage
