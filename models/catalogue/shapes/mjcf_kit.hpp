/// What the writers of MJCF scenes share.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <string_view>

namespace vantage {

/// A camera element at `eye` that looks at `target` with `up` upwards in the image.
std::string mjcf_camera(std::string_view name, const Eigen::Vector3d& eye,
                        const Eigen::Vector3d& target, const Eigen::Vector3d& up, double fovy_deg);

struct AssetFolders {
  std::filesystem::path meshes;
  std::filesystem::path textures;
};
/// meshes/ and textures/ of a scene's folder; what was in them is removed.
/// @throws OutputError if they cannot be made.
AssetFolders empty_asset_folders(const std::filesystem::path& scene_directory);

}  // namespace vantage
