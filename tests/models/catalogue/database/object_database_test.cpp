#include "vantage/models/catalogue/database/object_database.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "vantage/models/catalogue/shapes/obj.hpp"
#include "tests/models/catalogue/shapes/mesh_checks.hpp"

namespace vantage {
namespace {

const DatabaseObject& first_of(const std::vector<DatabaseObject>& objects, auto&& wanted) {
  return *std::ranges::find_if(objects, wanted);
}

const DatabaseObject& original_of(const std::vector<DatabaseObject>& objects,
                                  const DatabaseObject& twin) {
  return first_of(objects, [&](const DatabaseObject& other) {
    return other.family == twin.family && other.twin == Twin::original;
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
  std::map<Twin, int> kinds;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    ++kinds[objects[i].twin];
    const bool begins = i == 0 || objects[i].family != objects[i - 1].family;
    EXPECT_EQ(objects[i].twin == Twin::original, begins) << objects[i].name;
    if (begins) {
      EXPECT_TRUE(seen.insert(objects[i].family).second) << objects[i].family;
    } else {
      EXPECT_EQ(objects[i].labelled, objects[i - 1].labelled);
    }
  }
  for (const Twin twin : {Twin::larger, Twin::warmer, Twin::decal, Twin::back_label}) {
    EXPECT_GE(kinds[twin], 25) << twin_name(twin);
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

TEST(Twins, LargerOnesAreLargerAndNothingElse) {
  const auto objects = object_database();
  const auto& twin = first_of(objects, [](const auto& o) { return o.twin == Twin::larger; });
  const GeneratedObject a = generate(original_of(objects, twin));
  const GeneratedObject b = generate(twin);
  EXPECT_NEAR(b.height_m / a.height_m, kTwinScale, 1e-9);
  EXPECT_EQ(a.texture, b.texture);
}

TEST(Twins, HuesDifferOnOneShape) {
  const auto objects = object_database();
  const auto& twin = first_of(objects, [](const auto& o) { return o.twin == Twin::warmer; });
  const GeneratedObject a = generate(original_of(objects, twin));
  const GeneratedObject b = generate(twin);
  EXPECT_EQ(to_obj(a.mesh), to_obj(b.mesh));
  EXPECT_GT(changed_pixels(a.texture, b.texture), a.texture.rgb.size() / 4);
}

TEST(Twins, DecalsAreSeenFromOneSideOnly) {
  const auto objects = object_database();
  for (const auto& twin : objects) {
    if (twin.twin != Twin::decal) continue;
    SCOPED_TRACE(twin.name);
    const GeneratedObject a = generate(original_of(objects, twin));
    const GeneratedObject b = generate(twin);
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

TEST(Twins, BackLabelsDifferOnTheSameSheet) {
  const auto objects = object_database();
  for (const auto& twin : objects) {
    if (twin.twin != Twin::back_label) continue;
    SCOPED_TRACE(twin.name);
    const GeneratedObject a = generate(original_of(objects, twin));
    const GeneratedObject b = generate(twin);
    EXPECT_EQ(to_obj(a.mesh), to_obj(b.mesh));
    const std::size_t changed = changed_pixels(a.texture, b.texture);
    EXPECT_GT(changed, 3U * 96U * 10U);
    EXPECT_LE(changed, 3U * 96U * 96U);
  }
}

}  // namespace
}  // namespace vantage
