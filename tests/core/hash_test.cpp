#include "vantage/core/hash.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

// Vectors of draft-eastlake-fnv.
TEST(Hash, KnownFnv1aVectors) {
  EXPECT_EQ(hash_bytes(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hash_bytes("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hash_bytes("foobar"), 0x85944171f73967e8ULL);
}

TEST(Hash, BytesAboveAsciiAreUnsigned) {
  EXPECT_EQ(hash_bytes("\xff"), (kHashSeed ^ 0xffU) * 0x100000001b3ULL);
}

TEST(Hash, ContinuesFromASeed) {
  EXPECT_EQ(hash_bytes("bar", hash_bytes("foo")), hash_bytes("foobar"));
}

TEST(Hash, DoublesByTheirBits) {
  const std::array values{1.0, 2.0};
  const std::array swapped{2.0, 1.0};
  const std::array minus_zero{-0.0};
  const std::array zero{0.0};
  EXPECT_NE(hash_doubles(values), hash_doubles(swapped));
  EXPECT_NE(hash_doubles(minus_zero), hash_doubles(zero));
  EXPECT_EQ(hash_doubles({}), kHashSeed);
}

TEST(Hash, OfAFileIsThatOfItsBytes) {
  const support::TemporaryDirectory directory;
  std::ofstream(directory / "f", std::ios::binary) << "foobar";
  EXPECT_EQ(hash_file(directory / "f"), hash_bytes("foobar"));
  EXPECT_THROW(hash_file(directory / "missing"), InputError);
}

TEST(Hash, TextHasSixteenDigits) {
  EXPECT_EQ(hash_text(0x1fULL), "000000000000001f");
  EXPECT_EQ(hash_text(0xcbf29ce484222325ULL), "cbf29ce484222325");
}

TEST(Hash, OfDoublesContinuesFromASeed) {
  EXPECT_EQ(hash_doubles(std::array{2.0}, hash_doubles(std::array{1.0})),
            hash_doubles(std::array{1.0, 2.0}));
}

}  // namespace
}  // namespace vantage
