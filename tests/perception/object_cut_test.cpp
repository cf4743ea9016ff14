#include "vantage/perception/object_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tests/support/room_pictures.hpp"
#include "vantage/perception/background_planes.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace {

ObjectView view_of(const support::RoomPicture& picture) {
  ObjectView view;
  view.width_px = picture.bgr.cols;
  view.height_px = picture.bgr.rows;
  view.focal_px = support::kRoomFocal_px;
  view.centre_px = {0.5 * view.width_px, 0.5 * view.height_px};
  for (const auto& bgr : picture.bgr) view.rgb.insert(view.rgb.end(), {bgr[2], bgr[1], bgr[0]});
  view.depth_m.assign(picture.depth_m.begin(), picture.depth_m.end());
  view.mask.assign(view.depth_m.size(), 1);
  return view;
}

struct Overlap {
  double found = 0.0;  ///< of the object's pixels, in the mask
  double right = 0.0;  ///< of the mask's pixels, on the object
};

Overlap overlap(const CutObject& cut, const ObjectView& picture, const cv::Mat1b& truth) {
  double object = cv::countNonZero(truth), mask = 0.0, both = 0.0;
  for (int row = 0; row < cut.view->height_px; ++row) {
    for (int column = 0; column < cut.view->width_px; ++column) {
      if (cut.view->mask[cut.view->index(row, column)] == 0) continue;
      mask += 1.0;
      both += truth(row + cut.view->top_px - picture.top_px,
                    column + cut.view->left_px - picture.left_px) != 0
                  ? 1.0
                  : 0.0;
    }
  }
  return {both / object, both / mask};
}

/// Worst and mean over objects, views and rooms.
void expect_overlap(const support::Room& like, double mean_found, double mean_right, double worst) {
  double found = 0.0, right = 0.0;
  int count = 0;
  for (int k = 0; k < 5; ++k) {
    const auto object = support::made_up_object(std::string(1, static_cast<char>('a' + k)), 7);
    for (std::size_t v = 0; v < 7; v += 2) {
      support::Room room = like;
      room.seed = 10 + static_cast<std::uint64_t>(k);
      const auto picture = support::room_picture(object, support::yaw_of_named_view(v), room);
      const ObjectView view = view_of(picture);
      const CutObject cut = cut_by_depth(view);
      ASSERT_TRUE(cut.view.has_value()) << object.name << " " << v << ": " << cut.reason;
      const Overlap o = overlap(cut, view, picture.mask);
      EXPECT_GT(std::min(o.found, o.right), worst) << object.name << " view " << v;
      found += o.found;
      right += o.right;
      ++count;
    }
  }
  EXPECT_GT(found / count, mean_found);
  EXPECT_GT(right / count, mean_right);
  fmt::print("found {:.3f} right {:.3f}\n", found / count, right / count);
}

TEST(ObjectCut, FindsTheObjectInACrop) { expect_overlap({}, 0.9, 0.9, 0.7); }

TEST(ObjectCut, WithManyHoles) { expect_overlap({.holes = 0.4}, 0.8, 0.85, 0.5); }

TEST(ObjectCut, InAWholePicture) { expect_overlap({.margin = -1.0}, 0.85, 0.85, 0.6); }

TEST(ObjectCut, FromFlatAndFromSteep) {
  expect_overlap({.elevation_rad = 0.35}, 0.85, 0.85, 0.6);
  expect_overlap({.elevation_rad = 1.1}, 0.85, 0.85, 0.6);
}

TEST(ObjectCut, TellsTheElevationOverTheTable) {
  const auto object = support::made_up_object("a", 7);
  for (const double elevation_rad : {0.5, 0.9}) {
    const auto picture = support::room_picture(
        object, 0.0, {.elevation_rad = elevation_rad, .holes = 0.1, .margin = -1.0});
    const CutObject cut = cut_by_depth(view_of(picture));
    ASSERT_TRUE(cut.elevation_rad.has_value());
    EXPECT_NEAR(*cut.elevation_rad, elevation_rad, 0.06);
  }
}

