#include "bench/castray.hpp"

#include <octomap/octomap.h>

namespace vantage::bench {

struct CastrayGain::Tree {
  octomap::OcTree map;
  Eigen::AlignedBox3d box;
};

CastrayGain::CastrayGain(const OccupancyGrid& grid)
    : tree_(new Tree{octomap::OcTree(grid.frame.cell_size_m.minCoeff()), grid.frame.box()}) {
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.state(cell) == CellState::unobserved) continue;
    const Eigen::Vector3d p = grid.frame.centre(grid.frame.cell(cell));
    tree_->map.setNodeValue(p.x(), p.y(), p.z(), grid.log_odds[cell], true);
  }
  tree_->map.updateInnerOccupancy();
}

CastrayGain::~CastrayGain() = default;

double CastrayGain::of_view(const Pose& T_world_sensor, const FieldOfView& field,
                            double azimuth_step_rad, double tilt_step_rad) const {
  const Eigen::Vector3d p = T_world_sensor.translation();
  const octomap::point3d origin(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                static_cast<float>(p.z()));
  double gain = 0.0;
  octomap::KeyRay keys;
  for (double tilt = field.tilt_min_rad; tilt <= field.tilt_max_rad; tilt += tilt_step_rad) {
    for (double azimuth = -field.half_width_rad; azimuth <= field.half_width_rad;
         azimuth += azimuth_step_rad) {
      const Eigen::Vector3d d = T_world_sensor.linear() * beam_direction({azimuth, tilt});
      const SegmentClip clip = clip_segment(tree_->box, p, p + field.range_max_m * d);
      if (clip.empty()) continue;
      const octomap::point3d direction(static_cast<float>(d.x()), static_cast<float>(d.y()),
                                       static_cast<float>(d.z()));
      const double range_m = clip.leave * field.range_max_m;
      octomap::point3d end;
      if (!tree_->map.castRay(origin, direction, end, true, range_m)) {
        end = origin + direction * static_cast<float>(range_m);
      }
      tree_->map.computeRayKeys(origin, end, keys);
      for (const octomap::OcTreeKey& key : keys) {
        const octomap::point3d centre = tree_->map.keyToCoord(key);
        const Eigen::Vector3d at(centre.x(), centre.y(), centre.z());
        if (tree_->box.contains(at) && tree_->map.search(key) == nullptr) gain += 1.0;
      }
    }
  }
  return gain;
}

}  // namespace vantage::bench
