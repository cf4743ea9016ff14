// What the page of a run is made of, and what of the folder of a run is refused: key by key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "tests/report/sample_run.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/clouds/ply.hpp"
#include "vantage/report/report.hpp"
#include "vantage/report/report_embed.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {

using nlohmann::json;

class PageOfARun : public testing::Test {
 protected:
  PageOfARun() { support::write_sample_run(run_.path()); }
  std::string page(const ReportSections& sections = Tabletop::report()) {
    write_report(run_.path(), sections);
    return read_file(run_ / "report.html");
  }
  /// What stands between the tags that hold the data.
  std::string data_text(const ReportSections& sections = Tabletop::report()) {
    const std::string text = page(sections);
    const std::string open = R"(id="run-data">)";
    const std::size_t begin = text.find(open) + open.size();
    return text.substr(begin, text.find("</script>", begin) - begin);
  }
  json data(const ReportSections& sections = Tabletop::report()) {
    return json::parse(data_text(sections));
  }
  std::string refusal_of(const json& metrics) {
    write_file(run_ / "metrics.json", metrics.dump());
    return refusal();
  }
  std::string refusal() {
    try {
      write_report(run_.path(), Tabletop::report());
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  support::TemporaryDirectory run_;
};

TEST_F(PageOfARun, EveryMetricHasItsType) {
  const auto expect_refused = [&](const char* key, const json& value, const char* expected) {
    json metrics = support::sample_metrics();
    metrics[key] = value;
    EXPECT_EQ(refusal_of(metrics),
              (run_ / "metrics.json").string() + ": " + key + ": expected " + expected);
  };
  for (const char* key : {"task", "status", "scene", "method", "state_hash"}) {
    expect_refused(key, 1, "a text");
  }
  for (const char* key : {"simulated_time_s", "wall_time_s", "real_time_factor", "path_length_m",
                          "collisions", "observable_cells"}) {
    expect_refused(key, "far", "a number");
  }
  for (const char* key : {"unreachable", "map", "region"}) expect_refused(key, 1, "an object");
  for (const char* key : {"scans", "observations", "candidates", "objects"}) {
    expect_refused(key, json::array({1}), "a list of objects");
    expect_refused(key, json::object(), "a list of objects");
  }
}

TEST_F(PageOfARun, EveryNumberOfAScanHasItsType) {
  const auto expect_refused = [&](const char* key, const json& value, const char* expected) {
    json metrics = support::sample_metrics();
    metrics["scans"][1][key] = value;
    EXPECT_EQ(refusal_of(metrics),
              (run_ / "metrics.json").string() + ": scans[1]: " + key + ": expected " + expected);
  };
  for (const char* key : {"unobserved_cells", "observable_unobserved_cells", "actual_new_cells",
                          "chosen_view", "plan_time_s", "path_length_m", "leg_length_m",
                          "pose_error_m", "pose_error_before_registration_m"}) {
    expect_refused(key, "far", "a number");
  }
  for (const char* key : {"predicted", "view"}) expect_refused(key, 1, "an object");
  json metrics = support::sample_metrics();
  metrics["scans"][1]["plan_time_s"] = nullptr;
  metrics["wall_time_s"] = nullptr;
  EXPECT_EQ(refusal_of(metrics), "no error") << "what could not be measured";
  metrics["scans"][1]["plan_time_s"] = "far";
  write_file(run_ / "metrics.json", metrics.dump());
  EXPECT_NO_THROW(write_report(run_.path(), RecognitionTask::report())) << "it has no scans";
  metrics.erase("scans");
  EXPECT_EQ(refusal_of(metrics), (run_ / "metrics.json").string() + ": scans: missing");
}

TEST_F(PageOfARun, HoldsWhatWasFoundOutAfterwards) {
  EXPECT_EQ(data()["hindsight"], json({{"bound", nullptr}, {"branches", nullptr}}));
  write_file(run_ / "bound.json", R"({"least_s": 12})");
  write_file(run_ / "branches.json", R"({"regret": 3})");
  EXPECT_EQ(data()["hindsight"],
            json({{"bound", {{"least_s", 12}}}, {"branches", {{"regret", 3}}}}));
  EXPECT_TRUE(data(RecognitionTask::report())["hindsight"].is_null());
  write_file(run_ / "bound.json", "[1]");
  EXPECT_EQ(refusal(), (run_ / "bound.json").string() + ": expected a JSON object");
}

TEST_F(PageOfARun, OfNoSceneIsCalledARun) {
  json metrics = support::sample_metrics();
  metrics.erase("scene");
  write_file(run_ / "metrics.json", metrics.dump());
  EXPECT_THAT(page(), testing::HasSubstr("<title>Run · adaptive · Vantage</title>"));
  EXPECT_EQ(data()["title"], "Run");
}

TEST_F(PageOfARun, OfALeanRunSaysHowToRunItInFull) {
  std::filesystem::remove(run_ / "voxels.bin");
  const std::string folder = run_.path().string();
  EXPECT_THAT(refusal(), testing::StartsWith(folder + "/voxels.bin: missing"));
  EXPECT_THAT(refusal(), testing::HasSubstr("`vantage run " + folder + "/config.yaml --out " +
                                            folder + " --overwrite`"));
}

TEST_F(PageOfARun, HasNoSignsOfMarkupInItsData) {
  json metrics = support::sample_metrics();
  metrics["scene"] = "a<b>&c";
  write_file(run_ / "metrics.json", metrics.dump());
  const std::string text = data_text();
  EXPECT_EQ(text.find_first_of("<>&"), text.npos);
  EXPECT_THAT(text, testing::HasSubstr(R"("a\u003cb\u003e\u0026c")"));
  EXPECT_EQ(json::parse(text)["metrics"]["scene"], "a<b>&c");
}

TEST_F(PageOfARun, HoldsEachFileInItsPlace) {
  PointCloud cloud;
  cloud.points = {{-1.0F, 2.0F, 3.0F}, {1.0F, 6.0F, 11.0F}};
  write_ply(run_ / "cloud.ply", cloud);
  const json held = data();
  EXPECT_EQ(held["cloud"], cloud_json(run_ / "cloud.ply"));
  EXPECT_EQ(held["voxels"], voxels_json(run_ / "voxels.bin"));
  EXPECT_EQ(held["trajectory"]["truth"], trajectory_json(run_ / "trajectory.tum"));
  EXPECT_EQ(held["trajectory"]["estimated"], trajectory_json(run_ / "trajectory_estimated.tum"));
  EXPECT_NE(held["trajectory"]["estimated"], held["trajectory"]["truth"]);
  EXPECT_EQ(held["manifest"], json::parse(read_file(run_ / "manifest.json")));
  EXPECT_EQ(held["steps"]["rows"][8][1], "9");
  EXPECT_FALSE(held["media"].contains("video"));
}

TEST_F(PageOfARun, AFrameWithoutANumberComesBeforeTheFirst) {
  std::filesystem::create_directory(run_ / "frames");
  write_file(run_ / "frames" / "cover.png", "bc");
  write_file(run_ / "frames" / "scan_00.png", "a");
  EXPECT_EQ(data()["media"]["frame"], "data:image/png;base64,YQ==");
}

TEST_F(PageOfARun, HasItsDataInOneLineOfPlainLetters) {
  write_file(run_ / "config.yaml", "name: caf\xc3\xa9\n");
  std::string text = data_text();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  text.erase(0, text.find_first_not_of('\n'));
  EXPECT_EQ(text.find('\n'), text.npos);
  EXPECT_TRUE(std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; }));
  EXPECT_EQ(json::parse(text)["config"], "name: caf\xc3\xa9\n");
}

TEST_F(PageOfARun, HasItsStyle) {
  EXPECT_THAT(page(), testing::HasSubstr("<style>\n:root {\n  color-scheme: light;"));
}

}  // namespace
}  // namespace vantage
