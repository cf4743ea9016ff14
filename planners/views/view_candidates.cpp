#include "vantage/planners/views/view_candidates.hpp"

#include <cmath>

namespace vantage {

void RingOfViews::check() const {
  if (yaw_offsets_rad.empty()) throw ConfigError("yaw_offsets_rad must name at least one offset");
}

std::vector<Candidate> ring_of_views(const RingOfViews& ring, const Eigen::Vector3d& centre_m) {
  check_options(ring, "ring_of_views");
  std::vector<Candidate> views;
  for (int position = 0; position < ring.positions; ++position) {
    const double bearing_rad =
        ring.start_angle_rad + 2.0 * std::numbers::pi * position / ring.positions;
    const Eigen::Vector3d p_sensor(centre_m.x() + ring.radius_m * std::cos(bearing_rad),
                                   centre_m.y() + ring.radius_m * std::sin(bearing_rad),
                                   ring.height_m);
    for (const double offset_rad : ring.yaw_offsets_rad) {
      Candidate view;
      view.id = static_cast<int>(views.size());
      view.T_world_sensor = make_pose(p_sensor, bearing_rad + std::numbers::pi + offset_rad);
      views.push_back(view);
    }
  }
  return views;
}

}  // namespace vantage
