#include "bench/castray.hpp"

#include <octomap/octomap.h>

#include <cmath>

#include "vantage/planners/visibility/beam_gain.hpp"

namespace vantage::bench {
namespace {

octomap::point3d to_octomap(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// Per voxel along an axis, the cell that its centre lies in.
std::vector<int> cells_of_voxels(const GridFrame& frame, int axis, double edge_m) {
  std::vector<int> cells;
  for (int voxel = 0;; ++voxel) {
    const int cell = static_cast<int>((voxel + 0.5) * edge_m / frame.cell_size_m[axis]);
    if (cell >= frame.cells[axis]) return cells;
    cells.push_back(cell);
  }
}

constexpr int kHalfWidth = 1 << 15;  // a key is of 16 bits, that of the origin in the middle

octomap::OcTreeKey key_of(std::size_t x, std::size_t y, std::size_t z) {
  const auto key = [](std::size_t voxel) {
    return static_cast<octomap::key_type>(kHalfWidth + voxel);
  };
  return {key(x), key(y), key(z)};
}

void insert_voxels(const OccupancyGrid& grid, octomap::OcTree& map) {
  const auto x = cells_of_voxels(grid.frame, 0, map.getResolution());
  const auto y = cells_of_voxels(grid.frame, 1, map.getResolution());
  const auto z = cells_of_voxels(grid.frame, 2, map.getResolution());
  for (std::size_t k = 0; k < z.size(); ++k) {
    for (std::size_t j = 0; j < y.size(); ++j) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        const CellState state = grid.state(grid.frame.index({x[i], y[j], z[k]}));
        if (state == CellState::unobserved) continue;
        const float log_odds = state == CellState::occupied ? map.getClampingThresMaxLog()
                                                            : map.getClampingThresMinLog();
        map.setNodeValue(key_of(i, j, k), log_odds, /*lazy_eval=*/true);
      }
    }
  }
}

}  // namespace

std::vector<Eigen::Vector3d> laser_beams(const LaserOptions& laser) {
  const FieldOfView field = field_of_view(laser);
  const int lines = static_cast<int>(std::lround(laser.scan_duration_s * laser.line_rate_hz));
  const int gaps = static_cast<int>(std::lround(2.0 * field.half_width_rad / laser.step_rad));
  const double line_step_rad = (field.tilt_max_rad - field.tilt_min_rad) / lines;
  std::vector<Eigen::Vector3d> beams;
  for (int line = 0; line <= lines; ++line) {
    const double tilt_rad = field.tilt_min_rad + line * line_step_rad;
    for (int beam = 0; beam <= gaps; ++beam) {
      beams.push_back(beam_direction({(beam - 0.5 * gaps) * laser.step_rad, tilt_rad}));
    }
  }
  return beams;
}

std::vector<Eigen::Vector3d> image_beams(const RgbdOptions& camera, const FieldOfView& view) {
  return beam_directions(view, {.step_rad = camera.fovy_rad / camera.height_px});
}

/// In a frame of its own, whose origin is the map's lowest corner: there voxels and cells have
/// their first faces in common.
struct CastrayGain::Tree {
  octomap::OcTree map;
  Eigen::Vector3d corner_m;  ///< world
  Eigen::AlignedBox3d box;

  /// Unobserved voxels before the first occupied one.
  double unobserved_along(const Eigen::Vector3d& p, const Eigen::Vector3d& d, double range_m,
                          octomap::KeyRay& keys) const {
    const octomap::point3d origin = to_octomap(p);
    octomap::point3d end;
    if (!map.castRay(origin, to_octomap(d), end, true, range_m)) {
      end = origin + to_octomap(d) * static_cast<float>(range_m);
    }
    map.computeRayKeys(origin, end, keys);
    double count = 0.0;
    for (const octomap::OcTreeKey& key : keys) {
      const octomap::point3d centre = map.keyToCoord(key);
      const Eigen::Vector3d at(centre.x(), centre.y(), centre.z());
      if (box.contains(at) && map.search(key) == nullptr) count += 1.0;
    }
    return count;
  }
};

CastrayGain::CastrayGain(const OccupancyGrid& grid)
    : tree_(new Tree{octomap::OcTree(grid.frame.cell_size_m.minCoeff()), grid.frame.min_corner_m,
                     Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), grid.frame.box().sizes())}) {
  insert_voxels(grid, tree_->map);
  tree_->map.updateInnerOccupancy();
  tree_->map.prune();
}

CastrayGain::~CastrayGain() = default;

double CastrayGain::of_view(const Pose& T_world_sensor, std::span<const Eigen::Vector3d> beams,
                            double range_max_m) const {
  const Eigen::Vector3d p = T_world_sensor.translation() - tree_->corner_m;
  double gain = 0.0;
  octomap::KeyRay keys;
  for (const Eigen::Vector3d& beam : beams) {
    const Eigen::Vector3d d = T_world_sensor.linear() * beam;
    const SegmentClip clip = clip_segment(tree_->box, p, p + range_max_m * d);
    if (clip.empty()) continue;
    gain += tree_->unobserved_along(p, d, clip.leave * range_max_m, keys);
  }
  return gain;
}

CellState CastrayGain::state_at(const Eigen::Vector3d& p_world) const {
  const octomap::OcTreeNode* node = tree_->map.search(to_octomap(p_world - tree_->corner_m));
  if (node == nullptr) return CellState::unobserved;
  return tree_->map.isNodeOccupied(node) ? CellState::occupied : CellState::free;
}

}  // namespace vantage::bench
