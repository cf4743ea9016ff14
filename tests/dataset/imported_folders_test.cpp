// What is made of folders of pictures that are not all alike.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/import_pictures.hpp"
#include "vantage/dataset/pictures/replace_folder.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A block on a table, 0.6 m below a camera that looks down by that; of 160 x 120 px, in mm.
cv::Mat block_seen_from(double elevation_deg) {
  const double elevation_rad = elevation_deg * std::numbers::pi / 180.0;
  cv::Mat depth(120, 160, CV_16UC1);
  for (int row = 0; row < depth.rows; ++row) {
    const double y = (row - 60) / 200.0;
    const double z_m = 0.6 / (y * std::cos(elevation_rad) + std::sin(elevation_rad));
    depth.row(row).setTo(std::lround(1000.0 * z_m));
  }
  depth(cv::Rect(65, 45, 30, 30)) -= 100;
  return depth;
}

class ImportedFolders : public testing::Test {
 protected:
  /// @param stem of the files, below the folder
  void put(const std::string& stem, const cv::Mat& depth) const {
    const fs::path path = folder_.path() / stem;
    fs::create_directories(path.parent_path());
    cv::imwrite(path.string() + "_rgb.png", cv::Mat(depth.size(), CV_8UC3, cv::Scalar::all(90)));
    cv::imwrite(path.string() + "_depth.png", depth);
  }
  void put(const std::string& stem) const { put(stem, cv::Mat(30, 40, CV_16UC1, cv::Scalar(900))); }
  void put_mask(const std::string& stem) const {
    cv::imwrite((folder_.path() / (stem + "_mask.png")).string(),
                cv::Mat(120, 160, CV_8UC1, cv::Scalar::all(255)));
  }
  [[nodiscard]] static ImportOptions whole() {
    ImportOptions options;
    options.cut = "whole";
    return options;
  }
  [[nodiscard]] ImportOutcome imported(const ImportOptions& options,
                                       const std::vector<std::string>& from = {"mine"}) const {
    ImportRun run;
    for (const std::string& folder : from) run.from.push_back(folder_ / folder);
    run.root = folder_ / "out";
    run.overwrite = true;
    return import_pictures(options, run);
  }
  [[nodiscard]] std::vector<ViewEntry> views() const {
    return index_dataset(folder_ / "out").views;
  }
  static double elevation_deg_of(const ViewEntry& view) {
    return view.given_elevation_rad.value_or(-1.0) * 180.0 / std::numbers::pi;
  }
  support::TemporaryDirectory folder_;
};

/// Of a picture of 40 x 30 px up to a tenth of its size off the middle.
TEST_F(ImportedFolders, APrincipalPointIsAboutInTheMiddleOfAWholePicture) {
  put("mine/drill/front");
  const auto left_px = [&](double x, double y) {
    ImportOptions options = whole();
    options.focal_px = 35.0;
    options.centre_px = std::array{x, y};
    (void)imported(options);
    return load_view(views().front()).view.left_px;
  };
  EXPECT_EQ(left_px(23.5, 15.0), 0);
  EXPECT_EQ(left_px(16.5, 15.0), 0);
  EXPECT_EQ(left_px(24.5, 15.0), 4);
  EXPECT_EQ(left_px(22.0, 17.5), 0);
  EXPECT_EQ(left_px(22.0, 18.5), 2);
}

TEST_F(ImportedFolders, NumbersMakeATurnByTheirValueFromThirteenOn) {
  const std::vector<std::string> names{"00", "1", "02", "3", "04",  "5",
                                       "06", "7", "08", "9", "010", "11"};
  for (const std::string& name : names) put("mine/drill/" + name);
  const ImportOutcome twelve = imported(whole());
  EXPECT_THAT(twelve.notices, Not(Contains(HasSubstr("taken for one turn"))));
  put("mine/drill/12");
  EXPECT_THAT(imported(whole()).notices, Contains(HasSubstr("taken for one turn")));
  // Frames are in order of the paths: 00 010 02 04 06 08 1 11 12 3 5 7 9.
  const auto all = views();
  ASSERT_EQ(all.size(), 13U);
  const std::vector<int> value{0, 10, 2, 4, 6, 8, 1, 11, 12, 3, 5, 7, 9};
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_NEAR(all[i].yaw_rad, 2.0 * std::numbers::pi * value[i] / 13.0, 1e-5) << i;
  }
}

TEST_F(ImportedFolders, ANameTellsAnElevationByThePattern) {
  put("mine/drill/front_60");
  put("mine/drill/top_30");
  ImportOptions options = whole();
  options.layout = "{object}/{view}_{elevation}_{kind}";
  (void)imported(options);
  ASSERT_EQ(views().size(), 2U);
  EXPECT_NEAR(elevation_deg_of(views()[0]), 60.0, 1e-3);
  EXPECT_NEAR(elevation_deg_of(views()[1]), 90.0, 1e-3) << "the name of the view tells better";
}

TEST_F(ImportedFolders, SomePicturesHaveAPose) {
  put("mine/drill/30deg");
  put("mine/drill/b");
  write_file(folder_ / "mine/drill/b_pose.txt", "180 20\n");
  const ImportOutcome outcome = imported(whole());
  EXPECT_TRUE(outcome.notes.degrees);
  ASSERT_EQ(views().size(), 2U);
  EXPECT_NEAR(views()[1].yaw_rad, std::numbers::pi, 1e-6);
  EXPECT_NEAR(elevation_deg_of(views()[1]), 20.0, 1e-3);
}

