// Golden episodes: tests/golden/<name>/{trace.txt, map.png}. VANTAGE_UPDATE_GOLDEN=1 writes them
// anew.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdlib>
#include <filesystem>

#include "tests/tasks/golden_episodes.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

const fs::path kGolden = fs::path(VANTAGE_SOURCE_DIR) / "tests" / "golden";

void write_golden(const fs::path& folder, const GoldenResult& actual) {
  fs::create_directories(folder);
  write_file(folder / "trace.txt", trace_text(actual.trace));
  cv::imwrite((folder / "map.png").string(), actual.image, {cv::IMWRITE_PNG_COMPRESSION, 9});
}

/// Keeps both traces and images side by side for a look, and says where.
std::string keep_evidence(const std::string& name, const GoldenResult& actual) {
  const fs::path kept = fs::path("golden-failures") / name;
  fs::remove_all(kept);
  write_golden(kept / "actual", actual);
  fs::copy(kGolden / name, kept / "expected", fs::copy_options::recursive);
  return fs::absolute(kept).string();
}

class Golden : public testing::TestWithParam<GoldenEpisode> {};

TEST_P(Golden, KeepsToItsTrace) {
  const GoldenResult actual = GetParam().run();
  const fs::path folder = kGolden / GetParam().name;
  if (std::getenv("VANTAGE_UPDATE_GOLDEN") != nullptr) {
    write_golden(folder, actual);
    return;
  }
  const Trace expected = parse_trace(read_file(folder / "trace.txt"));
  const std::string difference = trace_difference(expected, actual.trace);
  if (difference.empty()) return;
  FAIL() << GetParam().name << ": " << difference << "traces and images kept in "
         << keep_evidence(std::string(GetParam().name), actual)
         << "\n./test --update-golden takes the new behaviour over";
}

INSTANTIATE_TEST_SUITE_P(Episodes, Golden, testing::ValuesIn(golden_episodes()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Trace, ReadsBackWhatItWrites) {
  Trace trace;
  trace.exact(0, "chosen_view", -1.0);
  trace.within_percent(0, "unobserved_cells", 1234.0, 2.0);
  trace.within(1, "precision", 0.97, 0.02);
  EXPECT_EQ(trace_text(parse_trace(trace_text(trace))), trace_text(trace));
}

TEST(Trace, NamesTheFirstStepThatDiffers) {
  Trace expected;
  expected.within_percent(0, "cells", 100.0, 2.0);
  expected.exact(1, "view", 3.0);
  expected.exact(2, "view", 4.0);
  Trace actual = expected;
  actual.entries[0].number = 101.9;
  EXPECT_EQ(trace_difference(expected, actual), "");
  actual.entries[1].number = 5.0;
  actual.entries[2].number = 5.0;
  EXPECT_EQ(trace_difference(expected, actual),
            "first difference in step 1:\n  expected view = 3\n  actual   view = 5\n");
  actual.entries[0].number = 102.1;
  EXPECT_NE(trace_difference(expected, actual).find("step 0"), std::string::npos);
  actual.entries.pop_back();
  actual.entries[0].number = 100.0;
  actual.entries[1].number = 3.0;
  EXPECT_NE(trace_difference(expected, actual).find("actual   nothing"), std::string::npos);
}

}  // namespace
}  // namespace vantage
