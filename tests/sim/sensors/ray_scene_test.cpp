#include "vantage/sim/sensors/ray_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>
#include <vector>

#include "tests/sim/sensors/sensor_scene.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

struct Ray {
  Eigen::Vector3d p;
  Eigen::Vector3d d;
};

Eigen::Vector3d random_direction(Rng& rng) {
  return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
}

/// From a shell round the scene, above the floor, towards somewhere in it.
Ray random_ray(Rng& rng) {
  Eigen::Vector3d p = 4.0 * random_direction(rng);
  p.z() = std::abs(p.z()) + 0.01;
  const Eigen::Vector3d target(rng.uniform(-1.8, 1.8), rng.uniform(-1.8, 1.8),
                               rng.uniform(0.0, 1.5));
  return {p, (target - p).normalized()};
}

struct Reference {
  double distance;
  int geom;
};

Reference mujoco_ray(const test::MjcfModel& scene, const Ray& ray, int exclude_body = -1) {
  int geom = -1;
  const double distance = mj_ray(scene.model.get(), scene.data.get(), ray.p.data(), ray.d.data(),
                                 nullptr, 1, exclude_body, &geom);
  return {distance, geom};
}

/// A ray whose neighbours a micrometre and a half to the sides meet the same geom at about the same
/// distance: away from edges, where an error in the last float digit decides what is hit.
bool is_robust(const test::MjcfModel& scene, const Ray& ray, const Reference& reference) {
  const Eigen::Vector3d side = ray.d.unitOrthogonal();
  for (const Eigen::Vector3d& offset : {side, Eigen::Vector3d(ray.d.cross(side))}) {
    for (const double step : {-1.5e-6, 1.5e-6}) {
      const Reference near = mujoco_ray(scene, {ray.p + step * offset, ray.d});
      if (near.geom != reference.geom || std::abs(near.distance - reference.distance) > 1e-4) {
        return false;
      }
    }
  }
  return true;
}

void expect_agreement(const test::MjcfModel& scene, const RayScene& rays, int count,
                      std::uint64_t seed) {
  Rng rng(seed);
  std::set<int> seen;
  int fragile = 0;
  for (int i = 0; i < count; ++i) {
    const Ray ray = random_ray(rng);
    const Reference expected = mujoco_ray(scene, ray);
    const RayHit hit = rays.cast(ray.p, ray.d, 1e3);
    seen.insert(hit.geom_id);
    if (expected.geom == hit.geom_id &&
        (!hit.hit() || std::abs(hit.distance_m - expected.distance) < 1e-6)) {
      continue;
    }
    ++fragile;
    ASSERT_FALSE(is_robust(scene, ray, expected))
        << "ray " << i << ": geom " << hit.geom_id << " at " << hit.distance_m << ", mj_ray "
        << expected.geom << " at " << expected.distance;
  }
  EXPECT_LE(fragile, count / 1000);
  for (const char* name : {"floor", "tile", "box", "sphere", "capsule", "cylinder", "ellipsoid",
                           "hills", "mesh", "shell", "arm_mesh", "lamp"}) {
    EXPECT_TRUE(seen.contains(scene.geom(name))) << name;
  }
}

TEST(RayScene, AgreesWithMujocoOnEveryKindOfGeom) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  expect_agreement(scene, rays, 10000, 1);
}

TEST(RayScene, UpdateFollowsMovingBodies) {
  const auto scene = test::sensor_scene();
  RayScene rays(*scene.model, *scene.data);
  const std::vector<double> moved{-0.4, 0.5, 1.4, 0.8, 0.3, -0.4, 0.3, 0.7};
  std::copy(moved.begin(), moved.end(), scene.data->qpos);
  mj_forward(scene.model.get(), scene.data.get());
  rays.update(*scene.data);
  expect_agreement(scene, rays, 10000, 2);
}

