/// Objects to put on the turntable: generated ones, or scanned ones from a folder.
#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/dataset/dataset_options.hpp"

namespace vantage {

/// An object as MuJoCo reads it. Yaw 0 is its mesh as it is.
struct TurntableObject {
  std::string obj;            ///< bytes of a Wavefront OBJ file, metres, z up
  std::string png;            ///< bytes of its texture
  double specular = 0.2;      ///< strength of highlights, [0, 1]
  Eigen::AlignedBox3d box_m;  ///< bounds of the mesh
};

struct ObjectName {
  std::string category;
  std::string object;       ///< "<category>_<instance>"
  std::string family = {};  ///< of near-duplicates; of scanned objects, the object itself
};

/// The objects of a dataset, in order.
/// @throws InputError if `options.models` is given and holds no <name>/{model.obj, texture.png}.
std::vector<ObjectName> object_names(const DatasetOptions& options);

/// What the scanned ones among them are read from, in order; nothing where there are none.
std::vector<std::filesystem::path> scanned_files(const DatasetOptions& options);

/// Makes or reads one of them.
/// @throws InputError if its files cannot be read or hold no vertices.
TurntableObject make_turntable_object(const DatasetOptions& options, const ObjectName& name);

}  // namespace vantage
