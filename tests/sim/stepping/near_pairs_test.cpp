// Which pairs are near enough to be looked at, on both sides of each limit.
#include "vantage/sim/stepping/near_pairs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <string>
#include <utility>

#include "tests/support/mjcf.hpp"
#include "vantage/sim/stepping/near_geoms.hpp"

namespace vantage {
namespace {

TEST(NearPairs, EitherGeomMayAskForTheOther) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom size='.1' contype='6' conaffinity='8'/>"
      "<geom size='.1' contype='1' conaffinity='2'/><geom size='.1' contype='1' conaffinity='1'/>"
      "</worldbody></mujoco>");
  EXPECT_TRUE(masks_match(*scene.model, 0, 1));
  EXPECT_TRUE(masks_match(*scene.model, 1, 0));
  EXPECT_FALSE(masks_match(*scene.model, 0, 2));
  EXPECT_FALSE(masks_match(*scene.model, 2, 0));
  EXPECT_TRUE(masks_match(*scene.model, 1, 2));
}

TEST(NearPairs, BoxesHoldTheirGeoms) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset><hfield name='h' nrow='3' ncol='4' size='1 1 1 1'/></asset><worldbody>"
      "<geom type='box' size='.1 .2 .3'/><geom type='sphere' size='.4'/>"
      "<geom type='capsule' size='.1 .3'/><geom type='cylinder' size='.2 .5'/>"
      "<geom type='ellipsoid' size='.3 .1 .2'/><geom type='plane' size='1 1 1'/>"
      "<geom type='hfield' hfield='h'/></worldbody></mujoco>");
  const auto half_m = [&](int geom) {
    return Eigen::Vector3d(half_box_m(*scene.model, geom).matrix());
  };
  EXPECT_TRUE(half_m(0).isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-12));
  EXPECT_TRUE(half_m(1).isApprox(Eigen::Vector3d(0.4, 0.4, 0.4), 1e-12));
  EXPECT_TRUE(half_m(2).isApprox(Eigen::Vector3d(0.1, 0.1, 0.4), 1e-12));
  EXPECT_TRUE(half_m(3).isApprox(Eigen::Vector3d(0.2, 0.2, 0.5), 1e-12));
  EXPECT_TRUE(half_m(4).isApprox(Eigen::Vector3d(0.3, 0.1, 0.2), 1e-12));
  for (int geom = 0; geom < 7; ++geom) EXPECT_EQ(has_box(*scene.model, geom), geom < 5) << geom;
}

/// Whether a ball of 5 cm is left out beside a wall that is long in y, each with that margin.
bool is_far(double x_m, double y_m, double margin_wall_m = 0.0, double margin_ball_m = 0.0) {
  const auto scene = test::compile_mjcf(
      fmt::format("<mujoco><worldbody><geom type='box' size='.1 4 .3' margin='{}'/>"
                  "<body pos='{} {} 0'><freejoint/><geom size='.05' margin='{}'/></body>"
                  "</worldbody></mujoco>",
                  margin_wall_m, x_m, y_m, margin_ball_m));
  const int far = discard_far_pair(scene.model.get(), scene.data.get(), 0, 1);
  EXPECT_EQ(discard_far_pair(scene.model.get(), scene.data.get(), 1, 0), far);
  return far == 1;
}

TEST(NearPairs, ABallIsFarAMillimetreFromTheBoxOfAWall) {
  EXPECT_FALSE(is_far(0.1509, 0.0));
  EXPECT_TRUE(is_far(0.1515, 0.0));
  EXPECT_FALSE(is_far(-0.1509, 3.0));
  EXPECT_TRUE(is_far(-0.1515, 3.0));
  EXPECT_FALSE(is_far(0.0, 4.0509));
  EXPECT_TRUE(is_far(0.0, 4.0515));
}

TEST(NearPairs, TheLargerMarginCounts) {
  EXPECT_FALSE(is_far(0.1709, 0.0, 0.02, 0.01));
  EXPECT_TRUE(is_far(0.1715, 0.0, 0.02, 0.01));
  EXPECT_FALSE(is_far(0.1709, 0.0, 0.01, 0.02));
  EXPECT_TRUE(is_far(0.1715, 0.0, 0.01, 0.02));
}

/// Geoms of the world, of a base with a part welded to it, of an arm on it, of a hand on that; all
/// in one place.
test::MjcfModel chain(const std::string& options = "") {
  return test::compile_mjcf(
      "<mujoco><option>" + options +
      "</option><worldbody><geom size='.1'/><body><geom size='.1'/></body>"
      "<body><freejoint/><geom size='.1'/><body><geom size='.1'/></body>"
      "<body><joint/><geom size='.1'/><body><joint/><geom size='.1'/></body></body></body>"
      "</worldbody></mujoco>");
}

