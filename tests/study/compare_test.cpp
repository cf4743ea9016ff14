// Two folders side by side.
#include "vantage/study/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

class Compare : public testing::Test {
 protected:
  fs::path run(const std::string& name, const Json& changes) {
    Json metrics = {{"task", "next_best_view"}, {"status", "completed"}, {"method", "adaptive"},
                    {"wall_time_s", 10.0},      {"path_length_m", 8.0},  {"state_hash", "00ff"}};
    metrics["scans"] = Json::array({{{"unobserved_cells", 100}, {"plan_time_s", 1.0}}});
    if (!changes.is_null()) metrics.merge_patch(changes);
    fs::create_directories(folder_ / name);
    std::ofstream(folder_ / name / "metrics.json") << metrics;
    return folder_ / name;
  }
  support::TemporaryDirectory folder_;
};

TEST_F(Compare, WallTimesDoNotCount) {
  const auto first = run("a", {});
  const Json scans = Json::array({{{"unobserved_cells", 100}, {"plan_time_s", 7.0}}});
  const auto second = run("b", {{"wall_time_s", 99.0}, {"scans", scans}});
  EXPECT_EQ(compare_folders(first, second, 0.0).beyond, 0U);
}

/// A key of metrics.json that its own text calls a wall time, of whatever task.
TEST_F(Compare, WallTimesOfAnyTaskDoNotCount) {
  std::size_t found = 0;
  for_each_task([&]<class T>(const T&) {
    for (const RecordText& record : T::records()) {
      if (record.file != "metrics.json" || !record.text.starts_with("wall")) continue;
      std::string pointer = "/" + std::string(record.name);
      for (std::size_t at; (at = pointer.find("[]")) != std::string::npos;) {
        pointer.replace(at, 2, "/0");
      }
      std::ranges::replace(pointer, '.', '/');
      Json first = {{"task", "next_best_view"}};
      Json second = first;
      first[Json::json_pointer(pointer)] = 1.0;
      second[Json::json_pointer(pointer)] = 2.0;
      EXPECT_EQ(compare_folders(run("a", first), run("b", second), 0.0).beyond, 0U) << record.name;
      ++found;
    }
  });
  EXPECT_GT(found, 6U);
}

TEST_F(Compare, ToleranceIsRelative) {
  const auto first = run("a", {});
  const auto second = run("b", {{"path_length_m", 10.0}});
  const FolderComparison exact = compare_folders(first, second, 0.0);
  EXPECT_EQ(exact.beyond, 1U);
  EXPECT_THAT(comparison_text(exact), HasSubstr("! path_length_m"));
  EXPECT_EQ(compare_folders(first, second, 0.19).beyond, 1U);
  EXPECT_EQ(compare_folders(first, second, 0.21).beyond, 0U);
}

TEST_F(Compare, SaysFirstWhatMatters) {
  const auto first = run("a", {{"collisions", 0}, {"simulated_time_s", 61.23456}});
  const auto second =
      run("b", {{"path_length_m", 10.0}, {"collisions", 0}, {"simulated_time_s", 61.23456}});
  const FolderComparison comparison = compare_folders(first, second, 0.0);
  std::istringstream lines(comparison_text(comparison));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, testing::AllOf(HasSubstr(first.string()), HasSubstr(second.string()),
                                   HasSubstr("difference")));
  std::vector<std::string> path_row;
  std::size_t rows = 0;
  for (; std::getline(lines, line) && line.find("values differ") == line.npos; ++rows) {
    if (line.find("path_length_m") == line.npos) continue;
    std::istringstream cells(line);
    path_row.assign(std::istream_iterator<std::string>(cells), {});
  }
  EXPECT_EQ(path_row, (std::vector<std::string>{"!", "path_length_m", "8", "10", "+2"}));
  EXPECT_EQ(rows, 7U) << "nothing else unasked";
  EXPECT_THAT(line, HasSubstr("1 of 8 values differ beyond the tolerance; --all"));
  EXPECT_THAT(comparison_text(comparison), HasSubstr("61.23 "));
  const Json json = comparison_json(comparison, 0.0);
  EXPECT_EQ(json["first"], first.string());
  EXPECT_EQ(json["headlines"][2], Json({{"name", "path_length_m"},
                                        {"first", 8.0},
                                        {"second", 10.0},
                                        {"difference", 2.0},
                                        {"beyond", true}}));
  EXPECT_TRUE(json["headlines"][0]["first"].is_null()) << "the share of what there is to see";
}

