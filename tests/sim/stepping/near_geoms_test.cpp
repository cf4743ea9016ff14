// Leaving out what is far changes no bit: bodies of every shape fall and roll about in a room,
// beside the same model stepped by MuJoCo alone.

#include "vantage/sim/stepping/near_geoms.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/test_world.hpp"
#include "vantage/sim/stepping/model_part.hpp"
#include "vantage/sim/stepping/near_pairs.hpp"
#include "vantage/sim/world/model_names.hpp"

namespace vantage {
namespace {

const std::string kRoom =
    "<mujoco><asset><mesh name='wedge' vertex='0 0 0  .3 0 0  0 .3 0  0 0 .3  .3 .3 .1'/></asset>"
    "<worldbody><geom name='floor' type='plane' size='9 9 .1'/>"
    "<geom type='box' size='.05 4 1' pos='1.4 0 1'/><geom type='box' size='4 .05 1' pos='0 1.4 1'/>"
    "<geom type='box' size='.05 4 1' pos='-1.4 0 1' euler='0 5 0'/>"
    "<geom type='box' size='4 .05 1' pos='0 -1.4 1'/>"
    "<body pos='.4 .3 0'><geom type='cylinder' size='.1 .5'/></body>"
    "<body pos='-.5 -.4 .2' euler='40 0 70'><geom type='capsule' size='.08 .6'/></body>"
    "<body pos='-.4 .6 .1'><geom type='mesh' mesh='wedge'/></body>"
    "<body pos='.6 -.6 .1' euler='20 10 0'><geom type='ellipsoid' size='.4 .2 .1'/></body>"
    "<body pos='6 6 0'><geom type='cylinder' size='.3 2'/><geom type='box' size='.1 .1 3'/></body>";

std::string falling(const std::string& name, const std::string& geom, double x_m, double z_m) {
  return fmt::format(
      "<body name='{}' pos='{} {} {}' euler='30 {} 10'><freejoint name='{}'/><geom {} mass='1'/>"
      "</body>",
      name, x_m, 0.3 - x_m, z_m, 90.0 * x_m, name, geom);
}

std::string room_with_falling_bodies() {
  const std::vector<std::string> geoms{
      "type='box' size='.1 .2 .05'",       "type='sphere' size='.12'",
      "type='capsule' size='.06 .2'",      "type='cylinder' size='.1 .15'",
      "type='ellipsoid' size='.2 .1 .07'", "type='mesh' mesh='wedge'"};
  std::string text = kRoom;
  for (int i = 0; i < 12; ++i) {
    text += falling("body_" + std::to_string(i), geoms[static_cast<std::size_t>(i) % geoms.size()],
                    -0.9 + 0.15 * i, 0.5 + 0.2 * i);
  }
  return text + "</worldbody></mujoco>";
}

/// One step of MuJoCo as it comes.
void step_alone(const mjModel& model, mjData& data) {
  mjcb_contactfilter = nullptr;
  mj_step(&model, &data);
  mjcb_contactfilter = discard_far_pair;
}

TEST(NearGeoms, ContactsAreThoseOfMuJoCoAlone) {
  const test::SceneFolder folder(room_with_falling_bodies());
  World world(folder.alone());
  const DataPtr alone = world.copy_data();
  int most_contacts = 0;
  for (int tick = 0; tick < 120; ++tick) {
    world.advance_tick();
    for (int i = 0; i < world.options().steps_per_tick(); ++i) step_alone(world.model(), *alone);
    ASSERT_EQ(world.data().ncon, alone->ncon) << "tick " << tick;
    for (int i = 0; i < world.model().nq; ++i) {
      ASSERT_EQ(world.data().qpos[i], alone->qpos[i]) << "tick " << tick;
    }
    most_contacts = std::max(most_contacts, alone->ncon);
  }
  EXPECT_GT(most_contacts, 25);
}

TEST(NearGeoms, WhatIsFarIsLeftOutUntilSomethingComesNear) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/>"
      "<geom type='box' size='.1 1 .5' pos='3 0 .5'/><geom type='box' size='.1 1 .5' pos='-3 0 "
      ".5'/>"
      "<body pos='0 0 .2'><freejoint name='ball'/><geom size='.2'/></body></worldbody></mujoco>");
  World world(folder.alone());
  NearGeoms near(world.model());
  near.start(world.snapshot());
  EXPECT_FALSE(near.is_near(1));
  EXPECT_FALSE(near.is_near(2));
  EXPECT_TRUE(near.is_near(3)) << "the ball lies on the floor";
  EXPECT_TRUE(near.is_near(0));
  EXPECT_EQ(near.stepped().geoms(), 2);
  world.set_initial_pose("ball", Pose(Eigen::Translation3d(2.6, 0.0, 0.2)));
  near.follow(world.snapshot());
  EXPECT_TRUE(near.is_near(1));
  EXPECT_FALSE(near.is_near(2));
  world.set_initial_pose("ball", Pose(Eigen::Translation3d(0.0, 0.0, 0.9)));
  near.follow(world.snapshot());
  EXPECT_FALSE(near.is_near(3)) << "nothing is near in the air";
  EXPECT_FALSE(near.is_near(0));
  EXPECT_EQ(near.stepped().geoms(), 1) << "what moves is stepped all the same";
}

