/// A cubic through places that are passed in order.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace vantage {

/// Catmull-Rom by chord length: C1, through all places but the first and the last, which only say
/// how it begins and ends.  [BarryGoldman1988]
class PathSpline {
 public:
  /// @param places at least four; neighbours may coincide
  explicit PathSpline(std::span<const Eigen::Vector3d> places);

  [[nodiscard]] std::size_t segments() const { return places_.size() - 3; }
  /// Share [0, 1] of the way through a segment; 0 of the first is the second place.
  [[nodiscard]] Eigen::Vector3d at(std::size_t segment, double share) const;
  /// Lengths of the chords between the places it passes.
  [[nodiscard]] double chord_m(std::size_t segment) const {
    return (places_[segment + 2] - places_[segment + 1]).norm();
  }

 private:
  std::vector<Eigen::Vector3d> places_;
  std::vector<Eigen::Vector3d> tangent_;  // of the places that are passed, by chord length
};

}  // namespace vantage