TEST_F(Compare, AllIsOnDemand) {
  const auto first = run("a", {});
  const auto second = run("b", {{"scans", {{{"unobserved_cells", 90}}}}});
  const FolderComparison comparison = compare_folders(first, second, 0.0);
  EXPECT_THAT(comparison_text(comparison), testing::Not(HasSubstr("unobserved_cells")));
  EXPECT_THAT(comparison_text(comparison, true), HasSubstr("! scans[0].unobserved_cells"));
}

TEST_F(Compare, StudiesAreHeldAgainstEachOtherByTheirTables) {
  const auto study = [&](const std::string& name, double mean) {
    fs::create_directories(folder_ / name);
    std::ofstream(folder_ / name / "study.yaml") << "x";
    const Json all = {{"adaptive", {{"episodes", 2}, {"mean", mean}}}};
    const Json summary = {
        {"study", "s"}, {"completed", 2}, {"tables", {{"area", {{"north", all}, {"all", all}}}}}};
    std::ofstream(folder_ / name / "summary.json") << summary;
    return folder_ / name;
  };
  const FolderComparison comparison = compare_folders(study("a", 2.0), study("b", 1.5), 0.0);
  ASSERT_EQ(comparison.headlines.size(), 2U);
  EXPECT_EQ(comparison.headlines[1].name, "area, adaptive");
  EXPECT_EQ(comparison.headlines[1].second, 1.5);
  EXPECT_THAT(comparison_text(comparison), HasSubstr("-0.5"));
}

TEST_F(Compare, TextsCountExactlyOrWhereTheyBind) {
  const auto first = run("a", {});
  const auto other_method = run("b", {{"method", "simple"}, {"state_hash", "aa"}});
  EXPECT_EQ(compare_folders(first, other_method, 0.0).beyond, 2U);
  EXPECT_EQ(compare_folders(first, other_method, 0.01).beyond, 0U);
  const auto diverged = run("c", {{"status", "diverged"}});
  EXPECT_EQ(compare_folders(first, diverged, 0.5).beyond, 1U);
}

/// Then `path_length_m` of a scan was the length of its leg.
TEST_F(Compare, ARunOfAFormerVersionMeansWhatItSaid) {
  const auto former = run("a", {{"scans", {{{"path_length_m", 1.5}}, {{"path_length_m", 2.0}}}}});
  const auto now = run("b", {{"scans",
                              {{{"path_length_m", 1.5}, {"leg_length_m", 1.5}},
                               {{"path_length_m", 3.5}, {"leg_length_m", 2.0}}}}});
  EXPECT_EQ(compare_folders(former, now, 0.0).beyond, 0U);
}

TEST_F(Compare, MissingValuesCount) {
  const auto first = run("a", {});
  const auto second = run("b", {{"scans", Json::array()}, {"extra", 1}});
  const FolderComparison comparison = compare_folders(first, second, 1.0);
  EXPECT_EQ(comparison.beyond, 2U);
  const Json json = comparison_json(comparison, 1.0);
  EXPECT_TRUE(json["values"]["extra"]["first"].is_null());
  EXPECT_EQ(json["values"]["scans[0].unobserved_cells"]["first"], 100);
}

/// Numbers where there should be texts or lists, and the other way round.
TEST_F(Compare, ValuesOfAnotherKindAreDifferencesAndNoErrors) {
  const auto first = run("a", {});
  const auto odd = run(
      "b",
      {{"task", 5}, {"mean_entropy_nats", 1.0}, {"objects", {1, "x", {{"observations", "many"}}}}});
  EXPECT_GT(compare_folders(first, odd, 0.0).beyond, 0U);
  EXPECT_EQ(compare_folders(odd, odd, 0.0).beyond, 0U);
  std::ofstream(folder_ / "study.yaml") << "x";
  std::ofstream(folder_ / "summary.json") << R"({"completed": "all", "tables": 3})";
  EXPECT_EQ(compare_folders(folder_.path(), folder_.path(), 0.0).beyond, 0U);
}

