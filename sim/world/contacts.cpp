#include "vantage/sim/world/contacts.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>

namespace vantage {

std::vector<int> contact_points(const mjModel& model, const mjData& data, int root_body) {
  const auto is_robot = [&](int geom) {
    return model.body_rootid[model.geom_bodyid[geom]] == root_body;
  };
  std::vector<int> geoms;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    const bool first = is_robot(contact.geom1);
    if (contact.dist > 0.0 || first == is_robot(contact.geom2)) continue;
    geoms.push_back(first ? contact.geom2 : contact.geom1);
  }
  return geoms;
}

std::vector<int> touched_geoms(const mjModel& model, const mjData& data, int root_body) {
  std::vector<int> geoms = contact_points(model, data, root_body);
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
