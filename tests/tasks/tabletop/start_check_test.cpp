// What `vantage validate` says of a mapping task before it runs.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/tasks/tabletop/own_scene.hpp"
#include "vantage/tasks/validate.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using support::kWalls;
using support::objects_on;
using support::OwnScene;
using support::table_at;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kTable = table_at(0.0, 0.0, 0.72, 0.5, 0.5) + objects_on(0.72);
const std::string kLow = table_at(0.0, 0.0, 0.42, 0.5, 0.5) + objects_on(0.42);

Validation validated(const std::string& episode, const OwnScene& scene,
                     std::vector<std::string> more) {
  more.push_back(scene.set());
  return validate_episode(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes" / (episode + ".yaml"),
                          more);
}

std::string problem(const Validation& found) {
  return found.problems.size() == 1 ? found.problems.front() : "";
}

TEST(ValidateTableTop, AGoodSceneIsGood) {
  for (const std::string& table : {kTable, kLow}) {
    const Validation found = validated("tabletop", OwnScene(table + kWalls), {});
    EXPECT_THAT(found.problems, IsEmpty());
    EXPECT_THAT(found.notes, IsEmpty());
  }
}

TEST(ValidateTableTop, NothingToLocaliseByIsSaid) {
  const Validation found = validated("tabletop", OwnScene(kTable), {});
  EXPECT_THAT(found.problems, IsEmpty());
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_THAT(found.notes[0], AllOf(HasSubstr("tabletop.yaml: note: registration"),
                                    HasSubstr("base_scanner.range_max_m 10")));
}

TEST(ValidateTableTop, AMapThatMissesTheTable) {
  const OwnScene low(kLow + kWalls);
  const Validation above = validated("tabletop", low, {"map.centre_m=[0,0,0.982]"});
  EXPECT_EQ(above.code, ExitCode::usage);
  EXPECT_THAT(problem(above),
              AllOf(HasSubstr("tabletop.yaml: map.centre_m"), HasSubstr("0.31 m above"),
                    HasSubstr("'top'"), HasSubstr("z 0.420"), HasSubstr("map.centre_m: auto")));
  const Validation beside = validated("tabletop", low, {"map.centre_m=[1.5,1.5,0.682]"});
  EXPECT_THAT(problem(beside), AllOf(HasSubstr("map.centre_m"), HasSubstr("miss the table")));
  const Validation through = validated("tabletop", low, {"map.centre_m=[0,0,0.6]"});
  EXPECT_THAT(through.problems, IsEmpty());
  ASSERT_EQ(through.notes.size(), 1U);
  EXPECT_THAT(through.notes[0], HasSubstr("below the table top"));
}

TEST(ValidateTableTop, ASceneWithoutATable) {
  const Validation found =
      validated("tabletop", OwnScene(table_at(0.0, 0.0, 0.3, 0.5, 0.5) + kWalls), {});
  EXPECT_EQ(found.code, ExitCode::bad_input);
  EXPECT_THAT(problem(found),
              AllOf(HasSubstr("scene.xml: no table"), HasSubstr("min_height_m 0.4")));
}

/// A slab of 1.2 x 0.8 m, where the robot starts if nothing is known of a table: amid it; with a
/// free box on it.
std::string slab(const std::string& height, const std::string& more) {
  return "<geom name='slab' type='box' pos='1.2 0 " + height + "' size='.6 .4 .015' " + more +
         "/><body name='box' pos='1.2 0 .75'><freejoint/><geom type='box' size='.05 .05 .05'/>"
         "</body>";
}

TEST(ValidateTableTop, WhatIsNearlyATableIsNamed) {
  const OwnScene low(slab(".365", "") + kWalls);
  const Validation found = validated("tabletop", low, {});
  EXPECT_EQ(found.code, ExitCode::bad_input);
  EXPECT_THAT(problem(found),
              AllOf(HasSubstr("scene.xml: no table"), HasSubstr("'slab' of 0.96 m^2"),
                    HasSubstr("0.380 m, is below table.min_height_m 0.4")));
  EXPECT_THAT(problem(validated("tabletop", OwnScene(slab("1.4", "") + kWalls), {})),
              HasSubstr("1.415 m, is above table.max_height_m 1.2"));
  EXPECT_THAT(problem(validated("tabletop", OwnScene(slab(".6", "euler='5 0 0'") + kWalls), {})),
              HasSubstr("tilted by 0.087 rad, more than table.max_tilt_rad 0.05"));
  EXPECT_THAT(validated("tabletop", low, {"table.min_height_m=0.3", "robot.start_view=5"}).problems,
              IsEmpty());
}

