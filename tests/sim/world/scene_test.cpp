#include "vantage/sim/world/scene.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <thread>

#include "tests/sim/test_world.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using test::message_of;
using test::SceneFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string scene_complaint(const ModelSource& source) {
  return message_of<InputError>([&] { load_model(source); });
}
std::string scene_complaint(const std::string& mjcf) {
  return scene_complaint(SceneFolder(mjcf).with_pr2());
}

TEST(Scene, NamesAMissingFile) {
  EXPECT_EQ(scene_complaint(ModelSource{"nowhere/scene.xml", {}}),
            "nowhere/scene.xml: no such file");
  const SceneFolder folder(test::scene_mjcf(""));
  EXPECT_EQ(scene_complaint(ModelSource{folder.path(), "r2d2.xml"}), "r2d2.xml: no such file");
}

TEST(Scene, MalformedMjcfNamesFileAndLine) {
  const SceneFolder wrong_value(test::scene_mjcf("<geom size='x'/>"));
  EXPECT_THAT(
      scene_complaint(wrong_value.with_pr2()),
      AllOf(StartsWith(wrong_value.path().string()), HasSubstr("size"), HasSubstr("line 4")));
  const SceneFolder not_xml("<mujoco>\n<worldbody>\n<geom");
  EXPECT_THAT(scene_complaint(not_xml.alone()),
              AllOf(StartsWith(not_xml.path().string()), HasSubstr("Line number=3")));
  const SceneFolder robot_wrong("<mujoco><nonsense/></mujoco>");
  const SceneFolder scene(test::scene_mjcf(""));
  EXPECT_THAT(scene_complaint(ModelSource{scene.path(), robot_wrong.path()}),
              StartsWith(robot_wrong.path().string()));
}

TEST(Scene, RejectsNumbersThatAreNotFinite) {
  EXPECT_NE(scene_complaint(test::scene_mjcf("<geom size='.1' pos='nan 0 0'/>")), "");
  EXPECT_NE(
      scene_complaint(test::scene_mjcf("<body pos='0 0 nan'><freejoint/><geom size='.1'/></body>")),
      "");
  EXPECT_NE(
      scene_complaint(test::scene_mjcf("<body><freejoint/><geom size='.1' mass='inf'/></body>")),
      "");
  EXPECT_NE(scene_complaint(test::scene_mjcf("<body><freejoint/><geom size='inf'/></body>")), "");
}

TEST(Scene, RejectsTimeSteps) {
  for (const char* timestep : {"0", "-1", "1e10", "nan"}) {
    EXPECT_NE(scene_complaint("<mujoco><option timestep='" + std::string(timestep) +
                              "'/><worldbody/></mujoco>"),
              "")
        << timestep;
  }
}

TEST(Scene, RejectsNamesOfTheRobot) {
  const std::string taken = test::scene_mjcf("<body name='robot/arm'><geom size='.1'/></body>");
  EXPECT_THAT(scene_complaint(taken), HasSubstr("'robot/arm'"));
  EXPECT_EQ(scene_complaint(SceneFolder(taken).alone()), "") << "without a robot the name is free";
}

