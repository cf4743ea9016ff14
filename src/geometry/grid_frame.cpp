#include "vantage/geometry/grid_frame.hpp"

#include <algorithm>

namespace vantage {

GridFrame make_grid_frame(const std::array<double, 3>& centre_m,
                          const std::array<double, 3>& size_m, const std::array<int, 3>& cells) {
  GridFrame frame;
  frame.cells = Eigen::Array3i(cells[0], cells[1], cells[2]);
  const Eigen::Vector3d size(size_m[0], size_m[1], size_m[2]);
  expects((frame.cells > 0).all() && (size.array() > 0.0).all(), "a grid needs cells and a size");
  frame.cell_size_m = size.array() / frame.cells.cast<double>();
  frame.min_corner_m = Eigen::Vector3d(centre_m[0], centre_m[1], centre_m[2]) - 0.5 * size;
  return frame;
}

SegmentClip clip_segment(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& p0,
                         const Eigen::Vector3d& p1) {
  SegmentClip clip;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = p1[axis] - p0[axis];
    const double low = box.min()[axis] - p0[axis];
    const double high = box.max()[axis] - p0[axis];
    if (d == 0.0) {
      if (low > 0.0 || high < 0.0) return {.enter = 1.0, .leave = 0.0};
      continue;
    }
    clip.enter = std::max(clip.enter, std::min(low / d, high / d));
    clip.leave = std::min(clip.leave, std::max(low / d, high / d));
  }
  return clip;
}

}  // namespace vantage