TEST(ValidateScene, SaysWhatIsNearlyATable) {
  // At the origin stands the robot too, before it is placed: MuJoCo could not tell them apart.
  const std::string at_origin =
      "<geom name='slab' type='box' pos='0 0 .365' size='.6 .4 .015'/>"
      "<geom type='box' pos='.55 .35 .175' size='.02 .02 .195'/>"
      "<geom type='box' pos='-.55 .35 .175' size='.02 .02 .195'/>"
      "<geom type='box' pos='-.3 .1 .48' size='.1 .06 .1'/>"
      "<body pos='.25 -.15 .432'><freejoint/><geom type='box' size='.08 .12 .05'/></body>"
      "<body pos='.1 .22 .532'><freejoint/><geom type='box' size='.05 .05 .15'/></body>";
  const Validation found = validate_file(OwnScene(at_origin + kWalls).path());
  EXPECT_EQ(found.code, ExitCode::done);
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_THAT(found.notes[0], HasSubstr("note: no table: the nearest to one, 'slab'"));
  const Validation tilted = validate_file(OwnScene(slab(".6", "euler='5 0 0'") + kWalls).path());
  ASSERT_EQ(tilted.notes.size(), 1U);
  EXPECT_THAT(tilted.notes[0], HasSubstr("table.max_tilt_rad 0.05"));
}

TEST(ValidateTableTop, AMapThatNoViewReaches) {
  const OwnScene scene(kTable + kWalls);
  for (const char* laser : {"laser.range_max_m=0.3", "laser.tilt_max_rad=-0.34"}) {
    const Validation found = validated("tabletop", scene, {laser});
    EXPECT_EQ(found.code, ExitCode::usage) << laser;
    EXPECT_THAT(problem(found), AllOf(HasSubstr("laser: range_max_m"), HasSubstr("map.centre_m")));
  }
}

TEST(ValidateTableTop, ViewsOffTheFloorMap) {
  const OwnScene scene(table_at(9.0, 0.0, 0.72, 0.5, 0.5));
  EXPECT_THAT(problem(validated("tabletop", scene, {})),
              AllOf(HasSubstr("floor_map.half_size_m: 6"), HasSubstr("11.0 would do")));
  EXPECT_THAT(validated("tabletop", scene, {"floor_map.half_size_m=11"}).problems, IsEmpty());
}

TEST(ValidateTableTop, ATableTooLargeForTheCircleOfViews) {
  const OwnScene scene(table_at(0.0, 0.0, 0.72, 1.0, 0.5) + kWalls);
  EXPECT_THAT(problem(validated("tabletop", scene, {})), HasSubstr("candidates.radius_m 1.60"));
  EXPECT_THAT(validated("tabletop", scene, {"candidates.radius_m=1.6"}).problems, IsEmpty());
}

const std::string kRoom = std::string(kWalls) +
                          "<geom type='box' pos='-3 0 1.25' size='.05 3 1.25'/>"
                          "<geom type='box' pos='0 -3 1.25' size='3 .05 1.25'/>";

TEST(ValidateTableTop, ViewsThatAllLieBehindWallsAreAnError) {
  const OwnScene room(kTable + kRoom);
  EXPECT_THAT(validated("tabletop", room, {}).notes, IsEmpty());
  const Validation outside = validated("tabletop", room, {"candidates.radius_m=5"});
  EXPECT_EQ(outside.code, ExitCode::usage);
  EXPECT_THAT(problem(outside),
              AllOf(HasSubstr("candidates.radius_m 5: of 10 positions"), HasSubstr("10 "),
                    HasSubstr("past what stands between"), HasSubstr("is free all round")));
}

TEST(ValidateTableTop, ViewsOutOfReachOrBehindAWallAreANote) {
  const std::string screen = "<geom type='box' pos='-.9 0 .8' size='.02 1.1 .8'/>";
  const Validation found = validated("tabletop", OwnScene(kTable + kRoom + screen), {});
  EXPECT_THAT(found.problems, IsEmpty());
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_THAT(found.notes[0],
              AllOf(HasSubstr("note: candidates.radius_m 1.2: of 10 positions on the ring "),
                    HasSubstr(" are out of the robot's reach"), testing::Not(HasSubstr(" 0 are"))));
}

