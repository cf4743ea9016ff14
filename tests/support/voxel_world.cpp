#include "tests/support/voxel_world.hpp"

#include <cmath>
#include <limits>

namespace vantage {
namespace {

std::vector<double> steps(double from, double to, double step) {
  std::vector<double> angles;
  const int count = static_cast<int>(std::ceil((to - from) / step));
  for (int i = 0; i <= count; ++i) angles.push_back(from + (to - from) * i / count);
  return angles;
}

}  // namespace

VoxelWorld voxel_world(const std::vector<std::string_view>& plan, double cell_m, int layers) {
  VoxelWorld world;
  world.frame.cells = {static_cast<int>(plan.front().size()), static_cast<int>(plan.size()),
                       layers};
  world.frame.cell_size_m.setConstant(cell_m);
  world.frame.min_corner_m = {-0.5 * cell_m * world.frame.cells.x(),
                              -0.5 * cell_m * world.frame.cells.y(), 0.0};
  world.solid.resize(world.frame.size(), false);
  for (std::size_t row = 0; row < plan.size(); ++row) {
    for (std::size_t column = 0; column < plan[row].size(); ++column) {
      const int height = plan[row][column] == '.' ? 0 : plan[row][column] - '0';
      for (int z = 0; z < height; ++z) {
        const int y = static_cast<int>(plan.size() - 1 - row);
        world.solid[world.frame.index({static_cast<int>(column), y, z})] = true;
      }
    }
  }
  return world;
}

RangeScan scan_voxels(const VoxelWorld& world, const Pose& T_world_sensor, const FieldOfView& field,
                      double step_rad) {
  RangeScan scan;
  scan.field_of_view = field;
  scan.tilt_rad = steps(field.tilt_min_rad, field.tilt_max_rad, step_rad);
  scan.azimuth_rad = steps(-field.half_width_rad, field.half_width_rad, step_rad);
  const Eigen::Vector3d p_sensor = T_world_sensor.translation();
  for (const double tilt : scan.tilt_rad) {
    for (const double azimuth : scan.azimuth_rad) {
      const Eigen::Vector3d ray = T_world_sensor.linear() * beam_direction({azimuth, tilt});
      double range = std::numeric_limits<double>::infinity();
      walk_ray(world.frame, p_sensor, p_sensor + field.range_max_m * ray, [&](std::size_t cell) {
        if (!world.solid[cell]) return true;
        range = (world.frame.centre(world.frame.cell(cell)) - p_sensor).dot(ray);
        return false;
      });
      scan.range_m.push_back(static_cast<float>(range));
    }
  }
  return scan;
}

}  // namespace vantage
