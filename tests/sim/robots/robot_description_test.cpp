// What a robot's folder may say, and what it is told when it is wrong.
#include "vantage/sim/robots/robot_description.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "tests/control/flight_kit.hpp"
#include "tests/sim/test_world.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr auto kRover = R"(kind: mobile_base
model: robot.xml
base: robot/base
footprint: {inscribed_radius_m: 0.17, circumscribed_radius_m: 0.18}
drive:
  name: differential
  free_joint: robot/base
  left_wheel: robot/left_wheel
  right_wheel: robot/right_wheel
  wheel_radius_m: 0.05
  track_m: 0.27
  on_floor: [robot/left_tread]
planar_scanner: robot/base_scan
head: {pan: robot/head_pan, tilt: robot/head_tilt, camera: robot/camera}
tilting_laser: {tilt: robot/laser_tilt, site: robot/laser}
)";

std::string with(std::string text, const std::string& what, const std::string& instead) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

/// A folder outside the repository with the rover's MJCF and a robot.yaml of its own.
class Folder {
 public:
  explicit Folder(const std::string& yaml, const std::string& what = {},
                  const std::string& instead = {}) {
    write_file(path() / "robot.yaml", yaml);
    write_file(path() / "robot.xml",
               with(read_file(test::robot_folder("rover").mjcf), what, instead));
  }
  [[nodiscard]] fs::path path() const { return folder_.path(); }

 private:
  support::TemporaryDirectory folder_;
};

/// @param what of the MJCF is replaced
std::string complaint(const std::string& yaml, const std::string& what = {},
                      const std::string& instead = {}) {
  const Folder folder(yaml, what, instead);
  return test::message_of<Error>([&] {
    const RobotFolder robot = read_robot(folder.path());
    const test::SceneFolder scene(test::scene_mjcf(""));
    const World world({scene.path(), robot.mjcf});
    test::mobile_base(world, robot);
  });
}

TEST(RobotDescription, ReadsEveryRobotThatComesAlong) {
  for (const char* name : {"pr2", "rover"}) {
    const RobotFolder robot = test::robot_folder(name);
    EXPECT_GT(mobile_base_of(robot, "robot").footprint.inscribed_radius_m, 0.1) << name;
  }
  for (const char* name : {"quadrotor", "quadrotor_mini"}) {
    EXPECT_EQ(quadrotor_of(test::robot_folder(name), "robot").rotors.size(), 4U) << name;
  }
}

TEST(RobotDescription, AFolderAnywhereIsARobot) { EXPECT_EQ(complaint(kRover), ""); }

TEST(RobotDescription, AnMjcfFileInTheFolderReplacesItsOwn) {
  const Folder folder(kRover);
  fs::copy_file(folder.path() / "robot.xml", folder.path() / "variant.xml");
  EXPECT_EQ(read_robot(folder.path()).mjcf.filename(), "robot.xml");
  EXPECT_EQ(read_robot(folder.path() / "variant.xml").mjcf.filename(), "variant.xml");
}

TEST(RobotDescription, AFolderWithoutRobotYamlSaysSo) {
  const support::TemporaryDirectory empty;
  EXPECT_THAT(test::message_of<InputError>([&] { read_robot(empty.path()); }),
              AllOf(HasSubstr(empty.path().string()), HasSubstr("no robot.yaml in it")));
}

TEST(RobotDescription, WhatIsMissingIsNamed) {
  EXPECT_THAT(complaint(with(kRover, "kind: mobile_base\n", "")), HasSubstr("kind: missing"));
  EXPECT_THAT(complaint(with(kRover, "model: robot.xml\n", "")), HasSubstr("model: missing"));
  EXPECT_THAT(complaint(with(kRover, "robot.xml", "other.xml")),
              AllOf(HasSubstr("robot.yaml:2: model"), HasSubstr("other.xml: no such file")));
  EXPECT_THAT(complaint(with(kRover, "base: robot/base\n", "")), HasSubstr("base: missing"));
  EXPECT_THAT(complaint(with(kRover, "  left_wheel: robot/left_wheel\n", "")),
              AllOf(HasSubstr("drive"), HasSubstr("left_wheel: missing")));
  EXPECT_THAT(complaint(with(kRover, "inscribed_radius_m: 0.17, ", "")),
              HasSubstr("inscribed_radius_m: missing"));
  EXPECT_THAT(complaint(with(kRover, "  on_floor: [robot/left_tread]\n", "")),
              HasSubstr("on_floor: missing"));
}

