#include "vantage/perception/features/kit/upright_extents.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

#include "vantage/information/quantile.hpp"

namespace vantage {

UprightExtents upright_extents(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& up,
                               double low, double high) {
  const Eigen::Vector3d u = up.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> horizontal;
  horizontal << u, up.cross(u);
  Eigen::Matrix2Xd from_above = horizontal.transpose() * points;
  from_above.colwise() -= from_above.rowwise().mean().eval();
  const Eigen::Matrix2d spread = from_above * from_above.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(spread);
  const Eigen::Matrix<double, 3, 2> axes = horizontal * solver.eigenvectors();
  const auto ends_m = [&](const Eigen::Vector3d& axis) -> Eigen::Vector2d {
    const Eigen::RowVectorXd along = axis.transpose() * points;
    std::vector<double> values(along.begin(), along.end());
    const double lower_m = quantile(values, low);
    return {lower_m, quantile(std::move(values), high)};
  };
  const auto extent = [&](const Eigen::Vector3d& axis) { return LevelExtent{axis, ends_m(axis)}; };
  const auto length_m = [](const LevelExtent& e) { return e.ends_m.y() - e.ends_m.x(); };
  LevelExtent a = extent(axes.col(0));
  LevelExtent b = extent(axes.col(1));
  if (length_m(a) < length_m(b)) std::swap(a, b);
  const Eigen::Vector2d heights_m = ends_m(up);
  return {heights_m.x(), heights_m.y(), length_m(a), length_m(b), a, b};
}

}  // namespace vantage
