/// Viewpoint feature histogram.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/perception/features/kit/feature_result.hpp"
#include "vantage/perception/features/kit/state_bytes.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// Distances from the centroid in the histogram's fourth block.
enum class VfhSizes {
  none,      ///< the block is zero, so that objects of one shape are alike
  metres,    ///< bins of 1 cm
  relative,  ///< bins of 1/45 of the greatest distance
};

/// 308 bins [RusuEtAl2010]: three angles between each point's normal and the mean normal at the
/// centroid (45 each), distance from the centroid (45), angle between normals and line of sight
/// (128). Increments as PCL has them: 100 / (N - 1) for pairs with the centroid, 100 / N for lines
/// of sight. Unlike PCL, which divides both by sqrt(length^2 + 1), the line of sight has unit
/// length and relative distances their greatest for a unit.
/// @param cloud with normals, not empty; points with a zero normal are left out
Eigen::VectorXf viewpoint_feature_histogram(const PointCloud& cloud,
                                            const Eigen::Vector3d& p_viewpoint, VfhSizes sizes);

/// The histogram of a view's surface as shares, square-rooted.
struct Vfh {
  static constexpr std::string_view name = "vfh";
  static constexpr StrategyText text{
      .summary =
          "Viewpoint feature histogram of the visible surface: shape and the direction it is seen "
          "from, in 308 bins.",
      .formula =
          "sqrt of the shares of 3 x 45 angles to the mean normal, 45 distances from the centroid, "
          "128 angles to the line of sight",
      .source = "RusuEtAl2010"};
  double normal_radius_m = 0.01;
  bool size_block = false;
  int min_points = 32;
  void fields(auto&& f) {
    f("normal_radius_m", normal_radius_m,
      "radius of the neighbourhood of a surface normal; higher is smoother", above(0.0));
    f("size_block", size_block,
      "true: distances of the points from the centroid count too, in bins of 1 cm, so that sizes "
      "differ");
    f("min_points", min_points,
      "least number of points with a normal, below which the feature is skipped; higher is more "
      "careful",
      at_least(3));
  }

  [[nodiscard]] Vfh train(std::span<const ObjectView>, Rng&) const { return *this; }
  [[nodiscard]] int dimension() const { return 308; }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const { put_options(bytes, *this); }
  static Vfh take_state(ByteReader& reader) { return take_options<Vfh>(reader); }
};

}  // namespace vantage
