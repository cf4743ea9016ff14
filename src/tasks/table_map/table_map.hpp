/// The map that a robot keeps of a table on which many things stand: what hides what from where,
/// and which ways are free.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <span>
#include <vector>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/flight_map.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/upright_cylinder.hpp"
#include "vantage/planners/trajectory/esdf.hpp"

namespace vantage {

struct TableMapOptions {
  std::array<double, 2> size_m{1.0, 1.0};
  double height_m = 0.5;
  double foot_m = 0.03;
  double cell_m = 0.02;
  int columns = 160;
  double clearance_m = 0.35;
  double margin_m = 0.03;
  ClutterHazardOptions hazard = {.layers = 5};
  void fields(auto&& f) {
    f("size_m", size_m, "edge lengths of the table top along x and y, which the robot knows",
      between(0.1, 10.0));
    f("height_m", height_m,
      "greatest height above the table of what may stand on it, as the robot is told; higher keeps "
      "flights farther from what they have not seen",
      between(0.05, 3.0));
    f("foot_m", foot_m,
      "height above the table where the map begins; lower maps what is low, and errors of the "
      "pose as obstacles",
      between(0.0, 0.2));
    f("cell_m", cell_m,
      "edge of a cell; lower resolves finer, at the inverse cube of it in time and memory",
      Range{0.005, 0.2});
    f("columns", columns, "number of image columns that are used; higher maps finer and is slower",
      between(8, 4096));
    f("clearance_m", clearance_m,
      "least distance of a flight from obstacles, and from what was not seen yet over the table, "
      "to the vehicle's middle; higher is safer and finds fewer ways",
      between(0.0, 2.0));
    f("margin_m", margin_m,
      "how far beyond an object the cells of the map still are its own and do not hide it; higher "
      "overlooks what stands close to it",
      between(0.0, 0.2));
    f("hazard", hazard, "how likely what was not seen hides what is behind it");
  }
};

/// Cells of a free table are free, what stands there is occupied, and the rest stops a ray with the
/// hazard that the images so far have shown. Knows nothing beside the table.
class TableMap {
 public:
  /// @param p_world_table_m middle of the table top
  /// @throws ConfigError if options are out of range.
  TableMap(const Eigen::Vector3d& p_world_table_m, const TableMapOptions& options);

  /// Takes in a depth image.
  void insert(const CameraImages& images, const Pose& T_world_camera);

  /// A flag for each cell: whether it is over an outline seen from above (world, convex,
  /// counter-clockwise), as high as something there, by `margin_m` wider.
  [[nodiscard]] std::vector<std::uint8_t> cells_over(const std::vector<Eigen::Vector2d>& outline,
                                                     double height_m) const;
  /// Expected share of a target that is seen from a place.
  /// @param own its cells, see cells_over(); empty: those in the cylinder
  [[nodiscard]] double visible_share(const UprightCylinder& target,
                                     std::span<const std::uint8_t> own,
                                     const Eigen::Vector3d& p_world_eye_m) const;
  /// Whether a vehicle can fly along a polyline: it keeps clear of obstacles, and of what is over
  /// the table and was not seen yet.
  [[nodiscard]] bool is_clear(std::span<const Eigen::Vector3d> path_m) const;

  [[nodiscard]] const OccupancyGrid& grid() const { return map_.grid(); }
  [[nodiscard]] double hazard() const { return hazard_.global_hazard(); }
  /// Of a map with these options.
  static GridFrame frame_of(const Eigen::Vector3d& p_world_table_m, const TableMapOptions& options);

 private:
  void refresh();
  [[nodiscard]] Esdf distances() const;
  [[nodiscard]] double distance_m(const Eigen::Vector3d& p_world_m) const;

  TableMapOptions options_;
  Eigen::Vector3d p_table_m_;
  FlightMap map_;
  ClutterHazard hazard_;
  std::vector<float> transmission_;
  Esdf distances_;  ///< to what is not known to be free
};

}  // namespace vantage
