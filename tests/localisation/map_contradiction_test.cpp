// A map that fits together, and one whose walls are drawn twice.
#include "vantage/localisation/map_contradiction.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/localisation/plan_world.hpp"

namespace vantage {
namespace {

using namespace test_plan;

/// Round the ring once and a quarter more; what is seen after `from` is moved by `off`.
double contradicted(const Pose2& off, std::size_t from) {
  Rng rng(1);
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  const auto walls = ring(15.0, 28.0, 2.0);
  auto way = way_round(15.0, 28.0, 2.0, 2);
  way.resize(5 * way.size() / 8);
  std::vector<PointCloud> clouds;
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < way.size(); i += 2) {
    clouds.push_back(scan(walls, way[i], 0.01, rng, registration));
    poses.push_back(i < from ? way[i] : compose(off, way[i]));
  }
  std::vector<SeenFrom> scans;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    scans.push_back({clouds[i], Eigen::Vector2d::Zero(), poses[i]});
  }
  return contradicted_share(scans);
}

TEST(MapContradiction, NoneWhereAllFitsTogether) { EXPECT_LT(contradicted({}, 0), 0.005); }

TEST(MapContradiction, NoneOfAMapThatIsMovedAsAWhole) {
  EXPECT_LT(contradicted({0.3, 0.2, 0.1}, 0), 0.005);
}

TEST(MapContradiction, WallsDrawnTwiceAreSeen) {
  EXPECT_GT(contradicted({0.25, 0.25, 0.0}, 160), 0.06) << "a map in doubt";
}

/// Of what a scanner at (2, 2.5) cm sees from one pose, scan by scan.
double share_of(const std::vector<PointCloud>& clouds) {
  std::vector<SeenFrom> scans;
  for (const PointCloud& cloud : clouds) scans.push_back({cloud, {0.02, 0.025}, {}});
  return contradicted_share(scans);
}

/// Points in its row of cells, that far along x, with that normal.
PointCloud ahead(const std::vector<float>& x_m, const Eigen::Vector2f& normal = {-1.0F, 0.0F}) {
  PointCloud cloud;
  for (const float x : x_m) {
    cloud.points.emplace_back(x, 0.025F, 0.25F);
    cloud.normals.emplace_back(normal.x(), normal.y(), 0.0F);
  }
  return cloud;
}