TEST(ObjectCut, APictureWithoutDepthHasNoObject) {
  auto picture = support::room_picture(support::made_up_object("a", 7), 0.0, {});
  picture.depth_m = 0.0F;
  const CutObject cut = cut_by_depth(view_of(picture));
  EXPECT_FALSE(cut.view.has_value());
  EXPECT_FALSE(cut.reason.empty());
}

/// Without depth yet.
ObjectView grey_picture(int width_px, int height_px) {
  ObjectView view;
  view.width_px = width_px;
  view.height_px = height_px;
  view.focal_px = 150.0;
  view.centre_px = {0.5 * width_px, 0.5 * height_px};
  view.rgb.assign(std::size_t{3} * width_px * height_px, 9);
  return view;
}

/// From 0.6 m above a table, looking down by 0.7 rad, without noise.
ObjectView leaning_table(int width_px = 160, int height_px = 120) {
  ObjectView view = grey_picture(width_px, height_px);
  const Eigen::Vector3d up = up_in_camera(0.7);
  for (int row = 0; row < height_px; ++row) {
    for (int column = 0; column < width_px; ++column) {
      view.depth_m.push_back(static_cast<float>(-0.6 / up.dot(view.ray(row, column))));
    }
  }
  return view;
}

/// A square of 30 px whose depth is 10 cm before the table's.
void put_block(ObjectView& view, int top_px, int left_px) {
  for (int row = top_px; row < top_px + 30; ++row) {
    for (int column = left_px; column < left_px + 30; ++column) {
      view.depth_m[view.index(row, column)] -= 0.1F;
    }
  }
}

void lose_depth(ObjectView& view, int first_column, int last_column) {
  for (int row = 45; row < 75; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      view.depth_m[view.index(row, column)] = 0.0F;
    }
  }
}

TEST(BackgroundPlanes, ATableUnderABlockIsFoundExactly) {
  ObjectView view = leaning_table();
  put_block(view, 45, 65);
  const auto planes = background_planes(view);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_LT((planes[0].normal - up_in_camera(0.7)).norm(), 1e-5);
  EXPECT_NEAR(planes[0].offset_m, 0.6, 1e-5);
  EXPECT_DOUBLE_EQ(planes[0].share, 1.0 - 900.0 / 19200.0);
  EXPECT_NEAR(elevation_over(planes), 0.7, 1e-5);
}

TEST(BackgroundPlanes, APlaneWithNothingBeforeItIsNoBackground) {
  EXPECT_TRUE(background_planes(leaning_table()).empty());
}

/// A table under a block, of which only a part of the picture is measured.
std::size_t planes_in(const cv::Rect& part) {
  ObjectView view = leaning_table();
  put_block(view, 45, 65);
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (!part.contains(cv::Point(column, row))) view.depth_m[view.index(row, column)] = 0.0F;
    }
  }
  return background_planes(view).size();
}

TEST(BackgroundPlanes, ReachTheBorderOnOneSideAtLeast) {
  EXPECT_EQ(planes_in({0, 20, 100, 80}), 1U) << "left";
  EXPECT_EQ(planes_in({60, 20, 100, 80}), 1U) << "right";
  EXPECT_EQ(planes_in({20, 0, 120, 80}), 1U) << "top";
  EXPECT_EQ(planes_in({20, 40, 120, 80}), 1U) << "bottom";
  EXPECT_EQ(planes_in({20, 20, 120, 80}), 0U);
}

