// Defaults and ranges of what perception goes by, by number.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/option_numbers.hpp"
#include "vantage/perception/background_planes.hpp"
#include "vantage/perception/clouds/kd_tree.hpp"
#include "vantage/perception/clouds/registration.hpp"
#include "vantage/perception/clutter/object_among_others.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/perception/images/image_files.hpp"
#include "vantage/perception/images/npy.hpp"
#include "vantage/perception/picture_notes.hpp"
#include "vantage/perception/search/object_search.hpp"

namespace vantage {
namespace {

using support::expect_numbers;

constexpr Range kAnyShare = between(0.0, 1.0);
constexpr Range kAboveZero = above(0.0);

TEST(PerceptionOptions, OfClouds) {
  expect_numbers(PostOptions{}, {{"min_beams", 3, between(1, 100)},
                                 {"max_width_m", 0.25, kAboveZero},
                                 {"gap_m", 0.12, kAboveZero},
                                 {"same_m", 0.12, kAboveZero},
                                 {"sigma_m", 0.015, kAboveZero},
                                 {"min_posts", 3, between(2, 1000)},
                                 {"min_spread_m", 0.3, kAboveZero}});
  expect_numbers(NormalOptions{}, {{"radius_m", 0.08, kAboveZero},
                                   {"min_neighbours", 5, at_least(3)},
                                   {"line_ratio", 0.05, kAnyShare}});
}

TEST(PerceptionOptions, OfRegistration) {
  expect_numbers(RegistrationOptions{}, {{"voxel_m", 0.03, kAboveZero},
                                         {"normals.radius_m", 0.12, kAboveZero},
                                         {"normals.min_neighbours", 5, at_least(3)},
                                         {"normals.line_ratio", 0.05, kAnyShare},
                                         {"max_correspondence_m", 0.20, kAboveZero},
                                         {"min_correspondence_m", 0.04, kAboveZero},
                                         {"shrink", 0.8, between(0.1, 0.99)},
                                         {"trim_fraction", 0.9, between(0.1, 1.0)},
                                         {"kernel_scale_m", 0.01, kAboveZero},
                                         {"max_normal_angle_rad", 0.8, between(0.0, 3.1416)},
                                         {"max_normal_z", 0.5, kAnyShare},
                                         {"min_constraint", 0.005, kAnyShare},
                                         {"min_constraint_correspondences", 3.0, at_least(0.0)},
                                         {"min_overlap", 0.02, kAnyShare},
                                         {"min_correspondences", 40, at_least(3)},
                                         {"max_iterations", 60, at_least(1)},
                                         {"tolerance_m", 5e-5, kAboveZero},
                                         {"tolerance_rad", 2e-5, kAboveZero},
                                         {"max_correction_m", 0.25, kAboveZero},
                                         {"max_correction_rad", 0.15, kAboveZero},
                                         {"posts.min_beams", 3, between(1, 100)},
                                         {"posts.max_width_m", 0.25, kAboveZero},
                                         {"posts.gap_m", 0.12, kAboveZero},
                                         {"posts.same_m", 0.12, kAboveZero},
                                         {"posts.sigma_m", 0.015, kAboveZero},
                                         {"posts.min_posts", 3, between(2, 1000)},
                                         {"posts.min_spread_m", 0.3, kAboveZero}});
}

TEST(PerceptionOptions, OfTables) {
  expect_numbers(TableOptions{}, {{"min_height_m", 0.4},
                                  {"max_height_m", 1.2},
                                  {"max_tilt_rad", 0.05, between(0.0, 0.8)},
                                  {"inlier_distance_m", 0.015, kAboveZero},
                                  {"max_normal_angle_rad", 0.4, between(0.0, 1.6)},
                                  {"cell_m", 0.02, kAboveZero},
                                  {"min_area_m2", 0.04, kAboveZero},
                                  {"hypotheses", 200, between(1, 1000000)},
                                  {"max_step_m", 0.03, kAboveZero}});
  EXPECT_EQ(TableOptions{}.region_centre_m, (std::array{0.0, 0.0}));
  EXPECT_EQ(TableOptions{}.region_size_m, (std::array{2.0, 2.0}));
  expect_numbers(ObjectCropOptions{}, {{"min_height_m", 0.010, at_least(0.0)},
                                       {"max_height_m", 0.60, kAboveZero},
                                       {"hull_margin_m", 0.0, between(-0.5, 0.5)}});
}

TEST(PerceptionOptions, OfSegmentation) {
  expect_numbers(ObjectSegmentationOptions{}, {{"radius_m", 0.2, {0.0, 2.0, true}},
                                               {"max_height_m", 0.5, {0.0, 2.0, true}},
                                               {"min_height_m", 0.006, between(0.0, 0.1)},
                                               {"table_tolerance_m", 0.06, {0.0, 0.5, true}},
                                               {"min_pixels", 150, at_least(1)},
                                               {"mask_growth_px", 1, between(0, 20)},
                                               {"margin_px", 3, between(0, 50)}});
  expect_numbers(SeparationOptions{}, {{"gap_m", 0.015, kAboveZero},
                                       {"gap_growth_per_m", 0.004, at_least(0.0)},
                                       {"reach_m", 0.05, kAboveZero},
                                       {"min_share", 0.3, kAnyShare}});
}

TEST(PerceptionOptions, OfSearch) {
  expect_numbers(ObjectSearchOptions{}, {{"support.min_height_m", 0.3, between(-10.0, 100.0)},
                                         {"support.max_height_m", 1.5, between(-10.0, 100.0)},
                                         {"support.columns", 160, between(16, 4096)},
                                         {"support.cell_m", 0.05, between(0.002, 0.5)},
                                         {"support.min_area_m2", 0.03, kAboveZero},
                                         {"support.inlier_distance_m", 0.02, kAboveZero},
                                         {"support.max_tilt_rad", 0.08, between(0.0, 0.8)},
                                         {"cut.radius_m", 0.3, {0.0, 2.0, true}},
                                         {"cut.max_height_m", 0.5, {0.0, 2.0, true}},
                                         {"cut.min_height_m", 0.006, between(0.0, 0.1)},
                                         {"cut.table_tolerance_m", 0.06, {0.0, 0.5, true}},
                                         {"cut.min_pixels", 60, at_least(1)},
                                         {"cut.mask_growth_px", 1, between(0, 20)},
                                         {"cut.margin_px", 3, between(0, 50)},
                                         {"range_m", 3.0, {0.0, 20.0, true}},
                                         {"nearest_m", 0.85, at_least(0.0)},
                                         {"border_px", 2, between(0, 100)},
                                         {"gap_m", 0.05, between(0.002, 1.0)},
                                         {"noise_per_m", 0.0008, between(0.0, 0.1)}});
}

TEST(PerceptionOptions, OfPictures) {
  expect_numbers(PictureNotes{}, {{"focal_px", 570.3, kAboveZero},
                                  {"centre_px[0]", 320.0},
                                  {"centre_px[1]", 240.0},
                                  {"bins", 8, between(2, 3600)},
                                  {"degrees", 1}});
  EXPECT_EQ(PictureNotes{}.cut, "mask");
}

TEST(PerceptionOptions, AnEmptyBandOfHeightsIsRefused) {
  TableOptions table;
  table.min_height_m = table.max_height_m;
  EXPECT_THROW(check_options(table), ConfigError);
  ObjectCropOptions crop;
  crop.min_height_m = crop.max_height_m;
  EXPECT_THROW(check_options(crop), ConfigError);
  SupportSearchOptions support;
  support.min_height_m = support.max_height_m;
  EXPECT_THROW(check_options(support), ConfigError);
  RegistrationOptions registration;
  registration.min_correspondence_m = registration.max_correspondence_m;
  EXPECT_NO_THROW(check_options(registration)) << "a radius that stays as it is";
}

TEST(PerceptionResults, OfFilesAreEmptyAtFirst) {
  for (const int value :
       {ColourImage{}.width_px, ColourImage{}.height_px, DepthImage{}.width_px,
        DepthImage{}.height_px, MaskImage{}.width_px, MaskImage{}.height_px, NpyMatrix{}.rows,
        NpyMatrix{}.columns, ViewName{}.video, ViewName{}.frame}) {
    EXPECT_EQ(value, 0);
  }
  EXPECT_FALSE(NpyMatrix{}.integers);
  EXPECT_EQ(DepthImage{}.unit_m, 0.001);
  EXPECT_EQ(ViewEntry{}.yaw_rad, 0.0);
  EXPECT_EQ(PairSetting{}.max_depth_m, 0.0);
  EXPECT_EQ(PairSetting{}.depth_unit_m, 0.0);
  EXPECT_EQ(ImagePair{}.cut, ObjectCut::mask);
}

TEST(PerceptionResults, OfViewsAreEmptyAtFirst) {
  const ObjectView view;
  for (const int value : {view.width_px, view.height_px, view.left_px, view.top_px}) {
    EXPECT_EQ(value, 0);
  }
  EXPECT_EQ(view.focal_px, 570.3);
  EXPECT_EQ(view.centre_px, Eigen::Vector2d(320.0, 240.0));
  EXPECT_EQ(view.up, Eigen::Vector3d(0.0, -1.0, 0.0));
  EXPECT_EQ(view.seen_share, 1.0);
  EXPECT_EQ(ObjectAmongOthers{}.seen_share, 0.0);
  EXPECT_EQ(TablePlane{}.height_m, 0.0);
  EXPECT_EQ(TablePlane{}.normal, Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_TRUE(TablePlane{}.centroid_m.isZero());
  EXPECT_TRUE(TablePlane{}.scatter_m2.isZero());
  EXPECT_EQ(TablePlane{}.inliers, 0U);
  EXPECT_EQ(BackgroundPlane{}.normal, Eigen::Vector3d(0.0, 0.0, -1.0));
  EXPECT_EQ(BackgroundPlane{}.offset_m, 0.0);
  EXPECT_EQ(BackgroundPlane{}.share, 0.0);
}

TEST(PerceptionResults, OfRegistrationSayNothingAtFirst) {
  const RegistrationResult result;
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.rmse_m, 0.0);
  EXPECT_EQ(result.overlap, 0.0);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.unconstrained, 0);
  EXPECT_TRUE(result.information.isZero());
  EXPECT_TRUE(PosePrior{}.information.isIdentity());
  EXPECT_TRUE(std::isinf(Correction{}.shift_m));
  EXPECT_TRUE(std::isinf(Correction{}.turn_rad));
  EXPECT_FALSE(PostFix{}.found);
  EXPECT_TRUE(PostFix{}.information.isZero());
  EXPECT_EQ(Neighbour{}.index, 0U);
  EXPECT_EQ(Neighbour{}.distance2_m2, 0.0F);
}

}  // namespace
}  // namespace vantage
