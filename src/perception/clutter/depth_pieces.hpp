/// Parts of an image that belong together by depth.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "vantage/perception/column_cut.hpp"

namespace vantage {

/// The step of depth between neighbouring pixels from which they show two things.
struct DepthStep {
  double near_m = 0.015;
  double growth_per_m = 0.004;  ///< of the squared distance

  [[nodiscard]] double at_m(float z_m) const {
    return near_m + growth_per_m * static_cast<double>(z_m * z_m);
  }
};

/// What rises from the table in the column over a place.
struct RisingColumn {
  Patch patch;
  cv::Mat1f heights_m;
  cv::Mat1b rises;
};

struct DepthPiece {
  std::vector<cv::Point> pixels;        ///< of the patch
  std::vector<Eigen::Vector2d> points;  ///< of each pixel, seen from above, world
  std::vector<Eigen::Vector2d> hull;    ///< of them

  /// From a place to the nearest point: what stands round a place, as a screen does, is not there.
  [[nodiscard]] double nearest_m(const Eigen::Vector2d& p_world_m) const;
  /// From a place to the hull; 0 inside.
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_world_m) const;
};

class DepthPieces {
 public:
  /// @param images outlive it
  DepthPieces(const CameraImages& images, const Pose& T_world_camera, RisingColumn column,
              const DepthStep& step)
      : images_(images), T_(T_world_camera), column_(std::move(column)), step_(step) {}

  [[nodiscard]] const RisingColumn& column() const { return column_; }
  [[nodiscard]] Eigen::Vector3d p_world(const cv::Point& at) const;
  [[nodiscard]] bool inside(const cv::Point& at) const;
  /// Whether there is depth at `other` that is nearer than at `at`, by a step.
  [[nodiscard]] bool nearer(const cv::Point& other, const cv::Point& at) const;
  /// Whether the image shows that nothing rises at a place on the table itself.
  [[nodiscard]] bool is_bare(const Eigen::Vector3d& p_world_m, double reach_m) const;
  /// Those that are large enough to tell whose they are, by their first pixels, row by row.
  [[nodiscard]] std::vector<DepthPiece> all() const;

 private:
  [[nodiscard]] DepthPiece piece_from(const cv::Point& seed, cv::Mat1b& left) const;

  const CameraImages& images_;
  Pose T_;
  RisingColumn column_;
  DepthStep step_;
};

/// The pieces that stand round a place: the nearest to it, unless it is farther than `reach_m`, and
/// those over what is seen of that, such as a bowl's inside and outside.
/// @param is_bare the place itself shows nothing that rises, as a plate's middle: then what
/// encloses it counts as there
std::vector<const DepthPiece*> round_place(const std::vector<DepthPiece>& pieces,
                                           const Eigen::Vector2d& p_world_m, double reach_m,
                                           bool is_bare);

}  // namespace vantage
