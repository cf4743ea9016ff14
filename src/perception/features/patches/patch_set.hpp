/// Descriptors of the patches of a view.
#pragma once

#include <Eigen/Core>

namespace vantage {

struct PatchSet {
  Eigen::MatrixXf descriptors;  ///< dimensions x patches
  Eigen::Matrix2Xf places;      ///< x, y of each patch's centre within the object's box, 0 .. 1

  [[nodiscard]] Eigen::Index size() const { return descriptors.cols(); }
};

inline constexpr int kPatchStep_px = 8;
inline constexpr int kPatchSide_px = 16;

}  // namespace vantage
