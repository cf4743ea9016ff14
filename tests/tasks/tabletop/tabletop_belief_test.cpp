// What is believed of a table after a scan: how far it goes, and what stands on it.
#include "vantage/tasks/tabletop/tabletop_belief.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cstddef>

#include "tests/support/synthetic_room.hpp"

namespace vantage {
namespace {

/// A table of 1.6 x 2 m that is 0.72 m high, with a box on it, seen from 1.25 m up.
TabletopObservation wide_table_seen(double half_width_rad = 0.65) {
  support::SyntheticScene scene;
  scene.boxes = {support::box_at({1.0, 0.5, 0.7}, {1.6, 2.0, 0.04}),
                 support::box_at({1.0, 0.5, 0.77}, {0.1, 0.1, 0.1})};
  TabletopObservation observation;
  observation.T_base_laser = make_pose({-0.6, 0.5, 1.25}, 0.0);
  RangeScan& scan = observation.scan;
  scan.tilt_rad = support::evenly_spaced(0.1, 0.65, 120);
  scan.azimuth_rad = support::evenly_spaced(-half_width_rad, half_width_rad, 121);
  scan.field_of_view = {
      .half_width_rad = half_width_rad, .tilt_min_rad = 0.1, .tilt_max_rad = 0.65};
  for (const double tilt_rad : scan.tilt_rad) {
    for (const double azimuth_rad : scan.azimuth_rad) {
      const double range_m = support::cast_ray(scene, observation.T_base_laser.translation(),
                                               beam_direction({azimuth_rad, tilt_rad}));
      scan.range_m.push_back(static_cast<float>(range_m));
    }
  }
  return observation;
}

/// It is looked for in twice the map, 1 x 1.4 m.
Tabletop small_region() {
  Tabletop task;
  task.map.centre_m = {1.0, 0.5, 0.9};
  task.map.size_m = {0.5, 0.7, 0.5};
  task.map.cells = {17, 17, 9};
  return task;
}

Eigen::AlignedBox2d extent_of_table(const TabletopBelief& belief) {
  Eigen::AlignedBox2d extent;
  for (const Eigen::Vector2d& corner : belief.table().hull) extent.extend(corner);
  return extent;
}

TEST(TabletopBelief, HasTheTableAndWhatStandsOnItFromOneScan) {
  TabletopBelief belief({}, small_region());
  const ReferenceMap no_walls{RegistrationOptions{}};
  const TabletopObservation seen = wide_table_seen();
  const BeliefUpdate update = belief.update(seen, no_walls, {});
  EXPECT_TRUE(update.registered);
  EXPECT_GT(update.freed_cells, 0U);
  const Eigen::AlignedBox2d table = extent_of_table(belief);
  EXPECT_NEAR(table.min().x(), 0.5, 0.06);
  EXPECT_NEAR(table.max().x(), 1.5, 0.06);
  EXPECT_NEAR(table.min().y(), -0.2, 0.06);
  EXPECT_NEAR(table.max().y(), 1.2, 0.06);
  const std::size_t once = belief.cloud().size();
  ASSERT_GT(once, 20U);
  for (const Eigen::Vector3f& p : belief.cloud().points) {
    EXPECT_GT(p.z(), 0.72F);
    EXPECT_LT((p - Eigen::Vector3f(1.0F, 0.5F, 0.77F)).cwiseAbs().maxCoeff(), 0.0501F);
  }
  belief.update(seen, no_walls, {});
  EXPECT_NEAR(static_cast<double>(belief.cloud().size()), 2.0 * static_cast<double>(once),
              0.1 * static_cast<double>(once))
      << "what was placed once is not placed again";
}

TEST(TabletopBelief, HasAsMuchOfTheTableAsAllScansHaveSeen) {
  TabletopBelief belief({}, small_region());
  const ReferenceMap no_walls{RegistrationOptions{}};
  belief.update(wide_table_seen(0.2), no_walls, {});
  EXPECT_LT(extent_of_table(belief).max().y(), 1.0);
  belief.update(wide_table_seen(), no_walls, {});
  EXPECT_NEAR(extent_of_table(belief).max().y(), 1.2, 0.08);
}

}  // namespace
}  // namespace vantage
