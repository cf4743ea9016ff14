#include "vantage/perception/clouds/normals.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

#include "vantage/perception/clouds/kd_tree.hpp"

namespace vantage {
namespace {

Eigen::Matrix3d covariance(const std::vector<Eigen::Vector3f>& points,
                           const std::vector<Neighbour>& neighbourhood) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Neighbour& n : neighbourhood) mean += points[n.index].cast<double>();
  mean /= static_cast<double>(neighbourhood.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Neighbour& n : neighbourhood) {
    const Eigen::Vector3d d = points[n.index].cast<double>() - mean;
    sum += d * d.transpose();
  }
  return sum / static_cast<double>(neighbourhood.size());
}

/// Across a line of points and horizontal; zero for a line that is itself far from horizontal.
Eigen::Vector3d across_horizontal_line(const Eigen::Vector3d& along) {
  constexpr double max_slope = 0.17;  // sin 10 deg
  if (std::abs(along.z()) > max_slope) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d::UnitZ().cross(along).normalized();
}

Eigen::Vector3d unoriented_normal(const Eigen::Matrix3d& spread, double line_ratio) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const Eigen::Vector3d& variance = solver.eigenvalues();  // ascending
  if (!(variance[2] > 0.0)) return Eigen::Vector3d::Zero();
  if (variance[1] < line_ratio * variance[2]) {
    return across_horizontal_line(solver.eigenvectors().col(2));
  }
  return solver.eigenvectors().col(0);
}

}  // namespace

void estimate_normals(PointCloud& cloud, const Eigen::Vector3d& p_viewpoint,
                      const NormalOptions& options) {
  const KdTree tree(cloud.points);
  cloud.normals.assign(cloud.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto neighbourhood = tree.within(cloud.points[i], options.radius_m);
    if (neighbourhood.size() < static_cast<std::size_t>(options.min_neighbours)) continue;
    Eigen::Vector3d normal =
        unoriented_normal(covariance(cloud.points, neighbourhood), options.line_ratio);
    if (normal.dot(p_viewpoint - cloud.points[i].cast<double>()) < 0.0) normal = -normal;
    cloud.normals[i] = normal.cast<float>();
  }
}

}  // namespace vantage
