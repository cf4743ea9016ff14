// A map that fits together, and one whose walls are drawn twice.
#include "vantage/localisation/map_contradiction.hpp"

#include <gtest/gtest.h>

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
  EXPECT_GT(contradicted({0.25, 0.25, 0.0}, 160), 0.03);
}

}  // namespace
}  // namespace vantage