TEST_F(Compare, FoldersMustBeOfOneKind) {
  const auto first = run("a", {});
  EXPECT_THROW(compare_folders(first, folder_.path() / "nowhere", 0.0), InputError);
  std::ofstream(folder_ / "study.yaml") << "x";
  EXPECT_THROW(compare_folders(first, folder_.path(), 0.0), InputError);
  EXPECT_THROW(compare_folders(folder_.path(), folder_.path(), 0.0), InputError);  // not collected
  std::ofstream(first / "metrics.json") << "{";
  EXPECT_THROW(compare_folders(first, first, 0.0), InputError);
}

TEST(ComparisonText, ListsWhatDiffersBeyondTheTolerance) {
  FolderComparison comparison{"one", "two", {}, {}, 2};
  comparison.values.push_back({"path_length_m", "100.0", "90.0", -10.0, 0.1, true});
  comparison.values.push_back({"extra", "", "1", 0.0, 0.0, true});
  comparison.values.push_back({"method", R"("a")", R"("b")", 0.0, 0.0, false});
  const auto gap = [](std::size_t spaces) { return std::string(spaces, ' '); };
  const std::string rows = "! path_length_m" + gap(31 + 1 + 19) + "100.0" + gap(1 + 20) +
                           "90.0  -10 (10 %)\n! extra" + gap(39 + 1 + 23) + "-" + gap(1 + 23) +
                           "1\n";
  const std::string all = comparison_text(comparison, true);
  EXPECT_EQ(all.substr(0, all.find('\n')), gap(11) + "one" + gap(9) + "two  difference");
  EXPECT_EQ(all.substr(all.find('\n') + 1), rows + "2 of 3 values differ beyond the tolerance\n");
  const std::string few = comparison_text(comparison);
  EXPECT_EQ(few.substr(few.find('\n') + 1),
            "2 of 3 values differ beyond the tolerance; --all lists them\n");
  comparison.beyond = 0;
  const std::string none = comparison_text(comparison);
  EXPECT_EQ(none.substr(none.find('\n') + 1), "0 of 3 values differ beyond the tolerance\n");
}

TEST_F(Compare, ListsAreHeldAgainstEachOtherItemByItem) {
  const auto scans = [](int second) -> Json {
    return {{"scans", {{{"unobserved_cells", 100}}, {{"unobserved_cells", second}}}}};
  };
  const FolderComparison comparison =
      compare_folders(run("a", scans(90)), run("b", scans(81)), 0.0);
  EXPECT_EQ(comparison.beyond, 1U);
  const Json values = comparison_json(comparison, 0.0)["values"];
  EXPECT_EQ(values["scans[0].unobserved_cells"]["difference"], 0.0);
  EXPECT_EQ(values["scans[1].unobserved_cells"]["difference"], -9.0);
  EXPECT_EQ(values["scans[1].unobserved_cells"]["relative"], 0.1);
  EXPECT_EQ(values["method"]["difference"], 0.0) << "of texts there is none";
}

TEST_F(Compare, ATextIsNoNumberUnderAnyTolerance) {
  const auto first = run("a", {});
  const auto odd = run("b", {{"method", 5}});
  EXPECT_EQ(compare_folders(first, odd, 0.5).beyond, 1U);
  EXPECT_EQ(compare_folders(odd, first, 0.5).beyond, 1U);
}

TEST(ComparisonText, IsOfNothingUnlessTold) {
  EXPECT_EQ(ComparedValue{}.difference, 0.0);
  EXPECT_EQ(ComparedValue{}.relative, 0.0);
  EXPECT_FALSE(ComparedValue{}.beyond);
  EXPECT_EQ(FolderComparison{}.beyond, 0U);
}

}  // namespace
}  // namespace vantage
