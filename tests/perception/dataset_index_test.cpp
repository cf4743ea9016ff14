#include "vantage/perception/dataset_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "tests/perception/dataset_files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

TEST(ViewNames, AreReadFromTheRight) {
  EXPECT_EQ(parse_view_name("coffee_mug_3_1_42"), (ViewName{"coffee_mug", "coffee_mug_3", 1, 42}));
  EXPECT_EQ(parse_view_name("apple_12_4_1"), (ViewName{"apple", "apple_12", 4, 1}));
  EXPECT_EQ(parse_view_name("model_2_b_7_2_9"), (ViewName{"model_2_b", "model_2_b_7", 2, 9}));
  for (const char* bad : {"", "apple", "apple_1", "apple_1_2", "_1_2_3", "apple_1_2_x",
                          "apple_1_2_", "apple_x_1_2", "apple_1_-2_3"}) {
    EXPECT_FALSE(parse_view_name(bad)) << bad;
  }
}

TEST(ViewNames, AreWrittenAsRead) {
  const ViewName name{"food_can", "food_can_7", 4, 133};
  EXPECT_EQ(to_string(name), "food_can_7_4_133");
  EXPECT_EQ(parse_view_name(to_string(name)), name);
}

TEST(YawBins, AreCentredOnMultiples) {
  for (int q = 0; q < 8; ++q) {
    EXPECT_EQ(yaw_bin(q * pi / 4.0), q);
    EXPECT_EQ(yaw_bin(q * pi / 4.0 + 0.99 * pi / 8.0), q);
    EXPECT_EQ(yaw_bin(q * pi / 4.0 - 0.99 * pi / 8.0), q);
    EXPECT_EQ(yaw_bin(q * pi / 4.0 - 6.0 * pi), q);
  }
  EXPECT_EQ(yaw_bin(pi, 2), 1);
}

class Index : public testing::Test {
 protected:
  void SetUp() override {
    support::put_view(root_.path(), "mug", "mug_1", 2, 10, "90.0\n");
    support::put_view(root_.path(), "mug", "mug_1", 2, 9, "-45");
    support::put_view(root_.path(), "food_can", "food_can_2", 1, 1, "  360.0 \n");
    support::put_view(root_.path(), "food_can", "food_can_2", 4, 1, "0");
  }
  std::filesystem::path of_mug(const std::string& name) {
    return root_.path() / "mug" / "mug_1" / name;
  }
  void expect_bad(const std::string& file, const std::string& reason) {
    try {
      index_dataset(root_.path());
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file));
      EXPECT_THAT(error.what(), HasSubstr(reason));
    }
    const DatasetIndex index = index_dataset(root_.path(), OnBadView::skip);
    ASSERT_FALSE(index.skipped.empty());
    EXPECT_THAT(index.skipped.front().file.string(), HasSubstr(file));
    EXPECT_THAT(index.skipped.front().reason, HasSubstr(reason));
  }
  support::TemporaryDirectory root_;
};

TEST_F(Index, IsSortedByNumberAndHasYaws) {
  write_file(root_.path() / "mug" / "mug_1" / "notes.png", "of no view");
  std::filesystem::create_directories(root_.path() / "mug" / ".mug_2.part");
  const DatasetIndex index = index_dataset(root_.path());
  ASSERT_EQ(index.views.size(), 4U);
  EXPECT_EQ(to_string(index.views[0].name), "food_can_2_1_1");
  EXPECT_EQ(to_string(index.views[1].name), "food_can_2_4_1");
  EXPECT_EQ(to_string(index.views[2].name), "mug_1_2_9");
  EXPECT_EQ(to_string(index.views[3].name), "mug_1_2_10");
  EXPECT_NEAR(index.views[0].yaw_rad, 0.0, 1e-12);
  EXPECT_NEAR(index.views[2].yaw_rad, 1.75 * pi, 1e-12);
  EXPECT_NEAR(index.views[3].yaw_rad, 0.5 * pi, 1e-12);
  EXPECT_EQ(index.views[3].file("loc.txt"), of_mug("mug_1_2_10_loc.txt"));
}

/// Of imported pictures: objects have words of their own, or one that begins like the category.
TEST_F(Index, ACategoryIsTheFolderThatItsObjectsAreNamedAfter) {
  support::put_view(root_.path(), "mug", "mug_red_1", 1, 1, "0");
  support::put_view(root_.path(), "mug", "mugs_1", 1, 1, "0");
  support::put_view(root_.path(), "mug", "mugs_1", 1, 2, "90");
  std::vector<std::string> found;
  for (const ViewEntry& view : index_dataset(root_.path()).views) {
    found.push_back(view.name.category + " " + to_string(view.name));
  }
  EXPECT_THAT(found, testing::ElementsAre("food_can food_can_2_1_1", "food_can food_can_2_4_1",
                                          "mug mug_1_2_9", "mug mug_1_2_10", "mug mug_red_1_1_1",
                                          "mugs mugs_1_1_1", "mugs mugs_1_1_2"));
}