TEST(RobotDescription, WhatTheModelLacksIsNamedWithWhatItHas) {
  EXPECT_THAT(complaint(with(kRover, "robot/head_pan", "robot/neck")),
              AllOf(HasSubstr("robot.yaml: head.pan"), HasSubstr("no joint 'robot/neck'"),
                    HasSubstr("robot/head_tilt")));
  EXPECT_THAT(complaint(with(kRover, "site: robot/laser", "site: robot/lidar")),
              AllOf(HasSubstr("tilting_laser.site"), HasSubstr("no site 'robot/lidar'"),
                    HasSubstr("robot/base_scan")));
  EXPECT_THAT(complaint(with(kRover, "[robot/left_tread]", "[robot/tyre]")),
              AllOf(HasSubstr("drive.on_floor"), HasSubstr("no geom 'robot/tyre'")));
}

TEST(RobotDescription, JointsMustBeWhatTheKeySays) {
  EXPECT_THAT(complaint(with(kRover, "pan: robot/head_pan", "pan: robot/head_tilt")),
              AllOf(HasSubstr("head.pan"), HasSubstr("axis")));
  EXPECT_THAT(complaint(with(kRover, "left_wheel: robot/left_wheel", "left_wheel: robot/base")),
              HasSubstr("joint 'robot/base' is no hinge"));
  EXPECT_THAT(complaint(with(kRover, "free_joint: robot/base", "free_joint: robot/head_pan")),
              HasSubstr("not the free joint of body 'robot/base'"));
}

TEST(RobotDescription, LasersMustBeMountedAsTheyAreReckonedWith) {
  const std::string scanner = "<site name=\"robot/base_scan\" ";
  EXPECT_EQ(complaint(kRover, scanner, scanner + "euler=\"0 0 0.7\" "), "") << "it may be turned";
  EXPECT_THAT(complaint(kRover, scanner, scanner + "euler=\"3.14159265 0 0\" "),
              HasSubstr("planar_scanner: its z axis is"))
      << "upside down, left and right change places";
  const std::string laser = "<site name=\"robot/laser\"";
  EXPECT_THAT(complaint(kRover, laser, laser + " euler=\"0 0 3.14159265\""),
              HasSubstr("tilting_laser.site: its y axis is"));
  EXPECT_THAT(complaint(kRover, laser, laser + " euler=\"0 0.1 0\""),
              HasSubstr("tilting_laser.site: its z axis is"));
  EXPECT_EQ(complaint(kRover, laser, laser + " pos=\"0.0009 0.1 0\""), "");
  EXPECT_THAT(complaint(kRover, laser, laser + " pos=\"0.03 0 0.04\""),
              HasSubstr("tilting_laser.site: it is 0.05 m beside the axis of joint "
                        "'robot/laser_tilt'"));
}

/// In a case that the beams would not get out of, if it were not the scanner's own.
TEST(RobotDescription, AScannerMayHaveABodyOfItsOwnThatStandsStill) {
  const std::string site = "<site name=\"robot/base_scan\" pos=\"0.085 0 0.170\"/>";
  const std::string body = "<body name=\"robot/case\">" + site;
  EXPECT_EQ(complaint(kRover, site, body + "</body>"), "");
  EXPECT_THAT(complaint(kRover, site,
                        body + "<joint/><geom type=\"sphere\" size=\"0.01\" mass=\"1\"/></body>"),
              HasSubstr("planar_scanner: it moves against body 'robot/base'"));
}

TEST(RobotDescription, AHeadLooksAheadAtRest) {
  const std::string camera = "<camera name=\"robot/camera\" pos=\"0.030 0 0\" xyaxes=\"0 -1 0 ";
  EXPECT_THAT(complaint(kRover, camera + "0 0 1", camera + "0.3 0 0.954"),
              HasSubstr("head.camera: it must look along the base's x"));
}

