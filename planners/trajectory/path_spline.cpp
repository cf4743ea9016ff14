#include "planners/trajectory/path_spline.hpp"

#include "src/core/error.hpp"

namespace vantage {

PathSpline::PathSpline(std::span<const Eigen::Vector3d> places)
    : places_(places.begin(), places.end()) {
  expects(places.size() >= 4, "a spline passes two places, between two others");
  for (std::size_t i = 1; i + 1 < places_.size(); ++i) {
    const double chords =
        (places_[i] - places_[i - 1]).norm() + (places_[i + 1] - places_[i]).norm();
    tangent_.push_back(chords > 0.0 ? Eigen::Vector3d((places_[i + 1] - places_[i - 1]) / chords)
                                    : Eigen::Vector3d::Zero());
  }
}

Eigen::Vector3d PathSpline::at(std::size_t segment, double share) const {
  const double u = share;
  const double v = 1.0 - share;
  const double chord = chord_m(segment);
  return v * v * (1.0 + 2.0 * u) * places_[segment + 1] +
         u * u * (3.0 - 2.0 * u) * places_[segment + 2] +
         chord * (u * v * v * tangent_[segment] - u * u * v * tangent_[segment + 1]);
}

}  // namespace vantage
