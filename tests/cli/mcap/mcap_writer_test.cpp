#include "vantage/mcap/mcap_writer.hpp"

#include <gtest/gtest.h>

#include "tests/cli/mcap/mcap_file.hpp"
#include "tests/support/temporary_directory.hpp"

namespace vantage {
namespace {

class McapWriters : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "run.mcap"; }
  [[nodiscard]] test::McapFile written() const { return test::McapFile(read_file(path())); }
  support::TemporaryDirectory folder_;
};

TEST_F(McapWriters, WriteWhatTheyAreGiven) {
  McapWriter writer(path());
  EXPECT_EQ(writer.add_channel("/a", "S", R"({"of": "a"})"), 1);
  EXPECT_EQ(writer.add_channel("/b", "S", "another of that name"), 2);
  EXPECT_EQ(writer.add_channel("/c", "T", "{}"), 3);
  writer.add_message(1, 500, "{}");
  writer.add_message(2, 300, R"({"k": 1})");
  writer.add_message(1, 900, "");
  writer.add_message(1, 400, "[2]");
  writer.add_metadata("about", {{"key", "value"}, {"a", "b"}});
  EXPECT_FALSE(std::filesystem::exists(path()));
  writer.commit();
  const test::McapFile file = written();
  using Named = std::pair<std::string, std::string>;
  EXPECT_EQ(file.schemas, (std::map<int, Named>{{1, {"S", R"({"of": "a"})"}}, {2, {"T", "{}"}}}));
  EXPECT_EQ(file.channels, (std::map<int, std::pair<std::string, int>>{
                               {1, {"/a", 1}}, {2, {"/b", 1}}, {3, {"/c", 2}}}));
  ASSERT_EQ(file.messages.size(), 4U);
  EXPECT_EQ(file.messages[1].channel, 2);
  EXPECT_EQ(file.messages[1].time_ns, 300U);
  EXPECT_EQ(file.messages[1].text, R"({"k": 1})");
  EXPECT_EQ(file.messages[2].time_ns, 900U);
  EXPECT_EQ(file.messages[3].text, "[2]");
  ASSERT_EQ(file.chunks.size(), 1U);
  EXPECT_EQ(file.chunks[0].times, (std::pair<std::uint64_t, std::uint64_t>{300, 900}));
  EXPECT_EQ(file.metadata.at("about"),
            (std::map<std::string, std::string>{{"a", "b"}, {"key", "value"}}));
}

TEST_F(McapWriters, BeginAChunkAfterEachMebibyte) {
  McapWriter writer(path());
  const std::uint16_t channel = writer.add_channel("/a", "S", "{}");
  const std::uint16_t other = writer.add_channel("/b", "S", "{}");
  for (std::uint64_t i = 0; i < 25; ++i) {
    writer.add_message(i % 5 == 2 ? other : channel, 1000 - 3 * i, std::string(100'000, 'x'));
  }
  writer.commit();
  const test::McapFile file = written();
  ASSERT_EQ(file.chunks.size(), 3U);
  EXPECT_EQ(file.chunks[0].messages, 11U) << "1.1 MB";
  EXPECT_EQ(file.chunks[1].messages, 11U);
  EXPECT_EQ(file.chunks[2].messages, 3U);
  EXPECT_EQ(file.chunks[1].times, (std::pair<std::uint64_t, std::uint64_t>{937, 967}));
  EXPECT_EQ(file.messages.back().time_ns, 928U);
}

TEST_F(McapWriters, PutMetadataBetweenChunks) {
  McapWriter writer(path());
  const std::uint16_t channel = writer.add_channel("/a", "S", "{}");
  writer.add_message(channel, 7, "1");
  writer.add_metadata("one", {});
  writer.add_message(channel, 5, "2");
  writer.add_metadata("two", {{"x", ""}});
  writer.commit();
  const test::McapFile file = written();
  EXPECT_EQ(file.chunks.size(), 2U);
  EXPECT_EQ(file.chunks[1].times, (std::pair<std::uint64_t, std::uint64_t>{5, 5}));
  EXPECT_EQ(file.metadata.size(), 2U);
  EXPECT_TRUE(file.metadata.at("one").empty());
}

TEST_F(McapWriters, MayWriteNothing) {
  McapWriter(path()).commit();
  const test::McapFile file = written();
  EXPECT_TRUE(file.chunks.empty());
  EXPECT_TRUE(file.messages.empty());
}

TEST_F(McapWriters, LeaveNothingWithoutCommit) {
  McapWriter(path()).add_channel("/a", "S", "{}");
  EXPECT_TRUE(folder_.is_empty());
}

/// Records of a schema, a channel and an empty message have 36, 31 and 31 bytes.
TEST_F(McapWriters, BeginAChunkAtAMebibyte) {
  constexpr std::size_t kRest = (std::size_t{1} << 20U) - 36 - 31 - 31;
  for (const std::size_t less : {0U, 1U}) {
    McapWriter writer(path());
    const std::uint16_t channel = writer.add_channel("/a", "S", "{}");
    writer.add_message(channel, 1, std::string(kRest - less, 'x'));
    writer.add_message(channel, 2, "{}");
    writer.commit();
    const test::McapFile file = written();
    ASSERT_EQ(file.chunks.size(), 2U - less);
    EXPECT_EQ(file.chunks[0].size, (std::size_t{1} << 20U) + (less == 0 ? 0 : 32));
  }
}

}  // namespace
}  // namespace vantage
