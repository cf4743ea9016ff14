#include "vantage/sim/stepping/near_pairs.hpp"

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include <algorithm>

namespace vantage {
namespace {

/// MuJoCo's solvers for convex shapes are exact to less.
constexpr double kSlack_m = 1e-3;

/// Parts of one piece, or of two with one joint between them (but for the world itself).
bool joined(const mjModel& model, int a, int b) {
  const int piece_a = model.body_weldid[model.geom_bodyid[a]];
  const int piece_b = model.body_weldid[model.geom_bodyid[b]];
  if (piece_a == piece_b) return true;
  if (piece_a == 0 || piece_b == 0 || (model.opt.disableflags & mjDSBL_FILTERPARENT) != 0) {
    return false;
  }
  const auto carrier = [&](int piece) { return model.body_weldid[model.body_parentid[piece]]; };
  return piece_a == carrier(piece_b) || piece_b == carrier(piece_a);
}

/// Whether the box round `geom` is farther from the middle of `other` than the sphere round it.
bool box_is_far(const mjModel& model, const mjData& data, int geom, int other, double margin_m) {
  using Rotation = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const Eigen::Vector3d> p_world(data.geom_xpos + 3 * geom);
  const Eigen::Map<const Eigen::Vector3d> p_world_other(data.geom_xpos + 3 * other);
  const Eigen::Map<const Rotation> R_world_geom(data.geom_xmat + 9 * geom);
  const Eigen::Array3d p = (R_world_geom.transpose() * (p_world_other - p_world)).array().abs();
  const double reach_m = model.geom_rbound[other] + margin_m + kSlack_m;
  return (p - half_box_m(model, geom)).max(0.0).matrix().squaredNorm() > reach_m * reach_m;
}

}  // namespace

bool masks_match(const mjModel& model, int a, int b) {
  return (model.geom_contype[a] & model.geom_conaffinity[b]) != 0 ||
         (model.geom_contype[b] & model.geom_conaffinity[a]) != 0;
}

bool has_box(const mjModel& model, int geom) {
  return model.geom_type[geom] != mjGEOM_PLANE && model.geom_type[geom] != mjGEOM_HFIELD;
}

Eigen::Array3d half_box_m(const mjModel& model, int geom) {
  const Eigen::Map<const Eigen::Array3d> size(model.geom_size + 3 * geom);
  switch (model.geom_type[geom]) {
    case mjGEOM_CAPSULE: return {size[0], size[0], size[0] + size[1]};
    case mjGEOM_CYLINDER: return {size[0], size[0], size[1]};
    case mjGEOM_SPHERE: return Eigen::Array3d::Constant(size[0]);
    default: return size;  // ellipsoids and boxes; of a mesh, the box round it
  }
}

int discard_far_pair(const mjModel* model, mjData* data, int geom, int other) {
  if (joined(*model, geom, other) || !masks_match(*model, geom, other)) return 1;
  if (!has_box(*model, geom) || !has_box(*model, other)) return 0;
  const double margin_m = std::max(model->geom_margin[geom], model->geom_margin[other]);
  const bool far = box_is_far(*model, *data, geom, other, margin_m) ||
                   box_is_far(*model, *data, other, geom, margin_m);
  return far ? 1 : 0;
}

}  // namespace vantage