TEST(RayScene, AgreesFromInsideTheScene) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(3);
  for (int i = 0; i < 3000; ++i) {
    const Ray ray{{0.1, 0.2, 0.75}, random_direction(rng)};
    const Reference expected = mujoco_ray(scene, ray);
    if (!is_robust(scene, ray, expected)) continue;
    const RayHit hit = rays.cast(ray.p, ray.d, 1e3);
    ASSERT_EQ(hit.geom_id, expected.geom) << i;
    if (hit.hit()) {
      ASSERT_NEAR(hit.distance_m, expected.distance, 1e-6) << i;
    }
  }
}

TEST(RayScene, ExcludesTheSensorsBody) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  const int base = scene.body("robot/base");
  const Ray down{{0.0, 0.0, 1.2}, {0.0, 0.0, -1.0}};
  EXPECT_EQ(rays.cast(down.p, down.d, 10.0).geom_id, scene.geom("shell"));
  const RayHit hit = rays.cast(down.p, down.d, 10.0, base);
  EXPECT_EQ(hit.geom_id, scene.geom("lamp"));
  EXPECT_NEAR(hit.distance_m, 0.8, 1e-9);
}

TEST(RayScene, RangeEndsWhereItIsToldTo) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  const Eigen::Vector3d p(0.0, -3.0, 0.3);
  const Eigen::Vector3d up(0.0, 0.0, -1.0);
  EXPECT_TRUE(rays.cast(p, up, 0.3000001).hit());
  EXPECT_FALSE(rays.cast(p, up, 0.2999999).hit());
  EXPECT_FALSE(rays.cast(p, -up, 1e9).hit());
  EXPECT_TRUE(std::isinf(rays.cast(p, -up, 1e9).distance_m));
}

TEST(RayScene, FilterLeavesOutTheRobotWithAllItsBodies) {
  const auto scene = test::sensor_scene();
  const auto all = solid_geoms(*scene.model);
  const auto rest = solid_geoms(*scene.model, {.exclude_body_prefix = "robot/"});
  EXPECT_EQ(all.size(), rest.size() + 2);
  const RayScene rays(*scene.model, *scene.data, {.exclude_body_prefix = "robot/"});
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_ray(rng);
    const int hit = rays.cast(ray.p, ray.d, 1e3).geom_id;
    ASSERT_NE(hit, scene.geom("shell"));
    ASSERT_NE(hit, scene.geom("arm_mesh"));
  }
}

TEST(RayScene, FilterByGroup) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom name="hull" type="sphere" size="0.2" group="3"/>
      <geom name="visual" type="sphere" size="0.1" group="2"/>
    </worldbody></mujoco>)");
  const Eigen::Vector3d p(-1.0, 0.0, 0.0);
  const Eigen::Vector3d d(1.0, 0.0, 0.0);
  EXPECT_NEAR(RayScene(*scene.model, *scene.data).cast(p, d, 9.0).distance_m, 0.8, 1e-12);
  EXPECT_NEAR(RayScene(*scene.model, *scene.data, {.max_group = 2}).cast(p, d, 9.0).distance_m, 0.9,
              1e-12);
}

TEST(RayScene, OfTwoGeomsAtTheSameDistanceTheFirst) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom type="box" size="0.1 0.5 0.5"/>
      <geom type="box" size="0.1 0.2 0.2"/>
      <geom type="box" size="0.1 0.4 0.1"/>
    </worldbody></mujoco>)");
  const RayScene rays(*scene.model, *scene.data);
  EXPECT_EQ(rays.cast({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 9.0).geom_id, 0);
  EXPECT_EQ(rays.cast({1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, 9.0).geom_id, 0);
}

TEST(RayScene, MocapBodiesMove) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <body mocap="true"><geom type="sphere" size="0.1"/></body>
    </worldbody></mujoco>)");
  RayScene rays(*scene.model, *scene.data);
  scene.data->mocap_pos[0] = 0.5;
  mj_forward(scene.model.get(), scene.data.get());
  rays.update(*scene.data);
  EXPECT_NEAR(rays.cast({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 9.0).distance_m, 1.4, 1e-12);
}

