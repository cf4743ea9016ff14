#include "vantage/perception/clouds/kd_tree.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <utility>

namespace vantage {
namespace {

/// The view of the points that nanoflann asks for.
struct PointsAdaptor {
  std::vector<Eigen::Vector3f> points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointsAdaptor>,
                                        PointsAdaptor, 3, std::size_t>;
constexpr std::size_t kLeafSize = 12;

}  // namespace

struct KdTree::Impl {
  explicit Impl(std::vector<Eigen::Vector3f> points)
      : adaptor{std::move(points)},
        index(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {}
  PointsAdaptor adaptor;
  Index index;
};

KdTree::KdTree(std::vector<Eigen::Vector3f> points)
    : impl_(std::make_unique<Impl>(std::move(points))) {}
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;
KdTree::~KdTree() = default;

std::size_t KdTree::size() const { return impl_->adaptor.points.size(); }
const std::vector<Eigen::Vector3f>& KdTree::points() const { return impl_->adaptor.points; }

std::optional<Neighbour> KdTree::nearest(const Eigen::Vector3f& p, double max_distance_m) const {
  if (size() == 0) return std::nullopt;
  Neighbour found;
  nanoflann::KNNResultSet<float> closest(1);
  closest.init(&found.index, &found.distance2_m2);
  // What is farther is not searched; a little more than asked for, as nodes' distances are rounded.
  found.distance2_m2 = static_cast<float>(1.001 * max_distance_m * max_distance_m);
  impl_->index.findNeighbors(closest, p.data(), {});
  if (found.distance2_m2 > max_distance_m * max_distance_m) return std::nullopt;
  return found;
}

std::vector<Neighbour> KdTree::nearest_k(const Eigen::Vector3f& p, std::size_t count) const {
  count = std::min(count, size());
  if (count == 0) return {};
  std::vector<std::size_t> indices(count);
  std::vector<float> distances2(count);
  impl_->index.knnSearch(p.data(), count, indices.data(), distances2.data());
  std::vector<Neighbour> found(count);
  for (std::size_t i = 0; i < count; ++i) found[i] = {indices[i], distances2[i]};
  return found;
}

std::vector<Neighbour> KdTree::within(const Eigen::Vector3f& p, double radius_m) const {
  if (size() == 0) return {};
  std::vector<std::pair<std::size_t, float>> matches;
  const auto radius2 = static_cast<float>(radius_m * radius_m);
  impl_->index.radiusSearch(p.data(), radius2, matches, nanoflann::SearchParams(0, 0.0F, false));
  std::vector<Neighbour> found;
  found.reserve(matches.size());
  for (const auto& [index, distance2] : matches) found.push_back({index, distance2});
  std::ranges::sort(found, [](const Neighbour& a, const Neighbour& b) {
    return std::pair(a.distance2_m2, a.index) < std::pair(b.distance2_m2, b.index);
  });
  return found;
}

}  // namespace vantage
