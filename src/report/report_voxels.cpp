#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/bytes.hpp"
#include "vantage/core/error.hpp"
#include "vantage/geometry/grid_frame.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage {
namespace {

constexpr std::string_view kVoxelsMagic = "VTGVOX01";
constexpr std::size_t kHeaderBytes = 8 + 9 * sizeof(double) + sizeof(std::uint64_t);
constexpr std::size_t kRecordBytes = 16;
constexpr int kMaxCellsPerAxis = 65535;
constexpr std::size_t kMaxCells = 64U << 20;

GridFrame frame_of(const VoxelMap& map) {
  GridFrame frame;
  frame.min_corner_m = map.box_m.min();
  frame.cell_size_m = map.cell_size_m;
  frame.cells = (map.box_m.sizes().array() / map.cell_size_m.array()).round().max(1.0).cast<int>();
  return frame;
}

std::string header_problem(const VoxelMap& map) {
  const auto finite = [](const Eigen::Vector3d& v) { return v.allFinite(); };
  if (!finite(map.cell_size_m) || !finite(map.box_m.min()) || !finite(map.box_m.max())) {
    return "cell size or box is not finite";
  }
  if ((map.cell_size_m.array() <= 0.0).any() || map.box_m.isEmpty()) {
    return "cell size or box is empty";
  }
  const Eigen::Array3d cells = (map.box_m.sizes().array() / map.cell_size_m.array()).round();
  if ((cells > kMaxCellsPerAxis).any() || cells.max(1.0).prod() > static_cast<double>(kMaxCells)) {
    return "the grid has too many cells";
  }
  return {};
}

/// Per cell of the grid the step at which it filled, for one kind of voxel.
class Fill {
 public:
  static constexpr std::uint16_t kNever = std::numeric_limits<std::uint16_t>::max();

  Fill(const GridFrame& frame, const std::vector<VoxelRecord>& voxels, std::uint8_t kind)
      : frame_(frame), step_(frame.size(), kNever) {
    for (const VoxelRecord& voxel : voxels) {
      const Eigen::Vector3d p(voxel.x, voxel.y, voxel.z);
      if (voxel.kind != kind || is_far(p)) continue;
      const Eigen::Array3i cell = frame.cell_at(p);
      if (!frame.contains(cell)) continue;
      std::uint16_t& step = step_[frame.index(cell)];
      const auto last = static_cast<std::uint16_t>(kNever - 1);
      const std::uint16_t filled = kind == kVoxelOccupied ? std::min(voxel.step, last) : 0;
      step = std::min(step, filled);
    }
  }
  [[nodiscard]] std::uint16_t step(std::size_t index) const { return step_[index]; }
  [[nodiscard]] std::size_t size() const { return step_.size(); }

  /// True if some neighbour is missing, or came later than the cell itself.
  [[nodiscard]] bool ever_exposed(std::size_t index) const {
    const Eigen::Array3i cell = frame_.cell(index);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Eigen::Array3i neighbour = cell;
        neighbour[axis] += side;
        if (!frame_.contains(neighbour)) return true;
        if (step_[frame_.index(neighbour)] > step_[index]) return true;
      }
    }
    return false;
  }

 private:
  /// Beyond the grid, maybe farther than cells have numbers.
  [[nodiscard]] bool is_far(const Eigen::Vector3d& p) const {
    const Eigen::Array3d cells = (p - frame_.min_corner_m).array() / frame_.cell_size_m.array();
    return (cells < -1.0).any() || (cells > frame_.cells.cast<double>() + 1.0).any();
  }

  const GridFrame& frame_;
  std::vector<std::uint16_t> step_;
};

std::vector<PackedVoxel> exposed_voxels(const GridFrame& frame, const Fill& fill,
                                        std::uint8_t kind) {
  std::vector<PackedVoxel> found;
  for (std::size_t i = 0; i < fill.size(); ++i) {
    if (fill.step(i) == Fill::kNever || !fill.ever_exposed(i)) continue;
    const Eigen::Array<std::uint16_t, 3, 1> cell = frame.cell(i).cast<std::uint16_t>();
    const auto step = static_cast<std::uint16_t>(std::min<std::uint16_t>(fill.step(i), 0x7FFF));
    const auto packed = static_cast<std::uint16_t>(step | (kind << 15));
    found.push_back({{cell.x(), cell.y(), cell.z()}, packed});
  }
  return found;
}

