// How a folder of pictures is read, without commands: cli_pictures_test.cpp has those.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <set>
#include <tuple>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/intrinsics_file.hpp"
#include "vantage/dataset/pictures/layout_pattern.hpp"
#include "vantage/dataset/pictures/picture_layout.hpp"
#include "vantage/dataset/pictures/pose_file.hpp"
#include "vantage/dataset/pictures/view_directions.hpp"
#include "vantage/perception/dataset_index.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Layout : public testing::Test {
 protected:
  void put(const std::string& colour, const std::string& depth) const {
    for (const auto& [file, type] : {std::pair{colour, CV_8UC3}, {depth, CV_16UC1}}) {
      const auto path = folder_.path() / file;
      std::filesystem::create_directories(path.parent_path());
      cv::imwrite(path.string(), cv::Mat(2, 2, type, cv::Scalar::all(200)));
    }
  }
  /// "recording|object|view" of each picture.
  std::set<std::string> found(const std::string& layout = "") const {
    std::set<std::string> texts;
    for (const FoundPicture& p : find_pictures(folder_.path(), layout).pictures) {
      texts.insert(p.recording + "|" + p.object + "|" + p.view +
                   (p.yaw_deg ? "@" + std::to_string(static_cast<int>(*p.yaw_deg)) : ""));
    }
    return texts;
  }
  support::TemporaryDirectory folder_;
};

TEST_F(Layout, FoldersOfObjects) {
  put("drill/front_rgb.png", "drill/front_depth.png");
  put("mug_2/back-left_1_color.png", "mug_2/back-left_1_depth.png");
  EXPECT_THAT(found(), ElementsAre("|drill_1|front", "|mug_2|back_left"));
}

TEST_F(Layout, FoldersOfKindsAndViews) {
  put("rgb/drill/front.png", "depth/drill/front.png");
  put("rgb/mug/left.png", "depth/mug/left.png");
  EXPECT_THAT(found(), ElementsAre("|drill_1|front", "|mug_1|left"));
}

TEST_F(Layout, AFolderAView) {
  put("drill/front/rgb.png", "drill/front/depth.png");
  put("mug/top/rgb.png", "mug/top/depth.png");
  EXPECT_THAT(found(), ElementsAre("|drill_1|front", "|mug_1|top"));
}

TEST_F(Layout, RoomsAndObjectsInEitherOrder) {
  for (const char* object : {"drill", "mug", "can"}) {
    for (const char* room : {"kitchen", "office"}) {
      const std::string a = std::string(room) + "/" + object + "/front_";
      put(a + "rgb.png", a + "depth.png");
    }
  }
  const auto first = found();
  EXPECT_EQ(first.size(), 6U);
  EXPECT_TRUE(first.contains("office|can_1|front"));
  std::filesystem::rename(folder_.path() / "kitchen", folder_.path() / "x");
  EXPECT_TRUE(found().contains("x|mug_1|front"));
}

TEST_F(Layout, CategoriesHoldTheirInstances) {
  put("mug/mug_1/front_rgb.png", "mug/mug_1/front_depth.png");
  put("mug/mug_2/front_rgb.png", "mug/mug_2/front_depth.png");
  put("can/can_1/front_rgb.png", "can/can_1/front_depth.png");
  EXPECT_THAT(found(), ElementsAre("|can_1|front", "|mug_1|front", "|mug_2|front"));
}

TEST_F(Layout, AllInOneFolder) {
  put("power_drill_front_rgb.png", "power_drill_front_depth.png");
  put("mug_left_rgb.png", "mug_left_depth.png");
  EXPECT_THAT(found(), ElementsAre("|mug_1|left", "|power_drill_1|front"));
}

TEST_F(Layout, ANumberBeforeTheViewIsTheInstanceAndOneBehindItTheFrame) {
  put("mug_1_front_rgb.png", "mug_1_front_depth.png");
  put("mug_2_front_rgb.png", "mug_2_front_depth.png");
  put("can_left_003_rgb.png", "can_left_003_depth.png");
  put("can_2_45deg_rgb.png", "can_2_45deg_depth.png");
  EXPECT_THAT(found(), ElementsAre("|can_1|left", "|can_2|@45", "|mug_1|front", "|mug_2|front"));
}

