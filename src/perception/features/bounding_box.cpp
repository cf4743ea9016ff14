#include "src/perception/features/bounding_box.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/perception/features/object_pixels.hpp"
#include "src/perception/features/object_surface.hpp"

namespace vantage {
namespace {

/// Between the quantiles of the points' coordinates along `axis`, m.
double extent_m(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& axis, double low,
                double high) {
  const Eigen::RowVectorXd along = axis.transpose() * points;
  std::vector<double> values(along.begin(), along.end());
  const auto quantile = [&](double share) {
    const auto at =
        values.begin() + std::lround(share * (static_cast<double>(values.size()) - 1.0));
    std::ranges::nth_element(values, at);
    return *at;
  };
  return quantile(high) - quantile(low);
}

}  // namespace

FeatureResult BoundingBox::extract(const ObjectView& view) const {
  const ObjectPixels pixels = object_pixels(view);
  if (auto why = lacks_depth(pixels, min_pixels); !why.empty()) return FeatureResult::skip(why);
  if (auto why = lacks_geometry(view); !why.empty()) return FeatureResult::skip(why);
  if (!(view.up.norm() > 0.5)) return FeatureResult::skip("the direction of gravity is not known");
  const Eigen::Matrix3Xd points = object_points(view, pixels);
  const Eigen::Vector3d up = view.up.normalized();
  const Eigen::Vector3d u = up.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> horizontal;
  horizontal << u, up.cross(u);
  Eigen::Matrix2Xd from_above = horizontal.transpose() * points;
  from_above.colwise() -= from_above.rowwise().mean().eval();
  const Eigen::Matrix2d spread = from_above * from_above.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(spread);
  const Eigen::Matrix<double, 3, 2> axes = horizontal * solver.eigenvectors();
  const double a = extent_m(points, axes.col(0), low_quantile, high_quantile);
  const double b = extent_m(points, axes.col(1), low_quantile, high_quantile);
  const double height = extent_m(points, up, low_quantile, high_quantile);
  return {Eigen::Vector3d(height, std::max(a, b), std::min(a, b)).cast<float>(), {}};
}

}  // namespace vantage
