// What of a model is stepped, and that all else stays as it is.
#include "vantage/sim/stepping/model_part.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/mjcf.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;

/// A ball, geom 0, a shelf, geom 1, a rack of two, geoms 2 and 3, and another ball, geom 4.
test::MjcfModel balls_and_shelves() {
  return test::compile_mjcf(
      "<mujoco><worldbody><body pos='0 0 2'><freejoint/><geom size='.1'/></body>"
      "<body pos='3 0 0'><geom type='box' size='.1 .1 .1'/></body>"
      "<body pos='4 0 0'><geom type='box' size='.1 .1 .1'/><geom type='box' size='.1 .1 "
      ".2'/></body>"
      "<body pos='0 3 2'><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
}

std::vector<int> listed_geoms(const ModelPart& part) {
  std::vector<int> ids;
  for (int i = 0; i < part.geoms(); ++i) ids.push_back(part.geom_id(i));
  return ids;
}

template <class Numbers>
std::vector<int> first_of(const Numbers* numbers, int count) {
  return {numbers, numbers + count};
}

/// How many bodies of a model are looked at where no geom is near.
int bodies_that_are_always_there(const std::string& mjcf) {
  const auto scene = test::compile_mjcf(mjcf);
  ModelPart part(*scene.model);
  int bodies = 0;
  part.run(*scene.data, [&](const mjModel& model, mjData&) { bodies = model.nbody; });
  return bodies;
}

TEST(ModelPart, HasWhatMovesAndWhatItIsToldToHave) {
  const auto scene = balls_and_shelves();
  ModelPart part(*scene.model);
  EXPECT_THAT(listed_geoms(part), ElementsAre(0, 4));
  part.list(std::vector<char>{0, 0, 1, 0, 0});
  EXPECT_THAT(listed_geoms(part), ElementsAre(0, 2, 4));
  part.list_moving();
  EXPECT_THAT(listed_geoms(part), ElementsAre(0, 4));
}

TEST(ModelPart, WhatMovesAndIsNotNearKeepsOutOfContacts) {
  const auto scene = balls_and_shelves();
  ModelPart part(*scene.model);
  std::vector<int> contype;
  std::vector<int> conaffinity;
  const auto look = [&](const mjModel& model, mjData&) {
    contype = first_of(model.geom_contype, model.ngeom);
    conaffinity = first_of(model.geom_conaffinity, model.ngeom);
  };
  part.list(std::vector<char>{0, 1, 1, 0, 1});
  part.run(*scene.data, look);
  EXPECT_THAT(contype, ElementsAre(0, 1, 1, 1));
  EXPECT_THAT(conaffinity, ElementsAre(0, 1, 1, 1));
  part.list(std::vector<char>{1, 0, 0, 0, 0});
  part.run(*scene.data, look);
  EXPECT_THAT(contype, ElementsAre(1, 0));
  EXPECT_THAT(conaffinity, ElementsAre(1, 0));
}

TEST(ModelPart, EveryBodyHasItsOwnGeoms) {
  const auto scene = balls_and_shelves();
  ModelPart part(*scene.model);
  part.list(std::vector<char>{0, 0, 1, 1, 0});
  part.run(*scene.data, [](const mjModel& model, mjData&) {
    ASSERT_EQ(model.nbody, 4);
    ASSERT_EQ(model.ngeom, 4);
    EXPECT_THAT(first_of(model.body_geomnum, 4), ElementsAre(0, 1, 2, 1));
    EXPECT_THAT(first_of(model.body_geomadr, 4), ElementsAre(-1, 0, 1, 3));
    EXPECT_THAT(first_of(model.geom_bodyid, 4), ElementsAre(1, 2, 2, 3));
    EXPECT_THAT(first_of(model.body_rootid, 4), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(first_of(model.body_weldid, 4), ElementsAre(0, 1, 0, 3));
  });
}

TEST(ModelPart, WhatIsLeftOutStaysAsItIs) {
  const auto scene = balls_and_shelves();
  mjData& data = *scene.data;
  std::fill_n(data.xpos, 3 * scene.model->nbody, 7.0);
  std::fill_n(data.geom_xpos, 3 * scene.model->ngeom, 7.0);
  ModelPart part(*scene.model);
  part.list(std::vector<char>{0, 0, 1, 0, 0});
  part.run(data, [](const mjModel& model, mjData& seen) { mj_kinematics(&model, &seen); });
  EXPECT_THAT(first_of(data.xpos, 15), ElementsAre(0, 0, 0, 0, 0, 2, 7, 7, 7, 4, 0, 0, 0, 3, 2));
  EXPECT_THAT(first_of(data.geom_xpos, 15),
              ElementsAre(0, 0, 2, 7, 7, 7, 4, 0, 0, 7, 7, 7, 0, 3, 2));
}

TEST(ModelPart, AFrameWithoutAShapeIsThereIfASensorNamesIt) {
  const std::string frame =
      "<mujoco><worldbody><body name='frame' pos='5 0 0'/>"
      "<body pos='0 0 2'><freejoint/><geom size='.1'/></body></worldbody>";
  EXPECT_EQ(bodies_that_are_always_there(frame + "</mujoco>"), 2);
  EXPECT_EQ(bodies_that_are_always_there(
                frame + "<sensor><framepos objtype='body' objname='frame'/></sensor></mujoco>"),
            3);
}

TEST(ModelPart, AHandWithoutAShapeIsAlwaysThere) {
  EXPECT_EQ(bodies_that_are_always_there(
                "<mujoco><worldbody><body mocap='true' pos='0 0 1'/>"
                "<body pos='5 0 0'><geom type='box' size='.1 .1 .1'/></body></worldbody></mujoco>"),
            2);
}

TEST(ModelPart, ATendonOfASingleJointIsEnoughToHaveAll) {
  const auto geoms = [](const std::string& more) {
    const auto scene = test::compile_mjcf(
        "<mujoco><worldbody><body pos='5 0 0'><geom type='box' size='.1 .1 .1'/></body>"
        "<body pos='0 0 2'><joint name='swing'/><geom size='.1' pos='.2 0 0'/></body></worldbody>" +
        more + "</mujoco>");
    return ModelPart(*scene.model).geoms();
  };
  EXPECT_EQ(geoms(""), 1);
  EXPECT_EQ(geoms("<tendon><fixed><joint joint='swing' coef='1'/></fixed></tendon>"), 2);
}

}  // namespace
}  // namespace vantage
