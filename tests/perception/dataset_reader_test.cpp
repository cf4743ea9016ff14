#include "vantage/perception/dataset_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/perception/dataset_files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

class Reader : public testing::Test {
 protected:
  void SetUp() override {
    support::put_view(root_.path(), "coffee_mug", "coffee_mug_1", 4, 1, "100.0\n");
    support::put_view(root_.path(), "coffee_mug", "coffee_mug_1", 4, 2, "105.0\n");
    entry_ = index_dataset(root_.path()).views.front();
  }
  void expect_bad(const std::string& file, const std::string& reason) {
    try {
      load_view(entry_);
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file));
      EXPECT_THAT(error.what(), HasSubstr(reason));
    }
    std::vector<SkippedView> skipped;
    EXPECT_FALSE(load_view(entry_, skipped));
    ASSERT_EQ(skipped.size(), 1U);
    EXPECT_THAT(skipped.front().reason, HasSubstr(reason));
  }
  support::TemporaryDirectory root_;
  ViewEntry entry_;
};

TEST_F(Reader, ReadsEveryPixel) {
  const LabelledView labelled = load_view(entry_);
  const ObjectView& view = labelled.view;
  EXPECT_EQ(labelled.name, entry_.name);
  EXPECT_NEAR(labelled.yaw_rad, 100.0 * pi / 180.0, 1e-12);
  EXPECT_EQ(view.width_px, 5);
  EXPECT_EQ(view.height_px, 4);
  EXPECT_EQ(view.left_px, 300);
  EXPECT_EQ(view.top_px, 200);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      const std::size_t i = view.index(row, column);
      EXPECT_EQ(view.rgb[3 * i], row);
      EXPECT_EQ(view.rgb[3 * i + 1], column);
      EXPECT_EQ(view.rgb[3 * i + 2], 7);
      const bool hole = row == 0 && column == 0;
      EXPECT_FLOAT_EQ(view.depth_m[i], hole ? 0.0F : 0.001F * static_cast<float>(1000 + column));
      EXPECT_EQ(view.mask[i], row == 1 || row == 2 ? 1 : 0);
    }
  }
}

TEST_F(Reader, UpFollowsFromTheElevation) {
  EXPECT_LT((load_view(entry_).view.up - Eigen::Vector3d(0.0, -0.5, -std::sqrt(0.75))).norm(),
            1e-12);
  EXPECT_LT((up_in_camera(0.0) - Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), 1e-12);
}

TEST_F(Reader, NamesATruncatedPicture) {
  const auto file = entry_.file("crop.png");
  const std::string whole = read_file(file);
  for (const std::size_t length : {std::size_t{1}, whole.size() / 2, whole.size() - 1}) {
    write_file(file, whole.substr(0, length));
    expect_bad("coffee_mug_1_4_1_crop.png", "is no whole PNG");
  }
}

TEST_F(Reader, NamesDamagedPixels) {
  const auto file = entry_.file("depthcrop.png");
  std::string bytes = read_file(file);
  const auto data = bytes.find("IDAT");
  for (std::size_t i = data + 4; i < data + 16; ++i) bytes[i] = '\x55';
  write_file(file, bytes);
  expect_bad("coffee_mug_1_4_1_depthcrop.png", "cannot be decoded");
}

TEST_F(Reader, NamesAMissingPicture) {
  std::filesystem::remove(entry_.file("depthcrop.png"));
  expect_bad("coffee_mug_1_4_1_depthcrop.png", "cannot read");
}

TEST_F(Reader, NamesSizesThatDiffer) {
  cv::imwrite(entry_.file("depthcrop.png").string(), cv::Mat(4, 6, CV_16UC1, cv::Scalar(900)));
  expect_bad("depthcrop.png", "is 6 x 4 px, the colour crop 5 x 4");
}

TEST_F(Reader, NamesAPictureOfAnotherKind) {
  cv::imwrite(entry_.file("depthcrop.png").string(), cv::Mat(4, 5, CV_8UC1, cv::Scalar(90)));
  expect_bad("depthcrop.png", "expected 16-bit depth");
}

TEST_F(Reader, NamesAnEmptyMask) {
  cv::imwrite(entry_.file("maskcrop.png").string(), cv::Mat::zeros(4, 5, CV_8UC1));
  expect_bad("maskcrop.png", "the mask is empty");
}

TEST_F(Reader, NamesABadLocation) {
  write_file(entry_.file("loc.txt"), "300;200");
  expect_bad("loc.txt", "expected the crop's top left pixel");
}

