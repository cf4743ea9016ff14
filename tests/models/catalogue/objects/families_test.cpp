#include "vantage/models/catalogue/objects/families.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/models/catalogue/shapes/mesh_checks.hpp"
#include "vantage/core/error.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"

namespace vantage {
namespace {

class EveryCategory : public testing::TestWithParam<std::string_view> {
 protected:
  static ObjectSpec spec(int instance) {
    return {std::string(GetParam()) + "_0" + std::to_string(instance), std::string(GetParam()), 11};
  }
};

TEST_P(EveryCategory, MeshesAreClosedTexturedAndOfHouseholdSize) {
  for (int instance = 0; instance < 6; ++instance) {
    SCOPED_TRACE(spec(instance).name);
    const GeneratedObject object = generate(spec(instance));
    support::expect_valid(object.mesh);
    EXPECT_TRUE(is_watertight(object.mesh));
    EXPECT_GT(signed_volume_m3(object.mesh), 1e-6);
    EXPECT_LT(support::share_shaded_inside_out(object.mesh), 0.03);
    EXPECT_GE(object.mesh.triangles.size(), 300U);
    EXPECT_LE(object.mesh.triangles.size(), 2000U);
    for (const auto& uv : object.mesh.uvs) {
      ASSERT_GE(uv.minCoeff(), 0.0);
      ASSERT_LE(uv.maxCoeff(), 1.0);
    }
    EXPECT_LE(object.height_m, 0.30);
    EXPECT_GE(object.height_m, 0.01);
    EXPECT_LE(object.footprint_radius_m, 0.17);
    EXPECT_GT(object.mass_kg, 0.0);
    EXPECT_GT(object.texture.width_px, 0);
  }
}

TEST_P(EveryCategory, OriginIsBelowTheMiddle) {
  const GeneratedObject object = generate(spec(0));
  const Eigen::AlignedBox3d box = bounds(object.mesh);
  EXPECT_NEAR(box.min().z(), 0.0, 1e-12);
  EXPECT_NEAR(box.max().z(), object.height_m, 1e-12);
  EXPECT_LT(box.center().head<2>().norm(), 1e-12);
  double radius = 0.0;
  for (const auto& p : object.mesh.positions_m) radius = std::max(radius, p.head<2>().norm());
  EXPECT_NEAR(radius, object.footprint_radius_m, 1e-12);
}

TEST_P(EveryCategory, InstancesDifferAndRepeat) {
  const GeneratedObject first = generate(spec(0));
  const GeneratedObject again = generate(spec(0));
  const GeneratedObject second = generate(spec(1));
  EXPECT_EQ(to_obj(first.mesh), to_obj(again.mesh));
  EXPECT_EQ(first.texture, again.texture);
  EXPECT_NE(to_obj(first.mesh), to_obj(second.mesh));
  EXPECT_NE(first.texture, second.texture);
}

INSTANTIATE_TEST_SUITE_P(Families, EveryCategory, testing::ValuesIn(object_categories()),
                         [](const auto& info) { return std::string(info.param); });

TEST(Families, CatalogueNamesAreUniqueAndFollowTheirCategory) {
  const std::vector<ObjectSpec> specs = catalogue(3, 2);
  EXPECT_EQ(specs.size(), 2U * 30U);
  EXPECT_EQ(object_categories().size(), 51U);
  std::set<std::string> names;
  for (const ObjectSpec& spec : specs) {
    names.insert(spec.name);
    EXPECT_EQ(spec.name.substr(0, spec.category.size()), spec.category);
  }
  EXPECT_EQ(names.size(), specs.size());
}

TEST(Families, SeedChangesTheObject) {
  EXPECT_NE(to_obj(generate({"mug_00", "mug", 1}).mesh),
            to_obj(generate({"mug_00", "mug", 2}).mesh));
}

TEST(Families, UnknownCategoryIsNamed) {
  try {
    generate({"boat_00", "boat", 1});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("unknown category 'boat'; known: mug"));
  }
}

}  // namespace
}  // namespace vantage
