#include "vantage/dataset/view_files.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <unistd.h>

#include <cstdint>
#include <filesystem>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace {

ObjectView random_view(Rng& rng) {
  ObjectView view;
  view.width_px = 1 + static_cast<int>(rng.uniform_index(40));
  view.height_px = 1 + static_cast<int>(rng.uniform_index(40));
  view.left_px = static_cast<int>(rng.uniform_index(600));
  view.top_px = static_cast<int>(rng.uniform_index(400));
  for (int i = 0; i < view.width_px * view.height_px; ++i) {
    for (int c = 0; c < 3; ++c)
      view.rgb.push_back(static_cast<std::uint8_t>(rng.uniform_index(256)));
    view.depth_m.push_back(0.001F * static_cast<float>(rng.uniform_index(4000)));
    view.mask.push_back(static_cast<std::uint8_t>(rng.uniform_index(2)));
  }
  view.mask.front() = 1;
  return view;
}

TEST(ViewFiles, AreReadAsTheyWereWritten) {
  const support::TemporaryDirectory folder;
  Rng rng(1);
  for (int i = 1; i <= 20; ++i) {
    const ObjectView view = random_view(rng);
    const double yaw_rad = rng.uniform(0.0, 6.2);
    const ViewEntry entry{{"cup", "cup_1", 2, i}, folder.path(), yaw_rad};
    write_view(view, entry);
    const LabelledView read = load_view(entry);
    EXPECT_EQ(read.view.width_px, view.width_px);
    EXPECT_EQ(read.view.left_px, view.left_px);
    EXPECT_EQ(read.view.top_px, view.top_px);
    EXPECT_EQ(read.view.rgb, view.rgb);
    EXPECT_EQ(read.view.mask, view.mask);
    for (std::size_t k = 0; k < view.depth_m.size(); ++k) {
      ASSERT_FLOAT_EQ(read.view.depth_m[k], view.depth_m[k]);
    }
  }
}

TEST(ViewFiles, AFolderThatIsNotThereIsNamed) {
  Rng rng(1);
  const ViewEntry entry{{"cup", "cup_1", 2, 1}, "/nonexistent/cup_1", 0.0};
  EXPECT_THROW(write_view(random_view(rng), entry), OutputError);
}

/// A pose is shorter than what is kept back before it is written.
TEST(ViewFiles, OnAFullFileSystemAreErrors) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "there is no /dev/full";
  const support::TemporaryDirectory folder;
  const ViewEntry entry{{"cup", "cup_1", 2, 1}, folder.path(), 0.5};
  std::filesystem::create_symlink("/dev/full", entry.file("pose.txt"));
  EXPECT_THROW(write_pose(entry), OutputError);
}

TEST(ViewFiles, DepthIsInWholeMillimetres) {
  const support::TemporaryDirectory folder;
  Rng rng(1);
  ObjectView view = random_view(rng);
  view.width_px = 5;
  view.height_px = 1;
  view.rgb.assign(15, 7);
  view.mask.assign(5, 1);
  view.depth_m = {0.0014F, 0.0016F, -1.0F, 65.0F, 70.0F};
  const ViewEntry entry{{"cup", "cup_1", 2, 1}, folder.path(), 0.0};
  write_view(view, entry);
  const cv::Mat written = cv::imread(entry.file("depthcrop.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(written.at<std::uint16_t>(0, 3), 65000);
  EXPECT_EQ(written.at<std::uint16_t>(0, 4), 65535) << "the most there is";
  const std::vector<float> read = load_view(entry).view.depth_m;
  ASSERT_EQ(read.size(), 5U);
  EXPECT_FLOAT_EQ(read[0], 0.001F);
  EXPECT_FLOAT_EQ(read[1], 0.002F);
  EXPECT_EQ(read[2], 0.0F);
  EXPECT_FLOAT_EQ(read[3], 65.0F);
  EXPECT_EQ(read[4], 0.0F);
}

TEST(ViewFiles, APoseHasAnElevationWhereItIsGiven) {
  const support::TemporaryDirectory folder;
  ViewEntry entry{{"cup", "cup_1", 2, 1}, folder.path(), 0.5};
  write_pose(entry);
  EXPECT_EQ(read_file(entry.file("pose.txt")), "28.6479\n");
  entry.given_elevation_rad = 0.25;
  write_pose(entry);
  EXPECT_EQ(read_file(entry.file("pose.txt")), "28.6479 14.3239\n");
}

}  // namespace
}  // namespace vantage
