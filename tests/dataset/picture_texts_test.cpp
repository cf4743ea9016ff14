// What names, patterns and small files beside pictures say, without pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/intrinsics_file.hpp"
#include "vantage/dataset/pictures/layout_pattern.hpp"
#include "vantage/dataset/pictures/picture_files.hpp"
#include "vantage/dataset/pictures/pose_file.hpp"
#include "vantage/dataset/pictures/view_directions.hpp"

namespace vantage {
namespace {
using testing::ElementsAre;
using testing::Pair;

TEST(DirectionNames, HaveTheirAnglesInAnySpelling) {
  const std::pair<const char*, double> names[] = {
      {"front", 0.0},        {"forward", 0.0},        {"FRONTVIEW", 0.0},   {"right", 90.0},
      {"Back", 180.0},       {"rear", 180.0},         {"behind", 180.0},    {"left view", 270.0},
      {"front_right", 45.0}, {"right-front", 45.0},   {"backright", 135.0}, {"right back", 135.0},
      {"rear.right", 135.0}, {"rightrear", 135.0},    {"behindright", 135}, {"back_left", 225.0},
      {"leftback", 225.0},   {"rear-left_side", 225}, {"leftrear", 225.0},  {"behind_left", 225.0},
      {"frontleft", 315.0},  {"left-front", 315.0}};
  for (const auto& [name, yaw_deg] : names) {
    const auto found = named_direction(name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->yaw_deg, yaw_deg) << name;
    EXPECT_FALSE(found->elevation_deg) << name;
  }
}

TEST(DirectionNames, OfTopAndBottomAreElevations) {
  for (const auto& [name, elevation_deg] : {std::pair("top", 90.0),
                                            {"above", 90.0},
                                            {"up", 90.0},
                                            {"bottom", -90.0},
                                            {"below_view", -90.0},
                                            {"down", -90.0}}) {
    const auto found = named_direction(name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->elevation_deg, elevation_deg) << name;
    EXPECT_FALSE(found->yaw_deg) << name;
  }
  for (const char* none : {"view", "side", "front1", "front/left", "", "leftright"}) {
    EXPECT_FALSE(named_direction(none)) << none;
  }
}

/// Angles a tenth of a bin off its middle are on it; those within 2 deg are the same.
TEST(DirectionBins, PutFewAnglesOnTheMiddleOfOne) {
  EXPECT_EQ(bins_for({0, 180}), 2);
  EXPECT_EQ(bins_for({0, 350}), 2);
  EXPECT_EQ(bins_for({0, 98, 180, 270}), 4);
  EXPECT_EQ(bins_for({0, 100, 180, 270}), 36);
  EXPECT_EQ(bins_for({0, 1.9, 120, 240}), 3);
  EXPECT_EQ(bins_for({0, 2.1, 120, 240}), 6);
  EXPECT_EQ(bins_for({359, 0.5, 120, 240}), 3);
  EXPECT_EQ(bins_for({0, 9.9, 47}), 8) << "none of up to 36 fits";
  std::vector<double> of_37;
  for (const int i : {0, 1, 2, 3, 5, 8, 13}) of_37.push_back(i * 360.0 / 37.0);
  EXPECT_EQ(bins_for(of_37), 8) << "nor does any less than 37";
  EXPECT_EQ(bins_for({90}), 8);
  EXPECT_EQ(bins_for({}), 8);
  std::vector<double> turn;
  for (int i = 0; i < 12; ++i) turn.push_back(30.0 * i);
  EXPECT_EQ(bins_for(turn), 12);
  turn.push_back(15.0);
  EXPECT_EQ(bins_for(turn), 8) << "too many to be of few";
}

TEST(DirectionBins, OfNamesAreAnglesOrACircle) {
  const Directions four = directions_of_names({"left", "front", "right", "back", "front"});
  EXPECT_TRUE(four.degrees);
  EXPECT_THAT(four.names, ElementsAre("front", "right", "back", "left"));
  EXPECT_EQ(four.yaw_deg.at("left"), 270.0);
  const Directions twice = directions_of_names({"rear", "back"});
  EXPECT_FALSE(twice.degrees) << "both are 180 deg";
  EXPECT_EQ(twice.bins, 2);
  EXPECT_THAT(twice.yaw_deg, ElementsAre(Pair("back", 0.0), Pair("rear", 180.0)));
  const Directions circle = directions_of_names({"spout", "front", "handle"});
  EXPECT_FALSE(circle.degrees);
  EXPECT_THAT(circle.names, ElementsAre("front", "handle", "spout"));
  EXPECT_EQ(circle.yaw_deg.at("spout"), 240.0);
  EXPECT_THAT(directions_of_names({"top"}).names, ElementsAre("top", ""));
}

class SmallFile : public testing::Test {
 protected:
  std::filesystem::path with(const std::string& text) {
    write_file(folder_ / "file", text);
    return folder_ / "file";
  }
  support::TemporaryDirectory folder_;
};

TEST_F(SmallFile, OfAPoseIsAYawOrAYawAndElevationOrAMatrix) {
  EXPECT_EQ(read_picture_pose(with("30\n")).yaw_deg, 30.0);
  EXPECT_FALSE(read_picture_pose(with("30\n")).elevation_deg);
  EXPECT_EQ(read_picture_pose(with("-12.5, 90")).yaw_deg, -12.5);
  EXPECT_EQ(read_picture_pose(with("-12.5, 90")).elevation_deg, 90.0);
  EXPECT_EQ(read_picture_pose(with("7 -90")).elevation_deg, -90.0);
  // At (-1, 2) in the object's frame, looking down by 30 deg.
  const PicturePose pose = read_picture_pose(with("3 1 4 -1  1 5 9 2  6 5 -0.5 3"));
  EXPECT_NEAR(pose.yaw_deg, -116.56505117707799, 1e-9);
  EXPECT_NEAR(*pose.elevation_deg, 30.0, 1e-9);
  EXPECT_NEAR(*read_picture_pose(with("0 0 0 1 0 0 0 1 0 0 -1.1 0 0 0 0 1")).elevation_deg, 90.0,
              1e-9);
  EXPECT_NEAR(*read_picture_pose(with("0 0 0 1 0 0 0 1 0 0 1.1 0 0 0 0 1")).elevation_deg, -90.0,
              1e-9);
  EXPECT_NEAR(*read_picture_pose(with("0 0 0 1 0 0 0 1 0 0 0.75 0")).elevation_deg,
              -48.590377890729, 1e-9);
  for (const char* wrong : {"", "30 91", "30 -91", "1 2 3", "30 x", "30x", "nan", "30 inf",
                            "0 0 0 1 0 0 0 1 0 0 1 0 0"}) {
    EXPECT_THROW((void)read_picture_pose(with(wrong)), InputError) << wrong;
  }
}

TEST_F(SmallFile, OfIntrinsicsNamesThemOrIsAMatrix) {
  const auto intrinsics = [&](const std::string& text) { return read_intrinsics(with(text)); };
  const Intrinsics keys = intrinsics("old_fx: 100\nfx: 500\nfy: 524\ncx: 321\ncy: 239.5\n");
  EXPECT_EQ(keys.focal_px, 512.0);
  EXPECT_THAT(keys.centre_px, ElementsAre(321.0, 239.5));
  const Intrinsics quoted = intrinsics("{'fx' = +500, \"cx\": 1.5, \"cy\" : 2.5}");
  EXPECT_EQ(quoted.focal_px, 500.0);
  EXPECT_THAT(quoted.centre_px, ElementsAre(1.5, 2.5));
  const Intrinsics matrix = intrinsics("[[570, 0, 320], [0, 572, 241], [0, 0, 1]]");
  EXPECT_EQ(matrix.focal_px, 571.0);
  EXPECT_THAT(matrix.centre_px, ElementsAre(320.0, 241.0));
  const Intrinsics four = intrinsics("500 510 322 238\n");
  EXPECT_EQ(four.focal_px, 505.0);
  EXPECT_THAT(four.centre_px, ElementsAre(322.0, 238.0));
}

/// Of pixels above 10, and of both axes within 5 %.
TEST_F(SmallFile, OfIntrinsicsMakesSense) {
  const auto focal_px = [&](const std::string& fx, const std::string& fy) {
    return read_intrinsics(with("fx: " + fx + "\nfy: " + fy + "\ncx: 1\ncy: 2\n")).focal_px;
  };
  EXPECT_EQ(focal_px("500", "476"), 488.0);
  EXPECT_THROW(focal_px("500", "474"), InputError);
  EXPECT_THROW(focal_px("500", "526"), InputError);
  EXPECT_THROW(focal_px("10", "10"), InputError);
  EXPECT_EQ(focal_px("10.5", "10.5"), 10.5);
  EXPECT_THROW(focal_px("10.1", "9.9"), InputError);
  EXPECT_THROW(focal_px("10.0", "10.4"), InputError);
  EXPECT_THROW(focal_px("10.4", "10.0"), InputError);
  EXPECT_EQ(read_intrinsics(with("# fx fy cx cy\nfx=500\ncx=1\ncy=2\n")).focal_px, 500.0)
      << "where they are named first they have no number";
  EXPECT_THROW((void)read_intrinsics(with("fx: 500\ncx: 1\n")), InputError);
}

using Fields = std::map<std::string, std::string>;

TEST(LayoutPatterns, SayWhatTheFieldsOfAPathAre) {
  const LayoutPattern plain("{object}/{view}_{kind}");
  EXPECT_EQ(plain.match("mug/front_rgb"), (Fields{{"object", "mug"}, {"view", "front"}}));
  EXPECT_EQ(plain.match("mug/front_left_rgb"), (Fields{{"object", "mug"}, {"view", "front_left"}}));
  EXPECT_FALSE(plain.match("room/mug/front_rgb"));
  EXPECT_FALSE(plain.match("mug/front"));
  const LayoutPattern signs("{recording}.{object}-{frame}");
  EXPECT_EQ(signs.match("room.mug-12"),
            (Fields{{"recording", "room"}, {"object", "mug"}, {"frame", "12"}}));
  EXPECT_FALSE(signs.match("roomXmug-12"));
  EXPECT_FALSE(signs.match("room.mug-x"));
  EXPECT_EQ(LayoutPattern("{category}_{yaw}_{elevation}").match("mug_-30.5_45"),
            (Fields{{"category", "mug"}, {"yaw", "-30.5"}, {"elevation", "45"}}));
  EXPECT_EQ(LayoutPattern("{*}/{*}/{object}").match("a//mug"), (Fields{{"object", "mug"}}));
}

TEST(LayoutPatterns, ThatMakeNoSenseAreTold) {
  for (const char* wrong : {"{objct}/{view}", "{object}/{view}/{view}", "{view}", "{object", ""}) {
    EXPECT_THROW(LayoutPattern{wrong}, ConfigError) << wrong;
  }
}

TEST(PictureWords, ArePartedAtSignsAndPutTogether) {
  EXPECT_THAT(words_of("a_b-c d.e__f"), ElementsAre("a", "b", "c", "d", "e", "f"));
  EXPECT_THAT(words_of("_mug_"), ElementsAre("mug"));
  EXPECT_TRUE(words_of("").empty());
  EXPECT_EQ(joined_words({"a", "b", "c"}), "a_b_c");
  EXPECT_EQ(lower("AbC1_Z"), "abc1_z");
}

}  // namespace
}  // namespace vantage
