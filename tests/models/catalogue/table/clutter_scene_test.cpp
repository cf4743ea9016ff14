#include "vantage/models/catalogue/table/clutter_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tests/models/catalogue/scene_files.hpp"
#include "vantage/core/error.hpp"
#include "vantage/models/catalogue/table/scene_mjcf.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

using support::kCheckedInScenes;
using support::Model;
using Data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

class ClutterScene : public testing::TestWithParam<ClutterSceneOptions> {
 protected:
  static fs::path folder() { return kCheckedInScenes / GetParam().name; }
};

class SteppedClutter : public ClutterScene {};

TEST_P(ClutterScene, IsWhatTheToolWrites) {
  const support::TemporaryDirectory directory;
  write_scene(make_clutter_scene(GetParam()), directory.path());
  support::expect_same_files(directory.path(), folder());
}

TEST_P(ClutterScene, HasWhatItsNameSays) {
  const TableScene scene = make_clutter_scene(GetParam());
  EXPECT_EQ(scene.objects.size(), static_cast<std::size_t>(GetParam().objects));
  EXPECT_TRUE(scene.name.ends_with(fmt::format("_{}", scene.objects.size())));
  EXPECT_EQ(scene.boxes.size(), static_cast<std::size_t>(GetParam().boxes));
}

TEST_P(ClutterScene, StaysOnTheTableAndUnderItsLimit) {
  double highest_m = 0.0;
  for (const PlacedObject& placed : make_clutter_scene(GetParam()).objects) {
    for (const auto& p : moved(placed.object.footprint_m, placed.T_world_object)) {
      EXPECT_LT(p.cwiseAbs().maxCoeff(), kTableHalf_m) << placed.spec.name;
    }
    const double height_m = placed.z_m + placed.object.height_m - kWorktop_m;
    EXPECT_LE(height_m, kClutterHeight_m) << placed.spec.name;
    highest_m = std::max(highest_m, height_m);
  }
  constexpr double kLaser_m = 1.05;  // of the robot with its lift down
  EXPECT_GT(kWorktop_m + highest_m, kLaser_m) << "the laser looks over everything";
}

/// The scene with every object free to move, and contacts good enough for it to come to rest.
Model loosened(const fs::path& folder, const TableScene& scene) {
  std::string text = read_file(folder / "scene.xml");
  const auto insert_after = [&](const std::string& what, const std::string& more) {
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.insert(text.find('>', at) + 1, more);
  };
  for (const PlacedObject& placed : scene.objects) {
    insert_after("<body name=\"" + placed.spec.name + "\"", "<freejoint/>");
  }
  insert_after("<mujoco model",
               "<size njmax=\"3000\" nconmax=\"2000\"/>"
               "<option cone=\"elliptic\" impratio=\"10\" noslip_iterations=\"10\">"
               "<flag multiccd=\"enable\"/></option>"
               "<default><geom condim=\"6\" friction=\"1 0.01 0.002\"/></default>");
  const support::TemporaryDirectory directory;
  fs::copy(folder, directory.path(), fs::copy_options::recursive);
  write_file(directory / "scene.xml", text);
  return support::load_mjcf(directory / "scene.xml");
}

TEST_P(SteppedClutter, ThingsDoNotOverlap) {
  const Model model = loosened(folder(), make_clutter_scene(GetParam()));
  ASSERT_NE(model, nullptr);
  const Data data(mj_makeData(model.get()), &mj_deleteData);
  mj_forward(model.get(), data.get());
  EXPECT_GT(data->ncon, 0);
  for (int i = 0; i < data->ncon; ++i) {
    const mjContact& contact = data->contact[i];
    EXPECT_GT(contact.dist, -1e-4) << mj_id2name(model.get(), mjOBJ_GEOM, contact.geom1) << " and "
                                   << mj_id2name(model.get(), mjOBJ_GEOM, contact.geom2);
  }
}

