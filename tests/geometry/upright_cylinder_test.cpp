// Samples of the surface of a cylinder that an eye sees.
#include "vantage/geometry/upright_cylinder.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage {
namespace {

const UprightCylinder kCan{{1.0, -2.0, 0.7}, 0.04, 0.12};

TEST(FacingSamples, LieOnTheSideOfTheEyeAndOnTop) {
  const Eigen::Vector3d eye(2.5, -1.0, 1.6);
  double sum = 0.0;
  double on_top = 0.0;
  for (const SurfaceSample& sample : facing_samples(kCan, eye)) {
    sum += sample.weight;
    EXPECT_TRUE(kCan.contains(sample.p_world_m, 1e-9));
    const Eigen::Vector3d d = sample.p_world_m - kCan.p_foot_m;
    if (d.z() > kCan.height_m - 1e-9) {
      on_top += sample.weight;
      continue;
    }
    EXPECT_NEAR(d.head<2>().norm(), kCan.radius_m, 1e-12);
    EXPECT_GT(d.head<2>().dot((eye - kCan.p_foot_m).head<2>()), 0.0) << "it faces the eye";
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // Seen areas: 2 r h cos(e) of the side, pi r^2 sin(e) of the top.
  const Eigen::Vector3d to = eye - (kCan.p_foot_m + 0.06 * Eigen::Vector3d::UnitZ());
  const double e = std::atan2(to.z(), to.head<2>().norm());
  const double side = 2.0 * 0.04 * 0.12 * std::cos(e);
  const double top = 3.14159265358979 * 0.04 * 0.04 * std::sin(e);
  EXPECT_NEAR(on_top, top / (side + top), 1e-9);
}

TEST(FacingSamples, FromBelowNoTopIsSeen) {
  for (const SurfaceSample& sample : facing_samples(kCan, {3.0, -2.0, 0.2})) {
    EXPECT_LT(sample.p_world_m.z(), 0.82);
  }
}

}  // namespace
}  // namespace vantage
