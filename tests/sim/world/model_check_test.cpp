#include "vantage/sim/world/model_check.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "tests/sim/test_world.hpp"
#include "tests/support/mjcf.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

test::MjcfModel ball() {
  return test::compile_mjcf(
      "<mujoco><worldbody><body name='ball'><freejoint/><geom name='skin' size='.1'/></body>"
      "</worldbody></mujoco>");
}

std::string complaint(const test::MjcfModel& scene) {
  return message_of<InputError>([&] { check_model(*scene.model, "ball.xml"); });
}

TEST(ModelCheck, AcceptsAHealthyModel) { EXPECT_EQ(complaint(ball()), ""); }

TEST(ModelCheck, RejectsTimeStepsThatMujocoAccepts) {
  const test::MjcfModel scene = ball();
  for (const double timestep_s : {0.0, -1.0, 1e10, 0.11, kNan, kInfinity}) {
    scene.model->opt.timestep = timestep_s;
    EXPECT_THAT(complaint(scene), StartsWith("ball.xml: option timestep is ")) << timestep_s;
  }
}

TEST(ModelCheck, NamesTheObjectWhoseNumberIsNotFinite) {
  const test::MjcfModel position = ball();
  position.model->body_pos[3] = kNan;
  EXPECT_EQ(complaint(position), "ball.xml: position of body 'ball' is nan");
  const test::MjcfModel mass = ball();
  mass.model->body_mass[1] = kInfinity;
  EXPECT_EQ(complaint(mass), "ball.xml: mass of body 'ball' is inf");
  const test::MjcfModel size = ball();
  size.model->geom_size[0] = kNan;
  EXPECT_EQ(complaint(size), "ball.xml: size of geom 'skin' is nan");
  const test::MjcfModel start = ball();
  start.model->qpos0[2] = kNan;
  EXPECT_THAT(complaint(start), AllOf(HasSubstr("qpos0"), HasSubstr("number 2 is nan")));
  const test::MjcfModel gravity = ball();
  gravity.model->opt.gravity[2] = -kInfinity;
  EXPECT_THAT(complaint(gravity), HasSubstr("gravity"));
}

TEST(ModelCheck, FindsNamesThatBelongToTheRobot) {
  const test::MjcfModel scene = test::compile_mjcf(
      "<mujoco><worldbody><body name='robot'/><body name='my_robot/x'/></worldbody></mujoco>");
  EXPECT_NO_THROW(check_no_robot_names(*scene.model, "a.xml"));
  const test::MjcfModel taken =
      test::compile_mjcf("<mujoco><worldbody><site name='robot/laser'/></worldbody></mujoco>");
  EXPECT_THAT(message_of<InputError>([&] { check_no_robot_names(*taken.model, "a.xml"); }),
              AllOf(StartsWith("a.xml: "), HasSubstr("'robot/laser'"), HasSubstr("rename")));
}

TEST(ModelCheck, ARobotNamesNoFilesHoweverItIsWritten) {
  const auto named = [](const std::string& mjcf) {
    return message_of<InputError>([&] { check_no_files(mjcf, "r.xml"); });
  };
  for (const char* mesh :
       {"<mesh file=\"a.stl\"/>", "<mesh name='m' file='a.stl'/>", "<mesh\n file = \"a.stl\"/>",
        "<mesh\tfile= 'a.stl'/>", "<mesh name='m'file='a.stl'/>", "<texture fileright='a.stl'/>"}) {
    EXPECT_THAT(named(std::string("<mujoco><asset>") + mesh + "</asset></mujoco>"),
                StartsWith("r.xml: refers to 'a.stl'; "))
        << mesh;
  }
  EXPECT_EQ(named("<mujoco><!-- <mesh file=\"a.stl\"/> --><geom name='x file=\"a\"'/></mujoco>"),
            "");
}

TEST(ModelCheck, FindsWhatChangedBesideTheRobot) {
  const test::MjcfModel alone = ball();
  const test::MjcfModel both = ball();
  both.model->geom_pos[0] += 1e-7;
  EXPECT_NO_THROW(check_same_scene(*alone.model, *both.model, "a.xml"));
  both.model->body_mass[1] *= 1.01;
  EXPECT_THAT(message_of<InputError>([&] { check_same_scene(*alone.model, *both.model, "a.xml"); }),
              HasSubstr("mass of body 'ball'"));
}

}  // namespace
}  // namespace vantage
