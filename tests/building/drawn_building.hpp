/// Meshes of buildings, drawn face by face.
#pragma once

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "vantage/building/mesh_file.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage::test {

using Outline = std::vector<Eigen::Vector2d>;

/// An OBJ file that grows.
class DrawnBuilding {
 public:
  /// Normals follow the corners' order by the right hand.
  void face(const std::vector<Eigen::Vector3d>& corners_m) {
    faces_ += "f";
    for (const Eigen::Vector3d& p_m : corners_m) {
      vertices_ += fmt::format("v {} {} {}\n", p_m.x(), p_m.y(), p_m.z());
      faces_ += fmt::format(" {}", ++count_);
    }
    faces_ += "\n";
  }

  /// A solid over a counter-clockwise outline, which may be concave.
  void prism(const Outline& outline_m, double low_m, double high_m) {
    faces_ += fmt::format("o solid_{}\n", ++objects_);
    std::vector<Eigen::Vector3d> top;
    std::vector<Eigen::Vector3d> bottom;
    for (std::size_t i = 0; i < outline_m.size(); ++i) {
      const Eigen::Vector2d& a = outline_m[i];
      const Eigen::Vector2d& b = outline_m[(i + 1) % outline_m.size()];
      face({at(a, low_m), at(b, low_m), at(b, high_m), at(a, high_m)});
      top.push_back(at(a, high_m));
      bottom.insert(bottom.begin(), at(a, low_m));
    }
    face(top);
    face(bottom);
  }

  void box(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m, double turn_rad = 0.0) {
    const Eigen::Vector2d middle_m = 0.5 * (low_m + high_m).head<2>();
    Outline outline_m{{low_m.x(), low_m.y()},
                      {high_m.x(), low_m.y()},
                      {high_m.x(), high_m.y()},
                      {low_m.x(), high_m.y()}};
    for (auto& p_m : outline_m) {
      p_m = middle_m + Eigen::Rotation2Dd(turn_rad) * (p_m - middle_m);
    }
    prism(outline_m, low_m.z(), high_m.z());
  }

  [[nodiscard]] std::string obj() const { return vertices_ + faces_; }

 private:
  static Eigen::Vector3d at(const Eigen::Vector2d& p_m, double z_m) {
    return {p_m.x(), p_m.y(), z_m};
  }
  std::string vertices_;
  std::string faces_;
  int count_ = 0;
  int objects_ = 0;
};

/// Walls of a room of 6 x 4 m inside, 0.1 m thick, with a door of `door_m` in the middle of the
/// wall at -y, turned by `turn_rad` about the origin; the walls are one solid.
inline DrawnBuilding room_with_door(double door_m, double turn_rad = 0.0) {
  const double h = 0.5 * door_m;
  Outline walls_m{{h, -2.1}, {3.1, -2.1}, {3.1, 2.1}, {-3.1, 2.1}, {-3.1, -2.1}, {-h, -2.1},
                  {-h, -2},  {-3, -2},    {-3, 2},    {3, 2},      {3, -2},      {h, -2}};
  Outline floor_m{{-3.1, -4.0}, {3.1, -4.0}, {3.1, 2.1}, {-3.1, 2.1}};
  const Eigen::Rotation2Dd turn(turn_rad);
  for (Outline* outline : {&walls_m, &floor_m}) {
    for (auto& p_m : *outline) p_m = turn * p_m;
  }
  DrawnBuilding building;
  building.prism(walls_m, 0.0, 2.5);
  building.prism(floor_m, -0.2, 0.0);
  return building;
}

}  // namespace vantage::test