TEST_F(Reader, APairOfPicturesIsTheViewWithTheFilesBesideThem) {
  const auto colour = entry_.file("crop.png");
  const ObjectView pair = load_image_pair(colour, entry_.file("depthcrop.png"), {}).view;
  const ObjectView whole = load_view(entry_).view;
  EXPECT_EQ(pair.rgb, whole.rgb);
  EXPECT_EQ(pair.depth_m, whole.depth_m);
  EXPECT_EQ(pair.mask, whole.mask);
  EXPECT_EQ(pair.left_px, 300);
  EXPECT_EQ(pair.up, whole.up);
  EXPECT_NEAR(yaw_beside(colour).value(), 100.0 * pi / 180.0, 1e-12);
}

TEST_F(Reader, APairByItselfIsMaskedByDepthAndInTheMiddle) {
  const auto colour = root_.path() / "mine.png";
  const auto depth = root_.path() / "mine_depth.png";
  std::filesystem::copy(entry_.file("crop.png"), colour);
  std::filesystem::copy(entry_.file("depthcrop.png"), depth);
  EXPECT_FALSE(yaw_beside(colour).has_value());
  const ObjectView near =
      load_image_pair(colour, depth, {.elevation_rad = 0.0, .max_depth_m = 1.0015}).view;
  EXPECT_THAT(near.mask,
              testing::ElementsAre(0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0));
  EXPECT_EQ(near.left_px, 318);
  EXPECT_EQ(near.top_px, 238);
  EXPECT_EQ(near.up, Eigen::Vector3d(0.0, -1.0, -0.0));
  EXPECT_THAT(load_image_pair(colour, depth, {}).view.mask, testing::Each(1));
  try {
    load_image_pair(colour, depth, {.max_depth_m = 0.5});
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("mine_depth.png: nothing is nearer"));
  }
}

TEST_F(Reader, APoseBesideAPictureMustBeANumber) {
  for (const char* pose : {"north\n", "nan", "inf"}) {
    write_file(entry_.file("pose.txt"), pose);
    EXPECT_THROW(yaw_beside(entry_.file("crop.png")), InputError) << pose;
  }
}

class PairBeside : public Reader {
 protected:
  void put_notes(const std::string& text) { write_file(root_.path() / "pictures.yaml", text); }
  ImagePair pair(const PairSetting& setting = {}) {
    return load_image_pair(entry_.file("crop.png"), entry_.file("depthcrop.png"), setting);
  }
};

TEST_F(PairBeside, NotesGiveTheIntrinsics) {
  put_notes("focal_px: 400.0\ncentre_px: [310.0, 230.0]\n");
  const ObjectView view = pair().view;
  EXPECT_EQ(view.focal_px, 400.0);
  EXPECT_EQ(view.centre_px, Eigen::Vector2d(310.0, 230.0));
  EXPECT_EQ(pair({.focal_px = 300.0}).view.focal_px, 300.0);
  const ViewEntry entry = index_dataset(root_.path()).views.front();
  EXPECT_EQ(load_view(entry).view.focal_px, 400.0);
  EXPECT_EQ(load_view(entry).view.centre_px, Eigen::Vector2d(310.0, 230.0));
}

TEST_F(PairBeside, WithoutNotesTheCameraIsTheUsualOne) {
  PairSetting setting;
  setting.usual.emplace();
  setting.usual->focal_px = 500.0;
  setting.usual->centre_px = {315.0, 235.0};
  EXPECT_EQ(pair(setting).view.focal_px, 500.0);
  EXPECT_EQ(pair(setting).view.centre_px, Eigen::Vector2d(315.0, 235.0));
  put_notes("focal_px: 400.0\n");
  EXPECT_EQ(pair(setting).view.focal_px, 400.0);
  EXPECT_EQ(pair(setting).view.centre_px, Eigen::Vector2d(320.0, 240.0));
}

TEST_F(PairBeside, ElevationIsThatSaidElseOfThePoseElseOfTheVideo) {
  EXPECT_LT((pair().view.up - up_in_camera(pi / 3.0)).norm(), 1e-12);
  EXPECT_LT((pair({.elevation_rad = 0.2}).view.up - up_in_camera(0.2)).norm(), 1e-12);
  write_file(entry_.file("pose.txt"), "-90 20");
  EXPECT_LT((pair().view.up - up_in_camera(pi / 9.0)).norm(), 1e-12);
  EXPECT_NEAR(yaw_beside(entry_.file("crop.png")).value(), 1.5 * pi, 1e-12);
}

