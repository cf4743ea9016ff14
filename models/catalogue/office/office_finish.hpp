/// What the surfaces of office furniture look like: regions of one image, and the parts with
/// those surfaces that furniture is put together from.
#pragma once

#include <Eigen/Core>

#include <span>

#include "vantage/models/catalogue/shapes/mesh.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"
#include "vantage/models/catalogue/shapes/uv_rect.hpp"

namespace vantage {

enum class Finish {
  oak,
  walnut,
  cardboard,
  books,
  binders,
  spreadsheet,  ///< on a screen
  editor,       ///< on a screen
  view,         ///< out of a window
  poster,
  keyboard,
  paper,
  foliage,
  clay,
  white,
  grey,
  dark,
  steel,
  blue_fabric,
  green_fabric,
  red_fabric,
  grey_fabric,
};

/// Where a face of that size (m) gets its image from: plain finishes keep their grain at true
/// scale up to the size of their region, images fill the face.
UvRect finish_uv(Finish finish, double width_m, double height_m);
Image paint_finishes();

/// A block between two corners; `front` is the finish of its +x face.
void add_block(TriangleMesh& mesh, const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m,
               Finish finish, Finish front);
void add_block(TriangleMesh& mesh, const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m,
               Finish finish);
/// A block with rounded edges; `T_mesh_cushion` moves it about the mesh's origin.
void add_cushion(TriangleMesh& mesh, const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m,
                 Finish finish, const Pose& T_mesh_cushion = Pose::Identity());
void add_rod(TriangleMesh& mesh, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m,
             double radius_m, Finish finish);
/// A surface of revolution from a profile of (r, z) that starts and ends on the axis.
void add_turned(TriangleMesh& mesh, std::span<const Eigen::Vector2d> profile_m,
                const Eigen::Vector2d& axis_m, Finish finish);
/// A leaf from `root` along a curve of that length that bends to the ground.
void add_leaf(TriangleMesh& mesh, const Eigen::Vector3d& root_m, double heading_rad,
              double length_m, double width_m);

}  // namespace vantage
