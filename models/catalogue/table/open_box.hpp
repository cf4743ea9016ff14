/// Shelves, crates and cartons on a table: open to one side, with things in them.
#pragma once

#include <Eigen/Core>

#include <string_view>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/models/catalogue/shapes/footprint.hpp"

namespace vantage {

/// A block of wood or cardboard with faces along the axes of the frame it is given in.
struct Board {
  std::string_view name;
  Eigen::Vector3d centre_m;
  Eigen::Vector3d half_m;
  std::string_view material = "dark_wood";
};

/// Where things stand in or on a box: a level rectangle with room above it, frame of the box.
struct Compartment {
  Eigen::Vector2d min_m;
  Eigen::Vector2d max_m;
  double floor_m = 0.0;  ///< above the plane that the box stands on
  double height_m = 0.0;
  bool inside = true;  ///< false: the top of the box
};

/// Open along +x. The origin lies below the middle, on the plane that the box stands on.
struct OpenBox {
  enum class Kind { shelf, pigeonholes, crate, carton };
  Kind kind = Kind::crate;
  Eigen::Vector3d size_m{0.24, 0.34, 0.25};  ///< outer, depth x width x height
  Pose2 T_world_box;
};

/// "shelf", "pigeonholes", "crate" or "carton".
std::string_view kind_name(OpenBox::Kind kind);

/// A box of that kind, up to 8 % smaller than the largest, in whole millimetres.
OpenBox make_open_box(OpenBox::Kind kind, Rng& rng);

std::vector<Board> boards(const OpenBox& box);

/// The compartments of a box, and its top if things up to `limit_m` above the plane that the box
/// stands on leave room for any there.
std::vector<Compartment> compartments(const OpenBox& box, double limit_m);

/// Seen from above, frame of the box, with `front_m` more before the opening.
Outline outline(const OpenBox& box, double front_m = 0.0);

}  // namespace vantage
