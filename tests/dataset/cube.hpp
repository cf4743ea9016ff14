/// A cube of 10 cm with a face of each colour, to see which way it was turned.
#pragma once

#include "vantage/dataset/turntable.hpp"
#include "vantage/models/catalogue/shapes/mesh_builders.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"

namespace vantage::support {

/// Faces +x red, -x green, +y blue, -y yellow, +z white, -z black.
inline TurntableObject coloured_cube() {
  const std::array<RgbColour, 6> colours{RgbColour(1, 0, 0), RgbColour(0, 1, 0),
                                         RgbColour(0, 0, 1), RgbColour(1, 1, 0),
                                         RgbColour(1, 1, 1), RgbColour(0, 0, 0)};
  const BoxUv uv = unfold_box(Eigen::Vector3d::Constant(0.1));
  Image texture(256, 256, RgbColour::Zero());
  for (std::size_t i = 0; i < 6; ++i) paint(texture, shrink(uv[i], -0.004), colours[i]);
  const TriangleMesh mesh = make_rounded_box(Eigen::Vector3d::Constant(0.1), 0.001, 2, uv);
  return {to_obj(mesh), png_bytes(texture), 0.0, bounds(mesh)};
}

/// A camera 0.8 m from the aim point; nothing is drawn at random.
inline Session plain_session(double elevation_rad) {
  return {.elevation_rad = elevation_rad,
          .distance_m = 0.8,
          .offset_m = Eigen::Vector2d::Zero(),
          .lamp_heading_rad = 0.5,
          .lamp_elevation_rad = 1.0,
          .ambient = 0.4,
          .table = 0.6};
}

}  // namespace vantage::support
