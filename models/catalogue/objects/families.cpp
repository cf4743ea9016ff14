#include "vantage/models/catalogue/objects/families.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "vantage/core/error.hpp"
#include "vantage/models/catalogue/objects/family_kit.hpp"
#include "vantage/models/catalogue/shapes/footprint.hpp"

namespace vantage {
namespace {

struct Family {
  std::string_view category;
  GeneratedObject (*make)(Rng&);
};

constexpr std::array kFamilies{
    Family{"mug", family::make_mug},
    Family{"cereal_box", family::make_cereal_box},
    Family{"bottle", family::make_bottle},
    Family{"bowl", family::make_bowl},
    Family{"soda_can", family::make_soda_can},
    Family{"banana", family::make_banana},
    Family{"book", family::make_book},
    Family{"teapot", family::make_teapot},
    Family{"apple", family::make_apple},
    Family{"detergent_bottle", family::make_detergent_bottle},
    Family{"plate", family::make_plate},
    Family{"food_can", family::make_food_can},
    Family{"vase", family::make_vase},
    Family{"toy_blocks", family::make_toy_blocks},
    Family{"hammer", family::make_hammer},
    Family{"milk_carton", family::make_milk_carton},
    Family{"tumbler", family::make_tumbler},
    Family{"orange", family::make_orange},
    Family{"jar", family::make_jar},
    Family{"lamp", family::make_lamp},
    Family{"screwdriver", family::make_screwdriver},
    Family{"wine_bottle", family::make_wine_bottle},
    Family{"cup", family::make_cup},
    Family{"lemon", family::make_lemon},
    Family{"pitcher", family::make_pitcher},
    Family{"tissue_box", family::make_tissue_box},
    Family{"wrench", family::make_wrench},
    Family{"pear", family::make_pear},
    Family{"flashlight", family::make_flashlight},
    Family{"sponge", family::make_sponge},
    // Not on the tables of the scenes.
    Family{"tomato", family::make_tomato},
    Family{"onion", family::make_onion},
    Family{"potato", family::make_potato},
    Family{"bell_pepper", family::make_bell_pepper},
    Family{"mushroom", family::make_mushroom},
    Family{"garlic", family::make_garlic},
    Family{"peach", family::make_peach},
    Family{"calculator", family::make_calculator},
    Family{"cell_phone", family::make_cell_phone},
    Family{"keyboard", family::make_keyboard},
    Family{"camera", family::make_camera},
    Family{"stapler", family::make_stapler},
    Family{"ball", family::make_ball},
    Family{"light_bulb", family::make_light_bulb},
    Family{"dry_battery", family::make_dry_battery},
    Family{"glue_stick", family::make_glue_stick},
    Family{"marker", family::make_marker},
    Family{"shampoo", family::make_shampoo},
    Family{"toothpaste", family::make_toothpaste},
    Family{"instant_noodles", family::make_instant_noodles},
    Family{"food_bag", family::make_food_bag},
};
constexpr std::size_t kTabletopCategories = 30;  // the first; the scenes depend on their number

/// Moves the origin below the middle of the bounding box and measures what follows from the mesh.
void settle(GeneratedObject& object) {
  const Eigen::AlignedBox3d box = bounds(object.mesh);
  const Eigen::Vector3d middle = box.center();
  transform(object.mesh, make_pose({-middle.x(), -middle.y(), -box.min().z()}, 0.0));
  object.height_m = box.sizes().z();
  object.footprint_m = convex_footprint(object.mesh);
  for (const auto& p : object.footprint_m) {
    object.footprint_radius_m = std::max(object.footprint_radius_m, p.norm());
  }
}

}  // namespace

std::vector<std::string_view> object_categories() {
  std::vector<std::string_view> names;
  for (const Family& family : kFamilies) names.push_back(family.category);
  return names;
}

std::vector<ObjectSpec> catalogue(std::uint64_t seed, int per_category) {
  std::vector<ObjectSpec> specs;
  for (const Family& family : std::span(kFamilies).first<kTabletopCategories>()) {
    for (int i = 0; i < per_category; ++i) {
      specs.push_back(
          {fmt::format("{}_{:02}", family.category, i), std::string(family.category), seed});
    }
  }
  return specs;
}

GeneratedObject generate(const ObjectSpec& spec) {
  const auto family = std::ranges::find(kFamilies, spec.category, &Family::category);
  if (family == kFamilies.end()) {
    throw ConfigError(fmt::format("object '{}': unknown category '{}'; known: {}", spec.name,
                                  spec.category, fmt::join(object_categories(), ", ")));
  }
  Rng rng = Rng::stream(spec.seed, spec.name);
  GeneratedObject object = family->make(rng);
  settle(object);
  return object;
}

}  // namespace vantage
