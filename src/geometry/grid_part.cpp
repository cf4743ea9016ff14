#include "vantage/geometry/grid_part.hpp"

namespace vantage {

GridPart whole(const GridFrame& frame) {
  return {.begin = Eigen::Array3i::Zero(), .count = frame.cells};
}

GridPart cells_about(const GridFrame& frame, const Eigen::AlignedBox3d& box_m) {
  constexpr int kMargin_cells = 2;
  const Eigen::AlignedBox3d common_m = box_m.intersection(frame.box());
  if (common_m.isEmpty()) return {};
  GridPart part;
  part.begin = (frame.cell_at(common_m.min()) - kMargin_cells).max(0);
  const Eigen::Array3i last = (frame.cell_at(common_m.max()) + kMargin_cells).min(frame.cells - 1);
  part.count = last - part.begin + 1;
  return part;
}

}  // namespace vantage
