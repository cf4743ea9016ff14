#include "vantage/building/building_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/building/made_mesh.hpp"

namespace vantage {
namespace {

using test::MadeMesh;

double heading_of(const std::vector<std::pair<double, double>>& walls) {
  MadeMesh made;
  for (const auto& [heading_rad, area_m2] : walls) {
    made.wall({1.0, 2.0}, heading_rad, 0.5 * area_m2, 2.0);
  }
  return wall_heading_rad(made.mesh);
}

TEST(WallHeading, IsThatOfMostWallsUpToAQuarterTurn) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  EXPECT_NEAR(heading_of({{0.3, 4.0}, {0.3 + kQuarter, 3.0}}), 0.3, 1e-9);
  EXPECT_NEAR(heading_of({{-0.4, 4.0}, {-0.4 + kQuarter, 3.0}}), -0.4, 1e-9);
  EXPECT_NEAR(heading_of({{0.8, 4.0}, {0.8 - kQuarter, 3.0}}), 0.8 - kQuarter, 1e-9);
  EXPECT_NEAR(heading_of({{0.7, 4.0}, {0.7 + 2.0 * kQuarter, 3.0}, {0.2, 5.0}}), 0.7, 1e-9);
}

TEST(WallHeading, IsNoneWhereWallsHaveNoneInCommon) {
  EXPECT_EQ(heading_of({{0.3, 4.0}, {0.6, 3.3}, {0.9, 3.3}, {1.2, 3.3}}), 0.0) << "29 %";
  EXPECT_NEAR(heading_of({{0.3, 4.0}, {0.6, 3.0}, {0.9, 3.0}, {1.2, 3.0}}), 0.3, 1e-9) << "31 %";
  EXPECT_EQ(heading_of({}), 0.0);
  EXPECT_EQ(heading_of({{5e-6, 4.0}}), 0.0) << "as good as along the axes";
  EXPECT_NEAR(heading_of({{5e-5, 4.0}}), 5e-5, 1e-9);
}

TEST(WallHeading, IsTheMeanOfThoseNearEachOther) {
  EXPECT_NEAR(heading_of({{0.30, 3.0}, {0.31, 1.0}, {0.32, 0.9}}), 0.3025, 1e-9);
}

TEST(WallHeading, IsOfWhatMostWallsHaveInCommonWithinHalfADegree) {
  const auto rad = [](double deg) { return deg * std::numbers::pi / 180.0; };
  EXPECT_NEAR(heading_of({{rad(50.2), 2.0}, {rad(20.02), 1.5}, {rad(20.48), 1.5}}), rad(20.25),
              1e-9);
  EXPECT_NEAR(heading_of({{rad(30.2), 2.0}, {rad(20.02), 1.5}, {rad(20.52), 1.5}}), rad(30.2),
              1e-9);
}

TEST(WallHeading, IsOfUprightFacesAlone) {
  MadeMesh made;
  made.wall({0.0, 0.0}, 0.3, 2.0, 2.0);
  // A large roof whose normal leans by far more than that of a wall.
  made.quad({0, 0, 3}, {9, 0, 3}, {9, 9, 12}, {0, 9, 12});
  EXPECT_NEAR(wall_heading_rad(made.mesh), 0.3, 1e-9);
}

TEST(FloorHeight, IsTheLowestLargeLevelWithAirAboveIt) {
  MadeMesh made;
  made.level(0, 0, 4, 4, 0.2, true);
  made.level(1, 1, 2, 2, 0.9, true);  // a table
  made.level(0, 0, 4, 4, 2.9, true);  // a roof
  EXPECT_NEAR(floor_height_m(made.mesh).value(), 0.2, 1e-9);
}

TEST(FloorHeight, HasAQuarterOfTheLargestLevel) {
  for (const double width_m : {0.9, 1.0}) {
    MadeMesh made;
    made.level(0, 0, width_m, 4, 0.2, true);
    made.level(0, 0, 4, 4, 2.9, true);
    EXPECT_NEAR(floor_height_m(made.mesh).value(), width_m == 1.0 ? 0.2 : 2.9, 1e-9) << width_m;
  }
}

TEST(FloorHeight, HasHeadroom) {
  for (const double roof_m : {1.65, 1.75}) {
    MadeMesh made;
    made.level(0, 0, 4, 3, 0.2, true);
    made.level(0, 0, 4, 3, roof_m, true);
    EXPECT_NEAR(floor_height_m(made.mesh).value(), roof_m == 1.75 ? 0.2 : 1.65, 1e-9) << roof_m;
  }
}

TEST(FloorHeight, IsOfFacesThatLookDownWhereNoneLooksUp) {
  MadeMesh made;
  made.level(0, 0, 4, 3, 0.2, false);
  EXPECT_NEAR(floor_height_m(made.mesh).value(), 0.2, 1e-9);
  made.level(0, 0, 4, 3, 1.0, true);
  EXPECT_NEAR(floor_height_m(made.mesh).value(), 1.0, 1e-9);
}

TEST(FloorHeight, IsTheMiddleOfALevelThatIsNotEven) {
  MadeMesh made;
  made.level(0, 0, 1, 4, 0.20, true);
  made.level(1, 0, 3, 4, 0.22, true);
  made.level(3, 0, 4, 4, 0.24, true);
  EXPECT_NEAR(floor_height_m(made.mesh).value(), 0.22, 1e-9);
}

TEST(FloorHeight, IsNoneWithoutLevelFaces) {
  MadeMesh made;
  made.wall_x(1.0, 0.0, 3.0, 2.0);
  EXPECT_FALSE(floor_height_m(made.mesh));
}

TEST(BuildingMesh, IsMovedAsAWhole) {
  MadeMesh made;
  made.triangle({1, 0, 0}, {0, 2, 0}, {0, 0, 3});
  Eigen::Isometry3d T(Eigen::Translation3d(1.0, 2.0, 3.0));
  T.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()));
  transform(made.mesh, T);
  EXPECT_LT((made.mesh.vertices_m[0] - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
  EXPECT_LT((made.mesh.vertices_m[1] - Eigen::Vector3d(-1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((made.mesh.vertices_m[2] - Eigen::Vector3d(1, 2, 6)).norm(), 1e-12);
}

TEST(FloorHeight, LevelsFiveCentimetresApartAreOneOrTwo) {
  MadeMesh apart;
  apart.level(0, 0, 1, 4, 0.20, true);
  apart.level(1, 0, 4, 4, 0.26, true);
  EXPECT_NEAR(floor_height_m(apart.mesh).value(), 0.20, 1e-9);
  MadeMesh near;
  near.level(0, 0, 1, 4, 0.20, true);
  near.level(1, 0, 2.2, 4, 0.24, true);
  EXPECT_NEAR(floor_height_m(near.mesh).value(), 0.24, 1e-9) << "the higher one is the wider";
}

/// A wall that leans by so much is one, or the heading is that of a smaller upright one.
TEST(WallHeading, IsOfFacesThatLeanByATenthAtMost) {
  for (const double lean : {0.08, 0.15}) {
    MadeMesh made;
    made.wall({0.0, 0.0}, 0.3, 1.0, 2.0);
    // From (0, 0) along 0.7 rad for 4 m, 3 m high along its slope.
    const Eigen::Vector3d along = 4.0 * Eigen::Vector3d(std::cos(0.7), std::sin(0.7), 0.0);
    const Eigen::Vector3d out(std::sin(0.7), -std::cos(0.7), 0.0);
    const Eigen::Vector3d rise =
        3.0 * (std::sqrt(1.0 - lean * lean) * Eigen::Vector3d::UnitZ() - lean * out);
    made.quad(Eigen::Vector3d::Zero(), along, along + rise, rise);
    EXPECT_NEAR(wall_heading_rad(made.mesh), lean < 0.1 ? 0.7 : 0.3, 1e-9) << lean;
  }
}

TEST(WallHeading, IsOfWallsUpToADegreeOffTheMiddleOfTheirHalfDegree) {
  const auto rad = [](double deg) { return deg * std::numbers::pi / 180.0; };
  EXPECT_NEAR(heading_of({{rad(20.25), 3.0}, {rad(21.2), 1.0}}), rad(20.4875), 1e-9);
}

TEST(WallHeading, AsGoodAsAlongTheAxesIsAlongThem) {
  EXPECT_EQ(heading_of({{9e-6, 4.0}}), 0.0);
  EXPECT_NEAR(heading_of({{1.1e-5, 4.0}}), 1.1e-5, 1e-9);
  MadeMesh made;  // its normal is a hair below the x axis
  made.wall({0.0, 0.0}, 0.5 * std::numbers::pi, 2.0, 2.0);
  EXPECT_EQ(wall_heading_rad(made.mesh), 0.0);
}

TEST(FloorHeight, AMetreAndAHalfIsHeadroomEnough) {
  MadeMesh made;
  made.level(0, 0, 4, 3, 0.0, true);
  made.level(0, 0, 4, 3, 1.5, true);
  EXPECT_EQ(floor_height_m(made.mesh), 0.0);
}

/// Two strips of 6 and 9 cm side by side, 15 cm wide, are looked at in the middle of each step:
/// of 10 cm in the first strip, of 15 cm in the second, of 30 cm nowhere.
TEST(FloorHeight, IsLookedForInStepsOfAThousandthOfTheBuilding) {
  const std::vector<std::pair<Eigen::Vector3d, double>> far_things{
      {{1, 1, 1}, 0.2}, {{150, 1, 1}, 0.9}, {{1, 150, 1}, 0.9}, {{1, 1, 150}, 0.2}};
  for (const auto& [size_m, floor_m] : far_things) {
    MadeMesh made;
    made.level(0.0, 0.0, 0.06, 0.15, 0.2, true);
    made.level(0.06, 0.0, 0.15, 0.15, 0.9, true);
    const Eigen::Vector3d corner = 0.15 * Eigen::Vector3d::Ones();
    // An upright triangle from there, which no upright line meets.
    made.triangle({corner.x(), corner.y(), 0}, {size_m.x(), size_m.y(), 0}, size_m);
    EXPECT_NEAR(floor_height_m(made.mesh).value_or(-1.0), floor_m, 1e-9) << size_m.transpose();
  }
  MadeMesh small;
  small.level(0.0, 0.0, 0.04, 0.1, 0.2, true);
  small.level(0.04, 0.0, 0.1, 0.1, 0.9, true);
  EXPECT_NEAR(floor_height_m(small.mesh).value_or(-1.0), 0.9, 1e-9) << "10 cm at least";
}

}  // namespace
}  // namespace vantage
