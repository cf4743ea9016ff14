/// Which pairs of geoms MuJoCo has to look at closely.
#pragma once

#include <Eigen/Core>

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

/// Whether MuJoCo looks for contacts between such geoms.
bool masks_match(const mjModel& model, int geom, int other);
/// Planes and height fields have none.
bool has_box(const mjModel& model, int geom);
/// Half edges of a box round the geom, in its frame.
Eigen::Array3d half_box_m(const mjModel& model, int geom);

/// MuJoCo's tests by body and by masks, which a filter replaces, then one that its bounding spheres
/// leave out: a long thin geom, a wall say, is near all of a room by its sphere, and near little of
/// it by its box. For `mjcb_contactfilter`: contacts are the same to the bit, and most of a step in
/// a room is saved.
/// @return 1 to discard the pair, 0 to look at it closely
int discard_far_pair(const mjModel* model, mjData* data, int geom, int other);

}  // namespace vantage