TEST(RayScene, EmptySceneHasNoHits) {
  const auto scene = test::compile_mjcf("<mujoco><worldbody/></mujoco>");
  RayScene rays(*scene.model, *scene.data);
  EXPECT_FALSE(rays.cast({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 9.0).hit());
}

TEST(RayScene, ThreadsCastTheSameBits) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  const auto sweep = [&](std::vector<double>& distances) {
    Rng rng(5);
    for (int i = 0; i < 5000; ++i) {
      const Ray ray = random_ray(rng);
      distances.push_back(rays.cast(ray.p, ray.d, 1e3).distance_m);
    }
  };
  std::vector<double> first;
  std::vector<double> second;
  std::thread other(sweep, std::ref(second));
  sweep(first);
  other.join();
  EXPECT_EQ(first, second);
}

TEST(RayScene, AgreesBesideAndInsideAMesh) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  const int mesh = scene.geom("mesh");
  const Eigen::Vector3d middle_m(1.2, -1.2, 0.5);
  Rng rng(6);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray{middle_m + rng.uniform(0.0, 0.45) * random_direction(rng), random_direction(rng)};
    const Reference expected = mujoco_ray(scene, ray);
    if (!is_robust(scene, ray, expected)) continue;
    const RayHit hit = rays.cast(ray.p, ray.d, 1e3);
    ASSERT_EQ(hit.geom_id, expected.geom) << i;
    if (hit.geom_id != mesh) continue;
    ASSERT_NEAR(hit.distance_m, expected.distance, 1e-6) << i;
    ASSERT_EQ(rays.cast(ray.p, ray.d, hit.distance_m + 1e-6).geom_id, mesh) << i;
    ASSERT_FALSE(rays.cast(ray.p, ray.d, hit.distance_m - 1e-6).hit()) << i;
    ++met;
  }
  EXPECT_GT(met, 1000);
}

/// The floor, and a box whose upper side lies in it.
TEST(RayScene, ReachesUpToItsRangeAndNoFartherAndOfTwoMeetsTheFirst) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/>"
      "<geom type='box' size='.5 .5 .5' pos='0 0 -.5'/></worldbody></mujoco>");
  const RayScene rays(*scene.model, *scene.data);
  const Eigen::Vector3d eye(0.0, 0.0, 1.0);
  const Eigen::Vector3d down(0.0, 0.0, -1.0);
  const RayHit hit = rays.cast(eye, down, 1.0);
  EXPECT_EQ(hit.geom_id, 0);
  EXPECT_EQ(hit.distance_m, 1.0);
  EXPECT_FALSE(rays.cast(eye, down, std::nextafter(1.0, 0.0)).hit());
}

TEST(RayScene, BlocksWhatItWouldMeetWhateverBlockedBefore) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  const int body = scene.body("arm");
  Rng rng(8);
  int blocker_id = -1;
  int blocked = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = random_ray(rng);
    const double range_m = rng.uniform(2.0, 8.0);
    const int excluded = i % 2 == 0 ? body : -1;
    const bool expected = rays.cast(ray.p, ray.d, range_m, excluded).hit();
    ASSERT_EQ(rays.blocks(ray.p, ray.d, range_m, excluded, blocker_id), expected) << i;
    if (!expected) continue;
    ++blocked;
    ASSERT_GE(blocker_id, 0);
    ASSERT_TRUE(rays.blocks(ray.p, ray.d, range_m, excluded, blocker_id)) << i;
  }
  EXPECT_GT(blocked, 5000);
  EXPECT_LT(blocked, 15000);
}

TEST(RayScene, PlanesThatAreMovedByHandMove) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><body mocap='true'><geom type='plane' size='9 9 .1'/></body>"
      "</worldbody></mujoco>");
  RayScene rays(*scene.model, *scene.data);
  scene.data->mocap_pos[2] = 0.5;
  mj_forward(scene.model.get(), scene.data.get());
  rays.update(*scene.data);
  EXPECT_NEAR(rays.cast({0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}, 9.0).distance_m, 1.5, 1e-12);
}

