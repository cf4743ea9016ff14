/// What the shape families are made with. Each make_* draws one instance; origin, footprint and
/// height are filled in afterwards by generate(). The order in which a function's arguments are
/// evaluated is the compiler's choice: draws stand in separate statements or inside braces.
#pragma once

#include <array>
#include <span>

#include "vantage/models/catalogue/objects/families.hpp"
#include "vantage/models/catalogue/shapes/mesh_builders.hpp"
#include "vantage/models/catalogue/shapes/patterns.hpp"

namespace vantage::family {

using Profile = std::vector<Eigen::Vector2d>;  ///< (r, z), metres

inline constexpr int kTexture_px = 256;
inline constexpr int kAround = 28;  ///< sides of a surface of revolution

/// Of a box, in the order of its BoxUv.
enum Face : std::size_t { right, left, back, front, top, bottom };

/// Texture layout of things turned on a lathe.
inline constexpr UvRect kWall{0.0, 0.28, 1.0, 1.0};
inline constexpr UvRect kInner{0.0, 0.0, 0.5, 0.27};
inline constexpr UvRect kPart{0.5, 0.0, 1.0, 0.27};
/// The same, kept away from the neighbours; for builders. u of the wall wraps round.
inline constexpr UvRect kWallUv{0.0, 0.29, 1.0, 0.995};
inline constexpr UvRect kInnerUv{0.01, 0.01, 0.49, 0.26};
inline constexpr UvRect kPartUv{0.51, 0.01, 0.99, 0.26};

/// Limits of hue (turns), saturation and brightness.
struct ColourRange {
  std::array<double, 2> hue;
  std::array<double, 2> saturation;
  std::array<double, 2> brightness;
};
RgbColour any_colour(const ColourRange& range, Rng& rng);
RgbColour vivid(Rng& rng);
RgbColour pale(Rng& rng);
RgbColour dark(Rng& rng);
inline const RgbColour kWhite{0.96, 0.96, 0.94};
inline const RgbColour kBlack{0.08, 0.08, 0.09};
inline const RgbColour kSteel{0.68, 0.70, 0.72};

template <class T, std::size_t N>
const T& pick(const std::array<T, N>& choices, Rng& rng) {
  return choices[rng.uniform_index(N)];
}

Image make_texture(const RgbColour& wall, const RgbColour& inner, const RgbColour& part);

double radius_at(std::span<const Eigen::Vector2d> profile_m, double z_m);

/// A vessel open at the top: base, outer wall, rounded rim, inner wall, floor. `outer_m` runs from
/// the edge of the base up to the rim; wall thickness is measured horizontally.
void add_vessel(TriangleMesh& mesh, std::span<const Eigen::Vector2d> outer_m, double wall_m,
                double floor_m);
/// A solid between two level discs, with `side` on the wall and `ends` on base and top.
void add_solid(TriangleMesh& mesh, std::span<const Eigen::Vector2d> outer_m, const UvRect& side,
               const UvRect& ends);
/// A handle in the x z plane, bulging by `reach_m` from (r, z_high) to (r, z_low) of the profile.
TriangleMesh make_handle(std::span<const Eigen::Vector2d> outer_m, double z_low_m, double z_high_m,
                         double reach_m, double width_m);

/// Lays a thing built along z on its side, along x.
void lay_down(TriangleMesh& mesh);

struct Label {
  std::string_view text;
  RgbColour ground;
  RgbColour ink;
};
/// A label across part of a wall: name, ornament, small print, barcode.
void draw_label(Image& image, const UvRect& wall, const Label& label, Rng& rng);

GeneratedObject make_mug(Rng& rng);
GeneratedObject make_bowl(Rng& rng);
GeneratedObject make_plate(Rng& rng);
GeneratedObject make_cup(Rng& rng);
GeneratedObject make_tumbler(Rng& rng);
GeneratedObject make_vase(Rng& rng);
GeneratedObject make_teapot(Rng& rng);
GeneratedObject make_pitcher(Rng& rng);

GeneratedObject make_bottle(Rng& rng);
GeneratedObject make_wine_bottle(Rng& rng);
GeneratedObject make_detergent_bottle(Rng& rng);
GeneratedObject make_soda_can(Rng& rng);
GeneratedObject make_food_can(Rng& rng);
GeneratedObject make_jar(Rng& rng);
GeneratedObject make_lamp(Rng& rng);

GeneratedObject make_cereal_box(Rng& rng);
GeneratedObject make_milk_carton(Rng& rng);
GeneratedObject make_tissue_box(Rng& rng);
GeneratedObject make_book(Rng& rng);
GeneratedObject make_toy_blocks(Rng& rng);

GeneratedObject make_banana(Rng& rng);
GeneratedObject make_apple(Rng& rng);
GeneratedObject make_orange(Rng& rng);
GeneratedObject make_lemon(Rng& rng);
GeneratedObject make_pear(Rng& rng);

GeneratedObject make_hammer(Rng& rng);
GeneratedObject make_screwdriver(Rng& rng);
GeneratedObject make_wrench(Rng& rng);
GeneratedObject make_flashlight(Rng& rng);
GeneratedObject make_sponge(Rng& rng);

GeneratedObject make_tomato(Rng& rng);
GeneratedObject make_onion(Rng& rng);
GeneratedObject make_potato(Rng& rng);
GeneratedObject make_bell_pepper(Rng& rng);
GeneratedObject make_mushroom(Rng& rng);
GeneratedObject make_garlic(Rng& rng);
GeneratedObject make_peach(Rng& rng);

GeneratedObject make_calculator(Rng& rng);
GeneratedObject make_cell_phone(Rng& rng);
GeneratedObject make_keyboard(Rng& rng);
GeneratedObject make_camera(Rng& rng);
GeneratedObject make_stapler(Rng& rng);

GeneratedObject make_ball(Rng& rng);
GeneratedObject make_light_bulb(Rng& rng);
GeneratedObject make_dry_battery(Rng& rng);
GeneratedObject make_glue_stick(Rng& rng);
GeneratedObject make_marker(Rng& rng);
GeneratedObject make_shampoo(Rng& rng);
GeneratedObject make_toothpaste(Rng& rng);
GeneratedObject make_instant_noodles(Rng& rng);
GeneratedObject make_food_bag(Rng& rng);

}  // namespace vantage::family
