#include "vantage/sim/world/collision_surfaces.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>

#include "tests/sim/test_world.hpp"

namespace vantage {
namespace {

/// Cubes of 20 cm, a slope, and a cube that touches nothing.
const char* const kCubes =
    "<mujoco><worldbody><geom type='plane' size='9 9 .1' pos='0 0 -2' euler='0 30 0'/>"
    "<geom type='box' size='.1 .1 .1' pos='3 -2 1'/>"
    "<geom type='box' size='.2 .2 .2' pos='-3 0 1' contype='0' conaffinity='0'/>"
    "<body name='robot/base' pos='0 0 1'><freejoint/>"
    "<geom name='trunk' type='box' size='.1 .1 .1' contype='0'/>"
    "<body name='arm' pos='.5 0 0'><joint type='hinge'/>"
    "<geom name='hand' type='box' size='.1 .1 .1' conaffinity='0'/></body></body>"
    "</worldbody></mujoco>";

/// Points of a lattice of n x n x n that lie on its outside.
std::size_t shell(std::size_t n) { return n * n * n - (n - 2) * (n - 2) * (n - 2); }

TEST(CollisionSurfaces, AreLatticesAsFineAsAsked) {
  const test::SceneFolder folder(kCubes);
  const World world(folder.alone());
  // The longest edge of a triangle, 0.2 m times the root of 2, in 10, 3 and 6 parts.
  const CollisionSurfaces fine = collision_surfaces(world);
  EXPECT_EQ(fine.robot.size(), 2 * shell(11));
  EXPECT_EQ(fine.scene_world_m.size(), shell(11));
  const CollisionSurfaces coarse = collision_surfaces(world, {.robot_m = 0.1, .scene_m = 0.05});
  EXPECT_EQ(coarse.robot.size(), 2 * shell(4));
  EXPECT_EQ(coarse.scene_world_m.size(), shell(7));
}

TEST(CollisionSurfaces, LieOnWhatMayCollide) {
  const test::SceneFolder folder(kCubes);
  const World world(folder.alone());
  const CollisionSurfaces surfaces = collision_surfaces(world);
  std::map<int, std::size_t> points_of;
  for (const SurfacePoint& point : surfaces.robot) {
    EXPECT_NEAR(point.p_geom_m.cwiseAbs().maxCoeff(), 0.1, 1e-12);
    ++points_of[point.geom_id];
  }
  EXPECT_EQ(points_of.size(), 2U);
  for (const char* name : {"trunk", "hand"}) {
    EXPECT_EQ(points_of[model_id(world.model(), ModelObject::geom, name)], shell(11)) << name;
  }
  for (const Eigen::Vector3f& p : surfaces.scene_world_m) {
    const Eigen::Vector3f off = p - Eigen::Vector3f(3.0F, -2.0F, 1.0F);
    EXPECT_NEAR(off.cwiseAbs().maxCoeff(), 0.1F, 1e-6F);
  }
  ASSERT_EQ(surfaces.planes.size(), 1U);
  EXPECT_LT((surfaces.planes[0].p_world_m - Eigen::Vector3d(0.0, 0.0, -2.0)).norm(), 1e-12);
  EXPECT_LT((surfaces.planes[0].normal - Eigen::Vector3d(0.5, 0.0, std::sqrt(0.75))).norm(), 1e-9);
}

std::size_t points_on_box(const std::string& half, double spacing_m) {
  const test::SceneFolder folder("<mujoco><worldbody><geom type='box' size='" + half +
                                 "'/></worldbody></mujoco>");
  const World world(folder.alone());
  return collision_surfaces(world, {.robot_m = spacing_m, .scene_m = spacing_m})
      .scene_world_m.size();
}

/// Plates of 20 cm, with 16 points on each of two sides and 12 round the middle between them.
TEST(CollisionSurfaces, OfPointsATenthOfTheSpacingApartOneIsKept) {
  EXPECT_EQ(points_on_box(".1 .1 .008", 0.1), 16U + 16U + 12U);
  EXPECT_EQ(points_on_box(".1 .1 .004", 0.1), 16U);
}

TEST(CollisionSurfaces, OfWhatIsSmallerThanTheSpacingAreCorners) {
  EXPECT_EQ(points_on_box(".1 .1 .1", 1.0), 8U);
}

}  // namespace
}  // namespace vantage
