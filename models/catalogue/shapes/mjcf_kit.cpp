#include "vantage/models/catalogue/shapes/mjcf_kit.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <system_error>

#include "vantage/core/atomic_file.hpp"

namespace vantage {

using Eigen::Vector3d;

std::string mjcf_camera(std::string_view name, const Vector3d& eye, const Vector3d& target,
                        const Vector3d& up, double fovy_deg) {
  const Vector3d back = (eye - target).normalized();
  const Vector3d x = up.cross(back).normalized();
  const Vector3d y = back.cross(x);
  return fmt::format(
      "    <camera name=\"{}\" pos=\"{} {} {}\" xyaxes=\"{:.6f} {:.6f} {:.6f} {:.6f} {:.6f} "
      "{:.6f}\" "
      "fovy=\"{}\"/>\n",
      name, eye.x(), eye.y(), eye.z(), x.x(), x.y(), x.z(), y.x(), y.y(), y.z(), fovy_deg);
}

AssetFolders empty_asset_folders(const std::filesystem::path& scene_directory) {
  AssetFolders folders{scene_directory / "meshes", scene_directory / "textures"};
  for (const auto& folder : {folders.meshes, folders.textures}) {
    std::error_code missing;
    std::filesystem::remove_all(folder, missing);
    make_writable_directory(folder);
  }
  return folders;
}

}  // namespace vantage
