// Thousands of damaged maps: reading them works or ends in InputError, and is over soon.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/belief/map/voxel_scene.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/belief/map/octomap_file.hpp"
#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

class FuzzedOctomap : public ::testing::Test {
 protected:
  void SetUp() override {
    Rng rng(5);
    const GridFrame frame = make_grid_frame({0.1, 0.2, 0.3}, {0.4, 0.4, 0.4}, {4, 4, 4});
    const OccupancyGrid grid = test::random_grid(frame, 0.3, 0.3, rng);
    for (const char* name : {"whole.bt", "whole.ot"}) {
      write_octomap(grid, directory_ / name);
      whole_.push_back(read_file(directory_ / name));
    }
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
  }
  void TearDown() override {
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  }

  /// Reads the bytes in every way there is.
  void try_to_read(const std::string& bytes) {
    const auto path = directory_ / "damaged";
    std::filesystem::remove(path);  // overwriting a file flushes it to disk on some systems
    std::ofstream(path, std::ios::binary) << bytes;
    ++tried_;
    try {
      const OctomapFile map(path);
      const CellBlock near_origin{{-16, -16, -16}, {16, 16, 16}};
      const OccupancyGrid grid = map.grid_of(near_origin);
      EXPECT_LE(grid.count(CellState::occupied), map.occupied());
      ++accepted_;
      EXPECT_EQ(read_octomap(path).occupied, map.occupied());
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("damaged"), std::string::npos);
    }
  }
  /// `whole` with the value of a header key replaced.
  static std::string with_header(const std::string& whole, const std::string& key,
                                 const std::string& value) {
    const auto begin = whole.find("\n" + key + " ") + key.size() + 2;
    return whole.substr(0, begin) + value + whole.substr(whole.find('\n', begin));
  }

  support::TemporaryDirectory directory_;
  std::vector<std::string> whole_;
  int tried_ = 0;
  int accepted_ = 0;
};

TEST_F(FuzzedOctomap, ValidFilesAreRead) {
  for (const std::string& whole : whole_) try_to_read(whole);
  EXPECT_EQ(accepted_, 2);
}

TEST_F(FuzzedOctomap, CutAtEveryLength) {
  for (const std::string& whole : whole_) {
    for (std::size_t size = 0; size < whole.size(); ++size) try_to_read(whole.substr(0, size));
  }
  EXPECT_EQ(accepted_, 0);
}

TEST_F(FuzzedOctomap, EveryByteAndEveryBit) {
  for (const std::string& whole : whole_) {
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const int flip : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ flip);
        try_to_read(damaged);
      }
    }
  }
  EXPECT_GT(tried_, 3000);
  EXPECT_GT(accepted_, 100);  // a flipped bit of a value is another map, no damage
}

TEST_F(FuzzedOctomap, HeaderNumbers) {
  const std::string most = std::to_string(std::numeric_limits<std::size_t>::max());
  for (const std::string& whole : whole_) {
    for (const std::string& size :
         {most, most + "0", std::string("-1"), std::string("1e9"), std::string("4294967296"),
          std::string(""), std::string(100'000, '9'), std::string("0x10")}) {
      try_to_read(with_header(whole, "size", size));
    }
    EXPECT_EQ(accepted_, 0);
    for (const char* res : {"nan", "inf", "-inf", "-0.1", "0", "1e-320", "1e308", "1e999", "0,1",
                            "\xff", "99999999999999999999999999"}) {
      try_to_read(with_header(whole, "res", res));
    }
    EXPECT_EQ(accepted_, 0);
    try_to_read(with_header(whole, "id", "OcTreeStamped"));
    try_to_read(with_header(whole, "id", ""));
    EXPECT_EQ(accepted_, 0);
  }
}

TEST_F(FuzzedOctomap, RandomBytes) {
  Rng rng(9);
  for (int i = 0; i < 1500; ++i) {
    const std::string& whole = whole_[rng.uniform_index(2)];
    // Some behind a good header, some with a piece of the data overwritten or doubled.
    std::string noise(rng.uniform_index(2000), '\0');
    for (char& byte : noise) byte = static_cast<char>(rng.uniform_index(256));
    const auto data = whole.find("data\n") + 5;
    const auto at = data + rng.uniform_index(whole.size() - data);
    const std::array<std::string, 4> damaged{noise, whole.substr(0, data) + noise,
                                             whole.substr(0, at) + noise + whole.substr(at),
                                             whole.substr(0, at) + whole.substr(data)};
    try_to_read(damaged[rng.uniform_index(damaged.size())]);
  }
}

TEST_F(FuzzedOctomap, EveryRecordTheSame) {
  // Claims as many children as there can be, as deep as the file goes on.
  for (const std::string& whole : whole_) {
    for (int byte = 0; byte < 256; ++byte) {
      try_to_read(whole.substr(0, whole.find("data\n") + 5) +
                  std::string(50'000, static_cast<char>(byte)));
    }
  }
  EXPECT_EQ(accepted_, 0);
}

}  // namespace
}  // namespace vantage
