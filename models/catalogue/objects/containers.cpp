#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr std::array<std::string_view, 6> kDrinks{"COLA", "WATER",   "LIME",
                                                  "SODA", "ICE TEA", "TONIC"};
constexpr std::array<std::string_view, 6> kTins{"BEANS", "SOUP", "CORN", "TUNA", "PEAS", "TOMATO"};
constexpr std::array<std::string_view, 6> kJars{"JAM",   "HONEY", "OLIVES",
                                                "PESTO", "CURRY", "CHILI"};
constexpr std::array<std::string_view, 5> kCleaners{"CLEAN", "SUDS", "FRESH", "WASH", "BLEACH"};
constexpr std::array<std::string_view, 5> kWines{"ROSSO", "MERLOT", "CAVA", "RIOJA", "SYRAH"};

}  // namespace

GeneratedObject make_bottle(Rng& rng) {
  const double h = rng.uniform(0.20, 0.27);
  const double r = rng.uniform(0.030, 0.038);
  const double shoulder = rng.uniform(0.62, 0.72) * h;
  const Profile outer = smooth_curve<Vector2d>(Profile{{0.86 * r, 0.0},
                                                       {r, 0.012},
                                                       {rng.uniform(0.9, 1.0) * r, 0.35 * h},
                                                       {r, shoulder},
                                                       {0.45 * r, 0.9 * h},
                                                       {0.36 * r, 0.93 * h}},
                                               3);
  GeneratedObject bottle;
  add_solid(bottle.mesh, outer, kWallUv, kInnerUv);
  add_solid(bottle.mesh, Profile{{0.42 * r, 0.925 * h}, {0.42 * r, h}}, kPartUv, kPartUv);
  const RgbColour drink = rng.uniform() < 0.5 ? hsv(rng.uniform(), 0.35, 0.9) : vivid(rng);
  const RgbColour ground = rng.uniform() < 0.5 ? kWhite : vivid(rng);
  bottle.texture = make_texture(drink, drink, vivid(rng));
  paint(bottle.texture, kWall, gradient(mix(drink, kBlack, 0.25), mix(drink, kWhite, 0.35)));
  draw_label(bottle.texture, part_of(kWall, 0.0, 0.28, 1.0, 0.62),
             {pick(kDrinks, rng), ground, dark(rng)}, rng);
  bottle.specular = 0.8;
  bottle.mass_kg = rng.uniform(0.3, 0.6);
  bottle.stands = true;
  return bottle;
}

GeneratedObject make_wine_bottle(Rng& rng) {
  const double h = rng.uniform(0.275, 0.294);
  const double r = rng.uniform(0.036, 0.041);
  const double shoulder = rng.uniform(0.56, 0.64) * h;
  const Profile outer = smooth_curve<Vector2d>(Profile{{0.95 * r, 0.0},
                                                       {r, 0.006},
                                                       {r, 0.5 * shoulder},
                                                       {r, shoulder},
                                                       {0.42 * r, shoulder + 0.15 * h},
                                                       {0.37 * r, 0.92 * h}},
                                               3);
  GeneratedObject bottle;
  add_solid(bottle.mesh, outer, kWallUv, kInnerUv);
  add_solid(bottle.mesh, Profile{{0.4 * r, 0.88 * h}, {0.4 * r, 0.975 * h}, {0.37 * r, h}}, kPartUv,
            kPartUv);
  const RgbColour glass = any_colour({{0.2, 0.45}, {0.5, 0.9}, {0.12, 0.32}}, rng);
  bottle.texture = make_texture(glass, glass, vivid(rng));
  draw_label(bottle.texture, part_of(kWall, 0.0, 0.14, 1.0, 0.48),
             {pick(kWines, rng), pale(rng), dark(rng)}, rng);
  bottle.specular = 0.9;
  bottle.mass_kg = 1.2;
  bottle.stands = true;
  return bottle;
}

