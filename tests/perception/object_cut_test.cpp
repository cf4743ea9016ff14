#include "vantage/perception/object_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

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

/// From 0.6 m above a table, looking down by 0.7 rad, without noise.
ObjectView leaning_table(int width_px = 160, int height_px = 120) {
  ObjectView view;
  view.width_px = width_px;
  view.height_px = height_px;
  view.focal_px = 150.0;
  view.centre_px = {0.5 * width_px, 0.5 * height_px};
  view.rgb.assign(std::size_t{3} * width_px * height_px, 9);
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

}  // namespace
}  // namespace vantage
