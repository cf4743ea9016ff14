#include "vantage/dataset/turntable.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "tests/dataset/cube.hpp"
#include "vantage/dataset/sensing.hpp"
#include "vantage/perception/features/standing_box.hpp"

namespace vantage {
namespace {

using std::numbers::pi;
constexpr double kElevation_rad = pi / 6.0;

struct Pixel {
  int r, g, b;
};

/// Mean colour of the lower middle of the object: the face towards the camera.
Pixel face_colour(const RenderedImages& images) {
  const std::size_t row = static_cast<std::size_t>(images.height_px * 11 / 20);
  const std::size_t i = 3 * (row * static_cast<std::size_t>(images.width_px) +
                             static_cast<std::size_t>(images.width_px / 2));
  return {images.rgb[i], images.rgb[i + 1], images.rgb[i + 2]};
}

class Cube : public testing::Test {
 protected:
  RenderedImages draw(double yaw_rad) {
    RenderedImages images;
    table_.draw(yaw_rad, images);
    return images;
  }
  DatasetOptions options_{.supersampling = 1};
  Turntable table_{support::coloured_cube(), support::plain_session(kElevation_rad), options_,
                   "cube", make_offscreen_context()};
};

TEST_F(Cube, ShowsItsXSideAtYawZeroAndTurnsCounterClockwise) {
  const Pixel front = face_colour(draw(0.0));
  EXPECT_GT(front.r, 2 * std::max(front.g, front.b));  // +x is red
  const Pixel quarter = face_colour(draw(0.5 * pi));
  EXPECT_GT(quarter.r, 2 * quarter.b);  // -y is yellow
  EXPECT_GT(quarter.g, 2 * quarter.b);
  const Pixel half = face_colour(draw(pi));
  EXPECT_GT(half.g, 2 * std::max(half.r, half.b));  // -x is green
}

TEST_F(Cube, DepthAndSizeAreThoseOfTheVirtualCamera) {
  const RenderedImages images = draw(0.0);
  const int middle = images.width_px / 2;
  const auto at = [&](int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(images.width_px) +
           static_cast<std::size_t>(column);
  };
  EXPECT_NEAR(images.focal_px, kFocal_px, 1e-3 * kFocal_px);
  EXPECT_EQ(images.segmentation[at(middle, middle)], table_.object_geom());
  // The optical axis meets the upright face x = 0.05 at 0.05 / cos(elevation) before the axis.
  EXPECT_NEAR(images.depth_m[at(middle, middle)], 0.8 - 0.05 / std::cos(kElevation_rad), 1e-3);
  int width = 0;
  for (int column = 0; column < images.width_px; ++column) {
    width += images.segmentation[at(middle, column)] == table_.object_geom() ? 1 : 0;
  }
  EXPECT_NEAR(width, kFocal_px * 0.1 / (0.8 - 0.05 / std::cos(kElevation_rad)), 1.5);
}

TEST_F(Cube, StandsOnTheTableInsideTheWindow) {
  for (const double yaw : {0.0, 0.3, pi / 4.0}) {
    const RenderedImages images = draw(yaw);
    for (int i = 0; i < images.width_px; ++i) {
      for (const int at : {i, (images.height_px - 1) * images.width_px + i, i * images.width_px,
                           (i + 1) * images.width_px - 1}) {
        EXPECT_NE(images.segmentation[static_cast<std::size_t>(at)], table_.object_geom());
      }
    }
  }
}

/// Pixels of the full image that a view's mask has.
std::set<std::pair<int, int>> pixels_of(const ObjectView& view) {
  std::set<std::pair<int, int>> pixels;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (view.mask[view.index(row, column)] == 0) continue;
      pixels.emplace(view.top_px + row, view.left_px + column);
    }
  }
  return pixels;
}

TEST_F(Cube, CutOutByDepthIsWhatRisesFromTheTable) {
  DatasetOptions options{.colour_noise = 0.0,
                         .depth_noise = false,
                         .edge_dropout = 0.0,
                         .mask_growth_px = 0,
                         .supersampling = 1};
  const auto cut = [&](double yaw_rad) {
    Rng rng(1);
    return pixels_of(sense(draw(yaw_rad), table_.object_geom(),
                           support::plain_session(kElevation_rad), options, rng));
  };
  const std::set<std::pair<int, int>> outline = cut(0.3);
  options.cut_by_depth = true;
  const std::set<std::pair<int, int>> by_depth = cut(0.3);
  std::vector<std::pair<int, int>> both;
  std::ranges::set_intersection(outline, by_depth, std::back_inserter(both));
  EXPECT_NE(by_depth, outline) << "the lowest millimetres of it are lost";
  EXPECT_GT(both.size(), outline.size() * 97 / 100);
  EXPECT_GT(both.size(), by_depth.size() * 97 / 100);
}

