#include "vantage/models/catalogue/office/office_mjcf.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <string>

#include "tests/models/catalogue/scene_files.hpp"
#include "tests/models/catalogue/shapes/mesh_checks.hpp"
#include "vantage/models/catalogue/office/corridor_plan.hpp"
#include "vantage/models/catalogue/office/office_list.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"

namespace vantage {
namespace {

class OfficeFolder : public testing::TestWithParam<OfficeOptions> {
 protected:
  static std::filesystem::path folder() { return support::kCheckedInScenes / GetParam().name; }
};

TEST_P(OfficeFolder, IsWhatTheToolWrites) {
  const support::TemporaryDirectory directory;
  write_scene(make_office_scene(GetParam()), directory.path());
  support::expect_same_files(directory.path(), folder());
}

TEST_P(OfficeFolder, LoadsWithFurnitureWhereItWasPut) {
  const OfficeScene scene = make_office_scene(GetParam());
  const support::Model model = support::load_mjcf(folder() / "scene.xml");
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->nv, 0);
  EXPECT_LE(model->ngeom, 800);
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()),
                                                               &mj_deleteData);
  mj_kinematics(model.get(), data.get());
  const std::vector<std::string> names = furniture_names(scene);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PlacedItem& placed = scene.furniture[i];
    const int geom = mj_name2id(model.get(), mjOBJ_GEOM, names[i].c_str());
    ASSERT_GE(geom, 0) << names[i];
    const TriangleMesh mesh = make_office_item(placed.item, placed.variant);
    const int solid = mj_name2id(model.get(), mjOBJ_GEOM, (names[i] + "_solid_0").c_str());
    EXPECT_EQ((model->geom_contype[geom] != 0) + (solid >= 0), hangs_on_wall(placed.item) ? 0 : 1)
        << names[i];
    if (solid >= 0) {
      EXPECT_NE(model->geom_contype[solid], 0) << names[i];
      EXPECT_EQ(model->geom_rgba[4 * solid + 3], 0.0F) << names[i] << " is felt, not seen";
    }
    const Outline outline = moved(convex_footprint(mesh), placed.T_world_item);
    const int id = model->geom_dataid[geom];
    double lowest = 1e9;
    for (int v = 0; v < model->mesh_vertnum[id]; ++v) {
      const float* p = model->mesh_vert + 3 * (model->mesh_vertadr[id] + v);
      const mjtNum local[3] = {p[0], p[1], p[2]};
      mjtNum world[3];
      mju_rotVecMat(world, local, data->geom_xmat + 9 * geom);
      mju_addTo3(world, data->geom_xpos + 3 * geom);
      ASSERT_LT(distance_to(outline, {world[0], world[1]}), 1e-3) << names[i];
      lowest = std::min(lowest, world[2]);
    }
    EXPECT_NEAR(lowest, bounds(mesh).min().z(), 1e-4) << names[i];
  }
}

TEST_P(OfficeFolder, HasStartsAndCameras) {
  const FloorPlan plan = floor_plan(GetParam());
  const support::Model model = support::load_mjcf(folder() / "scene.xml");
  ASSERT_NE(model, nullptr);
  ASSERT_EQ(model->nsite, 5);
  for (int i = 0; i < 5; ++i) {
    const Pose2& start = plan.T_world_starts[static_cast<std::size_t>(i)];
    const int site = mj_name2id(model.get(), mjOBJ_SITE, ("start_" + std::to_string(i)).c_str());
    ASSERT_GE(site, 0);
    EXPECT_NEAR(model->site_pos[3 * site], start.x_m, 1e-9);
    EXPECT_NEAR(model->site_pos[3 * site + 1], start.y_m, 1e-9);
    const mjtNum* quat = model->site_quat + 4 * site;
    EXPECT_NEAR(std::remainder(2.0 * std::atan2(quat[3], quat[0]) - start.yaw_rad, 2.0 * M_PI), 0.0,
                1e-6);
    EXPECT_EQ(model->site_group[site], 4);
  }
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_CAMERA, "overview"), 0);
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_CAMERA, "top"), 0);
}

std::vector<OfficeOptions> all_offices() {
  std::vector<OfficeOptions> all = office_scenes();
  for (const OfficeOptions& options : door_scenes()) all.push_back(options);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scenes, OfficeFolder,
                         testing::ValuesIn(support::some_of(all_offices(), 5)),
                         [](const auto& info) { return info.param.name; });

class CorridorFolder : public testing::TestWithParam<CorridorOptions> {};

TEST_P(CorridorFolder, IsWhatTheToolWrites) {
  const support::TemporaryDirectory directory;
  write_scene(make_corridor_scene(GetParam()), directory.path());
  support::expect_same_files(directory.path(), support::kCheckedInScenes / GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(Scenes, CorridorFolder, testing::ValuesIn(corridor_scenes()),
                         [](const auto& info) { return info.param.name; });

/// MuJoCo refuses meshes whose parts share an edge the wrong way round.
TEST(OfficeFurniture, EveryVariantIsValidAndCompiles) {
  const support::TemporaryDirectory directory;
  OfficeScene scene{"all", 1, 1, small_office(), {}};
  for (int i = 0; i <= static_cast<int>(OfficeItem::poster); ++i) {
    for (int variant = 0; variant < kVariants; ++variant) {
      const auto item = static_cast<OfficeItem>(i);
      SCOPED_TRACE(std::string(item_name(item)) + " " + std::to_string(variant));
      const TriangleMesh mesh = make_office_item(item, variant);
      support::expect_valid(mesh);
      EXPECT_LT(support::share_shaded_inside_out(mesh), 0.03);
      EXPECT_GT(signed_volume_m3(mesh), 1e-4);
      EXPECT_LE(bounds(mesh).max().z(), kWallHeight_m);
      EXPECT_NEAR(bounds(mesh).min().z(), hangs_on_wall(item) ? 0.89 : 0.0, 0.05);
      scene.furniture.push_back({item, variant, {}});
    }
  }
  write_scene(scene, directory.path());
  const support::Model model = support::load_mjcf(directory / "scene.xml");
  ASSERT_NE(model, nullptr);
  for (const PlacedItem& placed : scene.furniture) {
    const std::string mesh =
        std::string(item_name(placed.item)) + "_v" + std::to_string(placed.variant);
    EXPECT_GE(mj_name2id(model.get(), mjOBJ_MESH, mesh.c_str()), 0) << mesh;
  }
}

}  // namespace
}  // namespace vantage