TEST(RayScene, AFixedThingIsSeenWhereItIsTurnedTo) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><body name='beam'><geom type='box' size='1 .1 .1'/></body>"
      "</worldbody></mujoco>");
  RayScene rays(*scene.model, *scene.data);
  const Eigen::Vector3d eye(-2.0, 0.8, 0.0);
  EXPECT_FALSE(rays.cast(eye, Eigen::Vector3d::UnitX(), 9.0).hit());
  mjtNum* quat = scene.model->body_quat + 4 * scene.body("beam");
  quat[0] = quat[3] = std::sqrt(0.5);  // a quarter of a turn about z
  mj_forward(scene.model.get(), scene.data.get());
  rays.update(*scene.data);
  EXPECT_NEAR(rays.cast(eye, Eigen::Vector3d::UnitX(), 9.0).distance_m, 1.9, 1e-9);
}

TEST(RayScene, ALargeMeshIsSeenFromWithinAndFromWithout) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset><mesh name='hall' vertex='-3 -3 -3  3 -3 -3  3 3 -3  -3 3 -3  -3 -3 3  3 -3 3"
      "  3 3 3  -3 3 3' face='0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 "
      "4 7'/></asset><worldbody><geom type='mesh' mesh='hall'/></worldbody></mujoco>");
  const RayScene rays(*scene.model, *scene.data);
  for (const double x_m : {-2.5, 0.0, 2.5}) {
    const Eigen::Vector3d eye(x_m, 0.3, -0.2);
    EXPECT_NEAR(rays.cast(eye, Eigen::Vector3d::UnitX(), 99.0).distance_m, 3.0 - x_m, 1e-5);
    EXPECT_NEAR(rays.cast(eye, -Eigen::Vector3d::UnitX(), 99.0).distance_m, 3.0 + x_m, 1e-5);
  }
  EXPECT_NEAR(rays.cast({-9.0, 0.3, -0.2}, Eigen::Vector3d::UnitX(), 99.0).distance_m, 6.0, 1e-5);
}

/// A block of 1.2 m x 0.8 m, from 0.1 m below its place to 0.25 m above it.
TEST(RayScene, AHeightFieldIsClosedAllRound) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset><hfield name='h' nrow='3' ncol='4' size='.6 .4 .5 .1'/></asset>"
      "<worldbody><geom type='hfield' hfield='h'/></worldbody></mujoco>");
  std::fill_n(scene.model->hfield_data, 12, 0.5F);
  const RayScene rays(*scene.model, *scene.data);
  const auto distance_m = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
    return rays.cast(from, along, 99.0).distance_m;
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  for (const double a : {-0.55, -0.23, 0.13, 0.41}) {
    for (const double b : {-0.33, -0.07, 0.21, 0.37}) {
      EXPECT_NEAR(distance_m({a, b, -5.0}, z), 4.9, 1e-6) << a << " " << b;
      EXPECT_NEAR(distance_m({a, b, 5.0}, -z), 4.75, 1e-6) << a << " " << b;
    }
  }
  for (const double height_m : {-0.07, 0.03, 0.19}) {
    for (const double b : {-0.33, -0.07, 0.21, 0.37}) {
      EXPECT_NEAR(distance_m({-5.0, b, height_m}, x), 4.4, 1e-6) << b << " " << height_m;
      EXPECT_NEAR(distance_m({5.0, b, height_m}, -x), 4.4, 1e-6) << b << " " << height_m;
    }
    for (const double a : {-0.55, -0.23, 0.13, 0.41}) {
      EXPECT_NEAR(distance_m({a, -5.0, height_m}, y), 4.6, 1e-6) << a << " " << height_m;
      EXPECT_NEAR(distance_m({a, 5.0, height_m}, -y), 4.6, 1e-6) << a << " " << height_m;
    }
  }
}

}  // namespace
}  // namespace vantage
