/// Everyday objects in shape families. An instance draws its parameters from a random stream named
/// by the object, so that adding objects or families changes none of the others.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/models/catalogue/shapes/mesh.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"

namespace vantage {

struct ObjectSpec {
  std::string name;      ///< unique in a catalogue, "mug_03"
  std::string category;  ///< "mug"; names the shape family
  std::uint64_t seed = 0;
};

/// Object frame: origin below the middle of the bounding box, on the supporting plane; z up.
struct GeneratedObject {
  TriangleMesh mesh;
  Image texture;
  double specular = 0.2;                     ///< strength of highlights, [0, 1]
  std::vector<Eigen::Vector2d> footprint_m;  ///< convex outline seen from above, counter-clockwise
  double footprint_radius_m = 0.0;           ///< of the circle round the origin that holds it
  double height_m = 0.0;
  double mass_kg = 0.0;
  double top_radius_m = 0.0;  ///< of the level disc on top that can carry something; 0: none
  bool stands = false;        ///< has a flat base, can be put on another object
};

/// All categories, in a fixed order: 51.
std::vector<std::string_view> object_categories();

/// What the table-top scenes choose from: `per_category` objects of each of 30 categories, numbered
/// from 0.
std::vector<ObjectSpec> catalogue(std::uint64_t seed, int per_category = 6);

/// @throws ConfigError if no family has the category's name.
GeneratedObject generate(const ObjectSpec& spec);

}  // namespace vantage
