/// The gain of a view as peers compute it: one OctoMap castRay per beam of the sensor, then a look
/// at every node along the ray.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/sim/sensors/camera_options.hpp"
#include "vantage/sim/sensors/laser_options.hpp"

namespace vantage::bench {

/// Those of one scan: a line of beams per tick of the tilt joint. Unit vectors, sensor frame.
std::vector<Eigen::Vector3d> laser_beams(const LaserOptions& laser);
/// Those of the images that a view is made of: as far apart as pixels, over all that the images
/// see together, and once where they overlap.
std::vector<Eigen::Vector3d> image_beams(const RgbdOptions& camera, const FieldOfView& view);

class CastrayGain {
 public:
  /// The tree is the map without loss: voxels of the smallest edge of a cell, counted from the
  /// map's lowest corner, each free or occupied as the cell that its centre lies in. Pruned. Where
  /// cells are no cubes, voxels are smaller than they: a ray in the small office takes 1.3 times as
  /// many steps as through cubes of a cell's volume, in the large one twice as many.
  explicit CastrayGain(const OccupancyGrid& grid);
  ~CastrayGain();

  /// Sum over the beams of the unobserved voxels before each beam's first occupied one. Several
  /// threads may ask at once.
  [[nodiscard]] double of_view(const Pose& T_world_sensor, std::span<const Eigen::Vector3d> beams,
                               double range_max_m) const;

  /// What the tree has at a place.
  [[nodiscard]] CellState state_at(const Eigen::Vector3d& p_world) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace vantage::bench