/// `count` of `items`, evenly spread.
std::vector<PackedVoxel> thinned(const std::vector<PackedVoxel>& items, std::size_t count) {
  if (count >= items.size()) return items;
  std::vector<PackedVoxel> kept;
  kept.reserve(count);
  for (std::size_t i = 0; i < count; ++i) kept.push_back(items[i * items.size() / count]);
  return kept;
}

}  // namespace

void write_voxels(const std::filesystem::path& path, const VoxelMap& map) {
  expects(header_problem(map).empty(), "a voxel map has finite, positive cells in a box");
  std::string bytes(kVoxelsMagic);
  bytes.reserve(kHeaderBytes + kRecordBytes * map.voxels.size());
  for (const Eigen::Vector3d& v :
       {map.cell_size_m, Eigen::Vector3d(map.box_m.min()), Eigen::Vector3d(map.box_m.max())}) {
    for (int axis = 0; axis < 3; ++axis) put(bytes, v[axis]);
  }
  put(bytes, static_cast<std::uint64_t>(map.voxels.size()));
  for (const VoxelRecord& voxel : map.voxels) {
    put(bytes, voxel.x);
    put(bytes, voxel.y);
    put(bytes, voxel.z);
    put(bytes, voxel.step);
    put(bytes, voxel.kind);
    put(bytes, std::uint8_t{0});
  }
  write_file(path, bytes);
}

VoxelMap read_voxels(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  ByteReader reader(content, path.string() + ": not a voxel file");
  reader.require(content.size() >= kHeaderBytes && content.starts_with(kVoxelsMagic), "bad header");
  reader.block(kVoxelsMagic.size(), "the header");
  VoxelMap map;
  for (Eigen::Vector3d* v : {&map.cell_size_m, &map.box_m.min(), &map.box_m.max()}) {
    reader.numbers(std::span(v->data(), 3), "the header");
  }
  const auto count = reader.number<std::uint64_t>("the header");
  if (const std::string why = header_problem(map); !why.empty()) reader.fail(why);
  if (reader.left() % kRecordBytes != 0 || reader.left() / kRecordBytes != count) {
    reader.fail(fmt::format("header says {} voxels, the file holds {:.1f}", count,
                            static_cast<double>(reader.left()) / kRecordBytes));
  }
  map.voxels.resize(count);
  for (VoxelRecord& voxel : map.voxels) {
    for (float* p : {&voxel.x, &voxel.y, &voxel.z}) *p = reader.number<float>("a voxel");
    voxel.step = reader.number<std::uint16_t>("a voxel");
    voxel.kind = reader.number<std::uint8_t>("a voxel");
    reader.block(1, "a voxel");
    const bool finite = std::isfinite(voxel.x) && std::isfinite(voxel.y) && std::isfinite(voxel.z);
    if (voxel.kind > kVoxelUnobserved || !finite) reader.fail("a voxel is out of range");
  }
  return map;
}

PackedVoxels pack_voxels(const VoxelMap& map, std::size_t limit) {
  const GridFrame frame = frame_of(map);
  PackedVoxels packed;
  packed.cells = frame.cells;
  for (const VoxelRecord& voxel : map.voxels) ++packed.total[voxel.kind];
  for (const std::uint8_t kind : {kVoxelOccupied, kVoxelUnobserved}) {
    auto exposed = exposed_voxels(frame, Fill(frame, map.voxels, kind), kind);
    packed.surface[kind] = exposed.size();
    auto kept = thinned(exposed, limit - packed.voxels.size());
    packed.kept[kind] = kept.size();
    std::stable_sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
      return a.step_and_kind < b.step_and_kind;
    });
    packed.voxels.insert(packed.voxels.end(), kept.begin(), kept.end());
  }
  return packed;
}

}  // namespace vantage