/// A scene with every setting that could hurt the robot, or be lost on the way to it:
/// degrees, folders for meshes, nested includes, defaults, keyframes, small buffers.
struct DifficultScene : SceneFolder {
  DifficultScene()
      : SceneFolder(R"(
    <mujoco model="difficult">
      <compiler angle="degree" meshdir="meshes" autolimits="true" eulerseq="zyx"/>
      <option timestep="0.007" gravity="0 0 -9.81"/>
      <size njmax="77" nconmax="33"/>
      <default>
        <geom contype="2" rgba="1 0 0 1" friction="0.3 0.1 0.1" mass="7" margin="0.1"/>
        <joint damping="7" stiffness="3" type="slide"/>
        <site size="0.5"/>
        <general dyntype="filter" dynprm="3" gear="5" biastype="none"/>
        <default class="round"><geom type="capsule" size="0.3 0.3"/></default>
      </default>
      <asset>
        <texture name="grid" type="2d" builtin="checker" width="64" height="64"/>
        <texture type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0 0 0" width="16" height="16"/>
        <material name="grid" texture="grid" texrepeat="3 3"/>
        <mesh name="tetra" file="sub/tetra.obj" scale="0.5 1 1"/>
      </asset>
      <worldbody>
        <geom name="floor" type="plane" size="5 5 .1" material="grid"/>
        <geom name="tetra" type="mesh" mesh="tetra" pos="1 2 0.5" euler="30 20 10"/>
        <geom name="pill" class="round" pos="3 3 0.6"/>
        <include file="parts/door.xml"/>
      </worldbody>
      <keyframe><key name="open" qpos="0.3"/></keyframe>
    </mujoco>)") {
    add("parts/door.xml", "<mujocoinclude><include file='parts/hinge.xml'/></mujocoinclude>");
    add("parts/hinge.xml", R"(
    <mujocoinclude>
      <body name="door" pos="0 4 1">
        <joint name="hinge" type="hinge" range="-90 45"/>
        <geom name="leaf" type="box" size=".4 .02 .9"/>
      </body>
    </mujocoinclude>)");
    add("meshes/sub/tetra.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }
};

/// Names and numbers of a robot, for comparing it in two models.
struct RobotFigures {
  std::vector<double> numbers;
  explicit RobotFigures(const mjModel& m) {
    const auto add = [&](const mjtNum* values, int count) {
      numbers.insert(numbers.end(), values, values + count);
    };
    const auto is_robot = [&](int body) {
      return model_name(m, ModelObject::body, body).starts_with("robot/");
    };
    for (int body = 0; body < m.nbody; ++body) {
      if (!is_robot(body)) continue;
      numbers.push_back(m.body_mass[body]);
      add(m.body_pos + 3 * body, 3);
    }
    for (int geom = 0; geom < m.ngeom; ++geom) {
      if (!is_robot(m.geom_bodyid[geom])) continue;
      numbers.push_back(m.geom_type[geom]);
      numbers.push_back(m.geom_contype[geom]);
      numbers.push_back(m.geom_conaffinity[geom]);
      numbers.push_back(m.geom_margin[geom]);
      add(m.geom_size + 3 * geom, 3);
      add(m.geom_pos + 3 * geom, 3);
      add(m.geom_quat + 4 * geom, 4);
      add(m.geom_friction + 3 * geom, 3);
    }
    for (int joint = 0; joint < m.njnt; ++joint) {
      if (!is_robot(m.jnt_bodyid[joint])) continue;
      numbers.push_back(m.jnt_type[joint]);
      numbers.push_back(m.jnt_limited[joint]);
      numbers.push_back(m.jnt_stiffness[joint]);
      numbers.push_back(m.dof_damping[m.jnt_dofadr[joint]]);
      add(m.jnt_range + 2 * joint, 2);
    }
    add(m.actuator_gear, 6 * m.nu);
    add(m.actuator_gainprm, mjNGAIN * m.nu);
    add(m.actuator_biasprm, mjNBIAS * m.nu);
    add(m.actuator_ctrlrange, 2 * m.nu);
    add(m.actuator_forcerange, 2 * m.nu);
    numbers.insert(numbers.end(), m.actuator_dyntype, m.actuator_dyntype + m.nu);
    for (int site = 0; site < m.nsite; ++site) {
      if (is_robot(m.site_bodyid[site])) add(m.site_pos + 3 * site, 3);
    }
  }
};

TEST(Scene, ARobotThatRefersToFilesIsAnError) {
  const SceneFolder folder(test::scene_mjcf(""));
  folder.add("part.xml", "<mujoco><option/></mujoco>");
  folder.add("robot.xml",
             "<mujoco><include file=\"part.xml\"/><worldbody><body name='robot/base'>"
             "<geom size='.1'/></body></worldbody></mujoco>");
  EXPECT_THAT(
      scene_complaint(ModelSource{folder.path(), folder.path().parent_path() / "robot.xml"}),
      AllOf(HasSubstr("robot.xml: refers to 'part.xml'"), HasSubstr("primitives")));
}

TEST(Scene, TheRobotIsTheSameInAnyScene) {
  const LoadedModel pr2 = load_model({test::pr2_file(), {}});
  const LoadedModel plain = load_model(SceneFolder(test::scene_mjcf("")).with_pr2());
  const LoadedModel difficult = load_model(DifficultScene().with_pr2());
  const std::vector<double> expected = RobotFigures(*pr2.model).numbers;
  EXPECT_GT(expected.size(), 300U);
  EXPECT_EQ(RobotFigures(*plain.model).numbers, expected);
  EXPECT_EQ(RobotFigures(*difficult.model).numbers, expected);
}

TEST(Scene, TheSceneIsTheSameBesideTheRobot) {
  const DifficultScene folder;
  const LoadedModel loaded = load_model(folder.with_pr2());
  const mjModel& m = *loaded.model;
  const int hinge = model_id(m, ModelObject::joint, "hinge");
  EXPECT_NEAR(m.jnt_range[2 * hinge], -std::numbers::pi / 2.0, 1e-5);
  EXPECT_NEAR(m.jnt_range[2 * hinge + 1], std::numbers::pi / 4.0, 1e-5);
  EXPECT_EQ(m.jnt_limited[hinge], 1);
  const int pill = model_id(m, ModelObject::geom, "pill");
  EXPECT_EQ(m.geom_type[pill], mjGEOM_CAPSULE);
  EXPECT_EQ(m.geom_contype[pill], 2);
  EXPECT_EQ(m.nmesh, 1);
  EXPECT_EQ(m.ntex, 2);
  EXPECT_EQ(m.geom_matid[model_id(m, ModelObject::geom, "floor")], 0);
  EXPECT_EQ(m.nkey, 0);
  EXPECT_THAT(loaded.warnings, IsEmpty());

  // The mesh lies where it did, though MuJoCo moves meshes to their centre of mass.
  const LoadedModel alone = load_model(folder.alone());
  const int tetra = model_id(m, ModelObject::geom, "tetra");
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(m.geom_pos[3 * tetra + i], alone.model->geom_pos[3 * tetra + i], 1e-5);
  }
}

