#include "vantage/building/mesh_file.hpp"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// Vertices that are no farther apart are one.
constexpr double kWeld_m = 1e-4;
/// Single precision resolves a millimetre up to there.
constexpr double kFarthest_m = 8000.0;

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// Joins vertices as they come.
class Welder {
 public:
  explicit Welder(BuildingMesh& mesh) : mesh_(mesh) {}

  int add(const Eigen::Vector3d& p_m) {
    const Eigen::Array3d at = (p_m.array() / kWeld_m).round();
    const Key key(std::llround(at.x()), std::llround(at.y()), std::llround(at.z()));
    const auto [entry, is_new] = known_.try_emplace(key, static_cast<int>(mesh_.vertices_m.size()));
    if (is_new) mesh_.vertices_m.push_back(p_m);
    return entry->second;
  }

 private:
  using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  BuildingMesh& mesh_;
  std::map<Key, int> known_;
};

Eigen::Affine3d transform_of(const aiMatrix4x4& m) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  T.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return T;
}

/// Files without materials get a grey one from Assimp, which says nothing.
Eigen::Vector3f colour_of(const aiScene& scene, const aiMesh& mesh) {
  aiColor4D colour(-1.0F, -1.0F, -1.0F, 1.0F);
  if (mesh.mMaterialIndex < scene.mNumMaterials) {
    const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
    aiString name;
    material.Get(AI_MATKEY_NAME, name);
    const bool own = name != aiString(AI_DEFAULT_MATERIAL_NAME) && name.length > 0;
    if (own) material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  }
  return {colour.r, colour.g, colour.b};
}

/// Takes over the meshes of a file, node by node.
class Builder {
 public:
  Builder(const aiScene& scene, const std::string& file) : scene_(scene), file_(file) {}

  void add(const aiNode& node, const Eigen::Affine3d& T_building_parent) {
    const Eigen::Affine3d T = T_building_parent * transform_of(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], T);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], T);
  }

  BuildingMesh building;

 private:
  void add(const aiMesh& mesh, const Eigen::Affine3d& T_building_mesh) {
    std::vector<int> known;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      known.push_back(welder_.add(checked(T_building_mesh * Eigen::Vector3d(p.x, p.y, p.z))));
    }
    const bool mirrored = T_building_mesh.linear().determinant() < 0.0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      Triangle triangle{known[face.mIndices[0]], known[face.mIndices[1]], known[face.mIndices[2]]};
      if (mirrored) std::swap(triangle[1], triangle[2]);
      if (building.normal(triangle).norm() < 1e-12) continue;
      building.triangles.push_back(triangle);
      building.colours.push_back(colour_of(scene_, mesh));
      building.objects.push_back(objects_);
    }
    ++objects_;
  }

  [[nodiscard]] Eigen::Vector3d checked(const Eigen::Vector3d& p_m) const {
    if (!p_m.allFinite()) throw InputError(fmt::format("{}: a vertex is not finite", file_));
    if (p_m.cwiseAbs().maxCoeff() <= kFarthest_m) return p_m;
    throw InputError(fmt::format(
        "{}: too large: a vertex is {:.3g} m from the origin, {} m at most; is --scale right?",
        file_, p_m.cwiseAbs().maxCoeff(), kFarthest_m));
  }

  const aiScene& scene_;
  const std::string& file_;
  Welder welder_{building};
  int objects_ = 0;
};

Eigen::Affine3d upright(const MeshReading& reading) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  if (reading.up == UpAxis::y) T.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T.linear() *= reading.scale;
  return T;
}

}  // namespace

UpAxis usual_up_axis(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gltf" || extension == ".glb" ? UpAxis::y : UpAxis::z;
}

BuildingMesh read_building_mesh(const fs::path& file, const MeshReading& reading) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    throw InputError(fmt::format("{}: no such file", file.string()));
  }
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr) {
    throw InputError(fmt::format("{}: not a mesh that can be read: {}", file.string(),
                                 one_line(importer.GetErrorString())));
  }
  const std::string name = file.string();
  Builder builder(*scene, name);
  builder.add(*scene->mRootNode, upright(reading));
  if (builder.building.triangles.empty()) {
    throw InputError(fmt::format("{}: a mesh without triangles", name));
  }
  return std::move(builder.building);
}

}  // namespace vantage