TEST(NearGeoms, WhatNothingCanTouchIsLeftOutUnlessItMoves) {
  const std::string picture = "type='box' size='.1 .1 .1' contype='0' conaffinity='0'/>";
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/><geom name='decor' pos='.3 0 .1' " +
      picture + "<body name='hand' mocap='true' pos='0 0 5'><geom name='glove' " + picture +
      "</body><body pos='0 0 .2'><freejoint/><geom size='.2'/><geom name='shell' " + picture +
      "</body></worldbody></mujoco>");
  World world(folder.alone());
  const auto id = [&](const char* name) {
    return model_id(world.model(), ModelObject::geom, name);
  };
  NearGeoms near(world.model());
  near.start(world.snapshot());
  for (const char* name : {"decor", "glove", "shell"}) EXPECT_FALSE(near.is_near(id(name)));
  EXPECT_EQ(near.stepped().geoms(), 4) << "floor, glove, ball and shell";
  world.data().mocap_pos[2] = 1.25;
  world.advance_tick();
  EXPECT_DOUBLE_EQ(world.snapshot().geom_xpos[3 * id("glove") + 2], 1.25);
  EXPECT_DOUBLE_EQ(world.snapshot().geom_xpos[3 * id("decor")], 0.3);
}

/// Hundreds of boxes, each a body of its own or all in one, some of them below others; sites,
/// cameras and lights on bodies that stand still; bodies whose contacts are excluded; a door on a
/// post; a body moved by hand.
std::string furnished_room() {
  std::string text = kRoom;
  for (int i = 0; i < 400; ++i) {
    const double x_m = -1.3 + 0.13 * (i % 20);
    const double y_m = -1.3 + 0.13 * (i / 20 % 20);
    const std::string box =
        fmt::format("<geom type='box' size='.03 .05 .0{}' pos='.01 0 .03'/>", 1 + i % 7);
    text +=
        fmt::format("<body name='box_{}' pos='{} {} 0' euler='0 0 {}'>{}", i, x_m, y_m, 7 * i, box);
    if (i % 3 == 0) text += "<body pos='0 0 .05'>" + box + "</body>";
    if (i % 50 == 0) text += fmt::format("<site name='site_{0}'/><camera name='camera_{0}'/>", i);
    text += "</body>";
  }
  text +=
      "<body name='post' pos='.2 1.1 .4'><geom type='box' size='.03 .03 .4'/><body pos='.1 0 0'>"
      "<geom type='box' size='.02 .02 .1'/></body><body name='leaf'><joint name='hinge' axis='0 0 "
      "1'/><geom type='box' pos='.3 0 0' size='.25 .02 .3'/></body></body>"
      "<body name='hand' mocap='true' pos='0 0 .6'><geom type='sphere' size='.1'/></body>";
  const std::vector<std::string> geoms{"type='box' size='.1 .2 .05'", "type='sphere' size='.12'",
                                       "type='capsule' size='.06 .2'", "type='mesh' mesh='wedge'"};
  for (int i = 0; i < 8; ++i) {
    text += falling("body_" + std::to_string(i), geoms[static_cast<std::size_t>(i) % geoms.size()],
                    -0.9 + 0.2 * i, 0.5 + 0.2 * i);
  }
  return text +
         "</worldbody><contact><exclude body1='body_0' body2='body_1'/><exclude body1='body_2' "
         "body2='box_7'/></contact></mujoco>";
}

