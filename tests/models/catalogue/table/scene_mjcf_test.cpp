#include "vantage/models/catalogue/table/scene_mjcf.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "tests/models/catalogue/scene_files.hpp"
#include "vantage/core/hash.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

using support::files_below;
using support::kCheckedInScenes;
using support::Model;

class SceneFolder : public testing::TestWithParam<TableSceneOptions> {
 protected:
  static fs::path folder() { return kCheckedInScenes / GetParam().name; }
};

TEST_P(SceneFolder, IsWhatTheToolWrites) {
  const support::TemporaryDirectory directory;
  write_scene(make_table_scene(GetParam()), directory.path());
  support::expect_same_files(directory.path(), folder());
}

TEST_P(SceneFolder, LoadsWithObjectsWhereTheyWerePut) {
  const TableScene scene = make_table_scene(GetParam());
  const Model model = support::load_mjcf(folder() / "scene.xml");
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->nv, 0);
  EXPECT_DOUBLE_EQ(model->stat.extent, 1.0);
  for (const PlacedObject& placed : scene.objects) {
    const int body = mj_name2id(model.get(), mjOBJ_BODY, placed.spec.name.c_str());
    const int geom = mj_name2id(model.get(), mjOBJ_GEOM, (placed.spec.name + "/mesh").c_str());
    ASSERT_GT(body, 0) << placed.spec.name;
    ASSERT_GE(geom, 0) << placed.spec.name;
    EXPECT_EQ(model->geom_bodyid[geom], body);
    EXPECT_NE(model->geom_contype[geom], 0);
    EXPECT_NEAR(model->body_pos[3 * body], placed.T_world_object.x_m, 1e-5);
    EXPECT_NEAR(model->body_pos[3 * body + 1], placed.T_world_object.y_m, 1e-5);
    EXPECT_NEAR(model->body_pos[3 * body + 2], placed.z_m, 1e-5);
    EXPECT_GE(model->mesh_texcoordadr[model->geom_dataid[geom]], 0);
  }
}

/// MuJoCo moves a mesh to its centre of mass; what is seen must still stand on its support.
TEST_P(SceneFolder, MeshesRestOnWhatCarriesThem) {
  const TableScene scene = make_table_scene(GetParam());
  const Model model = support::load_mjcf(folder() / "scene.xml");
  ASSERT_NE(model, nullptr);
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()),
                                                               &mj_deleteData);
  mj_kinematics(model.get(), data.get());
  for (const PlacedObject& placed : scene.objects) {
    const int geom = mj_name2id(model.get(), mjOBJ_GEOM, (placed.spec.name + "/mesh").c_str());
    const int mesh = model->geom_dataid[geom];
    double lowest = 1e9;
    double highest = -1e9;
    for (int i = 0; i < model->mesh_vertnum[mesh]; ++i) {
      const float* p = model->mesh_vert + 3 * (model->mesh_vertadr[mesh] + i);
      const mjtNum* z_row = data->geom_xmat + 9 * geom + 6;
      const double z =
          data->geom_xpos[3 * geom + 2] + z_row[0] * p[0] + z_row[1] * p[1] + z_row[2] * p[2];
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
    EXPECT_NEAR(lowest, placed.z_m, 1e-4) << placed.spec.name;
    EXPECT_NEAR(highest, placed.z_m + placed.object.height_m, 1e-4) << placed.spec.name;
  }
}

TEST_P(SceneFolder, HasTheTableRoomAndCameras) {
  const Model model = support::load_mjcf(folder() / "scene.xml");
  ASSERT_NE(model, nullptr);
  const int top = mj_name2id(model.get(), mjOBJ_GEOM, "table/top");
  ASSERT_GE(top, 0);
  EXPECT_NEAR(model->geom_pos[3 * top + 2] + model->geom_size[3 * top + 2], kTableTop_m, 1e-12);
  EXPECT_NEAR(model->geom_size[3 * top], kTableHalf_m, 1e-12);
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_CAMERA, "overview"), 0);
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_CAMERA, "top"), 0);
  EXPECT_EQ(model->light_castshadow[0], 0);
  for (int i = 0; i < model->nnames; ++i) {
    EXPECT_NE(std::string(model->names + i).rfind("robot/", 0), 0U);
    i += static_cast<int>(std::string(model->names + i).size());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneFolder, testing::ValuesIn(standard_scenes()),
                         [](const auto& info) { return info.param.name; });

/// Files alike count once, as they take room once in the repository: offices share their furniture.
TEST(SceneFolders, AreSmall) {
  std::map<std::uint64_t, std::uintmax_t> bytes;
  for (const auto& [name, path] : files_below(kCheckedInScenes)) {
    bytes[hash_file(path)] = fs::file_size(path);
  }
  std::uintmax_t sum = 0;
  for (const auto& [hash, size] : bytes) sum += size;
  EXPECT_LT(sum, 44U << 20U);  // a third of it are the worktops c to e
}

TEST(SceneMjcf, EveryObjectOfTheCatalogueCompiles) {
  const support::TemporaryDirectory directory;
  TableScene scene{"all", 25, {}, {}};
  for (const ObjectSpec& spec : catalogue(25)) {
    scene.objects.push_back(
        {.spec = spec, .object = generate(spec), .T_world_object = {}, .support = {}});
  }
  write_scene(scene, directory.path());
  const Model model = support::load_mjcf(directory / "scene.xml");
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->nmesh, static_cast<int>(scene.objects.size()));
}

}  // namespace
}  // namespace vantage
