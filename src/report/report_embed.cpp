#include "vantage/report/report_embed.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/perception/clouds/ply.hpp"
#include "vantage/report/drawn_scene.hpp"
#include "vantage/report/report.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr std::size_t kMaxTrajectorySamples = 4000;

double rounded(double value, double step) { return std::round(value / step) * step; }

json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

template <class T>
std::string base64_of(const std::vector<T>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

/// By the number in its name: scan_100 comes after scan_99.
std::pair<std::uint64_t, fs::path> place_in_order(const fs::path& image) {
  const std::string name = image.filename().string();
  const std::size_t digits = std::min(name.find_first_of("0123456789"), name.size());
  std::uint64_t number = 0;
  std::from_chars(name.data() + digits, name.data() + name.size(), number);
  return {number, image};
}

}  // namespace

json trajectory_json(const fs::path& path) {
  const auto samples = read_tum(path);
  const std::size_t every = std::max<std::size_t>(
      1, (samples.size() + kMaxTrajectorySamples - 1) / kMaxTrajectorySamples);
  json list = json::array();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % every != 0 && i + 1 != samples.size()) continue;
    const TrajectorySample& s = samples[i];
    list.push_back({rounded(s.time_s, 1e-3), rounded(s.p_world_m.x(), 1e-4),
                    rounded(s.p_world_m.y(), 1e-4), rounded(s.p_world_m.z(), 1e-4),
                    rounded(s.yaw_rad, 1e-4)});
  }
  return list;
}

json voxels_json(const fs::path& path) {
  const VoxelMap map = read_voxels(path);
  const PackedVoxels packed = pack_voxels(map, kMaxReportVoxels);
  static_assert(sizeof(PackedVoxel) == 8);
  const std::string_view bytes(reinterpret_cast<const char*>(packed.voxels.data()),
                               packed.voxels.size() * sizeof(PackedVoxel));
  return {{"cell_size_m", vector_json(map.cell_size_m)},
          {"min_m", vector_json(map.box_m.min())},
          {"max_m", vector_json(map.box_m.max())},
          {"cells", {packed.cells.x(), packed.cells.y(), packed.cells.z()}},
          {"total", packed.total},
          {"surface", packed.surface},
          {"kept", packed.kept},
          {"data", base64(bytes)}};
}

json cloud_json(const fs::path& path) {
  const std::vector<Eigen::Vector3f> all = read_ply(path).cloud.points;
  if (all.empty()) return nullptr;
  const std::size_t every = (all.size() - 1) / (kMaxReportVoxels / 2) + 1;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < all.size(); i += every) points.push_back(all[i]);
  Eigen::AlignedBox3f box;
  for (const auto& p : points) box.extend(p);
  const Eigen::Array3f scale = box.sizes().array().max(1e-6F) / 65535.0F;
  std::vector<std::uint16_t> values;
  values.reserve(3 * points.size());
  for (const auto& p : points) {
    const Eigen::Array3f q = ((p - box.min()).array() / scale).round();
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<std::uint16_t>(q[axis]));
  }
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), 2 * values.size());
  return {{"min_m", vector_json(box.min().cast<double>())},
          {"scale_m", vector_json(scale.matrix().cast<double>())},
          {"total", all.size()},
          {"kept", points.size()},
          {"data", base64(bytes)}};
}

json scene_json(const fs::path& path) {
  const DrawnScene scene = read_drawn_scene(path);
  Eigen::AlignedBox3f box;
  for (const auto& p : scene.vertices_m) box.extend(p);
  if (box.isEmpty()) return nullptr;
  const Eigen::Array3f scale = box.sizes().array().max(1e-6F) / 65535.0F;
  std::vector<std::uint16_t> positions;
  for (const auto& p : scene.vertices_m) {
    const Eigen::Array3f q = ((p - box.min()).array() / scale).round();
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<std::uint16_t>(q[axis]));
  }
  std::vector<DrawnScene::Triangle> triangles;
  json parts = json::array();
  for (const auto& part : scene.triangles) {
    triangles.insert(triangles.end(), part.begin(), part.end());
    parts.push_back(part.size());
  }
  static_assert(sizeof(DrawnScene::Triangle) == 12 && sizeof(scene.colours[0]) == 3);
  return {{"min_m", vector_json(box.min().cast<double>())},
          {"scale_m", vector_json(scale.matrix().cast<double>())},
          {"extent",
           {{"min", vector_json(scene.extent_m.min().cast<double>())},
            {"max", vector_json(scene.extent_m.max().cast<double>())}}},
          {"parts", parts},
          {"positions", base64_of(positions)},
          {"colours", base64_of(scene.colours)},
          {"triangles", base64_of(triangles)}};
}

json frame_of(const fs::path& folder, bool first) {
  fs::path kept;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto extension = entry.path().extension();
    const bool image = extension == ".png" || extension == ".jpg";
    const bool part = entry.path().stem().extension() == ".part";
    if (!image || part) continue;
    const bool earlier = place_in_order(entry.path()) < place_in_order(kept);
    if (kept.empty() || earlier == first) kept = entry.path();
  }
  if (kept.empty()) return nullptr;
  const std::string type = kept.extension() == ".png" ? "png" : "jpeg";
  return "data:image/" + type + ";base64," + base64(read_file(kept));
}

}  // namespace vantage
