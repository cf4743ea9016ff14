#include <algorithm>
#include <cmath>

#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr std::array<std::string_view, 6> kMugWords{"HELLO",  "TEA",   "BOSS",
                                                    "COFFEE", "ROBOT", "MOM"};

/// Crockery: a pattern, a word or a plain glaze, with a rim in the second colour.
void decorate(Image& image, const RgbColour& ground, const RgbColour& accent, Rng& rng) {
  const double kind = rng.uniform();
  if (kind < 0.55) {
    paint(image, part_of(kWall, 0.0, 0.15, 1.0, 0.85), any_pattern(ground, accent, rng));
  } else if (kind < 0.8) {
    draw_text(image, part_of(kWall, 0.57, 0.34, 0.93, 0.66), pick(kMugWords, rng), accent);
    draw_disc(image, part_of(kWall, 0.14, 0.28, 0.36, 0.72), accent);
  } else {
    paint(image, kWall, gradient(ground, accent));
  }
  paint(image, part_of(kWall, 0.0, 0.94, 1.0, 1.0), accent);
}

/// Ceramic colours: pale outside with a vivid accent, or the other way round.
std::array<RgbColour, 2> glaze(Rng& rng) {
  const RgbColour a = pale(rng);
  const RgbColour b = vivid(rng);
  if (rng.uniform() < 0.5) return {a, b};
  return {b, a};
}

}  // namespace

GeneratedObject make_mug(Rng& rng) {
  const double r = rng.uniform(0.037, 0.046);
  const double h = rng.uniform(0.085, 0.108);
  const double taper = rng.uniform(0.78, 1.05);
  const double belly = rng.uniform(-0.05, 0.10);
  const double wall = 0.004;
  const Profile outer = smooth_curve<Vector2d>(Profile{{taper * r * 0.93, 0.0},
                                                       {taper * r, 0.006},
                                                       {r * (0.5 + 0.5 * taper + belly), 0.5 * h},
                                                       {r, h}},
                                               3);
  GeneratedObject mug;
  add_vessel(mug.mesh, outer, wall, 0.006);
  append(mug.mesh, make_handle(outer, 0.18 * h, 0.84 * h, rng.uniform(0.026, 0.034), 0.012));
  const auto [ground, accent] = glaze(rng);
  mug.texture = make_texture(ground, mix(ground, kWhite, 0.6), accent);
  decorate(mug.texture, ground, accent, rng);
  mug.specular = 0.5;
  mug.mass_kg = rng.uniform(0.28, 0.4);
  mug.stands = true;
  return mug;
}

GeneratedObject make_bowl(Rng& rng) {
  const double r = rng.uniform(0.062, 0.085);
  const double h = rng.uniform(0.05, 0.075);
  const double foot = rng.uniform(0.4, 0.55);
  const Profile outer = smooth_curve<Vector2d>(
      Profile{{foot * r, 0.0}, {0.78 * r, 0.25 * h}, {0.95 * r, 0.62 * h}, {r, h}}, 3);
  GeneratedObject bowl;
  add_vessel(bowl.mesh, outer, 0.004, 0.006);
  const auto [ground, accent] = glaze(rng);
  bowl.texture = make_texture(ground, mix(accent, kWhite, 0.35), accent);
  decorate(bowl.texture, ground, accent, rng);
  paint(bowl.texture, part_of(kInner, 0.0, 0.72, 1.0, 0.82), accent);
  bowl.specular = 0.5;
  bowl.mass_kg = rng.uniform(0.25, 0.45);
  bowl.stands = true;
  return bowl;
}