TEST_F(Index, NamesAMissingFile) {
  std::filesystem::remove(of_mug("mug_1_2_10_depthcrop.png"));
  support::put_view(root_.path(), "mug", "mug_1", 2, 11, "0");
  expect_bad("mug_1_2_10_depthcrop.png", "is missing");
  EXPECT_EQ(index_dataset(root_.path(), OnBadView::skip).views.size(), 4U);
}

TEST_F(Index, NamesAViewWhoseNameCannotBeRead) {
  write_file(of_mug("mug_99999999999_2_1_crop.png"), "of an instance beyond every int");
  expect_bad("mug_99999999999_2_1_crop.png", "numbers up to 2147483647");
  std::filesystem::remove(of_mug("mug_99999999999_2_1_crop.png"));
  write_file(of_mug("left_crop.png"), "of no number");
  expect_bad("left_crop.png", "<category>_<instance>_<video>_<frame>_crop.png");
  std::filesystem::remove(of_mug("left_crop.png"));
  write_file(of_mug("mug_1_2_010_crop.png"), "of frame 10, as it is not written");
  expect_bad("mug_1_2_010_crop.png", "no 0 before them");
  EXPECT_EQ(index_dataset(root_.path(), OnBadView::skip).views.size(), 4U);
}

TEST_F(Index, NamesABadPose) {
  support::put_view(root_.path(), "mug", "mug_1", 2, 11, "north");
  expect_bad("mug_1_2_11_pose.txt", "expected the pose in degrees");
  support::put_view(root_.path(), "mug", "mug_1", 2, 11, "nan");
  expect_bad("mug_1_2_11_pose.txt", "expected the pose in degrees");
}

TEST_F(Index, NamesAnUnknownVideo) {
  support::put_view(root_.path(), "mug", "mug_1", 3, 1, "0");
  expect_bad("mug_1_3_1_crop.png", "video 3 is none of 1, 2, 4");
}

TEST_F(Index, NamesACategoryOfOneView) {
  support::put_view(root_.path(), "bowl", "bowl_1", 1, 1, "0");
  expect_bad("bowl_1_1_1_crop.png", "the only view of its category");
  EXPECT_EQ(index_dataset(root_.path(), OnBadView::skip).views.size(), 4U);
}

TEST_F(Index, NamesNotesOfOneDirection) {
  write_file(root_.path() / "pictures.yaml", "bins: 1\n");
  try {
    index_dataset(root_.path());
    ADD_FAILURE() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("pictures.yaml"));
    EXPECT_THAT(error.what(), HasSubstr("bins"));
  }
}

TEST(EmptyIndex, IsAnError) {
  const support::TemporaryDirectory root;
  EXPECT_THROW(index_dataset(root.path()), InputError);
  EXPECT_THROW(index_dataset(root.path() / "none"), InputError);
}

TEST(YawBins, BeginHalfABinBeforeTheirMiddle) {
  EXPECT_EQ(yaw_bin(pi / 3.0 - 1e-9, 3), 0);
  EXPECT_EQ(yaw_bin(pi / 3.0 + 1e-9, 3), 1);
  EXPECT_EQ(yaw_bin(pi - 1e-9, 3), 1);
  EXPECT_EQ(yaw_bin(pi + 1e-9, 3), 2);
  EXPECT_EQ(yaw_bin(5.0 * pi / 3.0 + 1e-9, 3), 0);
  EXPECT_EQ(yaw_bin(4.0, 1), 0);
}

TEST(Videos, AreTakenFromThreeElevations) {
  EXPECT_NEAR(video_elevation_rad(1).value(), pi / 6.0, 1e-12);
  EXPECT_NEAR(video_elevation_rad(2).value(), pi / 4.0, 1e-12);
  EXPECT_NEAR(video_elevation_rad(4).value(), pi / 3.0, 1e-12);
  for (const int video : {0, 3, 5}) EXPECT_FALSE(video_elevation_rad(video)) << video;
}

TEST(ViewNames, NumbersMayBeZeroAndAreWholeWords) {
  EXPECT_EQ(parse_view_name("mug_0_0_0"), (ViewName{"mug", "mug_0", 0, 0}));
  EXPECT_EQ(parse_view_name("mug_1_2_2147483647")->frame, 2147483647);
  for (const char* bad :
       {"mug_1_2_2147483648", "mug_1_2_3x", "mug_1x_2_3", "mug_1_x2_3", "1_2_3"}) {
    EXPECT_FALSE(parse_view_name(bad)) << bad;
  }
}