TEST(ValidateTableTop, ABodyThatNeverRests) {
  const OwnScene scene(kTable + kWalls +
                       "<geom type='plane' size='3 3 .1' pos='8 0 0' euler='0 20 0'/><body "
                       "name='ball' pos='8 0 .5'><freejoint/><geom size='.1'/></body>");
  const Validation found = validated("tabletop", scene, {});
  EXPECT_EQ(found.code, ExitCode::bad_input);
  EXPECT_THAT(problem(found), AllOf(HasSubstr("scene.xml: body 'ball'"), HasSubstr("rest")));
  EXPECT_EQ(validate_file(scene.path()).code, ExitCode::bad_input);
}

TEST(ValidateScene, SaysWhatATableTopEpisodeWouldMeet) {
  EXPECT_THAT(validate_file(OwnScene(kTable + kWalls).path()).notes, IsEmpty());
  const Validation open = validate_file(OwnScene(kTable).path());
  ASSERT_EQ(open.notes.size(), 1U);
  EXPECT_THAT(open.notes[0], HasSubstr("note: registration"));
  const Validation large =
      validate_file(OwnScene(table_at(0.0, 0.0, 0.72, 1.0, 0.5) + kWalls).path());
  ASSERT_EQ(large.notes.size(), 1U);
  EXPECT_THAT(large.notes[0], HasSubstr("note: not with defaults: "));
}

std::vector<std::string> started_at(const std::string& pose) {
  return {"robot.start_site=''", "robot.start_pose=" + pose};
}

TEST(ValidateExploration, TheStartIsOnTheMap) {
  const OwnScene room(std::string(kWalls) + "<geom type='plane' size='50 50 .1'/>");
  EXPECT_THAT(validated("office_small", room, started_at("[0,0,0]")).problems, IsEmpty());
  const Validation off = validated("office_small", room, started_at("[-9,0,0]"));
  EXPECT_EQ(off.code, ExitCode::usage);
  EXPECT_THAT(problem(off), AllOf(HasSubstr("office_small.yaml: map.centre_m, map.size_m"),
                                  HasSubstr("robot.start_pose")));
}

TEST(ValidateExploration, ThereIsFreeFloor) {
  const OwnScene shut(
      "<geom type='box' size='.05 .7 .5' pos='.65 0 .5'/><geom type='box' size='.05 .7 .5' "
      "pos='-.65 0 .5'/><geom type='box' size='.7 .05 .5' pos='0 .65 .5'/><geom type='box' "
      "size='.7 .05 .5' pos='0 -.65 .5'/>");
  const Validation walled = validated("office_small", shut, started_at("[0,0,0]"));
  EXPECT_EQ(walled.code, ExitCode::bad_input);
  EXPECT_THAT(problem(walled),
              AllOf(HasSubstr("scene.xml: no free floor"), HasSubstr("start_pose")));
}

TEST(ValidateExploration, TheFloorMapHoldsTheMap) {
  const OwnScene room(std::string(kWalls) + "<geom type='plane' size='50 50 .1'/>");
  std::vector<std::string> small = started_at("[0,0,0]");
  small.emplace_back("floor_map.half_size_m=5");
  const Validation found = validated("office_small", room, small);
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_THAT(found.notes, testing::Contains(AllOf(HasSubstr("floor_map.half_size_m: 5 ends"),
                                                   HasSubstr("7.5 would do"))));
  EXPECT_THAT(validated("office_small", room, started_at("[0,0,0]")).notes,
              testing::Not(testing::Contains(HasSubstr("floor_map"))));
}

/// On a circle of 0.6 m the laser looks inwards, and the base's middle is 12 cm behind it.
TEST(ValidateTableTop, ViewsOffTheFloorMapAreAsFarAsTheyAre) {
  const OwnScene scene(table_at(0.0, 0.0, 0.72, 0.2, 0.2));
  const Validation found =
      validated("tabletop", scene, {"candidates.radius_m=0.6", "floor_map.half_size_m=0.6"});
  EXPECT_THAT(problem(found),
              AllOf(HasSubstr("floor_map.half_size_m: 0.6 ends"),
                    HasSubstr("0.72 m from the world's origin"), HasSubstr("2.0 would do")));
}