GeneratedObject make_plate(Rng& rng) {
  const double r = rng.uniform(0.085, 0.12);
  const double h = rng.uniform(0.018, 0.026);
  GeneratedObject plate;
  const Vector2d foot(0.55 * r, 0.0);
  const Vector2d rim(r, h);
  const Vector2d lip(r - 0.002, h + 0.003);
  add_lathe(plate.mesh, Profile{{0.0, 0.0}, foot}, kAround, kPartUv);
  add_lathe(plate.mesh, Profile{foot, {0.68 * r, 0.004}, {0.86 * r, 0.6 * h}, rim}, kAround,
            kPartUv);
  add_lathe(plate.mesh, Profile{rim, lip}, kAround, kPartUv);
  add_lathe(
      plate.mesh,
      Profile{lip, {0.84 * r, 0.6 * h + 0.004}, {0.66 * r, 0.008}, {0.5 * r, 0.0065}, {0.0, 0.006}},
      kAround, kWallUv);
  const auto [ground, accent] = glaze(rng);
  plate.texture = make_texture(ground, ground, ground);
  paint(plate.texture, part_of(kWall, 0.0, 0.04, 1.0, 0.3),
        any_pattern(mix(ground, kWhite, 0.5), accent, rng));
  paint(plate.texture, part_of(kWall, 0.0, 0.34, 1.0, 0.38), accent);
  plate.specular = 0.5;
  plate.mass_kg = rng.uniform(0.3, 0.6);
  plate.stands = true;
  return plate;
}

GeneratedObject make_cup(Rng& rng) {  // of paper, with a lid or without
  const double h = rng.uniform(0.09, 0.14);
  const double r = rng.uniform(0.039, 0.045);
  const Profile outer{{0.7 * r, 0.0}, {0.8 * r, 0.34 * h}, {0.9 * r, 0.67 * h}, {r, h}};
  const bool lid = rng.uniform() < 0.5;
  GeneratedObject cup;
  const RgbColour ground = rng.uniform() < 0.5 ? kWhite : RgbColour(0.66, 0.47, 0.30);
  const RgbColour accent = vivid(rng);
  cup.texture = make_texture(ground, kWhite, dark(rng));
  if (lid) {
    add_solid(cup.mesh, outer, kWallUv, kInnerUv);
    add_solid(cup.mesh,
              Profile{{r + 0.0015, h - 0.004},
                      {r + 0.002, h + 0.003},
                      {0.9 * r, h + 0.01},
                      {0.86 * r, h + 0.014}},
              kPartUv, kPartUv);
  } else {
    add_vessel(cup.mesh, outer, 0.002, 0.005);
  }
  paint(cup.texture, part_of(kWall, 0.0, 0.3, 1.0, 0.72),
        any_pattern(accent, mix(accent, kBlack, 0.4), rng));
  draw_disc(cup.texture, part_of(kWall, 0.15, 0.34, 0.35, 0.68), kWhite);
  draw_disc(cup.texture, part_of(kWall, 0.65, 0.34, 0.85, 0.68), kWhite);
  cup.mass_kg = rng.uniform(0.02, 0.3);
  cup.stands = true;
  return cup;
}

GeneratedObject make_tumbler(Rng& rng) {
  const double h = rng.uniform(0.10, 0.15);
  const double r = rng.uniform(0.032, 0.04);
  const double base = rng.uniform(0.75, 1.0);
  const Profile outer = smooth_curve<Vector2d>(
      Profile{{base * r, 0.0}, {0.5 * (1.0 + base) * r * rng.uniform(0.92, 1.05), 0.5 * h}, {r, h}},
      3);
  GeneratedObject glass;
  add_vessel(glass.mesh, outer, 0.003, 0.012);
  const RgbColour tint = any_colour({{0.0, 1.0}, {0.15, 0.55}, {0.9, 0.9}}, rng);
  glass.texture = make_texture(tint, mix(tint, kWhite, 0.3), tint);
  paint(glass.texture, part_of(kWall, 0.0, 0.0, 1.0, 0.12), mix(tint, kBlack, 0.35));
  const RgbColour accent = vivid(rng);
  if (rng.uniform() < 0.6) {
    paint(glass.texture, part_of(kWall, 0.0, 0.55, 1.0, 0.85), any_pattern(tint, accent, rng));
  } else {
    paint(glass.texture, part_of(kWall, 0.0, 0.12, 1.0, 0.95),
          stripes(tint, mix(tint, kWhite, 0.5), 14));
  }
  glass.specular = 0.9;
  glass.mass_kg = rng.uniform(0.18, 0.35);
  glass.stands = true;
  return glass;
}