/// The second row, which has no depth, counts as long as each pixel is looked at.
TEST(BackgroundPlanes, OfFourTimes12000PixelsEverySecondIsLookedAt) {
  const auto share = [](int width_px, int height_px) {
    ObjectView view = leaning_table(width_px, height_px);
    put_block(view, 86, 106);
    for (int column = 0; column < width_px; ++column) view.depth_m[view.index(1, column)] = 0.0F;
    const auto planes = background_planes(view);
    return planes.size() == 1 ? planes[0].share : -1.0;
  };
  EXPECT_DOUBLE_EQ(share(233, 206), 1.0 - 900.0 / (233.0 * 205.0)) << "two pixels fewer than that";
  EXPECT_DOUBLE_EQ(share(240, 200), 1.0 - 225.0 / 12000.0);
}

void expect_block(const ObjectView& picture) {
  const CutObject cut = cut_by_depth(picture);
  ASSERT_TRUE(cut.view) << cut.reason;
  EXPECT_EQ(cut.view->left_px, 57);
  EXPECT_EQ(cut.view->top_px, 37);
  EXPECT_EQ(cut.view->width_px, 46);
  EXPECT_EQ(cut.view->height_px, 46);
  EXPECT_EQ(std::ranges::count(cut.view->mask, 1), 900);
  ASSERT_TRUE(cut.elevation_rad);
  EXPECT_NEAR(*cut.elevation_rad, 0.7, 1e-5);
}

TEST(ObjectCut, IsABlockToThePixel) {
  ObjectView view = leaning_table();
  put_block(view, 45, 65);
  expect_block(view);
}

TEST(ObjectCut, FillsHolesAndJoinsWhatAHoleParts) {
  ObjectView view = leaning_table();
  put_block(view, 45, 65);
  lose_depth(view, 77, 82);
  expect_block(view);
}

TEST(ObjectCut, IsWhatIsInTheMiddle) {
  ObjectView view = leaning_table();
  put_block(view, 5, 5);
  put_block(view, 45, 65);
  expect_block(view);
}

/// Of the middle only a strip of the table is measured, and 36 px of the block.
TEST(ObjectCut, SaysHowFewPixelsStandOut) {
  ObjectView view = leaning_table();
  put_block(view, 45, 65);
  for (int row = 30; row < 65; ++row) {
    for (int column = 40; column < 120; ++column) {
      const bool kept = row >= 45 && row < 51 && column >= 65 && column < 71;
      if (!kept) view.depth_m[view.index(row, column)] = 0.0F;
    }
  }
  for (int row = 65; row < 75; ++row) {
    for (int column = 65; column < 95; ++column) view.depth_m[view.index(row, column)] += 0.1F;
  }
  EXPECT_EQ(cut_by_depth(view).reason,
            "36 pixels stand out from the background by depth, an object has at least 40");
}

struct InFront {
  cv::Rect place;
  float z_m = 0.0F;
};

/// A wall 4 m away that the camera looks straight at, and rectangles parallel to it before it.
ObjectView before_a_wall(int width_px, int height_px, const std::vector<InFront>& things) {
  ObjectView view = grey_picture(width_px, height_px);
  view.depth_m.assign(std::size_t{1} * width_px * height_px, 4.0F);
  for (const InFront& thing : things) {
    for (int row = thing.place.y; row < thing.place.br().y; ++row) {
      for (int column = thing.place.x; column < thing.place.br().x; ++column) {
        view.depth_m[view.index(row, column)] = thing.z_m;
      }
    }
  }
  return view;
}

/// The wall, one thing 3 m away and one 2 m away.
std::size_t planes_with(const cv::Rect& at_3m) {
  return background_planes(before_a_wall(160, 120, {{at_3m, 3.0F}, {{90, 75, 10, 10}, 2.0F}}))
      .size();
}

