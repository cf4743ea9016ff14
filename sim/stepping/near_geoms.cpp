#include "vantage/sim/stepping/near_geoms.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "vantage/sim/stepping/model_part.hpp"
#include "vantage/sim/stepping/near_pairs.hpp"

namespace vantage {
namespace {

/// How far a geom may move until masks are set anew, twice.
constexpr double kReach_m = 0.2;
/// Slower than this nothing moves half as far in a step.
constexpr double kSlow = 10.0;  // m/s or rad/s

bool collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

/// Moves without a joint, and without a word.
bool follows_mocap(const mjModel& model, int geom) {
  return model.body_mocapid[model.body_rootid[model.geom_bodyid[geom]]] >= 0;
}

bool stays_in_box(const mjModel& model, int geom) {
  return has_box(model, geom) && !follows_mocap(model, geom);
}

Eigen::Vector3d place_of(const mjData& at, int geom) {
  return Eigen::Map<const Eigen::Vector3d>(at.geom_xpos + 3 * geom);
}

using Rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

/// Axis-aligned, in the world.
Eigen::AlignedBox3d box_of(const mjModel& model, const mjData& at, int geom) {
  const Rotation R_world_geom(at.geom_xmat + 9 * geom);
  const Eigen::Vector3d reach = R_world_geom.cwiseAbs() * half_box_m(model, geom).matrix();
  return {place_of(at, geom) - reach, place_of(at, geom) + reach};
}

bool is_slow(const mjModel& model, const mjData& at) {
  return std::ranges::all_of(std::span(at.qvel, static_cast<std::size_t>(model.nv)),
                             [](double speed) { return std::abs(speed) < kSlow; });
}

}  // namespace

NearGeoms::~NearGeoms() = default;

NearGeoms::NearGeoms(const mjModel& model)
    : model_(model),
      stepped_(std::make_unique<ModelPart>(model)),
      started_(static_cast<std::size_t>(model.ngeom)),
      near_(static_cast<std::size_t>(model.ngeom)) {
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int body = model.geom_bodyid[geom];
    if (!collides(model, geom)) continue;
    near_[static_cast<std::size_t>(geom)] = 1;
    if (model.body_weldid[body] == 0) {
      fixed_.push_back({.geom = geom, .bounded = stays_in_box(model, geom)});
    } else {
      trees_[model.body_rootid[body]].geoms.push_back(geom);
    }
  }
}

/// Whichever way it turns.
Eigen::AlignedBox3d NearGeoms::reach_of(int geom) const {
  const Eigen::Vector3d& p_world = started_[static_cast<std::size_t>(geom)];
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(model_.geom_rbound[geom] + kReach_m);
  return {p_world - reach, p_world + reach};
}

/// Of a fixed geom without a box that it stays in.
bool NearGeoms::meets_unbounded(int moving, const Fixed& fixed) const {
  if (model_.geom_type[fixed.geom] != mjGEOM_PLANE || follows_mocap(model_, fixed.geom))
    return true;
  const Eigen::Vector3d p_plane = started_[static_cast<std::size_t>(moving)] - fixed.p_world_m;
  return fixed.normal.dot(p_plane) < model_.geom_rbound[moving] + kReach_m;
}

void NearGeoms::mark_pair(int geom, int other) {
  near_[static_cast<std::size_t>(geom)] = near_[static_cast<std::size_t>(other)] = 1;
}

void NearGeoms::mark_beside_fixed(const Tree& tree) {
  for (const Fixed& fixed : fixed_) {
    if (fixed.bounded && !tree.reach.intersects(fixed.box_m)) continue;
    const auto meets = [&](int geom) {
      return fixed.bounded ? reach_of(geom).intersects(fixed.box_m) : meets_unbounded(geom, fixed);
    };
    for (const int geom : tree.geoms) {
      if (masks_match(model_, geom, fixed.geom) && meets(geom)) mark_pair(geom, fixed.geom);
    }
  }
}

void NearGeoms::mark_beside_moving(const Tree& tree, const Tree& other) {
  if (!tree.reach.intersects(other.reach)) return;
  for (const int geom : tree.geoms) {
    for (const int partner : other.geoms) {
      if (geom != partner && masks_match(model_, geom, partner) &&
          reach_of(geom).intersects(reach_of(partner))) {
        mark_pair(geom, partner);
      }
    }
  }
}

void NearGeoms::place_fixed(const mjData& at) {
  for (Fixed& fixed : fixed_) {
    if (fixed.bounded) fixed.box_m = box_of(model_, at, fixed.geom);
    fixed.p_world_m = place_of(at, fixed.geom);
    fixed.normal = Rotation(at.geom_xmat + 9 * fixed.geom).col(2);
  }
}

void NearGeoms::start(const mjData& at) {
  place_fixed(at);
  look_anew(at);
}

void NearGeoms::look_anew(const mjData& at) {
  const bool slow = is_slow(model_, at);
  for (const Fixed& fixed : fixed_) near_[static_cast<std::size_t>(fixed.geom)] = slow ? 0 : 1;
  for (auto& [root, tree] : trees_) {
    tree.reach.setEmpty();
    for (const int geom : tree.geoms) {
      started_[static_cast<std::size_t>(geom)] = place_of(at, geom);
      near_[static_cast<std::size_t>(geom)] = slow ? 0 : 1;
      tree.reach.extend(reach_of(geom));
    }
  }
  if (slow) {
    for (auto tree = trees_.begin(); tree != trees_.end(); ++tree) {
      mark_beside_fixed(tree->second);
      for (auto other = tree; other != trees_.end(); ++other) {
        mark_beside_moving(tree->second, other->second);
      }
    }
  }
  stepped_->list(near_);
}

void NearGeoms::follow(const mjData& at) {
  const auto moved = [&](int geom) {  // by half, since `at` lags
    const Eigen::Vector3d gone = place_of(at, geom) - started_[static_cast<std::size_t>(geom)];
    return gone.cwiseAbs().maxCoeff() > 0.5 * kReach_m;
  };
  const bool go_on = is_slow(model_, at) && std::ranges::none_of(trees_, [&](const auto& tree) {
                       return std::ranges::any_of(tree.second.geoms, moved);
                     });
  if (!go_on) look_anew(at);
}

void NearGeoms::step(mjData& data) {
  stepped_->run(data, [](const mjModel& model, mjData& seen) { mj_step(&model, &seen); });
  for (int i = 0; i < data.ncon; ++i) {
    mjContact& contact = data.contact[i];
    contact.geom1 = stepped_->geom_id(contact.geom1);
    contact.geom2 = stepped_->geom_id(contact.geom2);
  }
}

}  // namespace vantage