TEST_F(Layout, ViewsOfTheirOwnNamesAndAngles) {
  put("drill/view0_rgb.png", "drill/view0_depth.png");
  put("mug/45deg_rgb.png", "mug/45deg_depth.png");
  put("pan/30deg_far_shot_rgb.png", "pan/30deg_far_shot_depth.png");
  EXPECT_THAT(found(), ElementsAre("|drill_1|view0", "|mug_1|@45", "|pan_1|@30"));
}

TEST_F(Layout, APatternDecides) {
  put("a/x_30_rgb.png", "a/x_30_depth.png");
  EXPECT_THAT(found("{recording}/{object}_{yaw}_{kind}"), ElementsAre("a|x_1|@30"));
  EXPECT_THROW(LayoutPattern("{object}/{object}"), ConfigError);
  EXPECT_THROW(LayoutPattern("{view}_{kind}"), ConfigError);
  EXPECT_THROW((void)found("{object}/nowhere"), InputError);
}

TEST_F(Layout, WhatIsNotClearAsksForALayout) {
  for (const char* a : {"p", "q"}) {
    for (const char* b : {"r", "s"}) {
      const std::string stem = std::string(a) + "/" + b + "/front_";
      put(stem + "rgb.png", stem + "depth.png");
    }
  }
  try {
    (void)found();
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--layout"));
  }
}

TEST_F(Layout, ColourWithoutDepthIsLeftOutAndTold) {
  put("drill/front_rgb.png", "drill/front_depth.png");
  put("drill/left_rgb.png", "drill/other_depth.png");
  EXPECT_EQ(find_pictures(folder_.path(), "").left_out.size(), 2U);
}

TEST_F(Layout, ObjectsThatWouldBeCalledAlikeAreNamed) {
  int set = 0;
  for (const auto& [a, b, name] : {std::tuple("drill", "drill_1", "drill_1"),
                                   {"mug2", "mug_2", "mug_2"},
                                   {"mug-2", "mug 2", "mug_2"}}) {
    const std::string root = std::to_string(++set) + "/";
    for (const std::string object : {a, b}) {
      put(root + object + "/front_rgb.png", root + object + "/front_depth.png");
    }
    try {
      (void)find_pictures(folder_.path() / root, "");
      ADD_FAILURE() << "no error of " << a;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string("'") + a + "'"));
      EXPECT_THAT(error.what(), HasSubstr(std::string("'") + b + "'"));
      EXPECT_THAT(error.what(), HasSubstr(std::string("'") + name + "'; rename"));
    }
  }
}

TEST_F(Layout, ANumberBeyondEveryIntIsPartOfTheName) {
  put("coke_5449000000996/front_rgb.png", "coke_5449000000996/front_depth.png");
  put("coke_999999999/front_rgb.png", "coke_999999999/front_depth.png");
  EXPECT_THAT(found(), ElementsAre("|coke_5449000000996_1|front", "|coke_999999999|front"));
  EXPECT_TRUE(parse_view_name("coke_5449000000996_1_1_1").has_value());
}

TEST(Directions, NamesHaveAngles) {
  EXPECT_EQ(named_direction("Front")->yaw_deg, 0.0);
  EXPECT_EQ(named_direction("left_side")->yaw_deg, 270.0);
  EXPECT_EQ(named_direction("back-right")->yaw_deg, 135.0);
  EXPECT_EQ(named_direction("top")->elevation_deg, 90.0);
  EXPECT_FALSE(named_direction("drill").has_value());
  const Directions seven = directions_of_names(
      {"front", "left", "back", "right", "front_left", "back_left", "back_right"});
  EXPECT_TRUE(seven.degrees);
  EXPECT_EQ(seven.bins, 8);
  const Directions top = directions_of_names({"front", "top", "back"});
  EXPECT_FALSE(top.degrees);
  EXPECT_THAT(top.names, ElementsAre("front", "back", "top"));
}

TEST(Directions, FewAnglesGetABinEach) {
  EXPECT_EQ(bins_for({0, 90, 180, 270}), 4);
  EXPECT_EQ(bins_for({-60, -40, -20, 0, 20, 40, 60}), 18);
  EXPECT_EQ(bins_for({0, 51.43, 102.86, 154.29, 205.71, 257.14, 308.57}), 7);
  EXPECT_EQ(bins_for({0, 17, 23, 91}), 8);
}