TEST(NearGeoms, AFurnishedRoomMovesAsMuJoCoMovesIt) {
  const test::SceneFolder folder(furnished_room());
  World world(folder.alone());
  const DataPtr alone = world.copy_data();
  std::set<int> touched;
  for (int tick = 0; tick < 60; ++tick) {
    for (mjData* data : {&world.data(), alone.get()}) data->mocap_pos[2] = 0.6 - 0.005 * tick;
    world.data().xfrc_applied[6 * model_id(world.model(), ModelObject::body, "body_3")] = 1.0;
    std::copy_n(world.data().xfrc_applied, 6 * world.model().nbody, alone->xfrc_applied);
    world.advance_tick();
    for (int i = 0; i < world.options().steps_per_tick(); ++i) step_alone(world.model(), *alone);
    ASSERT_EQ(world.data().ncon, alone->ncon) << "tick " << tick;
    for (int i = 0; i < alone->ncon; ++i) {
      ASSERT_EQ(world.data().contact[i].geom1, alone->contact[i].geom1);
      ASSERT_EQ(world.data().contact[i].geom2, alone->contact[i].geom2);
      touched.insert(alone->contact[i].geom1);
    }
    for (int i = 0; i < world.model().nq; ++i) {
      ASSERT_EQ(world.data().qpos[i], alone->qpos[i]) << "tick " << tick;
    }
  }
  EXPECT_GT(touched.size(), 10U);
}

TEST(NearGeoms, ASnapshotHasAllPoses) {
  const test::SceneFolder folder(furnished_room());
  World world(folder.alone());
  for (int tick = 0; tick < 10; ++tick) world.advance_tick();
  const mjModel& model = world.model();
  const DataPtr whole = world.copy_data();
  mj_kinematics(&model, whole.get());
  mj_comPos(&model, whole.get());
  mj_camlight(&model, whole.get());
  const mjData& now = world.snapshot();
  const auto same = [](const mjtNum* a, const mjtNum* b, int count) {
    return std::equal(a, a + count, b);
  };
  EXPECT_TRUE(same(now.geom_xpos, whole->geom_xpos, 3 * model.ngeom));
  EXPECT_TRUE(same(now.geom_xmat, whole->geom_xmat, 9 * model.ngeom));
  EXPECT_TRUE(same(now.xpos, whole->xpos, 3 * model.nbody));
  EXPECT_TRUE(same(now.site_xpos, whole->site_xpos, 3 * model.nsite));
  EXPECT_TRUE(same(now.cam_xpos, whole->cam_xpos, 3 * model.ncam));
}

TEST(NearGeoms, WhatIsPutElsewhereIsThere) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/>"
      "<body name='shelf' pos='5 0 .5'><body pos='0 0 .1'><geom name='board' type='box' "
      "size='.4 .4 .1'/></body></body>"
      "<body pos='0 0 1.2'><freejoint name='ball'/><geom size='.1'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.advance_tick();
  const int shelf = model_id(world.model(), ModelObject::body, "shelf");
  const int board = model_id(world.model(), ModelObject::geom, "board");
  EXPECT_DOUBLE_EQ(world.snapshot().geom_xpos[3 * board], 5.0);
  world.put_fixed_body(shelf, {0.1, 0.0, 0.3});
  EXPECT_DOUBLE_EQ(world.snapshot().geom_xpos[3 * board], 0.1);
  EXPECT_DOUBLE_EQ(world.snapshot().geom_xpos[3 * board + 2], 0.4);
  while (world.time_s() < 2.0) world.advance_tick();
  EXPECT_NEAR(world.data().qpos[2], 0.6, 0.02) << "it fell onto the board";
}

