#include "vantage/core/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

namespace vantage {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

auto ends_within(const std::string& what) {
  return ThrowsMessage<InputError>(AllOf(StartsWith("x.bin: "), HasSubstr("ends within " + what)));
}

RC_GTEST_PROP(ByteReader, ReadsWhatWasPut,
              (int number, const std::string& text, const std::vector<float>& row)) {
  std::string bytes;
  put(bytes, number);
  put_text(bytes, text);
  put(bytes, static_cast<std::uint32_t>(row.size()));
  for (const float x : row) put(bytes, x);
  ByteReader reader(bytes, "x.bin");
  RC_ASSERT(reader.number<int>("a number") == number);
  RC_ASSERT(reader.text("a text") == text);
  std::vector<float> back(reader.count(sizeof(float), "a row"));
  reader.numbers(std::span(back), "a row");
  RC_ASSERT(back == row);
  reader.finish();
}

// Written down, so that files of before are read by what comes after.
TEST(Bytes, AreThoseOfTheFormat) {
  std::string bytes;
  put(bytes, std::uint16_t{0x0102});
  put_text(bytes, "ab");
  put(bytes, 1.0F);
  put(bytes, true);
  const char expected[] =
      "\x02\x01"
      "\x02\0\0\0"
      "ab"
      "\0\0\x80\x3f"
      "\x01";
  EXPECT_EQ(bytes, std::string(expected, sizeof expected - 1));
}

TEST(ByteReader, EveryCutIsAnErrorThatNamesFileAndPart) {
  std::string whole;
  put(whole, 0.5);
  put_text(whole, "abc");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ByteReader reader(std::string_view(whole).substr(0, size), "x.bin");
    const auto read = [&] {
      (void)reader.number<double>("the number");
      (void)reader.text("the text");
    };
    EXPECT_THAT(read, ends_within(size < 8 ? "the number" : "the text")) << size;
  }
}

TEST(ByteReader, BelievesNoSize) {
  std::string bytes;
  put(bytes, std::numeric_limits<std::uint32_t>::max());
  bytes += "a few bytes";
  const ByteReader start(bytes, "x.bin");
  ByteReader reader = start;
  EXPECT_THAT([&] { (void)reader.text("the text"); }, ends_within("the text"));
  reader = start;
  EXPECT_THAT([&] { (void)reader.count(8, "the items"); }, ends_within("the items"));
  reader = start;
  EXPECT_THAT([&] { (void)reader.block(std::numeric_limits<std::size_t>::max(), "the block"); },
              ends_within("the block"));
  EXPECT_THAT([&] { reader.require_items(std::numeric_limits<std::size_t>::max(), 16, "items"); },
              ends_within("items"));
  EXPECT_NO_THROW(reader.require_items(1, bytes.size(), "items"));
  EXPECT_THAT([&] { reader.require_items(2, bytes.size() / 2 + 1, "items"); },
              ends_within("items"));
}

TEST(ByteReader, AFailedReadTakesNothing) {
  ByteReader reader("abc", "x.bin");
  EXPECT_THROW((void)reader.number<std::uint32_t>("a number"), InputError);
  EXPECT_EQ(reader.left(), 3U);
  EXPECT_EQ(reader.block(3, "the rest"), "abc");
}

TEST(ByteReader, WhatIsLeftIsTooMuch) {
  ByteReader reader("ab", "x.bin");
  EXPECT_THAT([&] { reader.finish(); },
              ThrowsMessage<InputError>(HasSubstr("x.bin: has 2 bytes too many")));
  reader.block(2, "all");
  EXPECT_NO_THROW(reader.finish());
}

TEST(ByteReader, ATextMayEndWhereTheBytesDo) {
  std::string bytes;
  put_text(bytes, "abc");
  ByteReader reader(bytes, "x.bin");
  EXPECT_EQ(reader.text("the text"), "abc");
  EXPECT_NO_THROW(reader.finish());
}

}  // namespace
}  // namespace vantage