TEST(PictureFiles, IntrinsicsAndPoses) {
  const support::TemporaryDirectory folder;
  const auto file = folder.path() / "camera";
  write_file(file, "fx: 525.0\nfy: 526.0\ncx: 319.5\ncy: 239.5\n");
  EXPECT_EQ(read_intrinsics(file).focal_px, 525.5);
  write_file(file, "{\"fx\": 500, \"fy\": 500, \"cx\": 320, \"cy\": 240}");
  EXPECT_EQ(read_intrinsics(file).centre_px[1], 240.0);
  write_file(file, "[[570, 0, 320], [0, 572, 241], [0, 0, 1]]");
  EXPECT_EQ(read_intrinsics(file).focal_px, 571.0);
  write_file(file, "570 0 320");
  EXPECT_THROW((void)read_intrinsics(file), InputError);
  write_file(file, "fx: 1e999\nfy: 1\ncx: 1\ncy: 1\n");
  EXPECT_THROW((void)read_intrinsics(file), InputError) << "beyond every number";
  write_file(file, "fx: " + std::string(2'000'000, '5'));
  EXPECT_THROW((void)read_intrinsics(file), InputError) << "no level for each digit";
  write_file(file, "30 45\n");
  EXPECT_EQ(read_picture_pose(file).elevation_deg, 45.0);
  // A camera 1 m before the front, 1 m up, that looks down by 45 deg.
  write_file(file, "0 0.7071 -0.7071 1  1 0 0 0  0 -0.7071 -0.7071 1  0 0 0 1");
  EXPECT_NEAR(read_picture_pose(file).yaw_deg, 0.0, 1e-9);
  EXPECT_NEAR(*read_picture_pose(file).elevation_deg, 45.0, 0.1);
  write_file(file, "north");
  EXPECT_THROW((void)read_picture_pose(file), InputError);
}

TEST_F(Layout, AFolderIsNoFileOfAPictureWhateverItsName) {
  put("drill/front_rgb.png", "drill/front_depth.png");
  for (const char* name : {"front_mask.png", "front_pose.txt"}) {
    std::filesystem::create_directories(folder_.path() / "drill" / name);
  }
  const FoundPicture picture = find_pictures(folder_.path(), "").pictures.at(0);
  EXPECT_FALSE(picture.mask);
  EXPECT_FALSE(picture.pose);
}

TEST_F(Layout, OfSeveralColoursWithoutDepthTheFirstIsNamed) {
  put("drill/front_rgb.png", "drill/front_depth.png");
  for (const char* colour : {"drill/left_rgb.png", "drill/left_color.png"}) {
    put(colour, "drill/other_depth.png");
  }
  EXPECT_THAT(find_pictures(folder_.path(), "").left_out,
              ElementsAre(HasSubstr("drill/left_color.png: has no depth"),
                          HasSubstr("drill/other_depth.png: has no colour")));
}

TEST_F(Layout, AnAngleMayHaveItsMarkBeforeIt) {
  put("can/az30_rgb.png", "can/az30_depth.png");
  put("cup/angle90_rgb.png", "cup/angle90_depth.png");
  put("drill/Yaw45_rgb.png", "drill/Yaw45_depth.png");
  put("mug/rot270_rgb.png", "mug/rot270_depth.png");
  EXPECT_THAT(found(), ElementsAre("|can_1|@30", "|cup_1|@90", "|drill_1|@45", "|mug_1|@270"));
}

TEST_F(Layout, SaysWhatItTakesFoldersFor) {
  const auto read = [&](const std::string& root, const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) {
      const std::string stem = root + "/" + folder + "/front_";
      put(stem + "rgb.png", stem + "depth.png");
    }
    const FoundPictures all = find_pictures(folder_.path() / root, "");
    const FoundPicture& first = all.pictures.front();
    return all.layout + " " + first.recording + "|" + first.category + "|" + first.object;
  };
  EXPECT_EQ(read("1", {"can/can_1", "mug/mug_1", "mug/mug_2"}),
            "{category}/{object}/{view}_{kind} |can|can_1");
  EXPECT_EQ(read("2", {"den/can/can_1", "den/mug/mug_1", "hall/mug/mug_1"}),
            "{recording}/{category}/{object}/{view}_{kind} den|can|can_1");
  EXPECT_EQ(read("3", {"can/den", "can/hall", "jug/den", "jug/hall", "mug/den"}),
            "{object}/{recording}/{view}_{kind} den|can|can_1");
  EXPECT_EQ(read("4", {"all/can", "all/mug"}), "{object}/{view}_{kind} |can|can_1")
      << "one folder round all says nothing";
}

