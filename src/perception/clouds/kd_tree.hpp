/// Nearest neighbours in a point cloud.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace vantage {

struct Neighbour {
  std::size_t index = 0;      ///< into the points the tree was built from
  float distance2_m2 = 0.0F;  ///< squared distance
};

/// Keeps a copy of the points, so that it may outlive them.
class KdTree {
 public:
  explicit KdTree(std::vector<Eigen::Vector3f> points);
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;
  ~KdTree();

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] const std::vector<Eigen::Vector3f>& points() const;

  /// The nearest point no farther than `max_distance_m`.
  [[nodiscard]] std::optional<Neighbour> nearest(const Eigen::Vector3f& p,
                                                 double max_distance_m) const;
  /// Up to `count` points, nearest first.
  [[nodiscard]] std::vector<Neighbour> nearest_k(const Eigen::Vector3f& p, std::size_t count) const;
  /// All points nearer than `radius_m`, nearest first, equal distances by index.
  [[nodiscard]] std::vector<Neighbour> within(const Eigen::Vector3f& p, double radius_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vantage