/// What tips, slides or rolls off does so in the first seconds.
TEST_P(SteppedClutter, StandsStably) {
  const TableScene scene = make_clutter_scene(GetParam());
  const Model model = loosened(folder(), scene);
  ASSERT_NE(model, nullptr);
  const Data data(mj_makeData(model.get()), &mj_deleteData);
  while (data->time < 2.0) mj_step(model.get(), data.get());
  EXPECT_EQ(data->warning[mjWARN_CNSTRFULL].number, 0);
  EXPECT_EQ(data->warning[mjWARN_CONTACTFULL].number, 0);
  for (const PlacedObject& placed : scene.objects) {
    const int body = mj_name2id(model.get(), mjOBJ_BODY, placed.spec.name.c_str());
    const mjtNum* at = data->xpos + 3 * body;
    EXPECT_LT(std::hypot(at[0] - placed.T_world_object.x_m, at[1] - placed.T_world_object.y_m,
                         at[2] - placed.z_m),
              0.02)
        << placed.spec.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ClutterScene, testing::ValuesIn(clutter_scenes()),
                         [](const auto& info) { return info.param.name; });
INSTANTIATE_TEST_SUITE_P(Scenes, SteppedClutter,
                         testing::ValuesIn(support::some_of(clutter_scenes(), 7)),
                         [](const auto& info) { return info.param.name; });

TEST(ClutterScenes, SetsShareLevelsButNoSeed) {
  const auto scenes = clutter_scenes();
  const std::vector<std::string> sets{"clutter_dev_",      "clutter_report_",
                                      "clutter_report_b_", "clutter_report_c_",
                                      "clutter_report_d_", "clutter_report_e_"};
  ASSERT_EQ(scenes.size() % sets.size(), 0U);
  const std::size_t levels = scenes.size() / sets.size();
  std::set<std::uint64_t> seeds;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const ClutterSceneOptions& first = scenes[i % levels];
    EXPECT_EQ(scenes[i].name, sets[i / levels] + std::to_string(first.objects));
    EXPECT_EQ(scenes[i].objects, first.objects);
    EXPECT_EQ(scenes[i].boxes, first.boxes);
    EXPECT_TRUE(seeds.insert(scenes[i].seed).second) << scenes[i].name;
  }
}

TEST(ClutterScenes, BoxesHoldThings) {
  for (const ClutterSceneOptions& options : clutter_scenes()) {
    const TableScene scene = make_clutter_scene(options);
    const auto raised = std::ranges::count_if(scene.objects, [](const PlacedObject& placed) {
      return placed.z_m > kWorktop_m && !placed.support;
    });
    EXPECT_GE(raised, options.objects / 4) << options.name;
  }
}

TEST(ClutterScenes, TooMuchForTheTableIsAnError) {
  EXPECT_THROW(make_clutter_scene({.objects = 60, .boxes = 0, .clearance_m = 0.2, .furniture = {}}),
               ConfigError);
}

TEST(OpenBox, IsOpenToTheFrontAlone) {
  Rng rng(1);
  for (const auto kind : {OpenBox::Kind::shelf, OpenBox::Kind::pigeonholes, OpenBox::Kind::crate,
                          OpenBox::Kind::carton}) {
    const OpenBox box = make_open_box(kind, rng);
    for (const Compartment& room : compartments(box, 0.0)) {
      const Eigen::Vector3d middle(0.0, 0.5 * (room.min_m + room.max_m).y(),
                                   room.floor_m + 0.5 * room.height_m);
      const auto blocked = [&](const Eigen::Vector3d& direction) {
        for (double way_m = 0.0; way_m < 0.5; way_m += 1e-3) {
          const Eigen::Vector3d p = middle + way_m * direction;
          for (const Board& board : boards(box)) {
            if (((p - board.centre_m).cwiseAbs().array() <= board.half_m.array()).all())
              return true;
          }
        }
        return false;
      };
      EXPECT_FALSE(blocked(Eigen::Vector3d::UnitX())) << kind_name(kind);
      for (const Eigen::Vector3d& direction :
           {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0),
            Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1)}) {
        EXPECT_TRUE(blocked(direction)) << kind_name(kind) << " " << direction.transpose();
      }
    }
  }
}

}  // namespace
}  // namespace vantage
