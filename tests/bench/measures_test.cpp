// What a benchmark prints.
#include "bench/measures.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "vantage/core/hash.hpp"

namespace vantage::bench {
namespace {

nlohmann::ordered_json printed(const std::string& configuration) {
  testing::internal::CaptureStdout();
  print_figures("decision", 2, configuration, {{"sweep_ms", 1.5}});
  return nlohmann::ordered_json::parse(testing::internal::GetCapturedStdout());
}

TEST(PrintFigures, NamesCommitConfigurationMachineAndThreadsOfEachFigure) {
  const auto object = printed("scans: 6\n");
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"name", "commit", "config_hash", "cpu", "threads",
                                            "figures"}));
  EXPECT_EQ(object["config_hash"], hash_text(hash_bytes("scans: 6\n")));
  EXPECT_NE(object["config_hash"], printed("scans: 7\n")["config_hash"]);
  EXPECT_EQ(object["threads"], 2);
  EXPECT_EQ(object["figures"]["sweep_ms"], 1.5);
}

}  // namespace
}  // namespace vantage::bench
