#include "vantage/perception/clouds/ply.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using support::TemporaryDirectory;

const std::string kHeader =
    "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
    "property float x\nproperty float y\nproperty float z\nend_header\n";
const std::string kOnePoint(12, '\0');

/// The message read_ply ends with for a file of `content`.
std::string error_of(const std::string& content) {
  const TemporaryDirectory directory;
  const auto path = directory / "cloud.ply";
  std::ofstream(path, std::ios::binary) << content;
  try {
    (void)read_ply(path);
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cloud.ply"), std::string::npos);
    return error.what();
  }
  return "";
}

bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

RC_GTEST_PROP(Ply, ReadsBackWhatItWrote, (std::uint64_t seed, bool normals, bool colours)) {
  Rng rng(seed);
  const TemporaryDirectory directory;
  ColouredCloud made;
  const std::size_t count = rng.uniform_index(50);
  for (std::size_t i = 0; i < count; ++i) {
    made.cloud.points.emplace_back(rng.normal(), rng.normal(), rng.normal());
    if (normals) made.cloud.normals.emplace_back(rng.normal(), rng.normal(), rng.normal());
    const auto byte = [&] { return static_cast<std::uint8_t>(rng.uniform_index(256)); };
    if (colours) made.rgb.push_back({byte(), byte(), byte()});
  }
  write_ply(directory / "cloud.ply", made.cloud, made.rgb);
  const ColouredCloud read = read_ply(directory / "cloud.ply");
  RC_ASSERT(read.cloud.points == made.cloud.points);
  RC_ASSERT(read.cloud.normals == made.cloud.normals);
  RC_ASSERT(read.rgb == made.rgb);
}

TEST(Ply, HeaderIsWhatOtherProgramsExpect) {
  const TemporaryDirectory directory;
  PointCloud cloud;
  cloud.points.emplace_back(1.0F, 2.0F, 3.0F);
  write_ply(directory / "cloud.ply", cloud, {{255, 0, 7}});
  const std::string bytes = read_file(directory / "cloud.ply");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  ASSERT_EQ(bytes.substr(0, header.size()), header);
  EXPECT_EQ(bytes.substr(header.size()),
            std::string("\x00\x00\x80\x3f\x00\x00\x00\x40\x00\x00\x40\x40\xff\x00\x07", 15));
}

TEST(Ply, SkipsPropertiesItDoesNotKnow) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "cloud.ply", std::ios::binary)
      << "ply\nformat binary_little_endian 1.0\ncomment made elsewhere\nelement vertex 1\n"
         "property double time\nproperty float x\nproperty uchar label\nproperty float y\n"
         "property float z\nend_header\n"
      << std::string(
             "\0\0\0\0\0\0\0\0"
             "\x00\x00\x80\x3f"
             "\x05"
             "\x00\x00\x00\x40"
             "\x00\x00\x40\x40",
             21);
  const ColouredCloud read = read_ply(directory / "cloud.ply");
  ASSERT_EQ(read.cloud.size(), 1U);
  EXPECT_EQ(read.cloud.points[0], Eigen::Vector3f(1, 2, 3));
}

TEST(Ply, AWellFormedFileHasNoError) { EXPECT_EQ(error_of(kHeader + kOnePoint), ""); }

TEST(Ply, MissingFileIsAnInputError) { EXPECT_THROW(read_ply("no/such/cloud.ply"), InputError); }

TEST(Ply, MalformedHeaders) {
  EXPECT_TRUE(says(error_of(""), "does not begin with 'ply'"));
  EXPECT_TRUE(says(error_of("solid cube\n"), "does not begin with 'ply'"));
  EXPECT_TRUE(says(error_of("ply\nformat binary_little_endian 1.0\n"), "no end_header"));
  const auto with = [](const std::string& from, const std::string& to) {
    return error_of(replaced(kHeader, from, to) + kOnePoint);
  };
  EXPECT_TRUE(says(with("binary_little_endian", "ascii"), "expected binary_little_endian"));
  EXPECT_TRUE(says(with("vertex", "face"), "expected the one element vertex"));
  EXPECT_TRUE(says(with("vertex 1", "vertex many"), "'many' is not a number"));
  EXPECT_TRUE(says(with("vertex 1", "vertex -1"), "'-1' is not a number"));
  EXPECT_TRUE(says(with("float y", "quad y"), "type 'quad' is not supported"));
  EXPECT_TRUE(says(with("property float y", "property list uchar int y"), "only scalar"));
  EXPECT_TRUE(says(with("float y", "int y"), "property 'y' is int, expected float"));
  EXPECT_TRUE(says(with("float y", "float x"), "needs each of x, y, z once"));
  EXPECT_TRUE(says(with("property float y\n", ""), "needs each of x, y, z once"));
  EXPECT_TRUE(says(with("property float x\nproperty float y\nproperty float z\n", ""),
                   "needs properties x, y, z"));
  EXPECT_TRUE(says(with("element vertex 1\n", ""), "unexpected header line"));
  EXPECT_TRUE(says(with("property float y", "colour red"), "unexpected header line"));
}

