#include "vantage/perception/features/patches/cloud_patches.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vantage {
namespace {

constexpr float kRadius_m = 0.05F;
constexpr std::size_t kMinNeighbours = 10;
constexpr double kMaxNeighbours = 256.0;
constexpr int kMaxPoints = 1600;

struct GridPoint {
  int row = 0;
  int column = 0;
  std::size_t point = 0;
};

std::vector<GridPoint> grid_of(const ObjectPixels& pixels, const ObjectSurface& surface) {
  const auto first = [](int side_px) { return (side_px - 1) % kPatchStep_px / 2; };
  std::vector<GridPoint> grid;
  for (int row = first(pixels.height_px); row < pixels.height_px; row += kPatchStep_px) {
    for (int column = first(pixels.width_px); column < pixels.width_px; column += kPatchStep_px) {
      const int point = surface.point_at[static_cast<std::size_t>(row) * pixels.width_px + column];
      if (point >= 0) grid.push_back({row, column, static_cast<std::size_t>(point)});
    }
  }
  return grid;
}

Eigen::Vector2f place_of(const ObjectPixels& pixels, const GridPoint& at) {
  const auto place = place_in_box(pixels, at.column + 0.5, at.row + 0.5);
  return {place[0], place[1]};
}

/// Points with a normal near that of a grid point, from every `stride`-th pixel.
std::vector<std::size_t> neighbours(const ObjectView& view, const ObjectSurface& surface,
                                    const GridPoint& at) {
  const Eigen::Vector3f& p = surface.cloud.points[at.point];
  // Clamped before it is a whole number: of a point at the camera it is beyond any.
  const int reach_px = static_cast<int>(std::clamp<double>(
      std::ceil(kRadius_m * view.focal_px / p.z()), -1.0, std::max(view.width_px, view.height_px)));
  const int stride =
      std::max(1, static_cast<int>(std::ceil((2.0 * reach_px + 1.0) / std::sqrt(kMaxNeighbours))));
  const int reach = reach_px / stride;
  std::vector<std::size_t> found;
  for (int i = -reach; i <= reach; ++i) {
    const int row = at.row + i * stride;
    if (row < 0 || row >= view.height_px) continue;
    for (int j = -reach; j <= reach; ++j) {
      const int column = at.column + j * stride;
      if (column < 0 || column >= view.width_px) continue;
      const int point = surface.point_at[view.index(row, column)];
      if (point < 0) continue;
      const auto index = static_cast<std::size_t>(point);
      if ((surface.cloud.points[index] - p).norm() > kRadius_m) continue;
      if (!surface.cloud.normals[index].isZero()) found.push_back(index);
    }
  }
  return found;
}

/// Mean of the basis' products over the neighbours. terms.
Eigen::VectorXf mean_products(const ObjectSurface& surface, std::size_t centre,
                              const std::vector<std::size_t>& around, const ProductBasis& basis) {
  const Eigen::Vector3f& p = surface.cloud.points[centre];
  const Eigen::Vector3f& n = surface.cloud.normals[centre];
  const auto& [angle_axis, along_axis, off_axis] =
      std::tie(basis.axes[0], basis.axes[1], basis.axes[2]);
  const Eigen::Index offs = off_axis.functions();
  const auto count = static_cast<Eigen::Index>(around.size());
  Eigen::MatrixXf angles(angle_axis.functions(), count);
  Eigen::MatrixXf places(along_axis.functions() * offs, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t point = around[static_cast<std::size_t>(i)];
    const Eigen::Vector3f d = surface.cloud.points[point] - p;
    const float along = n.dot(d);
    const float off = std::sqrt(std::max(0.0F, d.squaredNorm() - along * along));
    const float cosine = std::clamp(n.dot(surface.cloud.normals[point]), -1.0F, 1.0F);
    angles.col(i) = angle_axis.at(std::acos(cosine));
    Eigen::Map<Eigen::MatrixXf>(places.col(i).data(), offs, along_axis.functions()).noalias() =
        off_axis.at(off) * along_axis.at(along).transpose();
  }
  const Eigen::MatrixXf sums = angles * places.transpose() / static_cast<float>(count);
  Eigen::VectorXf products(basis.terms.cols());
  for (Eigen::Index t = 0; t < products.size(); ++t) {
    products[t] = sums(basis.terms(0, t), basis.terms(1, t) * offs + basis.terms(2, t));
  }
  return products;
}

}  // namespace

PatchSet describe_spins(const ObjectView& view, const ObjectPixels& pixels,
                        const ObjectSurface& surface, const ProductBasis& basis) {
  const auto grid = grid_of(pixels, surface);
  Eigen::MatrixXf products(basis.terms.cols(), static_cast<Eigen::Index>(grid.size()));
  Eigen::Matrix2Xf places(2, products.cols());
  Eigen::Index described = 0;
  for (const GridPoint& at : grid) {
    if (surface.cloud.normals[at.point].isZero()) continue;
    const auto around = neighbours(view, surface, at);
    if (around.size() < kMinNeighbours) continue;
    products.col(described) = mean_products(surface, at.point, around, basis);
    places.col(described++) = place_of(pixels, at);
  }
  return {basis.projection * products.leftCols(described), places.leftCols(described)};
}

PatchSet describe_sizes(const ObjectPixels& pixels, const ObjectSurface& surface,
                        const ProductBasis& basis) {
  const auto grid = grid_of(pixels, surface);
  const auto& axis = basis.axes[0];
  const std::size_t stride =
      std::max<std::size_t>(1, (surface.cloud.size() + kMaxPoints - 1) / kMaxPoints);
  const auto patches = static_cast<Eigen::Index>(grid.size());
  Eigen::MatrixXf counts = Eigen::MatrixXf::Zero(axis.values.cols(), patches);
  Eigen::Matrix2Xf places(2, patches);
  for (Eigen::Index g = 0; g < patches; ++g) {
    const GridPoint& at = grid[static_cast<std::size_t>(g)];
    const Eigen::Vector3f& p = surface.cloud.points[at.point];
    for (std::size_t i = 0; i < surface.cloud.size(); i += stride) {
      counts(axis.sample((surface.cloud.points[i] - p).norm()), g) += 1.0F;
    }
    places.col(g) = place_of(pixels, at);
  }
  const std::size_t taken = (surface.cloud.size() + stride - 1) / stride;
  const Eigen::MatrixXf functions = axis.values * counts / static_cast<float>(taken);
  Eigen::MatrixXf products(basis.terms.cols(), patches);
  for (Eigen::Index t = 0; t < products.rows(); ++t) {
    products.row(t) = functions.row(basis.terms(0, t));
  }
  return {basis.projection * products, places};
}

}  // namespace vantage