TEST_F(Cube, CutOutByDepthItShowsItsStand) {
  options_.cut_by_depth = true;
  Rng rng(1);
  const ObjectView view =
      sense(draw(0.0), table_.object_geom(), support::plain_session(kElevation_rad), options_, rng);
  const FeatureResult box = StandingBox{}.extract(view);
  ASSERT_TRUE(box.extracted()) << box.skipped;
  EXPECT_NEAR(box.vector[0], 0.1, 0.004);
}

TEST_F(Cube, WhatIsTooFlatIsNotCutOutByDepth) {
  Rng rng(1);
  RenderedImages bare = draw(0.0);
  const Eigen::Vector3d p_m = bare.T_world_camera.translation();
  const Eigen::Matrix3d rotation = bare.T_world_camera.linear();
  for (int row = 0; row < bare.height_px; ++row) {  // a table 5 mm higher and nothing on it
    for (int column = 0; column < bare.width_px; ++column) {
      const Eigen::Vector3d ray((column - 0.5 * (bare.width_px - 1)) / bare.focal_px,
                                (row - 0.5 * (bare.height_px - 1)) / bare.focal_px, 1.0);
      const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(bare.width_px) +
                     static_cast<std::size_t>(column);
      bare.depth_m[i] = static_cast<float>((0.005 - p_m.z()) / (rotation * ray).z());
    }
  }
  options_.cut_by_depth = true;
  options_.depth_noise = false;
  const ObjectView view =
      sense(bare, table_.object_geom(), support::plain_session(kElevation_rad), options_, rng);
  EXPECT_EQ(view.width_px, 0);
}

TEST(Window, HoldsTheBoundingSphere) {
  const TurntableObject object = support::coloured_cube();
  Session session = support::plain_session(kElevation_rad);
  const double reach = std::sqrt(3.0) * 0.05;
  const double angle = std::asin(reach / session.distance_m);
  EXPECT_GE(window_radius_px(object, session, "cube"), kFocal_px * std::tan(angle));
  EXPECT_LE(window_radius_px(object, session, "cube"), kFocal_px * std::tan(angle) + 10.0);
  session.distance_m = 0.2;
  EXPECT_THROW(window_radius_px(object, session, "cube"), InputError);
  session.distance_m = 0.05;
  EXPECT_THROW(window_radius_px(object, session, "cube"), InputError);
}

TEST(Sessions, ChangeOnlyWhatTheOptionsLet) {
  Rng rng(3);
  const DatasetOptions still{.step_deg = 30.0, .placement_m = 0.0, .lighting = 0.0};
  const Session a = draw_session(still, 0.5, rng);
  const Session b = draw_session(still, 0.5, rng);
  EXPECT_EQ(a.lamp_heading_rad, b.lamp_heading_rad);
  EXPECT_EQ(a.gain, Eigen::Vector3d::Ones());
  EXPECT_EQ(a.offset_m.norm(), 0.0);
  EXPECT_NE(a.first_yaw_rad, b.first_yaw_rad);
  for (int i = 0; i < 200; ++i) {
    const Session session = draw_session({.step_deg = 30.0, .placement_m = 0.02}, 0.5, rng);
    EXPECT_LE(session.offset_m.norm(), 0.02);
    EXPECT_GE(session.first_yaw_rad, 0.0);
    EXPECT_LT(session.first_yaw_rad, pi / 6.0);
    EXPECT_LT((session.gain - Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff(), 0.13);
  }
}

/// The sphere's radius in the image, rounded up, and 8 px.
TEST(Window, IsAsWideAsItsSphere) {
  TurntableObject object = support::coloured_cube();
  object.box_m =
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.05, -0.05, 0.0), Eigen::Vector3d(0.05, 0.05, 0.1));
  Session session = support::plain_session(kElevation_rad);
  EXPECT_EQ(window_radius_px(object, session, "cube"), 63 + 8);
  session.offset_m = Eigen::Vector2d(0.03, -0.04);
  EXPECT_EQ(window_radius_px(object, session, "cube"), 95 + 8);
  object.box_m =
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.01, 0.02, 0.3), Eigen::Vector3d(0.05, 0.1, 0.7));
  EXPECT_EQ(window_radius_px(object, session, "pole"), 167 + 8);
  session.distance_m = 0.6;
  EXPECT_EQ(window_radius_px(object, session, "pole"), 230 + 8);
  session.distance_m = 0.5967;
  EXPECT_EQ(window_radius_px(object, session, "pole"), 239)
      << "half of the image but for its middle";
  session.distance_m = 0.595;
  EXPECT_THROW(window_radius_px(object, session, "pole"), InputError);
}