TEST_F(Index, ElevationsOfPosesGoBeforeThoseOfVideos) {
  support::put_view(root_.path(), "mug", "mug_1", 2, 10, "-30 90\n");
  support::put_view(root_.path(), "mug", "mug_1", 7, 1, "450 -12.5");
  const DatasetIndex index = index_dataset(root_.path());
  ASSERT_EQ(index.views.size(), 5U);
  EXPECT_FALSE(index.views[2].given_elevation_rad);
  EXPECT_NEAR(index.views[2].elevation_rad(), pi / 4.0, 1e-12);
  EXPECT_NEAR(index.views[3].yaw_rad, 11.0 * pi / 6.0, 1e-12);
  EXPECT_NEAR(index.views[3].elevation_rad(), pi / 2.0, 1e-12);
  EXPECT_NEAR(index.views[4].yaw_rad, pi / 2.0, 1e-12);
  EXPECT_NEAR(index.views[4].elevation_rad(), -12.5 * pi / 180.0, 1e-12);
  EXPECT_EQ(index.views[4].mask_from(), ObjectCut::mask);
  ViewEntry of_no_video = index.views[4];
  of_no_video.given_elevation_rad.reset();
  EXPECT_THROW((void)of_no_video.elevation_rad(), InputError);
}

TEST_F(Index, NamesPosesOfTooManyNumbersOrBeyondTheZenith) {
  for (const char* pose : {"", "1 2 3", "10 20x", "inf"}) {
    support::put_view(root_.path(), "mug", "mug_1", 2, 11, pose);
    expect_bad("mug_1_2_11_pose.txt", "expected the pose in degrees");
  }
  for (const char* pose : {"10 90.5", "10 -90.5"}) {
    support::put_view(root_.path(), "mug", "mug_1", 2, 11, pose);
    expect_bad("mug_1_2_11_pose.txt", "is beyond 90");
  }
  EXPECT_EQ(index_dataset(root_.path(), OnBadView::skip).views.size(), 4U);
}

TEST_F(Index, NotesAllowACategoryOfOneViewAndSayHowMasksWereMade) {
  write_file(root_.path() / "pictures.yaml", "cut: depth\n");
  support::put_view(root_.path(), "bowl", "bowl_1", 1, 1, "0");
  const DatasetIndex index = index_dataset(root_.path());
  ASSERT_EQ(index.views.size(), 5U);
  EXPECT_EQ(to_string(index.views[0].name), "bowl_1_1_1");
  EXPECT_EQ(index.views[0].mask_from(), ObjectCut::depth);
  EXPECT_FALSE(index.views[0].cut);
}

TEST_F(Index, IsSortedByCategoryObjectVideoAndFrame) {
  support::put_view(root_.path(), "mug", "mug_1", 1, 11, "0");
  support::put_view(root_.path(), "mug", "mug_2", 1, 1, "0");
  for (const int frame : {1, 2}) {
    support::put_view(root_.path(), "mug_1", "mug_1_5", 1, frame, "0");
  }
  std::vector<std::string> names;
  for (const ViewEntry& view : index_dataset(root_.path()).views) {
    names.push_back(to_string(view.name));
  }
  EXPECT_THAT(names,
              testing::ElementsAre("food_can_2_1_1", "food_can_2_4_1", "mug_1_1_11", "mug_1_2_9",
                                   "mug_1_2_10", "mug_2_1_1", "mug_1_5_1_1", "mug_1_5_1_2"));
}

TEST_F(Index, LeavesAloneWhatIsHiddenAndWhatIsNoFolder) {
  std::filesystem::create_directories(root_.path() / "mug" / ".mug_2");
  write_file(root_.path() / "mug" / ".mug_2" / "mug_2_2_1_crop.png", "half written");
  write_file(root_.path() / "mug" / "readme.txt", "of no object");
  support::put_view(root_.path(), "mug", "mug_1", 2, 10, "-1e-20");
  const DatasetIndex index = index_dataset(root_.path());
  ASSERT_EQ(index.views.size(), 4U);
  EXPECT_EQ(index.views[3].yaw_rad, 0.0) << "not a whole turn";
}

TEST(EmptyIndex, SaysWhatWasWrongWithTheFirstView) {
  const support::TemporaryDirectory root;
  std::filesystem::create_directories(root.path() / "mug" / "mug_1");
  for (const char* file : {"left_crop.png", "right_crop.png"}) {
    write_file(root.path() / "mug" / "mug_1" / file, "of no number");
  }
  try {
    index_dataset(root.path(), OnBadView::skip);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("left_crop.png"));
  }
}

TEST(ViewNames, ACategoryMayBeOneLetter) {
  EXPECT_EQ(parse_view_name("a_1_2_3"), (ViewName{"a", "a_1", 2, 3}));
}

}  // namespace
}  // namespace vantage