GeneratedObject make_detergent_bottle(Rng& rng) {
  const double h = rng.uniform(0.21, 0.27);
  const double r = rng.uniform(0.05, 0.058);
  const double flatness = rng.uniform(0.55, 0.7);
  const Profile outer = smooth_curve<Vector2d>(Profile{{0.9 * r, 0.0},
                                                       {r, 0.012},
                                                       {rng.uniform(0.88, 1.0) * r, 0.4 * h},
                                                       {0.8 * r, 0.65 * h},
                                                       {0.42 * r, 0.86 * h}},
                                               3);
  GeneratedObject bottle;
  add_solid(bottle.mesh, outer, kWallUv, kInnerUv);
  scale(bottle.mesh, {1.0, flatness, 1.0});
  const double cap = 0.34 * r * flatness / 0.6;
  add_solid(bottle.mesh, Profile{{cap, 0.855 * h}, {cap, 0.96 * h}, {0.85 * cap, h}}, kPartUv,
            kPartUv);
  if (rng.uniform() < 0.6) {
    append(bottle.mesh, make_handle(outer, 0.42 * h, 0.8 * h, 0.022, 0.02));
  }
  const RgbColour plastic = vivid(rng);
  bottle.texture = make_texture(plastic, plastic, rng.uniform() < 0.4 ? kWhite : vivid(rng));
  draw_label(bottle.texture, part_of(kWall, 0.5, 0.12, 1.0, 0.66),
             {pick(kCleaners, rng), kWhite, dark(rng)}, rng);
  paint(bottle.texture, part_of(kWall, 0.12, 0.2, 0.38, 0.6), dots(plastic, kWhite, 4, 4, 0.35));
  bottle.specular = 0.4;
  bottle.mass_kg = rng.uniform(0.5, 1.1);
  bottle.stands = true;
  return bottle;
}

GeneratedObject make_soda_can(Rng& rng) {
  const bool slim = rng.uniform() < 0.35;
  const double r = slim ? 0.0265 : 0.033;
  const double h = slim ? rng.uniform(0.135, 0.16) : rng.uniform(0.112, 0.125);
  GeneratedObject can;
  const Vector2d foot(0.8 * r, 0.0);
  const Vector2d low(r, 0.009);
  const Vector2d high(r, h - 0.012);
  const Vector2d rim(0.82 * r, h);
  add_lathe(can.mesh, Profile{{0.0, 0.0}, foot, low}, kAround, kPartUv);
  add_lathe(can.mesh, Profile{low, {r, 0.33 * h}, {r, 0.66 * h}, high}, kAround, kWallUv);
  add_lathe(can.mesh, Profile{high, rim}, kAround, kPartUv);
  add_lathe(can.mesh, Profile{rim, {0.76 * r, h}, {0.74 * r, h - 0.004}, {0.0, h - 0.004}}, kAround,
            kPartUv);
  const RgbColour ground = vivid(rng);
  const RgbColour accent = rng.uniform() < 0.5 ? kWhite : vivid(rng);
  can.texture = make_texture(ground, ground, kSteel);
  paint(can.texture, kWall,
        rng.uniform() < 0.5 ? gradient(ground, mix(ground, accent, 0.6))
                            : stripes(ground, mix(ground, accent, 0.4), 2, 1.0));
  const std::string_view word = pick(kDrinks, rng);
  draw_text(can.texture, part_of(kWall, 0.08, 0.44, 0.42, 0.7), word, accent);
  draw_text(can.texture, part_of(kWall, 0.58, 0.44, 0.92, 0.7), word, accent);
  draw_barcode(can.texture, part_of(kWall, 0.42, 0.08, 0.58, 0.28), rng);
  can.specular = 0.8;
  can.mass_kg = rng.uniform(0.3, 0.37);
  can.top_radius_m = 0.8 * r;
  can.stands = true;
  return can;
}

GeneratedObject make_food_can(Rng& rng) {
  const bool flat = rng.uniform() < 0.3;
  const double r = flat ? rng.uniform(0.04, 0.048) : rng.uniform(0.033, 0.042);
  const double h = flat ? rng.uniform(0.035, 0.05) : rng.uniform(0.085, 0.115);
  GeneratedObject can;
  const Vector2d foot(r + 0.001, 0.0);
  const Vector2d low(r, 0.004);
  const Vector2d high(r, h - 0.004);
  const Vector2d rim(r + 0.001, h);
  add_lathe(can.mesh, Profile{{0.0, 0.0}, foot}, kAround, kPartUv);
  add_lathe(can.mesh, Profile{foot, low}, kAround, kPartUv);
  add_lathe(can.mesh, Profile{low, {r, 0.33 * h}, {r, 0.66 * h}, high}, kAround, kWallUv);
  add_lathe(can.mesh, Profile{high, rim, {r - 0.001, h}, {r - 0.0015, h - 0.003}}, kAround,
            kPartUv);
  add_lathe(can.mesh, Profile{{r - 0.0015, h - 0.003}, {0.5 * r, h - 0.003}, {0.0, h - 0.003}},
            kAround, kPartUv);
  can.texture = make_texture(kWhite, kWhite, kSteel);
  paint(can.texture, kPart, bands(kSteel, 0.9 * kSteel, 3));
  const RgbColour ground = vivid(rng);
  draw_label(can.texture, kWall,
             {pick(kTins, rng), ground, rng.uniform() < 0.5 ? kWhite : dark(rng)}, rng);
  can.specular = 0.5;
  can.mass_kg = rng.uniform(0.2, 0.45);
  can.top_radius_m = r;
  can.stands = true;
  return can;
}