/// Of many draws the least and the greatest are near the ends of their range.
TEST(Sessions, VaryAsMuchAsTheirOptionsSay) {
  Rng rng(3);
  const DatasetOptions options{
      .step_deg = 30.0, .distance_m = 2.0, .placement_m = 0.05, .lighting = 1.0};
  std::map<std::string, std::vector<double>> drawn;
  for (int i = 0; i < 4000; ++i) {
    const Session session = draw_session(options, 0.5, rng);
    ASSERT_EQ(session.elevation_rad, 0.5);
    drawn["distance"].push_back(session.distance_m);
    drawn["offset x"].push_back(session.offset_m.x());
    drawn["offset y"].push_back(session.offset_m.y());
    drawn["yaw"].push_back(session.first_yaw_rad);
    drawn["heading"].push_back(session.lamp_heading_rad);
    drawn["elevation"].push_back(session.lamp_elevation_rad);
    drawn["ambient"].push_back(session.ambient);
    drawn["table"].push_back(session.table);
    drawn["white balance"].push_back(session.gain.x() / session.gain.z());
  }
  const auto expect_range = [&](const char* what, double least, double most) {
    const auto [low, high] = std::ranges::minmax(drawn[what]);
    const double slack = 0.02 * (most - least);
    EXPECT_GE(low, least - 1e-12) << what;
    EXPECT_LT(low, least + slack) << what;
    EXPECT_LE(high, most + 1e-12) << what;
    EXPECT_GT(high, most - slack) << what;
  };
  expect_range("distance", 1.94, 2.06);
  expect_range("offset x", -0.05, 0.05);
  expect_range("offset y", -0.05, 0.05);
  expect_range("yaw", 0.0, pi / 6.0);
  expect_range("heading", -0.6, 1.8);
  expect_range("elevation", 0.75, 1.25);
  expect_range("ambient", 0.36, 0.48);
  expect_range("table", 0.5, 0.74);
  const auto [low, high] = std::ranges::minmax(drawn["white balance"]);
  EXPECT_GE(low, 0.97 / 1.03 - 1e-12);
  EXPECT_LT(low, 0.96);
  EXPECT_LE(high, 1.03 / 0.97 + 1e-12);
  EXPECT_GT(high, 1.04);
}

