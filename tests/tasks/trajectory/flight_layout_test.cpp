// What the scenes to fly through publish, and the objects that are drawn into them.
#include "vantage/tasks/trajectory/flight_layout.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/trajectory/supports_ground_truth.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

fs::path scene_file(const std::string& name) {
  return fs::path(VANTAGE_SOURCE_DIR) / "models/scenes" / name / "scene.xml";
}

TEST(FlightLayout, HasThePathAndTheStands) {
  const std::vector<FlightWaypoint> path = read_flight_path(scene_file("trajectory_3"));
  const auto supports_m = read_support_surfaces(scene_file("trajectory_3"));
  EXPECT_EQ(path.size(), 56U);
  EXPECT_EQ(supports_m.size(), 10U);
  EXPECT_NEAR(path[0].p_world_m.z(), 1.8, 1e-9);
  EXPECT_NEAR(path[0].yaw_rad, 0.0, 1e-3);
  EXPECT_NEAR((supports_m[0] - Eigen::Vector3d(-2.6, -2.75, 0.8)).norm(), 0.0, 1e-4);
}

TEST(FlightLayout, SaysWhichFileIsMissingOrWrong) {
  const support::TemporaryDirectory folder;
  const fs::path scene = folder.path() / "scene.xml";
  const auto message = [&] {
    try {
      read_flight_path(scene);
      read_support_surfaces(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(), testing::HasSubstr("path.csv"));
  write_file(folder.path() / "path.csv", "x_m,y_m,z_m,yaw_rad\n0,0,1.8,0\n");
  EXPECT_THAT(message(), testing::HasSubstr("two waypoints"));
  write_file(folder.path() / "path.csv", "x_m,y_m,z_m,yaw_rad\n0,0,1.8,0\n1,0,1.8,0\n");
  EXPECT_THAT(message(), testing::HasSubstr("stands.csv"));
  write_file(folder.path() / "stands.csv", "x_m,y_m,z_m,yaw_rad\n0,zero,1,0\n");
  EXPECT_THAT(message(), testing::HasSubstr("zero"));
}

TEST(FlightLayout, TheRegionHoldsThePathWithRoomAroundIt) {
  const std::vector<FlightWaypoint> path{{{1.0, 2.0, 1.8}, 0.0}, {{4.0, -1.0, 1.6}, 0.0}};
  const Eigen::AlignedBox3d region = flight_region(path, 2.0, 0.5);
  EXPECT_NEAR((region.min() - Eigen::Vector3d(-1.0, -3.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((region.max() - Eigen::Vector3d(6.0, 4.0, 2.3)).norm(), 0.0, 1e-12);
}

TEST(FlightLayout, TheRegionIsWideAndNotMuchHigherThanThePath) {
  const std::vector<FlightWaypoint> path{{{1.0, 2.0, 1.8}, 0.0}, {{4.0, -1.0, 1.6}, 0.0}};
  const Eigen::AlignedBox3d region = flight_region(path);
  EXPECT_NEAR((region.min() - Eigen::Vector3d(-2.0, -4.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((region.max() - Eigen::Vector3d(7.0, 5.0, 2.6)).norm(), 0.0, 1e-12);
}

const std::vector<Eigen::Vector3d> kSupports{{0.0, 0.0, 0.8}, {2.0, 0.0, 0.7}, {0.0, 2.0, 0.9}};

TEST(ObjectsOnSupports, ADrawIsItsSeeds) {
  const auto a = draw_objects({}, kSupports, 0.02, 7);
  const auto b = draw_objects({}, kSupports, 0.02, 7);
  const auto c = draw_objects({}, kSupports, 0.02, 8);
  ASSERT_EQ(a.size(), kSupports.size());
  int same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].object, b[i].object);
    EXPECT_EQ(a[i].yaw_rad, b[i].yaw_rad);
    EXPECT_EQ(a[i].p_world_m, b[i].p_world_m);
    EXPECT_NE(a[i].yaw_rad, c[i].yaw_rad);
    same += a[i].object == c[i].object ? 1 : 0;
    const Eigen::Vector3d off_m = a[i].p_world_m - kSupports[i];
    EXPECT_LE(off_m.norm(), 0.02);
    EXPECT_EQ(off_m.z(), 0.0);
  }
  EXPECT_LT(same, 3);
}

TEST(ObjectsOnSupports, AllDifferAndAllAreDrawnInTime) {
  ObjectDatabaseOptions small;
  small.objects = 6;
  std::set<std::string> drawn;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::set<std::string> now;
    for (const ObjectOnSupport& object : draw_objects(small, kSupports, 0.02, seed)) {
      now.insert(object.object);
    }
    EXPECT_EQ(now.size(), kSupports.size()) << "seed " << seed;
    drawn.merge(now);
  }
  EXPECT_EQ(drawn.size(), 6U);
  small.objects = 2;
  EXPECT_THROW(draw_objects(small, kSupports, 0.02, 1), ConfigError);
}

TEST(ObjectsOnSupports, StandInTheCompiledScene) {
  const fs::path scene = scene_file("trajectory_4");
  const auto objects = draw_objects({}, read_support_surfaces(scene), 0.02, 3);
  const World world({scene, {}, object_files({}, objects)}, {});
  const mjModel& model = world.model();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string name = "object_" + std::to_string(i);
    const int body = model_id(model, ModelObject::body, name);
    const int geom = model_id(model, ModelObject::geom, name);
    EXPECT_NEAR(model.body_pos[3 * body], objects[i].p_world_m.x(), 1e-5);
    EXPECT_NEAR(model.body_pos[3 * body + 2], objects[i].p_world_m.z(), 1e-5);
    EXPECT_EQ(model.geom_type[geom], mjGEOM_MESH);
    EXPECT_GE(model.geom_matid[geom], 0);
    double lowest_m = 1e9;
    const mjData& now = world.snapshot();
    const int mesh = model.geom_dataid[geom];
    for (int v = 0; v < model.mesh_vertnum[mesh]; ++v) {
      const float* p = model.mesh_vert + 3 * (model.mesh_vertadr[mesh] + v);
      const mjtNum* up = now.geom_xmat + 9 * geom + 6;
      const double z = up[0] * p[0] + up[1] * p[1] + up[2] * p[2] + now.geom_xpos[3 * geom + 2];
      lowest_m = std::min(lowest_m, z);
    }
    EXPECT_NEAR(lowest_m, objects[i].p_world_m.z(), 1e-3) << objects[i].object;
  }
}

/// As flights that were recorded have them: heading and distance of one after the other.
TEST(ObjectsOnSupports, StandWhereTheirSeedPutsThem) {
  const auto objects = draw_objects({}, kSupports, 0.02, 7);
  Rng place = Rng::stream(7, "object places");
  for (std::size_t i = 0; i < kSupports.size(); ++i) {
    const double heading_rad = place.uniform(0.0, 2.0 * std::numbers::pi);
    const double distance_m = 0.02 * std::sqrt(place.uniform());
    const Eigen::Vector3d off_m(distance_m * std::cos(heading_rad),
                                distance_m * std::sin(heading_rad), 0.0);
    EXPECT_NEAR((objects[i].p_world_m - kSupports[i] - off_m).norm(), 0.0, 1e-12) << i;
  }
}

TEST(ObjectsOnSupports, AreFollowedToWhereTheyArePut) {
  const fs::path scene = scene_file("trajectory_4");
  const auto drawn = draw_objects({}, read_support_surfaces(scene), 0.02, 3);
  World world({scene, {}, object_files({}, drawn)}, {});
  const Eigen::Vector3d by_m(0.1, -0.2, 0.05);
  world.put_fixed_body(model_id(world.model(), ModelObject::body, "object_1"),
                       drawn[1].p_world_m + by_m);
  std::vector<ObjectOnSupport> objects = drawn;
  follow_moved(world, objects);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Eigen::Vector3d moved_m = objects[i].p_world_m - drawn[i].p_world_m;
    EXPECT_NEAR((moved_m - (i == 1 ? 1.0 : 0.0) * by_m).norm(), 0.0, 1e-4) << i;
  }
}

TEST(ObjectsOnSupports, MayBeAllThatThereAre) {
  ObjectDatabaseOptions three;
  three.objects = 3;
  std::set<std::string> drawn;
  for (const ObjectOnSupport& object : draw_objects(three, kSupports, 0.02, 5)) {
    drawn.insert(object.object);
    EXPECT_TRUE(object.object.starts_with(object.category)) << object.object;
    EXPECT_LT(object.category.size(), object.object.size());
  }
  EXPECT_EQ(drawn.size(), 3U);
}

TEST(ObjectsOnSupports, FaceWhereTheirSeedTurnsThem) {
  Rng yaw = Rng::stream(7, "object yaws");
  for (const ObjectOnSupport& object : draw_objects({}, kSupports, 0.02, 7)) {
    EXPECT_NEAR(object.yaw_rad, yaw.uniform(0.0, 2.0 * std::numbers::pi), 1e-12);
  }
}

TEST(ObjectsOnSupports, AreTurnedInTheCompiledScene) {
  const fs::path scene = scene_file("trajectory_4");
  const auto objects = draw_objects({}, read_support_surfaces(scene), 0.02, 3);
  const auto files = object_files({}, objects);
  EXPECT_EQ(files.size(), 1 + 2 * objects.size());
  const World world({scene, {}, files}, {});
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const int body = model_id(world.model(), ModelObject::body, "object_" + std::to_string(i));
    const mjtNum* turn = world.model().body_quat + 4 * body;
    const double yaw_rad = 2.0 * std::atan2(turn[3], turn[0]);
    EXPECT_NEAR(std::remainder(yaw_rad - objects[i].yaw_rad, 2.0 * std::numbers::pi), 0.0, 1e-6);
    EXPECT_NEAR(world.model().body_pos[3 * body + 1], objects[i].p_world_m.y(), 1e-5);
  }
}

}  // namespace
}  // namespace vantage
