#include "vantage/models/catalogue/database/object_database.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/models/catalogue/shapes/mesh_checks.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"

namespace vantage {
namespace {

const DatabaseObject& first_of(const std::vector<DatabaseObject>& objects, auto&& wanted) {
  return *std::ranges::find_if(objects, wanted);
}

const DatabaseObject& original_of(const std::vector<DatabaseObject>& objects,
                                  const DatabaseObject& near_duplicate) {
  return first_of(objects, [&](const DatabaseObject& other) {
    return other.family == near_duplicate.family && other.near_duplicate == NearDuplicate::original;
  });
}

std::size_t changed_pixels(const Image& a, const Image& b) {
  std::size_t changed = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) changed += a.rgb[i] != b.rgb[i] ? 1 : 0;
  return changed;
}

TEST(ObjectDatabase, Has326ObjectsIn51Categories) {
  const auto objects = object_database();
  EXPECT_EQ(objects.size(), 326U);
  std::set<std::string> names;
  std::map<std::string, int> size;
  for (const auto& object : objects) {
    names.insert(object.name);
    ++size[object.category];
  }
  EXPECT_EQ(names.size(), 326U);
  EXPECT_EQ(size.size(), 51U);
  for (const auto& [category, count] : size) EXPECT_TRUE(count == 6 || count == 7) << category;
  for (const auto& object : objects) {
    const int number = std::stoi(object.name.substr(object.category.size() + 1));
    EXPECT_GE(number, 1);
    EXPECT_LE(number, size[object.category]);
  }
}

TEST(ObjectDatabase, FamiliesAreTogetherAndBeginWithTheirOriginal) {
  const auto objects = object_database();
  std::set<std::string> seen;
  std::map<NearDuplicate, int> kinds;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    ++kinds[objects[i].near_duplicate];
    const bool begins = i == 0 || objects[i].family != objects[i - 1].family;
    EXPECT_EQ(objects[i].near_duplicate == NearDuplicate::original, begins) << objects[i].name;
    if (begins) {
      EXPECT_TRUE(seen.insert(objects[i].family).second) << objects[i].family;
    } else {
      EXPECT_EQ(objects[i].labelled, objects[i - 1].labelled);
    }
  }
  for (const NearDuplicate near_duplicate : {NearDuplicate::larger, NearDuplicate::warmer,
                                             NearDuplicate::decal, NearDuplicate::back_label}) {
    EXPECT_GE(kinds[near_duplicate], 25) << near_duplicate_name(near_duplicate);
  }
}

TEST(ObjectDatabase, EveryObjectIsWhole) {
  for (const auto& object : object_database()) {
    SCOPED_TRACE(object.name);
    const GeneratedObject made = generate(object);
    support::expect_valid(made.mesh);
    EXPECT_NEAR(bounds(made.mesh).min().z(), 0.0, 5e-4);
    EXPECT_LE(made.footprint_radius_m, 0.18);
    EXPECT_LE(made.height_m, 0.32);
  }
}

TEST(ObjectDatabase, AnObjectRepeatsAndFollowsItsSeed) {
  const DatabaseObject object = object_database(1).front();
  EXPECT_EQ(to_obj(generate(object).mesh), to_obj(generate(object).mesh));
  EXPECT_NE(to_obj(generate(object).mesh), to_obj(generate(object_database(2).front()).mesh));
}

TEST(NearDuplicateObjects, LargerOnesAreLargerAndNothingElse) {
  const auto objects = object_database();
  const auto& near_duplicate =
      first_of(objects, [](const auto& o) { return o.near_duplicate == NearDuplicate::larger; });
  const GeneratedObject a = generate(original_of(objects, near_duplicate));
  const GeneratedObject b = generate(near_duplicate);
  EXPECT_NEAR(b.height_m / a.height_m, kNearDuplicateScale, 1e-9);
  EXPECT_EQ(a.texture, b.texture);
}

TEST(NearDuplicateObjects, HuesDifferOnOneShape) {
  const auto objects = object_database();
  const auto& near_duplicate =
      first_of(objects, [](const auto& o) { return o.near_duplicate == NearDuplicate::warmer; });
  const GeneratedObject a = generate(original_of(objects, near_duplicate));
  const GeneratedObject b = generate(near_duplicate);
  EXPECT_EQ(to_obj(a.mesh), to_obj(b.mesh));
  EXPECT_GT(changed_pixels(a.texture, b.texture), a.texture.rgb.size() / 4);
}

TEST(NearDuplicateObjects, DecalsAreSeenFromOneSideOnly) {
  const auto objects = object_database();
  for (const auto& near_duplicate : objects) {
    if (near_duplicate.near_duplicate != NearDuplicate::decal) continue;
    SCOPED_TRACE(near_duplicate.name);
    const GeneratedObject a = generate(original_of(objects, near_duplicate));
    const GeneratedObject b = generate(near_duplicate);
    ASSERT_GT(b.mesh.triangles.size(), a.mesh.triangles.size() + 100);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (std::size_t i = a.mesh.positions_m.size(); i < b.mesh.positions_m.size(); ++i) {
      mean += b.mesh.normals[i].head<2>();
    }
    for (std::size_t i = a.mesh.positions_m.size(); i < b.mesh.positions_m.size(); ++i) {
      EXPECT_GT(b.mesh.normals[i].head<2>().dot(mean.normalized()), 0.0);
    }
  }
}

TEST(NearDuplicateObjects, BackLabelsDifferOnTheSameSheet) {
  const auto objects = object_database();
  for (const auto& near_duplicate : objects) {
    if (near_duplicate.near_duplicate != NearDuplicate::back_label) continue;
    SCOPED_TRACE(near_duplicate.name);
    const GeneratedObject a = generate(original_of(objects, near_duplicate));
    const GeneratedObject b = generate(near_duplicate);
    EXPECT_EQ(to_obj(a.mesh), to_obj(b.mesh));
    const std::size_t changed = changed_pixels(a.texture, b.texture);
    EXPECT_GT(changed, 3U * 96U * 10U);
    EXPECT_LE(changed, 3U * 96U * 96U);
  }
}

}  // namespace
}  // namespace vantage