TEST(NearPairs, PartsOfOnePieceAndNeighboursInAChainDoNotTouch) {
  constexpr int kWorld = 0, kStill = 1, kBase = 2, kWelded = 3, kArm = 4, kHand = 5;
  const auto scene = chain();
  const auto left_out = [&](int a, int b) {
    const int far = discard_far_pair(scene.model.get(), scene.data.get(), a, b);
    EXPECT_EQ(discard_far_pair(scene.model.get(), scene.data.get(), b, a), far);
    return far == 1;
  };
  EXPECT_TRUE(left_out(kWorld, kStill));
  EXPECT_TRUE(left_out(kBase, kWelded));
  EXPECT_TRUE(left_out(kBase, kArm));
  EXPECT_TRUE(left_out(kWelded, kArm));
  EXPECT_TRUE(left_out(kArm, kHand));
  EXPECT_FALSE(left_out(kBase, kHand));
  EXPECT_FALSE(left_out(kWorld, kBase));
  EXPECT_FALSE(left_out(kStill, kArm));
}

TEST(NearPairs, ASceneMayLetNeighboursTouch) {
  const auto scene = chain("<flag filterparent='disable'/>");
  EXPECT_EQ(discard_far_pair(scene.model.get(), scene.data.get(), 2, 4), 0);
  EXPECT_EQ(discard_far_pair(scene.model.get(), scene.data.get(), 2, 3), 1) << "one piece";
}

/// A ball of 10 cm at a place beside a wall at x > 1, another one at y = 3, and a floor at z = 0.
struct Neighbours {
  explicit Neighbours(const Eigen::Vector3d& p_m)
      : scene(test::compile_mjcf(
            "<mujoco><worldbody><geom type='plane' size='9 9 .1'/>"
            "<geom type='box' size='.5 9 9' pos='1.5 0 0'/>"
            "<body pos='0 0 5'><freejoint/><geom size='.1'/></body>"
            "<body pos='0 3 5'><freejoint/><geom size='.1'/></body></worldbody></mujoco>")),
        near(*scene.model) {
    move(p_m);
    near.start(*scene.data);
  }
  void move(const Eigen::Vector3d& p_m) {
    std::copy(p_m.begin(), p_m.end(), scene.data->qpos);
    mj_kinematics(scene.model.get(), scene.data.get());
  }
  [[nodiscard]] std::string is_near() const {
    std::string text;
    for (int geom = 0; geom < 4; ++geom) text += near.is_near(geom) ? '#' : '.';
    return text;
  }
  test::MjcfModel scene;
  NearGeoms near;
};

TEST(NearGeomsReach, Is20CentimetresOfEachThatMoves) {
  EXPECT_EQ(Neighbours({0.0, 0.0, 5.0}).is_near(), "....");
  EXPECT_EQ(Neighbours({0.71, 0.0, 5.0}).is_near(), ".##.") << "wall";
  EXPECT_EQ(Neighbours({0.69, 0.0, 5.0}).is_near(), "....");
  EXPECT_EQ(Neighbours({0.0, 0.0, 0.29}).is_near(), "#.#.") << "floor";
  EXPECT_EQ(Neighbours({0.0, 0.0, 0.31}).is_near(), "....");
  EXPECT_EQ(Neighbours({0.0, 2.41, 5.0}).is_near(), "..##") << "ball";
  EXPECT_EQ(Neighbours({0.0, 2.39, 5.0}).is_near(), "....");
}

TEST(NearGeomsReach, IsLookedAtAnewAfter10Centimetres) {
  Neighbours beside({0.65, 0.0, 5.0});
  ASSERT_EQ(beside.is_near(), "....");
  beside.move({0.74, 0.0, 5.0});
  beside.near.follow(*beside.scene.data);
  EXPECT_EQ(beside.is_near(), "....") << "not yet, since it lies within half of the reach";
  beside.move({0.76, 0.0, 5.0});
  beside.near.follow(*beside.scene.data);
  EXPECT_EQ(beside.is_near(), ".##.");
}

TEST(NearGeomsReach, FastThingsAreNearAll) {
  for (const int dof : {0, 5, 11}) {
    Neighbours far({0.0, 0.0, 5.0});
    far.scene.data->qvel[dof] = -9.9;
    far.near.follow(*far.scene.data);
    EXPECT_EQ(far.is_near(), "....") << dof;
    far.scene.data->qvel[dof] = -10.1;
    far.near.follow(*far.scene.data);
    EXPECT_EQ(far.is_near(), "####") << dof;
    far.scene.data->qvel[dof] = 9.9;
    far.near.start(*far.scene.data);
    EXPECT_EQ(far.is_near(), "....") << dof;
  }
}