GeneratedObject make_jar(Rng& rng) {
  const double r = rng.uniform(0.032, 0.045);
  const double h = rng.uniform(0.09, 0.15);
  const double lid_r = rng.uniform(0.78, 0.95) * r;
  const Profile outer = smooth_curve<Vector2d>(
      Profile{{0.92 * r, 0.0}, {r, 0.008}, {r, 0.45 * h}, {r, 0.72 * h}, {0.93 * lid_r, 0.86 * h}},
      2);
  GeneratedObject jar;
  add_solid(jar.mesh, outer, kWallUv, kInnerUv);
  add_solid(jar.mesh, Profile{{lid_r, 0.845 * h}, {lid_r, h - 0.003}, {lid_r - 0.002, h}}, kPartUv,
            kPartUv);
  const RgbColour content = any_colour({{-0.05, 0.3}, {0.6, 0.95}, {0.35, 0.85}}, rng);
  jar.texture = make_texture(content, content, vivid(rng));
  paint(jar.texture, kWall, mottled(content, mix(content, kBlack, 0.35), 8, rng));
  draw_label(jar.texture, part_of(kWall, 0.0, 0.22, 1.0, 0.68),
             {pick(kJars, rng), pale(rng), dark(rng)}, rng);
  jar.specular = 0.7;
  jar.mass_kg = rng.uniform(0.35, 0.6);
  jar.top_radius_m = lid_r - 0.002;
  jar.stands = true;
  return jar;
}

GeneratedObject make_lamp(Rng& rng) {
  const double h = rng.uniform(0.24, 0.29);
  const double shade_low = rng.uniform(0.06, 0.075);
  const double shade_high = rng.uniform(0.5, 0.8) * shade_low;
  const double foot = rng.uniform(0.04, 0.052);
  const double z_shade = rng.uniform(0.5, 0.58) * h;
  GeneratedObject lamp;
  const Profile stand = smooth_curve<Vector2d>(Profile{{foot, 0.0},
                                                       {foot, 0.01},
                                                       {0.012, 0.03},
                                                       {rng.uniform(0.012, 0.032), 0.45 * z_shade},
                                                       {0.009, z_shade},
                                                       {0.009, h - 0.03}},
                                               3);
  add_solid(lamp.mesh, stand, kPartUv, kPartUv);
  const double wall = 0.002;
  const Vector2d low(shade_low, z_shade);
  const Vector2d high(shade_high, h);
  const Vector2d inner(wall, 0.0);
  add_lathe(lamp.mesh, Profile{low, 0.5 * (low + high), high}, kAround, kWallUv);
  add_lathe(lamp.mesh, Profile{high, high - inner}, kAround, kInnerUv);
  add_lathe(lamp.mesh, Profile{high - inner, low - inner}, kAround, kInnerUv);
  add_lathe(lamp.mesh, Profile{low - inner, low}, kAround, kInnerUv);
  const RgbColour shade = pale(rng);
  const RgbColour accent = vivid(rng);
  lamp.texture = make_texture(shade, kWhite, rng.uniform() < 0.4 ? kSteel : vivid(rng));
  if (rng.uniform() < 0.5)
    paint(lamp.texture, kWall, any_pattern(shade, mix(shade, accent, 0.6), rng));
  paint(lamp.texture, part_of(kWall, 0.0, 0.0, 1.0, 0.07), accent);
  paint(lamp.texture, part_of(kWall, 0.0, 0.93, 1.0, 1.0), accent);
  lamp.mass_kg = rng.uniform(0.6, 1.1);
  lamp.stands = true;
  return lamp;
}

}  // namespace vantage::family