TEST_F(PairBeside, APictureThatIsNoViewOfADatasetIsOfNoVideo) {
  const std::filesystem::path picture = root_.path() / "mug_1_4_1_rgb.png";
  std::filesystem::copy_file(entry_.file("crop.png"), picture);
  const ImagePair pair =
      load_image_pair(picture, entry_.file("depthcrop.png"), {.cut = ObjectCut::whole});
  EXPECT_LT((pair.view.up - up_in_camera(pi / 4.0)).norm(), 0.01) << "not 60 deg";
}

TEST_F(PairBeside, CutsAsAsked) {
  const ImagePair masked = pair();
  EXPECT_EQ(masked.cut, ObjectCut::mask);
  EXPECT_THAT(masked.view.mask,
              testing::ElementsAre(0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0));
  const ImagePair whole = pair({.cut = ObjectCut::whole});
  EXPECT_EQ(whole.cut, ObjectCut::whole);
  EXPECT_THAT(whole.view.mask, testing::Each(1));
  put_notes("cut: whole\n");
  EXPECT_EQ(pair().cut, ObjectCut::whole);
  EXPECT_EQ(pair().view.mask, masked.view.mask) << "by the mask, which was made so";
  std::filesystem::remove(entry_.file("maskcrop.png"));
  EXPECT_EQ(pair().cut, ObjectCut::whole);
  EXPECT_THAT(pair().view.mask, testing::Each(1));
  EXPECT_THROW(pair({.cut = ObjectCut::mask}), InputError) << "by depth: 20 pixels are no object";
}

TEST_F(PairBeside, WhatIsAtTheGreatestDepthIsTheObject) {
  std::filesystem::remove(entry_.file("maskcrop.png"));
  const double third_m = static_cast<double>(0.001F * 1002.0F);
  const auto mask = pair({.max_depth_m = third_m}).view.mask;
  EXPECT_EQ(mask[0], 0) << "a hole";
  EXPECT_EQ(mask[2], 1);
  EXPECT_EQ(mask[3], 0);
  EXPECT_EQ(pair({.max_depth_m = third_m - 1e-6}).view.mask[2], 0);
}

TEST_F(PairBeside, TheViewHasTheNameOfItsBin) {
  const auto colour = entry_.file("crop.png");
  EXPECT_EQ(view_name_beside(colour), "");
  put_notes("bins: 4\n");
  EXPECT_EQ(view_name_beside(colour), "");
  put_notes("bins: 4\nviews: [front, left, back, right]\n");
  EXPECT_EQ(view_name_beside(colour), "left") << "at 100 degrees";
  write_file(entry_.file("pose.txt"), "-80");
  EXPECT_EQ(view_name_beside(colour), "right");
  std::filesystem::remove(entry_.file("pose.txt"));
  EXPECT_EQ(view_name_beside(colour), "");
  EXPECT_FALSE(yaw_beside(colour));
}

TEST_F(PairBeside, WithoutAPlaceItIsTheMiddleOfTheImage) {
  std::filesystem::remove(entry_.file("loc.txt"));
  EXPECT_EQ(pair().view.left_px, 318);
  EXPECT_EQ(pair().view.top_px, 238);
  put_notes("centre_px: [100.5, 60.0]\n");
  EXPECT_EQ(pair().view.left_px, 98);
  EXPECT_EQ(pair().view.top_px, 58);
}

TEST_F(Reader, PlacesMayBeNegativeButNotHalf) {
  write_file(entry_.file("loc.txt"), "-3,12");
  const ObjectView view = load_view(entry_).view;
  EXPECT_EQ(view.left_px, -3);
  EXPECT_EQ(view.top_px, 12);
  for (const char* bad : {"300", "300,", ",200", "x,200", ""}) {
    write_file(entry_.file("loc.txt"), bad);
    expect_bad("loc.txt", "expected the crop's top left pixel");
  }
}

TEST_F(Reader, CutsAViewAsItsEntrySays) {
  entry_.cut = ObjectCut::whole;
  EXPECT_THAT(load_view(entry_).view.mask, testing::Each(1));
  entry_.cut = ObjectCut::mask;
  EXPECT_EQ(load_view(entry_).view.mask[0], 0);
  entry_.cut = ObjectCut::depth;
  std::vector<SkippedView> skipped;
  EXPECT_FALSE(load_view(entry_, skipped)) << "20 pixels are no object";
  ASSERT_EQ(skipped.size(), 1U);
  EXPECT_THAT(skipped[0].file.string(), HasSubstr("_crop.png"));
}

