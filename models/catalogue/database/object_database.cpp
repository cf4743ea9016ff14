#include "vantage/models/catalogue/database/object_database.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "vantage/models/catalogue/database/sticker.hpp"
#include "vantage/models/catalogue/shapes/patterns.hpp"

namespace vantage {
namespace {

/// Too low for an image on the side.
constexpr std::array<std::string_view, 13> kLow{
    "banana",     "plate",  "book",     "screwdriver", "wrench",     "marker",    "hammer",
    "flashlight", "sponge", "keyboard", "calculator",  "cell_phone", "toothpaste"};

/// Categories of 6 and 7 objects that make kDatabaseObjects.
int size_of_category(int index, int categories) {
  return (index + 1) * kDatabaseObjects / categories - index * kDatabaseObjects / categories;
}

std::vector<int> family_sizes(int objects, bool even) {
  if (objects == 7) return {4, 3};
  return even ? std::vector{3, 3} : std::vector{4, 2};
}

/// The kinds of a family in turn, from another one in each family.
NearDuplicate near_duplicate_of(std::string_view category, std::size_t family, int member) {
  if (member == 0) return NearDuplicate::original;
  constexpr std::array tall{NearDuplicate::larger, NearDuplicate::decal, NearDuplicate::warmer,
                            NearDuplicate::back_label};
  constexpr std::array low{NearDuplicate::larger, NearDuplicate::warmer, NearDuplicate::cooler};
  const bool is_low = std::ranges::find(kLow, category) != kLow.end();
  const std::span<const NearDuplicate> kinds = is_low ? std::span<const NearDuplicate>(low) : tall;
  return kinds[(family + static_cast<std::size_t>(member)) % kinds.size()];
}

std::vector<DatabaseObject> plan_family(std::string_view category, std::size_t index, char letter,
                                        int first_number, int size, std::uint64_t seed) {
  std::vector<DatabaseObject> members;
  bool labelled = false;
  for (int member = 0; member < size; ++member) {
    const NearDuplicate near_duplicate = near_duplicate_of(category, index, member);
    labelled = labelled || near_duplicate == NearDuplicate::back_label;
    members.push_back({.name = fmt::format("{}_{}", category, first_number + member),
                       .category = std::string(category),
                       .family = fmt::format("{}_{}", category, letter),
                       .near_duplicate = near_duplicate,
                       .seed = seed});
  }
  for (DatabaseObject& object : members) object.labelled = labelled;
  return members;
}

void enlarge(GeneratedObject& object, double factor) {
  scale(object.mesh, Eigen::Vector3d::Constant(factor));
  for (auto& p : object.footprint_m) p *= factor;
  object.footprint_radius_m *= factor;
  object.height_m *= factor;
  object.top_radius_m *= factor;
  object.mass_kg *= factor * factor * factor;
}

/// The hue of a colour turned, and `brightness` times as bright.
RgbColour turned(const RgbColour& colour, double turns, double brightness) {
  const double high = colour.maxCoeff();
  const double chroma = high - colour.minCoeff();
  if (chroma <= 0.0) return brightness * colour;
  double hue = 0.0;
  if (high == colour.x()) {
    hue = (colour.y() - colour.z()) / chroma;
  } else if (high == colour.y()) {
    hue = 2.0 + (colour.z() - colour.x()) / chroma;
  } else {
    hue = 4.0 + (colour.x() - colour.y()) / chroma;
  }
  return brightness * hsv(hue / 6.0 + turns, chroma / high, high);
}

void recolour(Image& image, double turns, double brightness) {
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      image.set(x, y, turned(image.at(x, y), turns, brightness));
    }
  }
}

Image decal_image(Rng& rng) {
  const double hue = rng.uniform();
  const RgbColour ground = hsv(hue, 0.75, 0.8);
  Image sticker_image(64, 64, RgbColour(0.96, 0.96, 0.94));
  draw_disc(sticker_image, {0.06, 0.06, 0.94, 0.94}, ground);
  const char letter = static_cast<char>('A' + rng.uniform_index(26));
  draw_text(sticker_image, {0.32, 0.25, 0.68, 0.75}, std::string_view(&letter, 1),
            RgbColour::Ones());
  return sticker_image;
}

