/// A rectangle of a texture: what a builder maps a surface to and a pattern is painted into.
#pragma once

#include <Eigen/Core>

namespace vantage {

/// Texture coordinates, v up; [0, 1] x [0, 1] is the whole image.
struct UvRect {
  double u0 = 0.0;
  double v0 = 0.0;
  double u1 = 1.0;
  double v1 = 1.0;

  /// The point at fractions (s, t) of width and height.
  [[nodiscard]] Eigen::Vector2d at(double s, double t) const {
    return {u0 + s * (u1 - u0), v0 + t * (v1 - v0)};
  }
};

/// The part of `rect` between two corners given as fractions of it.
inline UvRect part_of(const UvRect& rect, double s0, double t0, double s1, double t1) {
  const Eigen::Vector2d low = rect.at(s0, t0);
  const Eigen::Vector2d high = rect.at(s1, t1);
  return {low.x(), low.y(), high.x(), high.y()};
}

/// `rect` without a margin on all sides, so that filtering does not reach its neighbours.
inline UvRect shrink(const UvRect& rect, double margin) {
  return {rect.u0 + margin, rect.v0 + margin, rect.u1 - margin, rect.v1 - margin};
}

}  // namespace vantage