GeneratedObject make_vase(Rng& rng) {
  const double h = rng.uniform(0.17, 0.27);
  const double r = rng.uniform(0.04, 0.06);
  const double neck = rng.uniform(0.4, 0.65);
  const Profile outer = smooth_curve<Vector2d>(Profile{{rng.uniform(0.5, 0.75) * r, 0.0},
                                                       {r, rng.uniform(0.25, 0.45) * h},
                                                       {neck * r, 0.8 * h},
                                                       {(neck + 0.22) * r, h}},
                                               4);
  GeneratedObject vase;
  add_vessel(vase.mesh, outer, 0.005, 0.01);
  const auto [ground, accent] = glaze(rng);
  vase.texture = make_texture(ground, mix(ground, kBlack, 0.5), accent);
  decorate(vase.texture, ground, accent, rng);
  vase.specular = 0.6;
  vase.mass_kg = rng.uniform(0.5, 1.0);
  vase.stands = true;
  return vase;
}

GeneratedObject make_teapot(Rng& rng) {
  const double r = rng.uniform(0.06, 0.075);
  const double h = rng.uniform(0.09, 0.11);
  const Profile body = smooth_curve<Vector2d>(
      Profile{{0.6 * r, 0.0}, {r, 0.42 * h}, {0.82 * r, 0.8 * h}, {0.45 * r, h}}, 3);
  const Profile lid = smooth_curve<Vector2d>(Profile{{0.47 * r, h},
                                                     {0.3 * r, 1.1 * h},
                                                     {0.1 * r, 1.14 * h},
                                                     {0.17 * r, 1.24 * h},
                                                     {0.0, 1.31 * h}},
                                             3);
  GeneratedObject pot;
  add_solid(pot.mesh, body, kWallUv, kInnerUv);
  add_solid(pot.mesh, lid, kPartUv, kPartUv);
  append(pot.mesh, make_handle(body, 0.22 * h, 0.86 * h, 0.036, 0.013));
  const std::vector<Vector3d> spout = smooth_curve<Vector3d>(
      std::array<Vector3d, 4>{Vector3d(-0.85 * r, 0, 0.35 * h), Vector3d(-1.3 * r, 0, 0.5 * h),
                              Vector3d(-1.5 * r, 0, 0.8 * h), Vector3d(-1.75 * r, 0, 0.98 * h)},
      3);
  std::vector<Vector2d> radii;
  for (std::size_t i = 0; i < spout.size(); ++i) {
    radii.emplace_back(
        Vector2d::Constant(0.017 - 0.009 * static_cast<double>(i) / (spout.size() - 1.0)));
  }
  append(pot.mesh, make_tube(spout, radii, Vector3d::UnitY(), 10, kPartUv));
  const auto [ground, accent] = glaze(rng);
  pot.texture = make_texture(ground, ground, accent);
  decorate(pot.texture, ground, accent, rng);
  pot.specular = 0.6;
  pot.mass_kg = rng.uniform(0.6, 0.9);
  pot.stands = true;
  return pot;
}

GeneratedObject make_pitcher(Rng& rng) {
  const double h = rng.uniform(0.18, 0.24);
  const double r = rng.uniform(0.05, 0.062);
  const Profile outer = smooth_curve<Vector2d>(
      Profile{{0.85 * r, 0.0}, {r, 0.3 * h}, {0.74 * r, 0.78 * h}, {0.86 * r, h}}, 4);
  GeneratedObject pitcher;
  add_vessel(pitcher.mesh, outer, 0.004, 0.008);
  for (Vector3d& p : pitcher.mesh.positions_m) {  // draw the rim out to a lip opposite the handle
    const double up = std::clamp((p.z() / h - 0.8) / 0.2, 0.0, 1.0);
    const double towards_lip = std::max(0.0, -p.x() / std::max(p.head<2>().norm(), 1e-6));
    p.x() -= 0.022 * up * up * std::pow(towards_lip, 6.0);
  }
  append(pitcher.mesh, make_handle(outer, 0.25 * h, 0.9 * h, 0.042, 0.015));
  const auto [ground, accent] = glaze(rng);
  pitcher.texture = make_texture(ground, mix(ground, kWhite, 0.4), accent);
  decorate(pitcher.texture, ground, accent, rng);
  pitcher.specular = 0.5;
  pitcher.mass_kg = rng.uniform(0.5, 0.9);
  pitcher.stands = true;
  return pitcher;
}

}  // namespace vantage::family
