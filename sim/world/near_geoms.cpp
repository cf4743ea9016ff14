#include "vantage/sim/world/near_geoms.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <map>

#include "vantage/sim/world/near_pairs.hpp"

namespace vantage {
namespace {

/// More than anything moves in a step.
constexpr double kReach_m = 0.5;

bool collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

/// Moves without a joint.
bool follows_mocap(const mjModel& model, int body) {
  return model.body_mocapid[model.body_rootid[body]] >= 0;
}

/// Axis-aligned, in the world.
Eigen::AlignedBox3d box_of(const mjModel& model, const mjData& at, int geom) {
  using Rotation = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const Eigen::Vector3d> p_world(at.geom_xpos + 3 * geom);
  const Eigen::Map<const Rotation> R_world_geom(at.geom_xmat + 9 * geom);
  const Eigen::Vector3d reach = R_world_geom.cwiseAbs() * half_box_m(model, geom).matrix();
  return {p_world - reach, p_world + reach};
}

/// Round the bounding spheres: looser, and cheap enough for every step.
Eigen::AlignedBox3d box_of(const mjModel& model, const mjData& at, const std::vector<int>& geoms) {
  Eigen::AlignedBox3d box;
  for (const int geom : geoms) {
    const Eigen::Map<const Eigen::Vector3d> p_world(at.geom_xpos + 3 * geom);
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(model.geom_rbound[geom]);
    box.min() = box.min().cwiseMin(p_world - reach);
    box.max() = box.max().cwiseMax(p_world + reach);
  }
  return box;
}

}  // namespace

NearGeoms::NearGeoms(const mjModel& model) : model_(model) {
  std::map<int, Moving> trees;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int body = model.geom_bodyid[geom];
    if (!collides(model, geom) || follows_mocap(model, body)) continue;
    if (model.body_weldid[body] != 0) {
      trees[model.body_rootid[body]].geoms.push_back(geom);
    } else if (has_box(model, geom)) {
      fixed_.push_back({geom, model.geom_contype[geom], model.geom_conaffinity[geom]});
    }
  }
  for (auto& [root, tree] : trees) moving_.push_back(std::move(tree));
}

void NearGeoms::start(mjModel& stepping, const mjData& at) {
  for (Moving& moving : moving_) {
    moving.reach = box_of(model_, at, moving.geoms);
    moving.reach.min().array() -= kReach_m;
    moving.reach.max().array() += kReach_m;
  }
  near_count_ = 0;
  for (const Fixed& fixed : fixed_) {
    const Eigen::AlignedBox3d box = box_of(model_, at, fixed.geom);
    const bool near = std::ranges::any_of(
        moving_, [&](const Moving& moving) { return moving.reach.intersects(box); });
    stepping.geom_contype[fixed.geom] = near ? fixed.contype : 0;
    stepping.geom_conaffinity[fixed.geom] = near ? fixed.conaffinity : 0;
    near_count_ += near ? 1 : 0;
  }
}

void NearGeoms::follow(mjModel& stepping, const mjData& at) {
  const bool within = std::ranges::all_of(moving_, [&](const Moving& moving) {
    Eigen::AlignedBox3d inner = moving.reach;  // by half, since `at` lags
    inner.min().array() += 0.5 * kReach_m;
    inner.max().array() -= 0.5 * kReach_m;
    return inner.contains(box_of(model_, at, moving.geoms));
  });
  if (!within) start(stepping, at);
}

}  // namespace vantage
