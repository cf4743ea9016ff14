// Each array of a model is looked at from its first number to its last.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <functional>
#include <limits>
#include <utility>

#include "tests/sim/test_world.hpp"
#include "tests/support/mjcf.hpp"
#include "vantage/core/error.hpp"
#include "vantage/sim/world/model_check.hpp"
#include "vantage/sim/world/model_names.hpp"

namespace vantage {
namespace {

using test::message_of;
using testing::ElementsAre;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Seven bodies with one of everything.
test::MjcfModel seven() {
  std::string bodies;
  std::string motors;
  for (int i = 0; i < 7; ++i) {
    bodies += fmt::format(
        "<body name='b{0}' pos='{0} 0 1'><joint name='j{0}' type='hinge'/><geom name='g{0}' "
        "size='.1'/><site name='s{0}'/><camera name='c{0}'/><light name='l{0}'/></body>",
        i);
    motors += fmt::format("<motor name='m{0}' joint='j{0}'/>", i);
  }
  return test::compile_mjcf("<mujoco><worldbody>" + bodies + "<geom size='.1'/></worldbody>" +
                            "<actuator>" + motors + "</actuator></mujoco>");
}

TEST(ModelNumbers, TheLastOfEachArrayMustBeFinite) {
  const auto scene = seven();
  mjModel& m = *scene.model;
  struct Array {
    mjtNum* numbers;
    int count;
    std::string what;
  };
  const std::vector<Array> arrays{{m.body_pos, 3 * 8, "position of body 'b6'"},
                                  {m.body_quat, 4 * 8, "orientation of body 'b6'"},
                                  {m.body_ipos, 3 * 8, "centre of mass of body 'b6'"},
                                  {m.body_mass, 8, "mass of body 'b6'"},
                                  {m.body_inertia, 3 * 8, "inertia of body 'b6'"},
                                  {m.jnt_axis, 3 * 7, "axis of joint 'j6'"},
                                  {m.jnt_pos, 3 * 7, "anchor of joint 'j6'"},
                                  {m.jnt_range, 2 * 7, "range of joint 'j6'"},
                                  {m.jnt_stiffness, 7, "stiffness of joint 'j6'"},
                                  {m.geom_pos, 3 * 8, "position of geom 'g6'"},
                                  {m.geom_quat, 4 * 8, "orientation of geom 'g6'"},
                                  {m.geom_size, 3 * 8, "size of geom 'g6'"},
                                  {m.geom_friction, 3 * 8, "friction of geom 'g6'"},
                                  {m.site_pos, 3 * 7, "position of site 's6'"},
                                  {m.cam_pos, 3 * 7, "position of camera 'c6'"},
                                  {m.light_pos, 3 * 7, "position of light 'l6'"},
                                  {m.qpos0, 7, "start position (qpos0) of number 6"},
                                  {m.qpos_spring, 7, "spring reference of number 6"},
                                  {m.dof_damping, 7, "joint damping of number 6"},
                                  {m.dof_armature, 7, "joint armature of number 6"},
                                  {m.dof_frictionloss, 7, "joint friction of number 6"},
                                  {m.actuator_gainprm, mjNGAIN * 7, "gain of actuator 'm6'"},
                                  {m.actuator_biasprm, mjNBIAS * 7, "bias of actuator 'm6'"},
                                  {m.actuator_gear, 6 * 7, "gear of actuator 'm6'"},
                                  {m.actuator_ctrlrange, 2 * 7, "control range of actuator 'm6'"},
                                  {m.actuator_forcerange, 2 * 7, "force range of actuator 'm6'"},
                                  {m.opt.gravity, 3, "gravity of number 0"},
                                  {m.opt.wind, 3, "wind of number 0"},
                                  {&m.opt.density, 1, "density of number 0"},
                                  {&m.opt.viscosity, 1, "viscosity of number 0"}};
  const auto complaint = [&] { return message_of<InputError>([&] { check_model(m, "a.xml"); }); };
  ASSERT_EQ(complaint(), "");
  for (const Array& array : arrays) {
    mjtNum& last = array.numbers[array.count - 1];
    const mjtNum before = std::exchange(last, kNotANumber);
    EXPECT_EQ(complaint(), "a.xml: " + array.what + " is nan");
    last = before;
  }
}

TEST(ModelNumbers, AnObjectWithoutANameGoesByItsNumber) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom name='a' size='.1'/><geom size='.1'/></worldbody></mujoco>");
  scene.model->geom_size[3] = kNotANumber;
  EXPECT_EQ(message_of<InputError>([&] { check_model(*scene.model, "a.xml"); }),
            "a.xml: size of unnamed geom number 1 is nan");
}

TEST(ModelNumbers, ATimeStepMayBeATenthOfASecond) {
  const auto scene = seven();
  for (const double timestep_s : {1e-6, 0.1}) {
    scene.model->opt.timestep = timestep_s;
    EXPECT_NO_THROW(check_model(*scene.model, "a.xml")) << timestep_s;
  }
}

/// What check_same_scene says of two models of the same text, the second one changed.
std::string change_of(const std::function<test::MjcfModel()>& make,
                      const std::function<void(mjModel&)>& change) {
  const auto alone = make();
  const auto both = make();
  change(*both.model);
  return message_of<InputError>([&] { check_same_scene(*alone.model, *both.model, "a.xml"); });
}

TEST(ModelNumbers, WhatRoundsToTheSameTextIsTheSame) {
  const auto mass_by = [](double share) {
    return change_of(seven, [&](mjModel& m) { m.body_mass[1] *= 1.0 + share; });
  };
  EXPECT_EQ(mass_by(0.9e-4), "");
  EXPECT_EQ(mass_by(-0.9e-4), "");
  EXPECT_THAT(mass_by(1.5e-4), testing::HasSubstr("mass of body 'b0' would change from"));
  EXPECT_THAT(mass_by(-1.5e-4), testing::HasSubstr("mass of body 'b0' would change from"));
  const auto moved_by = [](double way_m) {
    return change_of(seven, [&](mjModel& m) { m.site_pos[1] += way_m; });
  };
  EXPECT_EQ(moved_by(0.9e-6), "");
  EXPECT_THAT(moved_by(1.5e-6),
              testing::HasSubstr("position of site 's0' would change from 0 to 1.5e-06"));
}

TEST(ModelNumbers, WhatIsLostIsNamed) {
  const auto two = test::compile_mjcf("<mujoco><worldbody><body/><body/></worldbody></mujoco>");
  const auto one = test::compile_mjcf("<mujoco><worldbody><body/></worldbody></mujoco>");
  EXPECT_EQ(message_of<InputError>([&] { check_same_scene(*two.model, *one.model, "a.xml"); }),
            "a.xml: cannot stand beside a robot: loses a body");
  EXPECT_NO_THROW(check_same_scene(*one.model, *two.model, "a.xml"));
}

test::MjcfModel wedge() {
  return test::compile_mjcf(
      "<mujoco><asset><mesh name='wedge' vertex='0 0 0  .4 0 0  0 .3 0  0 0 .2' "
      "face='0 2 1  0 1 3  0 3 2  1 2 3'/></asset><worldbody>"
      "<geom name='wedge' type='mesh' mesh='wedge' pos='1 2 3'/></worldbody></mujoco>");
}

TEST(ModelNumbers, AMeshIsTheSameWhereItsVerticesAre) {
  const std::string changed =
      "a.xml: cannot stand beside a robot: the mesh of geom 'wedge' would change";
  EXPECT_EQ(change_of(wedge, [](mjModel&) {}), "");
  EXPECT_EQ(change_of(wedge, [](mjModel& m) { m.geom_pos[1] += 0.9e-3; }), "");
  EXPECT_EQ(change_of(wedge, [](mjModel& m) { m.geom_pos[1] += 1.5e-3; }), changed);
  EXPECT_EQ(change_of(wedge, [](mjModel& m) { m.mesh_vert[3 * 3 + 2] += 0.01F; }), changed);
  EXPECT_EQ(change_of(wedge, [](mjModel& m) { --m.mesh_vertnum[0]; }), changed);
  EXPECT_EQ(change_of(wedge, [](mjModel& m) { m.geom_type[0] = mjGEOM_BOX; }), changed);
  EXPECT_THAT(change_of(wedge, [](mjModel& m) { m.geom_friction[0] = 0.5; }),
              testing::HasSubstr("friction of geom 'wedge'"));
}

TEST(ModelNumbers, VerticesMustBeFinite) {
  const auto scene = wedge();
  scene.model->mesh_vert[3 * 4 - 1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(message_of<InputError>([&] { check_model(*scene.model, "a.xml"); }),
            "a.xml: a mesh has a vertex that is not finite");
}

TEST(ModelNames, AreThoseOfTheirKindInOrder) {
  const auto scene = seven();
  const mjModel& m = *scene.model;
  EXPECT_THAT(model_names(m, ModelObject::body),
              ElementsAre("world", "b0", "b1", "b2", "b3", "b4", "b5", "b6"));
  EXPECT_THAT(model_names(m, ModelObject::joint),
              ElementsAre("j0", "j1", "j2", "j3", "j4", "j5", "j6"));
  EXPECT_THAT(model_names(m, ModelObject::geom),
              ElementsAre("g0", "g1", "g2", "g3", "g4", "g5", "g6"));
  EXPECT_THAT(model_names(m, ModelObject::site),
              ElementsAre("s0", "s1", "s2", "s3", "s4", "s5", "s6"));
  EXPECT_THAT(model_names(m, ModelObject::camera),
              ElementsAre("c0", "c1", "c2", "c3", "c4", "c5", "c6"));
  EXPECT_THAT(model_names(m, ModelObject::actuator),
              ElementsAre("m0", "m1", "m2", "m3", "m4", "m5", "m6"));
  EXPECT_EQ(find_model_id(m, ModelObject::site, "s0"), 0);
  EXPECT_EQ(find_model_id(m, ModelObject::site, "c0"), std::nullopt);
  EXPECT_EQ(message_of<InputError>([&] { model_id(m, ModelObject::camera, "s0"); }),
            "the model has no camera called 's0'");
}

/// A wedge that is the fourth geom.
test::MjcfModel wedge_behind_balls() {
  return test::compile_mjcf(
      "<mujoco><asset><mesh name='wedge' vertex='0 0 0  .4 0 0  0 .3 0  0 0 .2' "
      "face='0 2 1  0 1 3  0 3 2  1 2 3'/></asset><worldbody>"
      "<geom size='.1'/><geom size='.2'/><geom size='.3'/>"
      "<geom name='wedge' type='mesh' mesh='wedge' pos='1 2 3'/></worldbody></mujoco>");
}

TEST(ModelNumbers, AMeshIsLookedForWhereItsOwnGeomIs) {
  EXPECT_EQ(change_of(wedge_behind_balls, [](mjModel&) {}), "");
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(
        change_of(wedge_behind_balls, [&](mjModel& m) { m.geom_pos[3 * 3 + axis] += 1.5e-3; }),
        "a.xml: cannot stand beside a robot: the mesh of geom 'wedge' would change")
        << axis;
  }
}

/// A ten-thousandth of the larger one may be rounding, whichever of the two that is.
TEST(ModelNumbers, TheLargerNumberTellsWhatMayBeRounding) {
  const auto mass_by = [](double share) {
    return change_of(seven, [&](mjModel& m) { m.body_mass[1] *= 1.0 + share; });
  };
  EXPECT_EQ(mass_by(1.00005e-4), "");
  EXPECT_EQ(mass_by(-0.99995e-4), "");
  EXPECT_NE(mass_by(1.00015e-4), "");
  EXPECT_NE(mass_by(-1.00005e-4), "");
}

/// A wedge, a field of hills and a ball.
test::MjcfModel wedge_before_hills() {
  return test::compile_mjcf(
      "<mujoco><asset><hfield name='h' nrow='2' ncol='2' size='1 1 1 1'/>"
      "<mesh name='wedge' vertex='0 0 0  .4 0 0  0 .3 0  0 0 .2' "
      "face='0 2 1  0 1 3  0 3 2  1 2 3'/></asset><worldbody>"
      "<geom name='wedge' type='mesh' mesh='wedge' pos='1 2 3'/>"
      "<geom name='hills' type='hfield' hfield='h' pos='1 2 3'/>"
      "<geom name='ball' size='.1' pos='1 2 3'/></worldbody></mujoco>");
}

TEST(ModelNumbers, OnlyAMeshIsLookedForByItsVertices) {
  for (const auto& [geom, name] : {std::pair(1, "hills"), std::pair(2, "ball")}) {
    EXPECT_THAT(
        change_of(wedge_before_hills, [&, at = 3 * geom](mjModel& m) { m.geom_pos[at] += 0.9e-3; }),
        testing::HasSubstr(fmt::format("position of geom '{}' would change", name)));
  }
  EXPECT_THAT(change_of(wedge_before_hills, [](mjModel& m) { m.body_pos[0] = 1.0; }),
              testing::HasSubstr("position of body 'world' would change from 0 to 1"));
}

TEST(ModelNumbers, EveryNumberOfEveryVertexOfAMeshCounts) {
  const std::string changed =
      "a.xml: cannot stand beside a robot: the mesh of geom 'wedge' would change";
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(change_of(wedge, [&](mjModel& m) { m.mesh_vert[i] += 0.01F; }), changed) << i;
  }
  EXPECT_EQ(change_of(wedge_behind_balls, [](mjModel& m) { m.geom_quat[4 * 3 + 1] += 0.1; }),
            changed);
}

TEST(ModelNumbers, TheFirstVertexMustBeFiniteToo) {
  const auto scene = wedge();
  scene.model->mesh_vert[0] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(message_of<InputError>([&] { check_model(*scene.model, "a.xml"); }),
            "a.xml: a mesh has a vertex that is not finite");
}

TEST(ModelNumbers, ASceneIsNotCalledAsARobotEither) {
  const auto scene = test::compile_mjcf("<mujoco model='robot/x'><worldbody/></mujoco>");
  EXPECT_THAT(message_of<InputError>([&] { check_no_robot_names(*scene.model, "a.xml"); }),
              testing::HasSubstr("'robot/x'"));
}

}  // namespace
}  // namespace vantage