TEST(BackgroundPlanes, HaveTheirShareOfThePictureOfItsBorderAndOfItsMiddle) {
  EXPECT_EQ(planes_with({0, 0, 20, 120}), 2U) << "an eighth of the picture";
  EXPECT_EQ(planes_with({0, 0, 19, 120}), 1U);
  EXPECT_EQ(planes_with({0, 10, 108, 40}), 2U) << "of its 108 columns 13 are at the border";
  EXPECT_EQ(planes_with({0, 10, 109, 40}), 1U);
  EXPECT_EQ(planes_with({0, 10, 80, 36}), 2U) << "468 of 5800 at the border";
  EXPECT_EQ(planes_with({0, 10, 80, 35}), 1U);
  EXPECT_EQ(planes_with({0, 30, 80, 36}), 2U) << "half of it in the middle";
  EXPECT_EQ(planes_with({0, 30, 81, 36}), 1U);
}

TEST(BackgroundPlanes, AreFourAtMost) {
  const auto planes = background_planes(before_a_wall(160, 120,
                                                      {{{32, 0, 32, 120}, 1.6F},
                                                       {{64, 0, 32, 120}, 3.0F},
                                                       {{96, 0, 32, 120}, 1.2F},
                                                       {{128, 0, 32, 120}, 2.2F},
                                                       {{75, 55, 10, 10}, 0.7F}}));
  EXPECT_EQ(planes.size(), 4U);
}

/// 1.5 % of the 80 x 60 px in the middle are 72.
TEST(BackgroundPlanes, HaveSomethingBeforeThem) {
  ObjectView view = before_a_wall(160, 120, {{{76, 56, 8, 9}, 2.0F}});
  EXPECT_EQ(background_planes(view).size(), 1U);
  view.depth_m[view.index(56, 76)] = 4.0F;
  EXPECT_TRUE(background_planes(view).empty());
}

TEST(BackgroundPlanes, AreOfThirtyMeasuredPixelsAtLeast) {
  ObjectView view = before_a_wall(10, 3, {{{0, 0, 10, 3}, 2.0F}, {{5, 1, 1, 1}, 1.0F}});
  view.focal_px = 10.0;
  EXPECT_EQ(background_planes(view).size(), 1U);
  view.depth_m[view.index(0, 4)] = 0.0F;
  EXPECT_TRUE(background_planes(view).empty());
}

std::ptrdiff_t pixels_cut(const ObjectView& view) {
  const CutObject cut = cut_by_depth(view);
  return cut.view ? std::ranges::count(cut.view->mask, 1) : 0;
}

/// Narrower than four times a 60th of the picture's longer side, of 1 to 4 px.
TEST(ObjectCut, BridgesHolesByTheSizeOfThePicture) {
  const auto bridges = [](int width_px, int height_px, int hole_px) {
    ObjectView view = leaning_table(width_px, height_px);
    const int left_px = width_px / 2 - 15;
    put_block(view, 45, left_px);
    lose_depth(view, left_px + 10, left_px + 9 + hole_px);
    return pixels_cut(view) == 900;
  };
  EXPECT_TRUE(bridges(120, 100, 7));
  EXPECT_FALSE(bridges(120, 100, 8));
  EXPECT_TRUE(bridges(119, 100, 3));
  EXPECT_FALSE(bridges(119, 100, 4));
  EXPECT_TRUE(bridges(300, 120, 15));
  EXPECT_FALSE(bridges(300, 120, 16));
}

TEST(ObjectCut, WhatIsBeyondTheRangeIsAHole) {
  ObjectView view = leaning_table();
  put_block(view, 45, 65);
  lose_depth(view, 77, 82);
  std::ranges::replace(view.depth_m, 0.0F, INFINITY);
  expect_block(view);
  EXPECT_DOUBLE_EQ(background_planes(view).at(0).share, 18300.0 / 19020.0);
}

