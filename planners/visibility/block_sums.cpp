#include "vantage/planners/visibility/block_sums.hpp"

#include <algorithm>

namespace vantage {

BlockSums::BlockSums(const CellBlocks& blocks)
    : blocks_(blocks),
      stride_(1, blocks.blocks().x(), blocks.blocks().x() * blocks.blocks().y()),
      sums_(blocks.size(), 0.0F) {}

void BlockSums::add(const float* utility, int axis, const Eigen::Array3i& first, int end) {
  const int edge = blocks_.edge[axis];
  int begin = first[axis];
  float* sum = sums_.data() + (first / blocks_.edge * stride_).sum();
  while (begin < end) {
    const int next = std::min((begin / edge + 1) * edge, end);
    float seen = 0.0F;
    for (int i = begin; i < next; ++i) seen += utility[i];
    *sum += seen;
    sum += stride_[axis];
    begin = next;
  }
}

}  // namespace vantage