/// The walls are 2.95 m from the middle, and the robot plans as a disc of 0.48 m with a margin of
/// 4 cm.
TEST(ValidateTableTop, WhatIsFreeAllRoundIsSoForTheWholeRobot) {
  const std::string said =
      problem(validated("tabletop", OwnScene(kTable + kRoom), {"candidates.radius_m=5"}));
  const std::size_t at = said.rfind(" to ");
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_NEAR(std::stod(said.substr(at + 4)), 2.95 - 0.52, 0.06) << said;
}

/// The one position is on the right of a table 3 m to the left; a screen at the table's edge hides
/// it from there. On that side it is 9 m to the end of the floor map.
TEST(ValidateTableTop, WhatIsFreeReachesToTheFarEndOfTheFloorMap) {
  const OwnScene scene(table_at(-3.0, 0.0, 0.72, 0.5, 0.5) +
                       "<geom type='box' pos='-2.43 0 .8' size='.02 .6 .8'/>");
  const std::string said = problem(validated("tabletop", scene, {"candidates.positions=1"}));
  EXPECT_THAT(said, HasSubstr("of 1 positions on the ring 0 are out of the robot's reach, and 1 "));
  const std::size_t at = said.rfind(" to ");
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_NEAR(std::stod(said.substr(at + 4)), 9.0 - 0.52, 0.06) << said;
}

/// A laser that sees straight ahead alone, from where that is the middle of the map.
TEST(ValidateTableTop, AViewOfTheMiddleOfTheMapIsOfUse) {
  const Validation found = validated("tabletop", OwnScene(kTable + kWalls),
                                     {"candidates.positions=4", "candidates.yaw_offsets_rad=[0]",
                                      "laser.sector_rad=0.01", "laser.step_rad=0.01"});
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_THAT(found.notes, IsEmpty());
}

/// What begins 15 cm above the floor, as a shelf, too: no robot gets under it.
TEST(ValidateExploration, WhatHangsLowIsInTheWay) {
  const OwnScene shut(
      "<geom type='box' size='.05 .7 .4' pos='.65 0 .55'/><geom type='box' size='.05 .7 .4' "
      "pos='-.65 0 .55'/><geom type='box' size='.7 .05 .4' pos='0 .65 .55'/><geom type='box' "
      "size='.7 .05 .4' pos='0 -.65 .55'/>");
  EXPECT_THAT(problem(validated("office_small", shut, started_at("[0,0,0]"))),
              HasSubstr("scene.xml: no free floor"));
}

TEST(ValidateTableTop, AViewIsWithinTheReachOfTheLaser) {
  const OwnScene scene(kTable + kWalls);
  const auto said = [&](std::vector<std::string> more) {
    return problem(validated("tabletop", scene, std::move(more)));
  };
  EXPECT_THAT(said({"candidates.height_m=1.381"}),
              AllOf(HasSubstr("1.381 is out of the laser's reach, 1.050 to 1.380; 1.380 fits"),
                    HasSubstr("{height_m: 1.380}")));
  EXPECT_THAT(said({"candidates.height_m=1.048"}), HasSubstr("1.050 to 1.380; 1.050 fits"));
  EXPECT_THAT(said({"laser.tilt_max_rad=1.485"}),
              AllOf(HasSubstr("beyond the joint's -0.785 to 1.484"),
                    HasSubstr("tilt_min_rad: -0.36, tilt_max_rad: 1.484}")));
  EXPECT_THAT(said({"laser.tilt_min_rad=-0.786"}),
              HasSubstr("tilt_min_rad: -0.785, tilt_max_rad: 0.62}"));
  EXPECT_THAT(validated("tabletop", scene, {"candidates.height_m=1.379"}).problems, IsEmpty());
  EXPECT_THAT(validated("tabletop", scene,
                        {"candidates.height_m=1.0495", "laser.tilt_min_rad=-0.785",
                         "laser.tilt_max_rad=1.484"})
                  .problems,
              IsEmpty());
}

/// A bar along y, behind which one of the positions is.
std::string bar_behind_the_table(double low_m, double high_m) {
  return fmt::format("<geom type='box' pos='-.9 0 {}' size='.02 1.1 {}'/>", 0.5 * (low_m + high_m),
                     0.5 * (high_m - low_m));
}