constexpr auto kSlider = R"(kind: mobile_base
model: robot.xml
base: robot/base
footprint: {inscribed_radius_m: 0.1, circumscribed_radius_m: 0.15}
drive: {name: omnidirectional, x: robot/x, y: robot/y, yaw: robot/yaw}
planar_scanner: robot/base_scan
)";

/// @param body attributes @param joints of it
std::string slider_complaint(const std::string& body, const std::vector<std::string>& joints) {
  const support::TemporaryDirectory folder;
  write_file(folder.path() / "robot.yaml", kSlider);
  std::string text = "<mujoco><worldbody><body name='robot/base' " + body + ">";
  for (const std::string& joint : joints) text += "<joint " + joint + "/>";
  text +=
      "<geom size='.1' pos='0 0 .1'/><site name='robot/base_scan' pos='0 0 .25'/></body>"
      "</worldbody><actuator>";
  for (const char* name : {"x", "y", "yaw"}) {
    text += std::string("<velocity name='robot/") + name + "' joint='robot/" + name +
            "' ctrllimited='true' ctrlrange='-1 1'/>";
  }
  write_file(folder.path() / "robot.xml", text + "</actuator></mujoco>");
  return test::message_of<Error>([&] {
    const RobotFolder robot = read_robot(folder.path());
    const test::SceneFolder scene(test::scene_mjcf(""));
    const World world({scene.path(), robot.mjcf});
    test::mobile_base(world, robot);
  });
}

TEST(RobotDescription, SlidesAreThoseOfTheWorld) {
  const std::string x = "name='robot/x' type='slide' axis='1 0 0'";
  const std::string y = "name='robot/y' type='slide' axis='0 1 0'";
  const std::string yaw = "name='robot/yaw' axis='0 0 1'";
  EXPECT_EQ(slider_complaint("", {x, y, yaw}), "");
  EXPECT_EQ(slider_complaint("pos='0 0 .02'", {x, y, yaw}), "");
  EXPECT_THAT(slider_complaint("", {yaw, x, y}), HasSubstr("drive: the joints must all be those"));
  for (const char* off : {"pos='1 0 0'", "euler='0 0 90'"}) {
    EXPECT_THAT(slider_complaint(off, {x, y, yaw}), HasSubstr("upright over the origin")) << off;
  }
  EXPECT_THAT(slider_complaint("", {"name='robot/x' axis='1 0 0'", y, yaw}),
              HasSubstr("drive.x: joint 'robot/x' is no slide"));
}

TEST(RobotDescription, UnknownKindsAndKeysAreErrors) {
  EXPECT_THAT(complaint(with(kRover, "mobile_base", "submarine")),
              AllOf(HasSubstr("submarine"), HasSubstr("mobile_base, quadrotor")));
  EXPECT_THAT(complaint(std::string(kRover) + "rotors: [a]\n"),
              AllOf(HasSubstr("rotors"), HasSubstr("quadrotor")));
  EXPECT_THAT(complaint(with(kRover, "name: differential", "name: tracked")),
              AllOf(HasSubstr("tracked"), HasSubstr("omnidirectional, differential")));
  EXPECT_THAT(complaint(with(kRover, "inscribed_radius_m: 0.17", "inscribed_radius_m: 0.2")),
              HasSubstr("above circumscribed_radius_m"));
  for (const char* corners : {"[[0, 0], [1, 0]]", "[[0, 0], [1, 0], [2, 0]]",
                              "[[0, 0], [0.1, 0.1], [0.3, 0.3], [0.1, 0.1]]"}) {
    const std::string outline = std::string("footprint: {outline_m: ") + corners + ", ";
    EXPECT_THAT(complaint(with(kRover, "footprint: {", outline)),
                AllOf(HasSubstr("footprint"), HasSubstr("outline_m"), HasSubstr("enclose nothing")))
        << corners;
  }
}

