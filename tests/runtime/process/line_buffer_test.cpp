#include "vantage/runtime/process/line_buffer.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(LineBuffer, GivesLinesAsTheyGetWhole) {
  LineBuffer buffer(100);
  EXPECT_FALSE(buffer.take());
  EXPECT_TRUE(buffer.add("ab"));
  EXPECT_FALSE(buffer.take());
  EXPECT_TRUE(buffer.add("c\n\nde\nf"));
  EXPECT_EQ(buffer.take(), "abc");
  EXPECT_EQ(buffer.take(), "");
  EXPECT_EQ(buffer.waiting(), 4U);
  EXPECT_EQ(buffer.take(), "de");
  EXPECT_FALSE(buffer.take());
  EXPECT_EQ(buffer.waiting(), 1U);
}

TEST(LineBuffer, KeepsNoMoreThanItMay) {
  LineBuffer buffer(5);
  EXPECT_TRUE(buffer.add("ab\nc"));
  EXPECT_TRUE(buffer.add("d")) << "just as much as it may";
  EXPECT_FALSE(buffer.add("e"));
  EXPECT_EQ(buffer.waiting(), 5U);
  EXPECT_EQ(buffer.take(), "ab");
  EXPECT_FALSE(buffer.add("e\nfg")) << "one byte too many";
  EXPECT_EQ(buffer.waiting(), 5U);
  EXPECT_EQ(buffer.take(), "cde");
  EXPECT_EQ(buffer.waiting(), 1U);
  EXPECT_TRUE(buffer.add(""));
}

TEST(Printable, ShowsBytesThatAreNoLettersByNumber) {
  EXPECT_EQ(printable("a b~"), "a b~");
  EXPECT_EQ(printable("\x1f \x7e\x7f"), "\\x1f ~\\x7f");
  EXPECT_EQ(printable("\n\xc3\xa4"), "\\x0a\\xc3\\xa4");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, IsNoLongerThanAsked) {
  EXPECT_EQ(printable("abcde", 5), "abcde");
  EXPECT_EQ(printable("abcdef", 5), "abcde ...");
  EXPECT_EQ(printable("abcd\n", 5), "abcd\\ ...");
  EXPECT_EQ(printable(std::string(80, 'x')), std::string(80, 'x'));
  EXPECT_EQ(printable(std::string(81, 'x')), std::string(80, 'x') + " ...");
}

}  // namespace
}  // namespace vantage