/// Constraints between bodies name them: then all is stepped, as MuJoCo does.
TEST(NearGeoms, ConstraintsBetweenBodiesHold) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><body name='far' pos='5 0 0'><geom type='box' size='.1 .1 .1'/></body>"
      "<body name='nail' pos='0 0 2'><geom type='box' size='.1 .1 .1'/></body>"
      "<body name='lamp' pos='.5 0 1.5'><freejoint/><geom size='.1'/></body></worldbody>"
      "<equality><connect body1='lamp' body2='nail' anchor='-.5 0 .5'/></equality></mujoco>");
  World world(folder.alone());
  const DataPtr alone = world.copy_data();
  for (int tick = 0; tick < 40; ++tick) {
    world.advance_tick();
    for (int i = 0; i < world.options().steps_per_tick(); ++i) step_alone(world.model(), *alone);
    for (int i = 0; i < world.model().nq; ++i) ASSERT_EQ(world.data().qpos[i], alone->qpos[i]);
  }
  EXPECT_GT(world.data().qpos[2], 0.5) << "it hangs";
}

TEST(NearGeoms, WhatMovesWithoutAJointIsAlwaysNear) {
  const test::SceneFolder folder(
      "<mujoco><option gravity='0 0 0'/><worldbody>"
      "<body name='hand' mocap='true' pos='0 0 5'><geom type='box' size='.3 .3 .1'/></body>"
      "<body pos='0 0 1'><freejoint name='ball'/><geom size='.2'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.advance_tick();
  world.data().mocap_pos[2] = 1.25;
  world.advance_tick();
  EXPECT_GT(world.data().ncon, 0);
}

TEST(NearGeoms, AJumpIsNoticed) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='box' size='1 1 .5' pos='30 0 .5'/>"
      "<body pos='0 0 2'><freejoint name='ball'/><geom size='.2'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.advance_tick();
  std::vector<double> state = world.state();
  state[1] = 30.0;  // x, above the box
  world.set_state(state);
  while (world.time_s() < 2.0) world.advance_tick();
  EXPECT_NEAR(world.data().qpos[2], 1.2, 0.02);

  state[3] = 1.19;  // in contact at once
  world.set_state(state);
  int contacts = -1;
  world.on_step = [&](const World& stepped) {
    if (contacts < 0) contacts = stepped.data().ncon;
  };
  world.advance_tick();
  EXPECT_GT(contacts, 0) << "in the first step";
}

/// Pairs that touch of balls in a row, each 5 cm into the next, the first two of them excluded;
/// so many bodies that are left out come before them.
std::set<std::string> pairs_touching_behind(int left_out) {
  std::string text = "<mujoco><option gravity='0 0 0'/><worldbody>";
  for (int i = 0; i < left_out; ++i) {
    text += fmt::format("<body pos='9 {} 0'><geom size='.1'/></body>", i);
  }
  for (const auto& [name, x_m] : {std::pair("a", 0.0), {"b", 0.15}, {"c", 0.3}}) {
    text += fmt::format(
        "<body name='{0}' pos='{1} 0 0'><freejoint/><geom name='{0}' size='.1'/></body>", name,
        x_m);
  }
  const test::SceneFolder folder(
      text + "</worldbody><contact><exclude body1='a' body2='b'/></contact></mujoco>");
  World world(folder.alone());
  std::set<std::string> touching;
  world.on_step = [&](const World& stepped) {
    const auto name = [&](int geom) {
      return model_name(stepped.model(), ModelObject::geom, geom);
    };
    for (int i = 0; i < stepped.data().ncon; ++i) {
      const mjContact& contact = stepped.data().contact[i];
      const auto [first, second] = std::minmax(contact.geom1, contact.geom2);
      touching.insert(name(first) + name(second));
    }
  };
  world.advance_tick();
  return touching;
}

TEST(NearGeoms, PairsThatAreExcludedAreSoAmongWhatIsStepped) {
  for (const int left_out : {3, 4}) {
    EXPECT_EQ(pairs_touching_behind(left_out), std::set<std::string>{"bc"}) << left_out;
  }
}

TEST(NearGeoms, BodiesThatAreLeftOutAreNotPlaced) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><body name='shelf' pos='5 0 .5'><geom type='box' size='.4 .4 .1'/></body>"
      "<body pos='0 0 2'><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
  World world(folder.alone());
  world.advance_tick();
  const int shelf = model_id(world.model(), ModelObject::body, "shelf");
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(world.data().xpos[3 * shelf + axis], 0.0);
  EXPECT_DOUBLE_EQ(world.snapshot().xpos[3 * shelf], 5.0);
}