TEST(RobotDescription, TheKindMustSuitTheTask) {
  const RobotFolder robot = test::robot_folder("quadrotor");
  EXPECT_THAT(test::message_of<ConfigError>([&] { mobile_base_of(robot, "robot.model"); }),
              AllOf(HasSubstr("robot.model"), HasSubstr("models/robots/quadrotor is a quadrotor"),
                    HasSubstr("needs a mobile_base")));
}

TEST(RobotDescription, ASensorThatIsNotThereIsMissedWhereItIsNeeded) {
  const std::string blind =
      with(kRover, "tilting_laser: {tilt: robot/laser_tilt, site: robot/laser}\n", "");
  const Folder folder(blind);
  const RobotFolder robot = read_robot(folder.path());
  const test::SceneFolder scene(test::scene_mjcf(""));
  World world({scene.path(), robot.mjcf});
  const MobileBase base = test::mobile_base(world, robot);
  EXPECT_TRUE(base.has_head());
  EXPECT_FALSE(base.has_tilting_laser());
  EXPECT_THAT(test::message_of<InputError>([&] { base.command_laser_tilt(world, 0.0); }),
              HasSubstr("robot.yaml: tilting_laser: missing"));
}

/// The small quadrotor with changes in its MJCF.
std::string flight_complaint(const std::vector<std::pair<std::string, std::string>>& changes) {
  const support::TemporaryDirectory folder;
  const RobotFolder mini = test::robot_folder("quadrotor_mini");
  write_file(folder.path() / "robot.yaml", read_file(mini.description));
  std::string mjcf = read_file(mini.mjcf);
  for (const auto& [what, instead] : changes) mjcf = with(mjcf, what, instead);
  write_file(folder.path() / "quadrotor_mini.xml", mjcf);
  return test::message_of<InputError>([&] {
    const RobotFolder robot = read_robot(folder.path());
    const test::SceneFolder scene(test::scene_mjcf(""));
    const World world({scene.path(), robot.mjcf}, kFlightWorld);
    Quadrotor(world.model(), quadrotor_of(robot, "robot"), "mini", scene.path().string());
  });
}
std::string flight_complaint(const std::string& what, const std::string& instead) {
  return flight_complaint({{what, instead}});
}

TEST(RobotDescription, AQuadrotorMustBeAbleToFly) {
  EXPECT_THAT(flight_complaint("dynprm=\"0.025\" ctrlrange=\"0 4\" forcerange=\"0 4\"",
                               "dynprm=\"0.025\" ctrlrange=\"0 1.4\" forcerange=\"0 1.4\""),
              AllOf(HasSubstr("rotors"), HasSubstr("do not carry")));
  EXPECT_THAT(flight_complaint("gear=\"0 0 1 0 0 -0.012\"/>\n    <general name=\"robot/rotor_1\"",
                               "gear=\"0 0 1 0 0 0.012\"/>\n    <general name=\"robot/rotor_1\""),
              AllOf(HasSubstr("rotors"), HasSubstr("two of which turn each way")));
  for (const char* range : {"0 4.5", "0.1 4", "-4 4"}) {
    const std::string own = std::string("ctrlrange=\"") + range + "\" ";
    EXPECT_THAT(flight_complaint("<general name=\"robot/rotor_2\" ",
                                 "<general name=\"robot/rotor_2\" " + own),
                AllOf(HasSubstr("mini: rotors: actuator 'robot/rotor_2' has the ctrlrange"),
                      HasSubstr("0 4")))
        << range;
  }
  EXPECT_THAT(flight_complaint("xyaxes=\"0 -1 0 0 0 1\"", "xyaxes=\"1 0 0 0 0 1\""),
              AllOf(HasSubstr("camera"), HasSubstr("look along")));
}

TEST(RobotDescription, ARotorPushesAlongItsSitesAxisAlone) {
  const std::string next = "/>\n    <general name=\"robot/rotor_1\"";
  for (const char* gear : {"1 0 1 0 0 -0.012", "0 1 1 0 0 -0.012", "0 0 2 0 0 -0.012",
                           "0 0 1 1 0 -0.012", "0 0 1 0 1 -0.012"}) {
    EXPECT_THAT(flight_complaint("gear=\"0 0 1 0 0 -0.012\"" + next,
                                 std::string("gear=\"") + gear + "\"" + next),
                HasSubstr("mini: rotors: actuator 'robot/rotor_0' must act at a site"))
        << gear;
  }
  const std::string site = "<site name=\"robot/rotor_0\" ";
  EXPECT_THAT(flight_complaint(site, site + "euler=\"0.1 0 0\" "),
              HasSubstr("the site of actuator 'robot/rotor_0' must have its z axis up"));
  EXPECT_EQ(flight_complaint(site, site + "euler=\"0 0.03 0\" "), "");
}

