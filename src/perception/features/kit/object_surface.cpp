#include "vantage/perception/features/kit/object_surface.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

constexpr int kMinNeighbours = 6;
constexpr double kLineRatio = 1e-4;  // of the second spread to the first

/// Count, sum and sum of products of points: 1, x, y, z, xx, xy, xz, yy, yz, zz.
using Moments = Eigen::Array<double, 10, 1>;

Moments moments_of(const Eigen::Vector3d& p) {
  Moments m;
  m << 1.0, p.x(), p.y(), p.z(), p.x() * p.x(), p.x() * p.y(), p.x() * p.z(), p.y() * p.y(),
      p.y() * p.z(), p.z() * p.z();
  return m;
}

class MomentsImage {
 public:
  MomentsImage(int width_px, int height_px)
      : width_(width_px), height_(height_px), sums_(10, (width_px + 1) * (height_px + 1)) {
    sums_.setZero();
  }
  /// In row-major order; every pixel once.
  void set(int row, int column, const Moments& m) {
    sums_.col(at(row + 1, column + 1)) = m + sums_.col(at(row, column + 1)) +
                                         sums_.col(at(row + 1, column)) -
                                         sums_.col(at(row, column));
  }
  [[nodiscard]] Moments around(int row, int column, int radius_px) const {
    const int top = std::max(row - radius_px, 0);
    const int left = std::max(column - radius_px, 0);
    const int bottom = std::min(row + radius_px + 1, height_);
    const int right = std::min(column + radius_px + 1, width_);
    return sums_.col(at(bottom, right)) - sums_.col(at(top, right)) - sums_.col(at(bottom, left)) +
           sums_.col(at(top, left));
  }

 private:
  [[nodiscard]] Eigen::Index at(int row, int column) const { return row * (width_ + 1) + column; }
  int width_;
  int height_;
  Eigen::Array<double, 10, Eigen::Dynamic> sums_;
};

Eigen::Vector3d normal_of(const Moments& m, const Eigen::Vector3d& p) {
  if (m[0] < kMinNeighbours) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d mean = m.segment<3>(1).matrix() / m[0];
  Eigen::Matrix3d spread;
  spread << m[4], m[5], m[6], m[5], m[7], m[8], m[6], m[8], m[9];
  spread = spread / m[0] - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  if (!(solver.eigenvalues()[1] > kLineRatio * solver.eigenvalues()[2])) {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
  return normal.dot(p) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

}  // namespace

std::string lacks_geometry(const ObjectView& view) {
  if (!(view.focal_px > 0.0) || !std::isfinite(view.focal_px) || !view.centre_px.allFinite()) {
    return "the camera's intrinsics are not finite numbers";
  }
  return {};
}

std::string lacks_up(const ObjectView& view) {
  return view.up.norm() > 0.5 ? "" : "the direction of gravity is not known";
}

Eigen::Matrix3Xd object_points(const ObjectView& view, const ObjectPixels& pixels) {
  Eigen::Matrix3Xd points(3, pixels.depth_count);
  Eigen::Index next = 0;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (pixels.depth[view.index(row, column)] != 0) points.col(next++) = view.point(row, column);
    }
  }
  return points;
}

ObjectSurface object_surface(const ObjectView& view, const ObjectPixels& pixels, double radius_m) {
  const Eigen::Matrix3Xd points = object_points(view, pixels);
  ObjectSurface surface;
  surface.point_at.assign(pixels.depth.size(), -1);
  if (points.cols() == 0) return surface;
  const Eigen::Vector3d centre = points.rowwise().mean();  // products stay small around it
  MomentsImage image(view.width_px, view.height_px);
  int next = 0;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const std::size_t i = view.index(row, column);
      const bool seen = pixels.depth[i] != 0;
      if (seen) surface.point_at[i] = next++;
      image.set(row, column,
                seen ? moments_of(points.col(surface.point_at[i]) - centre) : Moments::Zero());
    }
  }
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const int point = surface.point_at[view.index(row, column)];
      if (point < 0) continue;
      const Eigen::Vector3d p = points.col(point);
      const auto radius_px =
          static_cast<int>(std::clamp(std::round(radius_m * view.focal_px / p.z()), 2.0, 8.0));
      surface.cloud.points.emplace_back(p.cast<float>());
      surface.cloud.normals.emplace_back(
          normal_of(image.around(row, column, radius_px), p).cast<float>());
    }
  }
  return surface;
}

}  // namespace vantage