/// Steps of 2.5 cm and a hundredth of the depth hold together, at 3 m 5.5 cm.
TEST(ObjectCut, PartsAtSteps) {
  const auto pixels = [](const std::vector<InFront>& things) {
    return pixels_cut(before_a_wall(160, 120, things));
  };
  EXPECT_EQ(pixels({{{60, 45, 20, 30}, 3.0F}, {{80, 45, 20, 30}, 3.07F}}), 600);
  EXPECT_EQ(pixels({{{50, 45, 15, 30}, 3.0F},
                    {{65, 45, 15, 30}, 3.05F},
                    {{80, 45, 15, 30}, 3.1F},
                    {{95, 45, 15, 30}, 3.15F}}),
            1800);
  // Across 4 px without depth 6 cm.
  const auto across = [&](float z_m) {
    return pixels({{{60, 45, 20, 30}, 3.0F}, {{80, 45, 4, 30}, 0.0F}, {{84, 45, 19, 30}, z_m}});
  };
  EXPECT_EQ(across(3.05F), 1290);
  EXPECT_EQ(across(3.07F), 600);
  // Three fifths of the nearer part, and so its median, are 5 cm before the other.
  EXPECT_EQ(pixels({{{60, 45, 20, 12}, 3.0F},
                    {{60, 57, 20, 18}, 3.05F},
                    {{80, 45, 4, 30}, 0.0F},
                    {{84, 45, 19, 30}, 3.1F}}),
            1290);
}

/// One of two things of 40 px, which are enough to show that the wall is behind them.
TEST(ObjectCut, FortyPixelsAreAnObject) {
  EXPECT_EQ(pixels_cut(before_a_wall(160, 120, {{{76, 58, 8, 5}, 2.0F}, {{44, 34, 8, 5}, 3.0F}})),
            40);
}

/// Across holes: the third is near the second alone, and all three weigh more than the fourth.
TEST(ObjectCut, JoinsPartAfterPart) {
  EXPECT_EQ(pixels_cut(before_a_wall(160, 120,
                                     {{{40, 45, 73, 30}, 0.0F},
                                      {{40, 45, 40, 30}, 3.0F},
                                      {{84, 45, 13, 30}, 3.04F},
                                      {{101, 45, 12, 30}, 3.0F},
                                      {{40, 80, 70, 35}, 2.5F}})),
            2190);
}

/// A block of 210 px with a bar 2 px wide, which stays if the block is less than 7/10 of all.
TEST(ObjectCut, WhatIsThinIsSmoothedAwayIfItIsLittle) {
  const auto pixels = [](int bar_px, const cv::Rect& elsewhere) {
    return pixels_cut(before_a_wall(
        160, 120, {{{60, 50, 15, 14}, 2.0F}, {{75, 55, bar_px, 2}, 2.0F}, {elsewhere, 2.0F}}));
  };
  EXPECT_EQ(pixels(45, {}), 210);
  EXPECT_EQ(pixels(46, {}), 302);
  EXPECT_EQ(pixels(46, {20, 10, 5, 4}), 210) << "230 of 322 are thick";
  EXPECT_EQ(pixels(44, {20, 10, 10, 2}), 210) << "of it, if not of all";
}

/// A square in the middle, and something larger.
bool middle_is_cut(int height_px, const cv::Rect& other) {
  return pixels_cut(before_a_wall(160, height_px,
                                  {{{72, height_px / 2 - 8, 16, 16}, 2.0F}, {other, 3.0F}})) == 256;
}

TEST(ObjectCut, OfAWholePictureTheFrameCutsNoObject) {
  EXPECT_TRUE(middle_is_cut(300, {0, 125, 40, 50}));
  EXPECT_TRUE(middle_is_cut(300, {120, 125, 40, 50}));
  EXPECT_TRUE(middle_is_cut(300, {65, 0, 30, 80}));
  EXPECT_TRUE(middle_is_cut(300, {65, 220, 30, 80}));
  EXPECT_FALSE(middle_is_cut(300, {1, 125, 40, 50})) << "a pixel beside the frame";
  EXPECT_FALSE(middle_is_cut(300, {119, 125, 40, 50}));
  EXPECT_FALSE(middle_is_cut(300, {65, 1, 30, 80}));
  EXPECT_FALSE(middle_is_cut(300, {65, 219, 30, 80}));
  EXPECT_FALSE(middle_is_cut(300, {0, 110, 55, 80})) << "more than five times as much";
  EXPECT_FALSE(middle_is_cut(299, {0, 125, 40, 50})) << "a crop";
}

