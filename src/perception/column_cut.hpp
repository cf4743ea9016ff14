/// The steps of cutting an object on a table out of an image by depth.
#pragma once

#include <opencv2/core.hpp>

#include "vantage/perception/object_segmentation.hpp"

namespace vantage {

/// Part of an image that shows a column, and what was measured there without lone outliers.
struct Patch {
  cv::Rect place;
  cv::Mat1f depth_m;
};

/// Above the table is no object where heights_over() says that.
inline constexpr float kOutside = -1.0F;
/// Of the least height of an object: what is lower than that is table even beside an object.
inline constexpr double kLow = 1.0 / 3.0;

/// Where the image may show something in the column over the table; all of it if the camera is in
/// the column's way.
cv::Rect place_of_column(const CameraImages& images, const Pose& T_world_camera,
                         const Eigen::Vector3d& p_world_table_m,
                         const ObjectSegmentationOptions& options);

Patch patch_of(const CameraImages& images, const cv::Rect& place);

/// The table top round the place, as the image shows it.
TableSearch find_table_top(const CameraImages& images, const Pose& T_world_camera,
                           const Eigen::Vector3d& p_world_table_m,
                           const ObjectSegmentationOptions& options, Rng& rng);

/// Above the table, m, where a pixel shows something in the column over its middle; else kOutside.
cv::Mat1f heights_over(const Patch& patch, const CameraImages& images, const Pose& T_world_camera,
                       const TablePlane& table, const Eigen::Vector3d& p_world_table_m,
                       const ObjectSegmentationOptions& options);

/// Of holes, those that show no table: a bowl's bottom is thinner than what is told from noise
/// pixel by pixel, but not on average.
void fill_holes(cv::Mat1b& mask, const cv::Mat1f& heights_m, double min_height_m);

/// What gave no depth and has the object on most of its edge is the object's: a camera measures
/// nothing that is too near to it, and a box's front and top may have only that between them.
/// @param depth_m of the same pixels; not above 0 where nothing was measured
void add_unmeasured(cv::Mat1b& mask, const cv::Mat1f& depth_m);

/// The object's foot, lower than what tells an object from noise: what is a little above the table
/// and no farther below the mask than the foot is high.
void add_foot(cv::Mat1b& mask, const cv::Mat1f& heights_m, const CameraImages& images,
              double distance_m, double min_height_m);

/// A square of 2 `half_px` + 1.
cv::Mat square(int half_px);

/// @param mask of the part of the image that begins at `corner`
ObjectView cut(const CameraImages& images, const cv::Mat1b& mask, const cv::Point& corner,
               int margin_px);

}  // namespace vantage