Image label_image(Rng& rng) {
  const double hue = rng.uniform();
  const RgbColour accent = hsv(hue, 0.7, 0.7);
  Image sticker_image(96, 96, RgbColour(0.95, 0.94, 0.9));
  paint(sticker_image, {0.0, 0.72, 1.0, 1.0}, accent);
  std::array<char, 3> code{};
  for (char& letter : code) letter = static_cast<char>('A' + rng.uniform_index(26));
  draw_text(sticker_image, {0.2, 0.77, 0.8, 0.95}, {code.data(), code.size()}, RgbColour::Ones());
  draw_small_print(sticker_image, {0.08, 0.3, 0.92, 0.68}, RgbColour(0.2, 0.2, 0.2), rng);
  draw_barcode(sticker_image, {0.1, 0.05, 0.55, 0.25}, rng);
  draw_disc(sticker_image, {0.65, 0.04, 0.92, 0.27}, accent);
  return sticker_image;
}

double typical_width_m(const GeneratedObject& object) {
  const Eigen::Vector3d size = bounds(object.mesh).sizes();
  return std::min(size.x(), size.y());
}

}  // namespace

std::string_view near_duplicate_name(NearDuplicate near_duplicate) {
  constexpr std::array<std::string_view, 6> names{"original", "larger", "warmer",
                                                  "cooler",   "decal",  "back_label"};
  return names[static_cast<std::size_t>(near_duplicate)];
}

std::vector<DatabaseObject> object_database(std::uint64_t seed) {
  const std::vector<std::string_view> categories = object_categories();
  std::vector<DatabaseObject> objects;
  for (std::size_t family = 0; family < 2; ++family) {
    for (std::size_t c = 0; c < categories.size(); ++c) {
      const int size = size_of_category(static_cast<int>(c), static_cast<int>(categories.size()));
      const std::vector<int> sizes = family_sizes(size, c % 2 == 0);
      const std::vector<DatabaseObject> members =
          plan_family(categories[c], c + family, family == 0 ? 'a' : 'b',
                      family == 0 ? 1 : 1 + sizes[0], sizes[family], seed);
      objects.insert(objects.end(), members.begin(), members.end());
    }
  }
  return objects;
}

GeneratedObject generate(const DatabaseObject& object) {
  GeneratedObject made = generate(ObjectSpec{object.family, object.category, object.seed});
  Rng rng = Rng::stream(object.seed, object.family + "/stickers");
  if (object.near_duplicate == NearDuplicate::larger) enlarge(made, kNearDuplicateScale);
  if (object.near_duplicate == NearDuplicate::warmer)
    recolour(made.texture, kNearDuplicateHue_turns, kNearDuplicateBrightness);
  if (object.near_duplicate == NearDuplicate::cooler)
    recolour(made.texture, -kNearDuplicateHue_turns, kNearDuplicateBrightness);
  const double heading = rng.uniform(-std::numbers::pi, std::numbers::pi);
  const double width_m = typical_width_m(made);
  const Image decal = decal_image(rng);
  const std::array<Image, 2> label{label_image(rng), label_image(rng)};
  if (object.labelled) {
    apply_sticker(
        made, {.heading_rad = 0.5 * std::numbers::pi,
               .middle = 0.5,
               .width_m = 0.6 * width_m,
               .height_m = std::min(0.6 * width_m, 0.5 * made.height_m),
               .sticker_image = label[object.near_duplicate == NearDuplicate::back_label ? 1 : 0]});
  }
  if (object.near_duplicate == NearDuplicate::decal) {
    const double size_m = std::min(0.45 * width_m, 0.45 * made.height_m);
    apply_sticker(made, {.heading_rad = heading,
                         .middle = 0.55,
                         .width_m = size_m,
                         .height_m = size_m,
                         .sticker_image = decal});
  }
  return made;
}

}  // namespace vantage