TEST(NearPairs, PlanesAndHillsReachWithoutEnd) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset><hfield name='h' nrow='3' ncol='4' size='1 1 1 1'/></asset><worldbody>"
      "<geom type='plane' size='.1 .1 .1'/><geom type='hfield' hfield='h'/>"
      "<body pos='5 0 .05'><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
  for (const int endless : {0, 1}) {
    EXPECT_EQ(discard_far_pair(scene.model.get(), scene.data.get(), endless, 2), 0) << endless;
    EXPECT_EQ(discard_far_pair(scene.model.get(), scene.data.get(), 2, endless), 0) << endless;
  }
}

/// Which geoms of a scene are near another one.
std::string nearness_in(const std::string& bodies, const std::string& assets = "") {
  const auto scene = test::compile_mjcf("<mujoco><asset>" + assets + "</asset><worldbody>" +
                                        bodies + "</worldbody></mujoco>");
  NearGeoms near(*scene.model);
  near.start(*scene.data);
  std::string text;
  for (int geom = 0; geom < scene.model->ngeom; ++geom) text += near.is_near(geom) ? '#' : '.';
  return text;
}

/// Of 10 cm, falling.
std::string ball_at(const std::string& place, const std::string& masks = "") {
  return "<body pos='" + place + "'><freejoint/><geom size='.1' " + masks + "/></body>";
}

TEST(NearGeomsReach, IsThatToPlanesWhereverTheyLie) {
  const std::string raised = "<geom type='plane' size='9 9 .1' pos='0 0 1'/>";
  EXPECT_EQ(nearness_in(raised + ball_at("0 0 1.29")), "##");
  EXPECT_EQ(nearness_in(raised + ball_at("0 0 1.31")), "..");
  const std::string upright = "<geom type='plane' size='9 9 .1' pos='2 0 0' euler='0 90 0'/>";
  EXPECT_EQ(nearness_in(upright + ball_at("2.29 0 5")), "##");
  EXPECT_EQ(nearness_in(upright + ball_at("2.31 0 5")), "..");
  EXPECT_EQ(nearness_in("<geom type='plane' size='9 9 .1'/>" +
                        ball_at("0 0 " + fmt::format("{}", 0.1 + 0.2))),
            "..")
      << "at its end";
}

TEST(NearGeomsReach, HasNoEndToHillsAndToWhatIsMovedByHand) {
  EXPECT_EQ(nearness_in("<geom type='hfield' hfield='h'/>" + ball_at("0 0 9"),
                        "<hfield name='h' nrow='3' ncol='4' size='1 1 1 1'/>"),
            "##");
  for (const char* shape : {"type='plane' size='9 9 .1'", "type='box' size='.1 .1 .1'"}) {
    EXPECT_EQ(nearness_in(std::string("<body mocap='true'><geom ") + shape + "/></body>" +
                          ball_at("0 0 9")),
              "##")
        << shape;
  }
}

TEST(NearGeomsReach, IsThatOfGeomsThatOnlyAskOrAreOnlyAsked) {
  const std::string floor = "<geom type='plane' size='9 9 .1'/>";
  for (const char* masks : {"contype='1' conaffinity='0'", "contype='0' conaffinity='1'"}) {
    EXPECT_EQ(nearness_in(floor + ball_at("0 0 .29", masks)), "##") << masks;
    EXPECT_EQ(nearness_in(floor + ball_at("0 0 .31", masks)), "..") << masks;
  }
  const std::string ghost = "<geom size='.1' contype='0' conaffinity='0'/>";
  EXPECT_EQ(nearness_in(ghost + floor + ball_at("0 0 .31")).substr(1), "..") << "after a ghost";
}

TEST(NearGeomsReach, IsWithoutEndUntilItIsLookedAt) {
  const auto scene = test::compile_mjcf("<mujoco><worldbody>" + ball_at("0 0 9") +
                                        "<geom type='plane' size='9 9 .1'/></worldbody></mujoco>");
  const NearGeoms near(*scene.model);
  EXPECT_TRUE(near.is_near(0));
  EXPECT_TRUE(near.is_near(1));
}

TEST(NearGeomsReach, OfWhatIsAsFastAsTheLimitHasNoEnd) {
  Neighbours far({0.0, 0.0, 5.0});
  far.scene.data->qvel[0] = -10.0;
  far.near.follow(*far.scene.data);
  EXPECT_EQ(far.is_near(), "####");
}

TEST(NearGeomsReach, IsTheSameUntilMoreThan10CentimetresAreGone) {
  const auto scene =
      test::compile_mjcf("<mujoco><worldbody><geom type='box' size='.5 9 9' pos='.85 0 0'/>" +
                         ball_at("0 0 5") + "</worldbody></mujoco>");
  NearGeoms near(*scene.model);
  near.start(*scene.data);
  for (const auto& [x_m, is_near] : {std::pair(0.1, false), std::pair(0.11, true)}) {
    scene.data->qpos[0] = x_m;
    mj_kinematics(scene.model.get(), scene.data.get());
    near.follow(*scene.data);
    EXPECT_EQ(near.is_near(0), is_near) << x_m;
  }
}

}  // namespace
}  // namespace vantage
