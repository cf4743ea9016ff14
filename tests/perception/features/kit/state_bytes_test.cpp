#include "vantage/perception/features/kit/state_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace vantage {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

auto refuses(const std::string& why) {
  return ThrowsMessage<InputError>(HasSubstr("state: " + why));
}

std::string bytes_of(const Eigen::MatrixXf& matrix) {
  std::string bytes;
  put_matrix(bytes, matrix);
  return bytes;
}

TEST(StateBytes, AMatrixComesBack) {
  Eigen::MatrixXf matrix(2, 3);
  matrix << 1, 2, 3, 4, 5, 6;
  const std::string bytes = bytes_of(matrix);
  EXPECT_EQ(bytes.size(), 2 * sizeof(std::uint32_t) + 6 * sizeof(float));
  ByteReader reader(bytes, "state");
  EXPECT_EQ(take_matrix(reader, 2, -1), matrix);
  reader.finish();
  const std::string empty_bytes = bytes_of(Eigen::MatrixXf(0, 4));
  ByteReader empty(empty_bytes, "state");
  EXPECT_EQ(take_matrix(empty).cols(), 4);
  empty.finish();
}

TEST(StateBytes, EveryCutOfAMatrixIsAnError) {
  const std::string bytes = bytes_of(Eigen::MatrixXf::Ones(2, 3));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader reader(std::string_view(bytes).substr(0, size), "state");
    EXPECT_THAT([&] { (void)take_matrix(reader); }, refuses("ends within a matrix")) << size;
  }
}

TEST(StateBytes, NoSizeOfAMatrixIsBelieved) {
  std::string bytes;
  for (int i = 0; i < 2; ++i) put(bytes, std::numeric_limits<std::uint32_t>::max());
  bytes += "some bytes";
  ByteReader reader(bytes, "state");
  EXPECT_THAT([&] { (void)take_matrix(reader); },
              refuses("ends within a matrix of 4294967295 x 4294967295"));
}

TEST(StateBytes, AMatrixOfAnotherSizeOrNotFiniteIsRefused) {
  const std::string bytes = bytes_of(Eigen::MatrixXf::Ones(2, 3));
  ByteReader reader(bytes, "state");
  EXPECT_THAT([&] { (void)take_vector(reader, 2); },
              refuses("holds a matrix of 2 x 3 where 2 x 1 belongs"));
  const std::string infinite =
      bytes_of(Eigen::MatrixXf::Constant(1, 1, std::numeric_limits<float>::infinity()));
  ByteReader other(infinite, "state");
  EXPECT_THAT([&] { (void)take_matrix(other); }, refuses("holds a number that is not finite"));
}

struct KnobsOfState {
  double share = 0.25;
  int count = 3;
  bool is_on = false;
  std::string file = "none";
  void fields(auto&& f) {
    f("share", share, "a share", between(0.0, 1.0));
    f("count", count, "a number", at_least(1));
    f("is_on", is_on, "a switch");
    f("file", file, "a file");
  }
};

TEST(StateBytes, OptionsComeBack) {
  std::string bytes;
  put_options(bytes, KnobsOfState{.share = 0.75, .count = 9, .is_on = true, .file = "a b"});
  EXPECT_EQ(bytes.size(), 8U + 4U + 1U + 4U + 3U);
  ByteReader reader(bytes, "state");
  const auto back = take_options<KnobsOfState>(reader);
  reader.finish();
  EXPECT_EQ(back.share, 0.75);
  EXPECT_EQ(back.count, 9);
  EXPECT_TRUE(back.is_on);
  EXPECT_EQ(back.file, "a b");
}

TEST(StateBytes, OptionsOutOfTheirRangeAreRefused) {
  std::string bytes;
  put_options(bytes, KnobsOfState{.share = 1.5});
  ByteReader reader(bytes, "state");
  EXPECT_THAT([&] { (void)take_options<KnobsOfState>(reader); }, refuses("share"));
}

TEST(StateBytes, AMatrixOfOtherRowsOrColumnsIsRefused) {
  const std::string bytes = bytes_of(Eigen::MatrixXf::Ones(2, 3));
  ByteReader rows(bytes, "state");
  EXPECT_THAT([&] { (void)take_matrix(rows, 3, -1); }, refuses("holds a matrix of 2 x 3"));
  ByteReader columns(bytes, "state");
  EXPECT_THAT([&] { (void)take_matrix(columns, -1, 2); }, refuses("holds a matrix of 2 x 3"));
  ByteReader no_rows(bytes, "state");
  EXPECT_THAT([&] { (void)take_matrix(no_rows, 0, -1); }, refuses("holds a matrix of 2 x 3"));
  ByteReader no_columns(bytes, "state");
  EXPECT_THAT([&] { (void)take_matrix(no_columns, -1, 0); }, refuses("holds a matrix of 2 x 3"));
  ByteReader any(bytes, "state");
  EXPECT_EQ(take_matrix(any, -1, 3).size(), 6);
  const std::string line = bytes_of(Eigen::MatrixXf::Ones(4, 1));
  ByteReader vector(line, "state");
  EXPECT_EQ(take_vector(vector, 4), Eigen::VectorXf::Ones(4));
}

}  // namespace
}  // namespace vantage