TEST_F(Layout, ObjectsAreNamedAfterTheirCategoryOnce) {
  for (const char* object : {"mug/red", "mug/mug_blue", "mug/mug3", "mug/mugs", "can/can"}) {
    put(std::string(object) + "/front_rgb.png", std::string(object) + "/front_depth.png");
  }
  std::vector<std::string> names;
  for (const FoundPicture& p :
       find_pictures(folder_.path(), "{category}/{object}/{view}_{kind}").pictures) {
    names.push_back(p.category + " " + p.object);
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("mug mug_red_1", "mug mug_blue_1", "mug mug_3",
                                                   "mug mug_mugs_1", "can can_1"));
}

TEST_F(Layout, WordsThatAllFilesHaveSayNothingButNumbersDo) {
  put("drill/shot_1_wide_rgb.png", "drill/shot_1_wide_depth.png");
  put("mug/shot_1_wide_rgb.png", "mug/shot_1_wide_depth.png");
  EXPECT_THAT(found(), ElementsAre("|drill_1|1", "|mug_1|1"));
}

TEST_F(Layout, AMaskMayBeInColour) {
  put("drill/front_rgb.png", "drill/front_depth.png");
  put("drill/front_mask.png", "other/x_depth.png");
  put("rgb/mug/left.png", "depth/mug/left.png");
  put("masks/mug/left.png", "other/y_depth.png");
  const FoundPictures all = find_pictures(folder_.path(), "{object}/{view}_{*}");
  const FoundPictures by_folder = find_pictures(folder_.path(), "{*}/{object}/{view}");
  ASSERT_EQ(all.pictures.size(), 1U);
  EXPECT_EQ(all.pictures[0].colour.filename(), "front_rgb.png");
  ASSERT_TRUE(all.pictures[0].mask);
  EXPECT_EQ(all.pictures[0].mask->filename(), "front_mask.png");
  ASSERT_EQ(by_folder.pictures.size(), 1U);
  EXPECT_EQ(by_folder.pictures[0].colour.parent_path(), folder_.path() / "rgb/mug");
  ASSERT_TRUE(by_folder.pictures[0].mask);
}

TEST_F(Layout, APatternPassesByWhatItDoesNotFit) {
  put("a_rgb.png", "a_depth.png");
  put("b/x_30_rgb.png", "b/x_30_depth.png");
  const FoundPictures some = find_pictures(folder_.path(), "{recording}/{object}_{yaw}_{kind}");
  EXPECT_THAT(some.left_out, ElementsAre(HasSubstr("a_rgb.png: not of the form of --layout")));
  EXPECT_EQ(some.pictures.size(), 1U);
}

TEST_F(Layout, ADirectionMayHaveThreeWords) {
  put("drill_rear_left_side_rgb.png", "drill_rear_left_side_depth.png");
  put("mug_front_rgb.png", "mug_front_depth.png");
  EXPECT_THAT(found(), ElementsAre("|drill_1|rear_left_side", "|mug_1|front"));
  EXPECT_EQ(find_pictures(folder_.path(), "").layout, "{object}_{view}_{kind}");
}

TEST_F(Layout, FoldersMayBeDeeperForSome) {
  put("drill/front_rgb.png", "drill/front_depth.png");
  put("mug/new/left_rgb.png", "mug/new/left_depth.png");
  EXPECT_THAT(found(), ElementsAre("|drill_1|front", "|mug_1|left"));
}

TEST_F(Layout, FoldersThatDoNotTellTheObjectAskForALayout) {
  const auto error_of = [&](const std::string& root, const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) {
      const std::string stem = root + "/" + folder + "/front_";
      put(stem + "rgb.png", stem + "depth.png");
    }
    try {
      (void)find_pictures(folder_.path() / root, "");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of("1", {"can/can", "mug/mug"}), HasSubstr("2 levels of folders"));
  EXPECT_THAT(error_of("2", {"den/can/new", "den/mug/old", "hall/jug/new"}),
              HasSubstr("3 levels of folders"));
}

TEST_F(Layout, NumbersNameObjectsOrTheirInstances) {
  for (const char* object : {"7", "m3", "coke_1234567890"}) {
    put(std::string(object) + "/front_rgb.png", std::string(object) + "/front_depth.png");
  }
  EXPECT_THAT(found(), ElementsAre("|7_1|front", "|coke_1234567890_1|front", "|m_3|front"));
}

}  // namespace
}  // namespace vantage