TEST(RobotDescription, ItsFileStandsForItsFolder) {
  const Folder folder(std::string(kRover) + "episode_defaults: {exploration: {a: 1}}\n");
  const RobotFolder robot = read_robot(folder.path() / "robot.yaml");
  EXPECT_EQ(robot.mjcf, folder.path() / "robot.xml");
  EXPECT_EQ(robot.description, folder.path() / "robot.yaml");
  EXPECT_NE(robot.episode_defaults.find("exploration"), nullptr);
  const support::TemporaryDirectory bare;
  fs::copy_file(folder.path() / "robot.xml", bare.path() / "robot.xml");
  EXPECT_THAT(test::message_of<InputError>([&] { read_robot(bare.path() / "robot.xml"); }),
              HasSubstr("no robot.yaml beside it"));
}

TEST(RobotDescription, AQuadrotorsCameraIsOnABodyThatItsServoTilts) {
  const std::string camera =
      "<camera name=\"robot/camera\" pos=\"0.015 0 0\" xyaxes=\"0 -1 0 0 0 1\"/>";
  EXPECT_EQ(flight_complaint(camera, "<body>" + camera + "</body>"),
            "mini: camera: it must be on a body of its own, a child of the base");
  EXPECT_EQ(flight_complaint({{camera, ""}, {"<!-- Legs. -->", "<body>" + camera + "</body>"}}),
            "mini: camera_tilt: it must tilt the camera");
  const std::string joint = "<joint name=\"robot/camera_tilt\" ";
  EXPECT_THAT(flight_complaint(joint, joint + "pos=\"0 0 0.02\" "),
              HasSubstr("mini: camera_tilt: it is 0.02 m beside the axis"));
}

TEST(RobotDescription, ARotorIsAnActuatorAtASiteWithARangeAndALag) {
  const std::string at_site = "mini: rotors: actuator 'robot/rotor_0' must act at a site";
  EXPECT_THAT(flight_complaint("site=\"robot/rotor_0\" gear", "jointinparent=\"robot/base\" gear"),
              HasSubstr(at_site));
  EXPECT_THAT(flight_complaint("site=\"robot/rotor_0\" gear",
                               "site=\"robot/rotor_0\" ctrllimited=\"false\" gear"),
              HasSubstr(at_site));
  EXPECT_EQ(flight_complaint("dyntype=\"filter\" dynprm=\"0.025\" ctrlrange", "ctrlrange"),
            "mini: rotors: actuator 'robot/rotor_0' must have a lag: dyntype=\"filter\"");
}

TEST(RobotDescription, DefaultsOfAnEpisodeAreKeys) {
  EXPECT_THAT(complaint(std::string(kRover) + "episode_defaults: 3\n"),
              HasSubstr("robot.yaml:16: episode_defaults"));
}

TEST(RobotDescription, RotorsHaveTheRangeOfTheFirst) {
  EXPECT_THAT(flight_complaint("<general name=\"robot/rotor_3\" ",
                               "<general name=\"robot/rotor_3\" ctrlrange=\"0 4.5\" "),
              HasSubstr("mini: rotors: actuator 'robot/rotor_3' has the ctrlrange 0 4.5"));
}

TEST(RobotDescription, ACameraMayLookAThousandthAside) {
  const std::string ahead = "xyaxes=\"0 -1 0 0 0 1\"";
  EXPECT_EQ(flight_complaint(ahead, "xyaxes=\"0.0009 -1 0 0 0 1\""), "");
  EXPECT_THAT(flight_complaint(ahead, "xyaxes=\"0.0018 -1 0 0 0 1\""), HasSubstr("look along"));
}

}  // namespace
}  // namespace vantage