TEST_F(ImportedFolders, OfOtherNamesAreRecordingsOfTheirNames) {
  put("new/kitchen/drill/front");
  put("old/kitchen/drill/front");
  put("old/office/drill/front");
  ImportOptions options = whole();
  options.layout = "{recording}/{object}/{view}_{kind}";
  const ImportOutcome outcome = imported(options, {"old", "new"});
  EXPECT_THAT(outcome.notes.recordings, ElementsAre("new kitchen", "old kitchen", "old office"));
  std::vector<int> videos;
  for (const ViewEntry& view : views()) {
    videos.push_back(view.name.video);
    EXPECT_EQ(view.name.frame, 1);
  }
  EXPECT_THAT(videos, ElementsAre(1, 2, 3));
}

TEST_F(ImportedFolders, AreCutByMasksIfAllHaveOne) {
  put("mine/drill/front", block_seen_from(40.0));
  put("mine/drill/left", block_seen_from(40.0));
  ImportOptions options;
  options.focal_px = 200.0;
  const ImportOutcome none = imported(options);
  EXPECT_EQ(none.notes.cut, "depth");
  EXPECT_THAT(none.notices, Contains(HasSubstr("no masks: the object is cut out by depth")));
  put_mask("mine/drill/left");
  const ImportOutcome one = imported(options);
  EXPECT_EQ(one.notes.cut, "depth");
  EXPECT_THAT(one.notices, Contains(HasSubstr("1 of 2 pictures have a mask")));
  options.cut = "mask";
  EXPECT_THAT(
      [&] { (void)imported(options); },
      testing::ThrowsMessage<InputError>(HasSubstr("front_rgb.png: has no mask beside it")));
  put_mask("mine/drill/front");
  options.cut = "auto";
  const ImportOutcome both = imported(options);
  EXPECT_EQ(both.notes.cut, "mask");
  EXPECT_THAT(both.notices, Not(Contains(HasSubstr("mask"))));
}

/// Of four the upper of the two in the middle; one whose name tells it is not asked.
TEST_F(ImportedFolders, TheMedianIsOfThoseThatDoNotTellTheirElevation) {
  put("mine/drill/above", block_seen_from(60.0));
  put("mine/drill/back", block_seen_from(35.0));
  put("mine/drill/front", block_seen_from(50.0));
  put("mine/drill/left", block_seen_from(30.0));
  put("mine/drill/right", block_seen_from(40.0));
  ImportOptions options;
  options.cut = "depth";
  options.focal_px = 200.0;
  (void)imported(options);
  ASSERT_EQ(views().size(), 5U);
  EXPECT_NEAR(elevation_deg_of(views()[0]), 90.0, 1e-3);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(elevation_deg_of(views()[i]), 40.0, 0.2) << i;
}

TEST_F(ImportedFolders, TheWidestPictureCounts) {
  put("mine/drill/front");
  put("mine/drill/left", cv::Mat(30, 700, CV_16UC1, cv::Scalar(900)));
  put("mine/drill/right");
  EXPECT_THAT(imported(whole()).notices, Contains(HasSubstr("a picture is 700 px wide")));
}

TEST_F(ImportedFolders, WorkThatIsBrokenOffLeavesNothing) {
  struct Stop {};
  for (const char* view : {"front", "left", "right", "back"}) {
    put(std::string("mine/drill/") + view);
  }
  int polled = 0;
  ImportRun run;
  run.from = {folder_ / "mine"};
  run.root = folder_ / "out";
  run.poll = [&] {
    if (++polled == 2) throw Stop{};
  };
  EXPECT_THROW((void)import_pictures(whole(), run), Stop);
  EXPECT_EQ(polled, 2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "mine alone";
}

TEST(ReplaceFolder, LeavesNothingOfTheOldOneInAnEmptyOne) {
  const support::TemporaryDirectory folder;
  fs::create_directories(folder / "data");
  write_file(folder / "data/notes", "old");
  fs::create_directories(folder / "data.part");
  replace_folder(folder / "data.part", folder / "data");
  EXPECT_TRUE(fs::is_empty(folder / "data"));
}

TEST_F(ImportedFolders, SayOfEachRecordingHowItsCameraLooksDown) {
  put("a/drill/above", block_seen_from(60.0));
  put("b/drill/front", block_seen_from(40.0));
  ImportOptions options;
  options.cut = "depth";
  options.focal_px = 200.0;
  EXPECT_THAT(imported(options, {"a", "b"}).notices,
              Contains(HasSubstr("b: the camera looks down by 40 deg")));
  options.elevation_deg = 20.0;
  EXPECT_THAT(imported(options, {"a", "b"}).notices, Not(Contains(HasSubstr("looks down by"))));
  ASSERT_EQ(views().size(), 2U);
  EXPECT_NEAR(elevation_deg_of(views()[1]), 20.0, 1e-3);
}

TEST_F(ImportedFolders, HaveNothingOfAnImportThatWasKilled) {
  put("mine/drill/front");
  fs::create_directories(folder_ / "out.part");
  write_file(folder_ / "out.part/half", "begun");
  (void)imported(whole());
  EXPECT_FALSE(fs::exists(folder_ / "out/half"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 2) << "mine and out";
}

}  // namespace
}  // namespace vantage