TEST(NearGeoms, BodiesOfExcludedPairsArePlacedHoweverFar) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><body name='post' pos='5 0 0'><geom type='box' size='.1 .1 .1'/></body>"
      "<body name='ball' pos='0 0 2'><freejoint/><geom size='.1'/></body></worldbody>"
      "<contact><exclude body1='ball' body2='post'/></contact></mujoco>");
  World world(folder.alone());
  world.advance_tick();
  const int post = model_id(world.model(), ModelObject::body, "post");
  EXPECT_DOUBLE_EQ(world.data().xpos[3 * post], 5.0);
}

TEST(NearGeoms, WhatIsNamedElsewhereIsSteppedHoweverFar) {
  const auto stepped = [](const std::string& named) {
    const test::SceneFolder folder(
        "<mujoco><worldbody><body name='post' pos='5 0 0'><geom name='post' type='box' "
        "size='.1 .1 .1'/><site name='hook'/></body><body name='ball' pos='0 0 2'><freejoint/>"
        "<geom name='ball' size='.1'/><site name='eye'/></body></worldbody>" +
        named + "</mujoco>");
    const World world(folder.alone());
    NearGeoms near(world.model());
    near.start(world.snapshot());
    return near.stepped().geoms();
  };
  EXPECT_EQ(stepped(""), 1);
  for (const char* named :
       {"<contact><pair geom1='ball' geom2='post'/></contact>",
        "<tendon><spatial><site site='hook'/><site site='eye'/></spatial></tendon>",
        "<equality><weld body1='ball' body2='post'/></equality>",
        "<equality><connect body1='ball' body2='post' anchor='0 0 0'/></equality>",
        "<sensor><framepos objtype='body' objname='post'/></sensor>",
        "<sensor><framepos objtype='xbody' objname='post'/></sensor>",
        "<sensor><framepos objtype='geom' objname='post'/></sensor>",
        "<actuator><adhesion body='post' ctrlrange='0 1'/></actuator>",
        "<sensor><framepos objtype='site' objname='eye' reftype='body' "
        "refname='post'/></sensor>"}) {
    EXPECT_EQ(stepped(named), 2) << named;
  }
}

/// A weight without a shape on an arm, and a sign that stands still, far along a frame with a gate.
TEST(NearGeoms, WhatHangsTogetherWithSomethingThatMovesIsSteppedWithIt) {
  const test::SceneFolder folder(
      "<mujoco><worldbody><geom type='box' size='.1 .1 .1' pos='0 -9 0'/>"
      "<body pos='0 0 2'><joint axis='0 1 0'/><geom size='.05' pos='.3 0 0' mass='1'/>"
      "<body name='weight' pos='.5 0 0'>"
      "<inertial pos='0 0 0' mass='2' diaginertia='.01 .01 .01'/></body></body>"
      "<body name='frame' pos='0 3 1'><geom type='box' size='.1 .1 1'/>"
      "<body name='sign' pos='5 0 0'><geom type='box' size='.1 .1 .1'/></body>"
      "<body name='gate'><joint axis='0 0 1' stiffness='1' springref='1'/>"
      "<geom type='box' size='.2 .02 .2' pos='.35 0 0'/></body></body></worldbody></mujoco>");
  World world(folder.alone());
  const DataPtr alone = world.copy_data();
  for (int tick = 0; tick < 20; ++tick) {
    world.advance_tick();
    for (int i = 0; i < world.options().steps_per_tick(); ++i) step_alone(world.model(), *alone);
    for (int i = 0; i < world.model().nq; ++i) {
      ASSERT_EQ(world.data().qpos[i], alone->qpos[i]) << "tick " << tick;
    }
  }
  const auto body = [&](const char* name) {
    return model_id(world.model(), ModelObject::body, name);
  };
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(world.data().subtree_com[3 * body("frame") + axis],
              alone->subtree_com[3 * body("frame") + axis]);
  }
  const double angle_rad = world.data().qpos[0];
  ASSERT_GT(angle_rad, 0.1);
  const Eigen::Vector3d weight_m(0.5 * std::cos(angle_rad), 0.0, 2.0 - 0.5 * std::sin(angle_rad));
  EXPECT_LT((body_pose(world, body("weight")).translation() - weight_m).norm(), 1e-9);
}

}  // namespace
}  // namespace vantage