TEST(ValidateTableTop, ARobotRollsOverMatsAndUnderLamps) {
  const auto found = [](double low_m, double high_m) {
    return validated("tabletop", OwnScene(kTable + kRoom + bar_behind_the_table(low_m, high_m)),
                     {});
  };
  EXPECT_THAT(found(0.0, 0.03).notes, IsEmpty());
  EXPECT_THAT(found(1.2, 1.6).notes, IsEmpty());
  for (const auto& [low_m, high_m] : {std::pair(0.0, 0.08), {0.4, 0.9}}) {
    const Validation note = found(low_m, high_m);
    EXPECT_THAT(note.problems, IsEmpty());
    ASSERT_EQ(note.notes.size(), 1U) << low_m;
    EXPECT_THAT(note.notes[0], AllOf(HasSubstr(" are out of the robot's reach"),
                                     testing::Not(HasSubstr(" 0 are"))));
  }
}

/// The way to the first is blocked, the second can be driven to.
TEST(ValidateTableTop, PositionsAreCountedByWhatTheyLack) {
  const auto note = [](const std::string& more, std::vector<std::string> options) {
    options.emplace_back("candidates.positions=4");
    const Validation found =
        validated("tabletop", OwnScene(kTable + kRoom + more), std::move(options));
    return found.notes.size() == 1 ? found.notes[0] : std::string();
  };
  EXPECT_THAT(note(bar_behind_the_table(0.0, 1.6), {}),
              HasSubstr("of 4 positions on the ring 1 are out of the robot's reach, and 0 more"));
  const std::string screen = "<geom type='box' pos='-.7 0 .8' size='.02 .6 .8'/>";
  EXPECT_THAT(note(screen, {"candidates.radius_m=1.4"}),
              testing::EndsWith("of 4 positions on the ring 0 are out of the robot's reach, and 1 "
                                "more see nothing of the map past what stands between"));
}

TEST(ValidateTableTop, WhatThereIsToLocaliseByIsSaid) {
  const auto note = [](const std::string& bodies) {
    const Validation found = validated("tabletop", OwnScene(bodies), {});
    return found.notes.size() == 1 ? found.notes[0] : std::string();
  };
  EXPECT_THAT(note(kTable), HasSubstr("it goes by posts"));
  EXPECT_THAT(note("<geom type='box' size='.5 .5 .02' pos='0 0 .7'/>"
                   "<geom type='box' size='.08 .08 .34' pos='0 0 .34'/>"),
              HasSubstr("odometry will drift"));
}

/// What does not go with keys that were set is a problem, with defaults a note.
TEST(ValidateScene, IsHeldToTheKeysThatWereSet) {
  const OwnScene large(table_at(0.0, 0.0, 0.72, 1.0, 0.5) + kWalls);
  EXPECT_THAT(validate_file(large.path(), {"candidates.radius_m=1.6"}).problems, IsEmpty());
  const Validation small = validate_file(large.path(), {"candidates.radius_m=1.3"});
  EXPECT_EQ(small.code, ExitCode::usage);
  EXPECT_THAT(problem(small), HasSubstr("candidates.radius_m"));
  EXPECT_THAT(small.notes, IsEmpty());
}

/// The corners of the base, but not its sides, are farther out than the post, 0.42 m from its
/// middle.
TEST(ValidateTableTop, TheRobotHasRoomToTurnAtItsStart) {
  const OwnScene scene(kTable + kWalls +
                       "<geom name='post' type='box' pos='1.32 .42 .5' size='.02 .02 .5'/>");
  const Validation found = validated("tabletop", scene, {"robot.start_behind_m=0"});
  EXPECT_EQ(found.code, ExitCode::usage);
  EXPECT_THAT(problem(found),
              AllOf(HasSubstr("robot.start_view 0 on the ring of candidates.radius_m 1.2, "
                              "robot.start_behind_m 0: "),
                    HasSubstr("would touch 'post' when it turns there")));
}

TEST(ValidateExploration, TheRobotHasRoomToTurnAtItsStart) {
  const OwnScene scene(std::string(kWalls) +
                       "<geom name='post' type='box' pos='0 .42 .5' size='.02 .02 .5'/>");
  const Validation found = validated("office_small", scene, started_at("[0,0,0]"));
  EXPECT_EQ(found.code, ExitCode::usage);
  EXPECT_THAT(problem(found), AllOf(HasSubstr("robot.start_pose"),
                                    HasSubstr("would touch 'post' when it turns there")));
}

}  // namespace
}  // namespace vantage