/// 160 x 120 px in the middle of the image: a table that is looked down on by 0.7 rad, and a block
/// of 30 x 30 px before it.
void put_table(const std::filesystem::path& colour, const std::filesystem::path& depth) {
  const Eigen::Vector3d up = up_in_camera(0.7);
  cv::Mat1w depth_mm(120, 160);
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const Eigen::Vector3d ray((column - 80) / 570.3, (row - 60) / 570.3, 1.0);
      const bool block = row >= 45 && row < 75 && column >= 65 && column < 95;
      const double z_m = -0.6 / up.dot(ray) - (block ? 0.1 : 0.0);
      depth_mm(row, column) = static_cast<std::uint16_t>(std::lround(1000.0 * z_m));
    }
  }
  cv::imwrite(colour.string(), cv::Mat3b(120, 160, cv::Vec3b(9, 9, 9)));
  cv::imwrite(depth.string(), depth_mm);
}

TEST_F(Reader, TheTableTellsAnElevationThatIsNotKnown) {
  put_table(entry_.file("crop.png"), entry_.file("depthcrop.png"));
  write_file(entry_.file("loc.txt"), "240,180");
  entry_.cut = ObjectCut::depth;
  const ObjectView view = load_view(entry_).view;
  EXPECT_NEAR(static_cast<double>(std::ranges::count(view.mask, 1)), 900.0, 60.0);
  EXPECT_LT((view.up - up_in_camera(pi / 3.0)).norm(), 1e-12) << "that of its video";
  put_table(root_.path() / "mine.png", root_.path() / "mine_depth.png");
  const ImagePair pair = load_image_pair(root_.path() / "mine.png", root_.path() / "mine_depth.png",
                                         {.cut = ObjectCut::depth});
  EXPECT_EQ(pair.cut, ObjectCut::depth);
  EXPECT_LT((pair.view.up - up_in_camera(0.7)).norm(), 0.01);
}

TEST_F(Reader, AMaskNamedAsTheDepthCutsAPictureOfOnesOwn) {
  const auto at = [&](const char* name) { return root_.path() / name; };
  for (const char* folder : {"colour", "depth", "mask"})
    std::filesystem::create_directory(at(folder));
  put_table(at("mug.png"), at("mug_depth.png"));
  put_table(at("colour/mug.png"), at("depth/mug.png"));
  cv::Mat1b mask(120, 160, static_cast<std::uint8_t>(0));
  mask(cv::Rect(70, 50, 20, 10)) = 255;
  for (const char* name : {"mug_mask.png", "mask/mug.png"}) cv::imwrite(at(name).string(), mask);
  for (const ImagePair& pair :
       {load_image_pair(at("mug.png"), at("mug_depth.png"), {}),
        load_image_pair(at("colour/mug.png"), at("depth/mug.png"), {.cut = ObjectCut::mask})}) {
    EXPECT_EQ(pair.cut, ObjectCut::mask);
    EXPECT_EQ(std::ranges::count(pair.view.mask, 1), 200);
    EXPECT_LT(pair.view.width_px, 40) << "cropped round it";
    EXPECT_EQ(pair.view.left_px, 240 + 70 - (pair.view.width_px - 20) / 2) << "of 640 px";
  }
  EXPECT_EQ(load_image_pair(at("mug.png"), at("mug_depth.png"), {.cut = ObjectCut::depth}).cut,
            ObjectCut::depth);
}

TEST_F(Reader, NamesAMaskOfAnotherSize) {
  cv::imwrite(entry_.file("maskcrop.png").string(), cv::Mat(3, 5, CV_8UC1, cv::Scalar(255)));
  expect_bad("maskcrop.png", "is 5 x 3 px, the colour crop 5 x 4");
}

TEST_F(Reader, APairOfWhichNothingIsKnownIsSeenFromHalfWayUp) {
  std::filesystem::copy(entry_.file("crop.png"), root_.path() / "mine.png");
  std::filesystem::copy(entry_.file("depthcrop.png"), root_.path() / "mine_depth.png");
  const ImagePair pair =
      load_image_pair(root_.path() / "mine.png", root_.path() / "mine_depth.png", {});
  EXPECT_EQ(pair.cut, ObjectCut::whole);
  EXPECT_LT((pair.view.up - up_in_camera(pi / 4.0)).norm(), 1e-3);
}

TEST_F(PairBeside, NoYawIsNoWholeTurn) {
  for (const char* pose : {"0", "360", "-720"}) {
    write_file(entry_.file("pose.txt"), pose);
    EXPECT_EQ(yaw_beside(entry_.file("crop.png")).value(), 0.0) << pose;
  }
}

}  // namespace
}  // namespace vantage