TEST(MapContradiction, IsTheShareOfBeamsThroughWhatTwoScansSee) {
  const PointCloud wall = ahead({2.025F});
  const PointCloud beam = ahead({4.025F});
  EXPECT_NEAR(share_of({wall, wall, beam}), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(share_of({wall, wall, beam, beam}), 0.5, 1e-12);
  EXPECT_EQ(share_of({wall, beam}), 0.0);
  EXPECT_EQ(share_of({ahead({2.025F, 2.03F}), beam}), 0.0) << "twice in one scan is once";
  EXPECT_EQ(share_of({}), 0.0);
}

TEST(MapContradiction, IsNoneWhereABeamEndsShortlyBehindASurface) {
  const PointCloud wall = ahead({2.025F});
  EXPECT_EQ(share_of({wall, wall, ahead({2.125F})}), 0.0);
  EXPECT_NEAR(share_of({wall, wall, ahead({2.225F})}), 1.0 / 3.0, 1e-12);
}

TEST(MapContradiction, IsNoneWhereTheScannerStandsBeforeASurface) {
  const PointCloud beam = ahead({4.025F});
  EXPECT_EQ(share_of({ahead({0.125F}), ahead({0.125F}), beam}), 0.0);
  EXPECT_EQ(share_of({ahead({0.175F}), ahead({0.175F}), beam}), 1.0) << "of the only one asked";
}

TEST(MapContradiction, IsOfSurfacesThatFaceTheScanner) {
  const PointCloud beam = ahead({4.025F});
  const auto through = [&](const Eigen::Vector2f& normal) {
    return share_of({ahead({2.025F}, normal), ahead({2.025F}, normal), beam});
  };
  EXPECT_NEAR(through({-0.75F, 0.661F}), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(through({-0.65F, 0.76F}), 0.0);
  EXPECT_EQ(through({1.0F, 0.0F}), 0.0);
  EXPECT_EQ(through({0.0F, 0.0F}), 0.0);
}

TEST(MapContradiction, IsAskedOfEveryThirdPointThatIsFarEnough) {
  const PointCloud wall = ahead({2.025F});
  PointCloud four = ahead({4.025F, 4.025F, 4.025F, 1.0F});
  EXPECT_NEAR(share_of({wall, wall, four}), 0.25, 1e-12);
  EXPECT_NEAR(share_of({wall, wall, ahead({4.025F}), ahead({0.46F})}), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(share_of({wall, wall, ahead({4.025F}), ahead({0.48F})}), 0.25, 1e-12);
}

TEST(MapContradiction, TheScannerIsWhereItsBaseHasIt) {
  const Pose2 T_world_base{3.0, 2.0, 0.5 * std::numbers::pi};
  const PointCloud wall = ahead({3.025F});
  const PointCloud beam = ahead({5.025F});
  std::vector<SeenFrom> scans;
  for (const PointCloud* cloud : {&wall, &wall, &beam}) {
    scans.push_back({*cloud, {1.02, 0.025}, T_world_base});
  }
  EXPECT_NEAR(contradicted_share(scans), 1.0 / 3.0, 1e-12);
}

/// One point of a surface that is seen from the left.
PointCloud surface_at(float x_m, float y_m) {
  PointCloud cloud = ahead({x_m});
  cloud.points.front().y() = y_m;
  return cloud;
}

TEST(MapContradiction, ASurfaceIsSeenByTwoWithinItsCellOfFiveCentimetres) {
  const PointCloud beam = ahead({4.025F});
  const auto seen_by = [&](const PointCloud& one, const PointCloud& other) {
    return share_of({one, other, beam});
  };
  EXPECT_NEAR(seen_by(surface_at(2.01F, 0.025F), surface_at(2.04F, 0.025F)), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(seen_by(surface_at(2.01F, 0.025F), surface_at(2.06F, 0.025F)), 0.0);
  EXPECT_NEAR(seen_by(surface_at(2.0F, 0.025F), surface_at(2.04F, 0.025F)), 1.0 / 3.0, 1e-12)
      << "from its lower side on";
  EXPECT_NEAR(seen_by(surface_at(2.025F, 0.0F), surface_at(2.025F, 0.04F)), 1.0 / 3.0, 1e-12);
}

TEST(MapContradiction, ASurfaceIsSeenOnceByAScanThatHasManyPointsOfIt) {
  const PointCloud beam = ahead({4.025F});
  EXPECT_EQ(share_of({beam, ahead({2.025F, 2.03F, 2.035F})}), 0.0);
}

TEST(MapContradiction, PointsOfNoSurfaceAreNoWitnesses) {
  const PointCloud wall = ahead({2.025F});
  const PointCloud beam = ahead({4.025F});
  EXPECT_EQ(share_of({wall, ahead({2.025F}, {0.0F, 0.0F}), beam}), 0.0);
  PointCloud mixed = ahead({1.025F}, {0.0F, 0.0F});
  append(mixed, wall);
  EXPECT_NEAR(share_of({wall, mixed, beam}), 1.0 / 3.0, 1e-12) << "those behind one are";
}

TEST(MapContradiction, PointsBehindOneThatIsTooNearAreAsked) {
  const PointCloud wall = ahead({2.025F});
  EXPECT_NEAR(share_of({wall, wall, ahead({0.46F, 1.0F, 1.0F, 4.025F})}), 1.0 / 3.0, 1e-12);
}

}  // namespace
}  // namespace vantage