TEST(Ply, PromisesAreCheckedAgainstTheFileBeforeMemoryIsTaken) {
  EXPECT_TRUE(says(error_of(kHeader), "but 0 bytes follow"));
  EXPECT_TRUE(says(error_of(kHeader + kOnePoint + "x"), "but 13 bytes follow"));
  EXPECT_TRUE(says(error_of(kHeader + std::string(11, '\0')), "but 11 bytes follow"));
  const std::string huge = replaced(kHeader, "vertex 1", "vertex 18446744073709551615");
  EXPECT_TRUE(says(error_of(huge + kOnePoint), "promises 18446744073709551615 vertices"));
  // 12 * 1537228672809129302 = 8 modulo 2^64.
  const std::string wraps = replaced(kHeader, "vertex 1", "vertex 1537228672809129302");
  EXPECT_FALSE(error_of(wraps + std::string(8, '\0')).empty());
}

TEST(Ply, WriteFailureIsAnOutputErrorAndLeavesNothing) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "file") << "x";
  EXPECT_THROW(write_ply(directory / "file" / "cloud.ply", PointCloud{}), OutputError);
}

/// A vertex of as many bytes as its types have, then x, y, z of 1, 2, 3.
TEST(Ply, KnowsTheSizeOfEveryType) {
  const std::vector<std::pair<std::string, std::size_t>> types{
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const std::string position("\x00\x00\x80\x3f\x00\x00\x00\x40\x00\x00\x40\x40", 12);
  for (const auto& [type, size] : types) {
    const std::string header = replaced(kHeader, "property float x\n",
                                        "property " + type + " other\nproperty float32 x\n");
    const TemporaryDirectory directory;
    write_file(directory / "cloud.ply",
               fmt::format("{}{}{}", header, std::string(size, '\7'), position));
    const ColouredCloud read = read_ply(directory / "cloud.ply");
    ASSERT_EQ(read.cloud.size(), 1U) << type;
    EXPECT_EQ(read.cloud.points[0], Eigen::Vector3f(1, 2, 3)) << type;
    EXPECT_TRUE(read.cloud.normals.empty());
    EXPECT_TRUE(read.rgb.empty());
  }
}

TEST(Ply, ColoursMayBeUint8AndNormalsFloat32InAnyOrder) {
  const TemporaryDirectory directory;
  write_file(directory / "cloud.ply",
             "ply\nformat binary_little_endian 1.0\nobj_info a scan\n\nelement vertex 2\n"
             "property uint8 blue\nproperty uint8 red\nproperty uint8 green\n"
             "property float32 nz\nproperty float32 nx\nproperty float32 ny\n"
             "property float z\nproperty float y\nproperty float x\nend_header\n" +
                 std::string("\1\2\xff"
                             "\x00\x00\x40\x40\x00\x00\x80\x3f\x00\x00\x00\x40"
                             "\x00\x00\x40\x40\x00\x00\x00\x40\x00\x00\x80\x3f",
                             27) +
                 std::string("\4\5\6", 3) + std::string(24, '\0'));
  const ColouredCloud read = read_ply(directory / "cloud.ply");
  ASSERT_EQ(read.cloud.size(), 2U);
  EXPECT_EQ(read.cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(read.cloud.normals[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(read.rgb[0], (Rgb{2, 255, 1}));
  EXPECT_EQ(read.rgb[1], (Rgb{5, 6, 4}));
  EXPECT_TRUE(read.cloud.points[1].isZero());
}

TEST(Ply, HeaderLinesHaveThreeWords) {
  const auto with = [](const std::string& from, const std::string& to) {
    return error_of(replaced(kHeader, from, to) + kOnePoint);
  };
  EXPECT_TRUE(says(with("binary_little_endian 1.0", "binary_little_endian"), "expected binary"));
  EXPECT_TRUE(says(with("element vertex 1", "element vertex"), "expected the one element"));
  EXPECT_TRUE(says(with("element vertex 1\n", "element vertex 1\nelement vertex 1\n"),
                   "expected the one element"));
  EXPECT_TRUE(says(with("property float y", "property float"), "only scalar"));
  EXPECT_TRUE(says(with("format binary_little_endian 1.0\n", ""), "is missing"));
  EXPECT_TRUE(says(with("vertex 1\n", "vertex 1x\n"), "'1x' is not a number"));
  const std::string no_vertex = "ply\nformat binary_little_endian 1.0\nend_header\n";
  EXPECT_TRUE(says(error_of(no_vertex), "is missing"));
}

}  // namespace
}  // namespace vantage
