/// An object cut out of an image in which others stand round it, and in front of it.
#pragma once

#include <optional>
#include <vector>

#include "vantage/geometry/upright_cylinder.hpp"
#include "vantage/perception/object_segmentation.hpp"

namespace vantage {

struct SeparationOptions {
  double gap_m = 0.015;
  double gap_growth_per_m = 0.004;
  double reach_m = 0.05;
  double min_share = 0.3;
  void fields(auto&& f) {
    f("gap_m", gap_m,
      "step of depth between neighbouring pixels from which they show two things; higher joins "
      "neighbours, lower breaks objects up",
      above(0.0));
    f("gap_growth_per_m", gap_growth_per_m,
      "by how much that step grows with the squared distance, as depth gets noisier",
      at_least(0.0));
    f("reach_m", reach_m,
      "greatest distance of what is seen of the object from the place where it stands, over pose "
      "errors; higher takes a neighbour for it sooner",
      above(0.0));
    f("min_share", min_share,
      "least share of the object that a view must show to be used; lower uses views that tell "
      "little and may mislead",
      between(0.0, 1.0));
  }
};

struct ObjectAmongOthers {
  SegmentedObject object;
  double seen_share = 0.0;  ///< of the surface that faces the camera; 0 if it was not found
  /// As far as was seen so far, on the table, where the robot knows it to stand.
  std::optional<UprightCylinder> shape;
  std::vector<Eigen::Vector2d> outline;  ///< of what is seen of it from above, convex, world
  std::optional<double> table_height_m;  ///< of the table's plane at the place, as the image has it
};

/// What stands at a place on a table. Pixels that rise from the table are joined where their depth
/// goes on from one to the next; of the patches, those count that stand round the place. The mask
/// shows nothing but the object. Where something nearer, or the image's border, cuts it off, its
/// edge is marked, and how much of it is seen is told from what hides it.
/// @param p_world_place_m where it stands, on the table
/// @param known what earlier views have seen of its shape
ObjectAmongOthers find_among_others(const CameraImages& images, const Pose& T_world_camera,
                                    const Eigen::Vector3d& p_world_place_m,
                                    const ObjectSegmentationOptions& options,
                                    const SeparationOptions& separation,
                                    const std::optional<UprightCylinder>& known, Rng& rng);

}  // namespace vantage