/// Offsets are as likely everywhere in a circle: half of them within 0.707 of its radius.
TEST(Sessions, OffsetsFillTheirCircle) {
  Rng rng(4);
  int within = 0;
  for (int i = 0; i < 4000; ++i) {
    const Session session = draw_session({.placement_m = 0.05}, 0.5, rng);
    within += session.offset_m.norm() < 0.05 * std::numbers::sqrt2 / 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(within / 4000.0, 0.5, 0.05);
}

/// By the numbers of the stream: a seed stands for the same recordings for ever.
TEST(Sessions, AreDrawnInTheOrderOfTheirMembers) {
  const DatasetOptions options{.step_deg = 30.0, .distance_m = 2.0, .placement_m = 0.05};
  Rng rng(7);
  const Session session = draw_session(options, 0.5, rng);
  Rng again(7);
  EXPECT_NEAR(session.distance_m, 2.0 * again.uniform(0.97, 1.03), 1e-12);
  const double heading_rad = again.uniform(-pi, pi);
  const double off_m = 0.05 * std::sqrt(again.uniform());
  EXPECT_NEAR(session.offset_m.x(), off_m * std::cos(heading_rad), 1e-12);
  EXPECT_NEAR(session.offset_m.y(), off_m * std::sin(heading_rad), 1e-12);
  EXPECT_NEAR(session.first_yaw_rad, again.uniform(0.0, pi / 6.0), 1e-12);
  const auto varied = [&](double middle, double range) {
    return middle + options.lighting * range * again.uniform(-1.0, 1.0);
  };
  EXPECT_NEAR(session.lamp_heading_rad, varied(0.6, 1.2), 1e-12);
  EXPECT_NEAR(session.lamp_elevation_rad, varied(1.0, 0.25), 1e-12);
  EXPECT_NEAR(session.ambient, varied(0.42, 0.06), 1e-12);
  EXPECT_NEAR(session.table, varied(0.62, 0.12), 1e-12);
  const double exposure = varied(1.0, 0.08);
  for (const double gain : session.gain) EXPECT_NEAR(gain, exposure * varied(1.0, 0.03), 1e-12);
}

TEST(Sessions, OfTheGreatestChangesOfLightAreNotCutOff) {
  Rng rng(3);
  double brightest = 0.0;
  for (int i = 0; i < 500; ++i) {
    brightest = std::max(brightest, draw_session({.lighting = 2.0}, 0.5, rng).ambient);
  }
  EXPECT_NEAR(brightest, 0.42 + 2.0 * 0.06, 0.005);
}

TEST(Lamp, LightsTheFaceThatItStandsBefore) {
  const auto context = make_offscreen_context();
  const auto red_with_lamp_at = [&](double heading_rad, double yaw_rad) {
    Session session = support::plain_session(kElevation_rad);
    session.lamp_heading_rad = heading_rad;
    session.lamp_elevation_rad = 0.3;
    const DatasetOptions options{.supersampling = 1};
    Turntable table(support::coloured_cube(), session, options, "cube", context);
    RenderedImages images;
    table.draw(yaw_rad, images);
    return face_colour(images).r;
  };
  EXPECT_GT(red_with_lamp_at(0.1, 0.0), red_with_lamp_at(1.5, 0.0) + 40) << "almost beside it";
  EXPECT_GT(red_with_lamp_at(1.3, 0.5), red_with_lamp_at(-1.3, 0.5) + 40) << "turned away";
}

/// Where the object is in its window, of a camera that looks down by 30 deg.
struct SeenPlace {
  double depth_m = 0.0;  ///< at the middle
  double column = 0.0;   ///< mean of the middle row, from the middle
  int lowest_row = 0;
};

SeenPlace seen_place(const Eigen::Vector2d& offset_m, const Eigen::Vector3d& box_shift_m) {
  TurntableObject object = support::coloured_cube();
  object.box_m.translate(box_shift_m);
  Session session = support::plain_session(kElevation_rad);
  session.offset_m = offset_m;
  Turntable table(object, session, {.supersampling = 1}, "cube", make_offscreen_context());
  RenderedImages images;
  table.draw(0.0, images);
  const int middle = images.width_px / 2;
  SeenPlace place;
  int pixels = 0;
  for (int row = 0; row < images.height_px; ++row) {
    for (int column = 0; column < images.width_px; ++column) {
      const auto i = static_cast<std::size_t>(row * images.width_px + column);
      if (row == middle && column == middle) place.depth_m = images.depth_m[i];
      if (images.segmentation[i] != table.object_geom()) continue;
      place.lowest_row = row - middle;
      if (row == middle) place.column += column - middle;
      if (row == middle) ++pixels;
    }
  }
  place.column /= std::max(pixels, 1);
  return place;
}

/// The face towards the camera is at x = 5 cm, where nothing is shifted.
TEST(TurntablePlace, IsThatOfTheSessionWhereverTheMeshIsDrawn) {
  const double c = std::cos(kElevation_rad);
  const auto depth_m = [&](double x_m) { return 0.8 - x_m / c; };
  const SeenPlace plain = seen_place({0.0, 0.0}, {0.0, 0.0, 0.0});
  EXPECT_NEAR(plain.depth_m, depth_m(0.05), 1e-3);
  EXPECT_NEAR(plain.column, 0.0, 1.5);
  const SeenPlace offset = seen_place({-0.03, 0.03}, {0.0, 0.0, 0.0});
  EXPECT_NEAR(offset.depth_m, depth_m(0.02), 1e-3);
  EXPECT_NEAR(offset.column, kFocal_px * 0.03 / depth_m(0.02), 1.5);
  const SeenPlace drawn_aside = seen_place({0.0, 0.0}, {0.03, -0.03, 0.0});
  EXPECT_NEAR(drawn_aside.depth_m, depth_m(0.02), 1e-3);
  EXPECT_NEAR(drawn_aside.column, kFocal_px * 0.03 / depth_m(0.02), 1.5);
  // Its lower edge, 5 cm below the aim point and then 3 cm, is as far before it as the face.
  const auto row = [&](double below_m) {
    const double s = std::sin(kElevation_rad);
    return kFocal_px * (0.05 * s + below_m * c) / (0.8 - 0.05 * c + below_m * s);
  };
  const SeenPlace drawn_low = seen_place({0.0, 0.0}, {0.0, 0.0, -0.02});
  EXPECT_NEAR(plain.lowest_row, row(0.05), 2.5);
  EXPECT_NEAR(plain.lowest_row - drawn_low.lowest_row, row(0.05) - row(0.03), 2.0);
}

/// Of the table before the object, at the lower edge of the window.
int table_grey(const Session& session) {
  Turntable table(support::coloured_cube(), session, {.supersampling = 1}, "cube",
                  make_offscreen_context());
  RenderedImages images;
  table.draw(0.0, images);
  const int pixel = (images.height_px - 1) * images.width_px + images.width_px / 2;
  EXPECT_NE(images.segmentation[static_cast<std::size_t>(pixel)], table.object_geom());
  return images.rgb[static_cast<std::size_t>(3 * pixel)];
}

TEST(Lamp, LightsTheTableAsItsSessionSays) {
  const Session plain = support::plain_session(kElevation_rad);
  Session session = plain;
  session.table = 0.2;
  EXPECT_LT(table_grey(session), table_grey(plain) - 40) << "a darker table";
  session = plain;
  session.ambient = 0.1;
  EXPECT_LT(table_grey(session), table_grey(plain) - 20) << "less light from everywhere";
  session = plain;
  session.lamp_elevation_rad = 0.2;
  EXPECT_LT(table_grey(session), table_grey(plain) - 20) << "a lower lamp";
}

TEST_F(Cube, CutOutByDepthIsOfWhatTheCameraMeasured) {
  const RenderedImages drawn = draw(0.3);
  Session session = support::plain_session(kElevation_rad);
  DatasetOptions options{.colour_noise = 0.0,
                         .depth_noise = false,
                         .edge_dropout = 0.0,
                         .cut_by_depth = true,
                         .supersampling = 1};
  const auto view_with = [&](const DatasetOptions& how) {
    Rng rng(1);
    return sense(drawn, table_.object_geom(), session, how, rng);
  };
  const ObjectView exact = view_with(options);
  EXPECT_EQ(exact.centre_px, Eigen::Vector2d(320.0, 240.0)) << "of the whole image";
  DatasetOptions other = options;
  other.edge_dropout = 1.0;
  EXPECT_GT(std::ranges::count(view_with(other).depth_m, 0.0F),
            std::ranges::count(exact.depth_m, 0.0F));
  other = options;
  other.mask_growth_px = options.mask_growth_px + 2;
  EXPECT_GT(pixels_of(view_with(other)).size(), pixels_of(exact).size());
  other = options;
  other.margin_px = options.margin_px - 2;
  EXPECT_EQ(view_with(other).width_px, exact.width_px - 4);
  session.gain.setConstant(0.5);
  std::vector<std::uint8_t> halves;
  for (const int value : exact.rgb) halves.push_back(static_cast<std::uint8_t>((value + 1) / 2));
  EXPECT_EQ(view_with(options).rgb, halves);
}

TEST_F(Cube, IsDrawnByAsManyRaysAPixelAsAskedFor) {
  options_.supersampling = 3;
  Turntable finer(support::coloured_cube(), support::plain_session(kElevation_rad), options_,
                  "cube", make_offscreen_context());
  RenderedImages images;
  finer.draw(0.0, images);
  const RenderedImages plain = draw(0.0);
  EXPECT_EQ(images.width_px, 3 * plain.width_px);
  EXPECT_EQ(images.height_px, 3 * plain.height_px);
}

}  // namespace
}  // namespace vantage