TEST(Scene, BuffersHoldSceneAndRobot) {
  const LoadedModel loaded = load_model(DifficultScene().with_pr2());
  const LoadedModel pr2 = load_model({test::pr2_file(), {}});
  EXPECT_EQ(loaded.model->njmax, 77 + pr2.model->njmax);
  EXPECT_EQ(loaded.model->nconmax, 33 + pr2.model->nconmax);
}

TEST(Scene, RefusesWhatWouldChangeBesideTheRobot) {
  EXPECT_THAT(scene_complaint("<mujoco><compiler settotalmass='50'/><worldbody><body name='stone'>"
                              "<freejoint/><geom size='.1'/></body></worldbody></mujoco>"),
              AllOf(HasSubstr("mass of body 'stone'"), HasSubstr("settotalmass")));
}

TEST(Scene, WorksFromARelativePath) {
  const DifficultScene folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path().parent_path());
  EXPECT_EQ(scene_complaint(ModelSource{"scene.xml", test::pr2_file()}), "");
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
  std::filesystem::current_path(before);
}

TEST(Scene, LoadsInSeveralThreads) {
  const DifficultScene folder;
  std::vector<int> bodies(4, 0);
  std::vector<std::thread> threads;
  for (int& count : bodies) {
    threads.emplace_back([&] { count = load_model(folder.with_pr2()).model->nbody; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(bodies, ::testing::Each(load_model(folder.with_pr2()).model->nbody));
}

TEST(Scene, FilesInMemoryStandInForThoseItRefersTo) {
  const SceneFolder folder(R"(
    <mujoco>
      <compiler meshdir="meshes"/>
      <worldbody><geom name="floor" type="plane" size="1 1 1"/></worldbody>
      <include file="object.xml"/>
    </mujoco>)");
  folder.add("object.xml", "<mujoco><worldbody><body name='stand_in'/></worldbody></mujoco>");
  ModelSource source = folder.with_pr2();
  EXPECT_GE(mj_name2id(load_model(source).model.get(), mjOBJ_BODY, "stand_in"), 0);
  source.files = {{"object.xml", R"(
    <mujoco>
      <asset><mesh name="object" file="object.obj"/></asset>
      <worldbody><body name="object"><geom type="mesh" mesh="object"/></body></worldbody>
    </mujoco>)"},
                  {"object.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                   "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"}};
  for (const std::filesystem::path& robot : {source.robot, std::filesystem::path()}) {
    source.robot = robot;
    const LoadedModel loaded = load_model(source);
    EXPECT_GE(mj_name2id(loaded.model.get(), mjOBJ_BODY, "object"), 0);
    EXPECT_LT(mj_name2id(loaded.model.get(), mjOBJ_BODY, "stand_in"), 0);
    EXPECT_GT(loaded.model->nmesh, 0);
  }
}

TEST(Scene, SaysWhatIsWrongInOneLine) {
  for (const char* geom : {"<geom size='x'/>", "<geom type='box'/>", "<geom nonsense='1'/>"}) {
    const std::string said = scene_complaint(test::scene_mjcf(geom));
    EXPECT_NE(said, "") << geom;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(Scene, RejectsWhatIsNotANumberInWhateverAttribute) {
  for (const char* geom : {"<geom size='.1' margin='nan'/>", "<geom size='.1' rgba='nan 0 0 1'/>",
                           "<geom size='.1' solref='nan 1'/>"}) {
    const SceneFolder folder(test::scene_mjcf(geom));
    EXPECT_THAT(scene_complaint(folder.alone()),
                AllOf(StartsWith(folder.path().string() + ": "), HasSubstr("NaN")))
        << geom;
  }
}

TEST(Scene, ThatIsNoFileRejectsWhatIsNotANumberToo) {
  EXPECT_THAT(message_of<InputError>([] {
                load_model(test::scene_mjcf("<geom size='.1' margin='nan'/>"), {}, "made up");
              }),
              AllOf(StartsWith("made up: "), HasSubstr("NaN")));
}

/// In processes of their own, where nothing has been loaded before.
TEST(Scene, ListensToMuJoCoFromTheFirstOneOn) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  for (const char* first :
       {"RejectsWhatIsNotANumberInWhateverAttribute", "ThatIsNoFileRejectsWhatIsNotANumberToo"}) {
    const std::string call = "'" + self + "' --gtest_brief=1 --gtest_filter=Scene." + first;
    EXPECT_EQ(std::system(call.c_str()), 0) << first;
  }
}

/// Files of this process that are open.
std::ptrdiff_t open_files() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

TEST(Scene, LeavesNoFilesBehind) {
  const SceneFolder folder(test::scene_mjcf(""));
  const support::TemporaryDirectory place;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("TMPDIR", place.path().c_str(), 1);
  load_model(folder.with_pr2());
  const std::ptrdiff_t open = open_files();
  load_model(folder.with_pr2());
  EXPECT_EQ(open_files(), open);
  EXPECT_TRUE(std::filesystem::is_empty(place.path()));
  ::unsetenv("TMPDIR");
  if (!kept.empty()) ::setenv("TMPDIR", kept.c_str(), 1);
}

TEST(Scene, SaysWhereItIsWrongAtTheEnd) {
  const std::string said = scene_complaint(test::scene_mjcf("<geom size='x'/>"));
  EXPECT_THAT(said, ::testing::EndsWith("line 4")) << said;
  EXPECT_THAT(said, HasSubstr(", Element 'geom', line 4")) << said;
}

TEST(Scene, ThatAsksForTooLittleStackGetsMore) {
  const SceneFolder folder(
      "<mujoco><size nstack='10'/><worldbody><geom type='plane' size='1 1 1'/>"
      "<body pos='0 0 .05'><freejoint/><geom type='box' size='.1 .1 .1'/></body></worldbody>"
      "</mujoco>");
  EXPECT_EQ(load_model(folder.alone()).model->nstack, 16000000);
}

}  // namespace
}  // namespace vantage
