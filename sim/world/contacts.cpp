#include "vantage/sim/world/contacts.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

/// Whether a wheel or caster stands on what it touches, rather than runs into it.
bool stands(const mjContact& contact, int own_geom, std::span<const int> on_floor) {
  constexpr double kLevel = 0.866;  // cosine of 30 degrees
  return std::ranges::find(on_floor, own_geom) != on_floor.end() &&
         std::abs(contact.frame[2]) > kLevel;  // z of the normal
}

}  // namespace

std::vector<int> contact_points(const mjModel& model, const mjData& data, int root_body,
                                std::span<const int> on_floor) {
  const auto is_robot = [&](int geom) {
    return model.body_rootid[model.geom_bodyid[geom]] == root_body;
  };
  std::vector<int> geoms;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    const bool first = is_robot(contact.geom1);
    if (contact.dist > 0.0 || first == is_robot(contact.geom2)) continue;
    if (stands(contact, first ? contact.geom1 : contact.geom2, on_floor)) continue;
    geoms.push_back(first ? contact.geom2 : contact.geom1);
  }
  return geoms;
}

std::vector<int> touched_geoms(const mjModel& model, const mjData& data, int root_body,
                               std::span<const int> on_floor) {
  std::vector<int> geoms = contact_points(model, data, root_body, on_floor);
  std::sort(geoms.begin(), geoms.end());
  geoms.erase(std::unique(geoms.begin(), geoms.end()), geoms.end());
  return geoms;
}

int CollisionCounter::update(std::span<const int> touched_geoms, double time_s) {
  int begun = 0;
  for (const int geom : touched_geoms) {
    const auto [last, is_new] = last_touched_s_.try_emplace(geom, time_s);
    if (is_new || time_s - last->second > release_s_) ++begun;
    last->second = time_s;
  }
  count_ += begun;
  return begun;
}

}  // namespace vantage