TEST(ObjectCut, IsNearTheMiddleOrSoMuchLarger) {
  const auto corner = [](const cv::Rect& a, const cv::Rect& b) {
    const CutObject cut = cut_by_depth(before_a_wall(160, 120, {{a, 2.0F}, {b, 2.4F}}));
    return cut.view ? cv::Point(cut.view->left_px + 8, cut.view->top_px + 8) : cv::Point();
  };
  // The first begins 30 or 29 px before the middle, the second ends 29 or 30 behind.
  EXPECT_EQ(corner({50, 52, 16, 16}, {93, 52, 16, 16}), cv::Point(93, 52));
  EXPECT_EQ(corner({51, 52, 16, 16}, {94, 52, 16, 16}), cv::Point(51, 52));
  EXPECT_EQ(corner({72, 32, 16, 16}, {72, 71, 16, 16}), cv::Point(72, 71));
  EXPECT_EQ(corner({72, 33, 16, 16}, {72, 72, 16, 16}), cv::Point(72, 33));
  // They weigh 143 and 338, then 143 and 105.
  EXPECT_EQ(corner({74, 54, 12, 12}, {10, 40, 30, 30}), cv::Point(10, 40));
  EXPECT_EQ(corner({74, 54, 12, 12}, {2, 3, 30, 30}), cv::Point(74, 54));
}

/// A block of 210 px with a bar of 90 px, and something else that keeps the bar from being smoothed
/// away before.
TEST(ObjectCut, SevenTenthsAreEnoughToSmoothTheRestAway) {
  EXPECT_EQ(
      pixels_cut(before_a_wall(
          160, 120, {{{60, 50, 15, 14}, 2.0F}, {{75, 55, 45, 2}, 2.0F}, {{20, 10, 10, 2}, 2.0F}})),
      210);
}

/// A hole above the smaller part and below the larger one is bridged as one beside them.
TEST(ObjectCut, JoinsPartsAboveEachOtherToo) {
  const auto pixels = [](int hole_px) {
    return pixels_cut(before_a_wall(160, 120,
                                    {{{60, 40, 30, 20}, 3.0F},
                                     {{60, 60, 30, hole_px}, 0.0F},
                                     {{60, 60 + hole_px, 30, 19}, 3.0F}}));
  };
  EXPECT_EQ(pixels(7), 600 + 210 + 570);
  EXPECT_EQ(pixels(8), 600);
}

/// Two blocks of 140 px, between which the wall is seen.
TEST(ObjectCut, GapsOfTwoPixelsAreClosed) {
  const auto pixels = [](int gap_px) {
    return pixels_cut(
        before_a_wall(160, 120, {{{65, 50, 10, 14}, 2.0F}, {{75 + gap_px, 50, 10, 14}, 2.0F}}));
  };
  EXPECT_EQ(pixels(1), 280 + 14);
  EXPECT_EQ(pixels(2), 280 + 28);
  EXPECT_EQ(pixels(3), 280);
}

/// Strips at each side of the picture, and what fills its middle before them.
TEST(BackgroundPlanes, WhatIsNoneOfThemIsNoneOfTheFour) {
  EXPECT_EQ(background_planes(before_a_wall(160, 120,
                                            {{{0, 0, 160, 20}, 2.0F},
                                             {{0, 100, 160, 20}, 3.0F},
                                             {{130, 20, 30, 80}, 2.5F},
                                             {{30, 20, 100, 80}, 1.0F}}))
                .size(),
            4U);
}

}  // namespace
}  // namespace vantage
