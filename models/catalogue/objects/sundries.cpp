#include <cmath>
#include <numbers>

#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr std::array<std::string_view, 5> kShampoos{"SHINE", "REPAIR", "SPORT", "ALOE", "VOLUME"};
constexpr std::array<std::string_view, 4> kPastes{"MINT", "WHITE", "FLUOR", "KIDS"};
constexpr std::array<std::string_view, 5> kNoodles{"RAMEN", "SHRIMP", "BEEF", "CURRY", "UDON"};
constexpr std::array<std::string_view, 5> kSnacks{"CHIPS", "NUTS", "POPS", "CORN", "PUFFS"};

}  // namespace

GeneratedObject make_ball(Rng& rng) {
  const double r = rng.uniform(0.032, 0.06);
  const bool oval = rng.uniform() < 0.25;  // as in rugby
  GeneratedObject ball;
  append(ball.mesh, make_superellipsoid({r, oval ? 0.62 * r : r, oval ? 0.62 * r : r}, 1.0, 1.0,
                                        kAround, 16, kWallUv));
  const RgbColour a = vivid(rng);
  const RgbColour b = rng.uniform() < 0.6 ? kWhite : vivid(rng);
  ball.texture = make_texture(a, a, a);
  switch (rng.uniform_index(4)) {
    case 0: paint(ball.texture, kWall, stripes(a, b, 4)); break;
    case 1: paint(ball.texture, kWall, checks(b, a, 10, 6)); break;
    case 2:
      paint(ball.texture, kWall, [=](double s, double t) {  // the seam of a tennis ball
        const double seam = 0.5 + 0.25 * std::sin(4.0 * std::numbers::pi * s);
        return std::abs(t - seam) < 0.03 ? b : a;
      });
      break;
    default: paint(ball.texture, kWall, dots(b, a, 8, 6, 0.33));
  }
  speckle(ball.texture, kWall, 0.02, 2, rng);
  ball.mass_kg = 0.15;
  return ball;
}

GeneratedObject make_light_bulb(Rng& rng) {
  const double r = rng.uniform(0.026, 0.034);
  const double cap_r = 0.013;
  const double h = rng.uniform(0.095, 0.115);
  GeneratedObject bulb;
  const Profile glass = smooth_curve<Vector2d>(Profile{{1.05 * cap_r, 0.025},
                                                       {0.62 * r, 0.45 * h},
                                                       {r, h - 1.05 * r},
                                                       {0.8 * r, h - 0.4 * r},
                                                       {0.3 * r, h - 0.04 * r},
                                                       {0.0, h}},
                                               3);
  add_solid(bulb.mesh, glass, kWallUv, kInnerUv);
  add_solid(bulb.mesh, Profile{{0.5 * cap_r, 0.0}, {cap_r, 0.005}, {cap_r, 0.027}}, kPartUv,
            kPartUv);
  lay_down(bulb.mesh);  // and rest on both ends
  const double tilt = std::asin((r - cap_r) / (h - 1.05 * r));
  transform(bulb.mesh, make_pose(Vector3d::Zero(), 0.0, tilt));
  const bool clear = rng.uniform() < 0.4;
  const RgbColour tint = clear ? any_colour({{0.1, 0.13}, {0.2, 0.4}, {0.8, 0.9}}, rng) : pale(rng);
  bulb.texture = make_texture(tint, tint, kSteel);
  paint(bulb.texture, kPart, bands(kSteel, 0.6 * kSteel, 5));
  draw_text(bulb.texture, part_of(kWall, 0.6, 0.72, 0.9, 0.82), "60W", mix(tint, kBlack, 0.6));
  bulb.specular = 0.9;
  bulb.mass_kg = 0.04;
  return bulb;
}

GeneratedObject make_dry_battery(Rng& rng) {
  const double r = rng.uniform(0.013, 0.0172);
  const double h = rng.uniform(0.05, 0.0615);
  GeneratedObject battery;
  add_solid(battery.mesh,
            Profile{{0.96 * r, 0.0},
                    {r, 0.0015},
                    {r, 0.3 * h},
                    {r, 0.6 * h},
                    {r, h - 0.004},
                    {0.94 * r, h - 0.0025}},
            kWallUv, kPartUv);
  add_solid(battery.mesh, Profile{{0.33 * r, h - 0.003}, {0.33 * r, h - 0.0004}, {0.3 * r, h}},
            kPartUv, kPartUv);
  const RgbColour band = vivid(rng);
  const RgbColour body = rng.uniform() < 0.6 ? kBlack : vivid(rng);
  battery.texture = make_texture(body, kSteel, kSteel);
  paint(battery.texture, part_of(kWall, 0.0, rng.uniform(0.62, 0.75), 1.0, 1.0), band);
  draw_text(battery.texture, part_of(kWall, 0.56, 0.28, 0.94, 0.5), "VOLT",
            body.sum() > 1.4 ? kBlack : kWhite);
  draw_text(battery.texture, part_of(kWall, 0.1, 0.28, 0.4, 0.5), "1 5V", band);
  battery.specular = 0.8;
  battery.mass_kg = 0.12;
  battery.stands = true;
  return battery;
}

GeneratedObject make_glue_stick(Rng& rng) {
  const double r = rng.uniform(0.011, 0.016);
  const double h = rng.uniform(0.085, 0.115);
  const double split = rng.uniform(0.6, 0.7) * h;
  GeneratedObject stick;
  add_solid(stick.mesh,
            Profile{{1.1 * r, 0.0}, {1.1 * r, 0.011}, {r, 0.012}, {r, 0.5 * split}, {r, split}},
            kWallUv, kInnerUv);
  add_solid(stick.mesh, Profile{{1.04 * r, split - 0.001}, {1.04 * r, h - 0.003}, {0.9 * r, h}},
            kPartUv, kPartUv);
  const RgbColour label = vivid(rng);
  stick.texture = make_texture(label, kWhite, rng.uniform() < 0.5 ? kWhite : vivid(rng));
  paint(stick.texture, part_of(kWall, 0.0, 0.0, 1.0, 0.2), mix(label, kBlack, 0.3));
  draw_text(stick.texture, part_of(kWall, 0.56, 0.45, 0.94, 0.72), "GLUE", kWhite);
  paint(stick.texture, part_of(kWall, 0.0, 0.82, 1.0, 0.9), vivid(rng));
  draw_barcode(stick.texture, part_of(kWall, 0.15, 0.35, 0.35, 0.75), rng);
  stick.mass_kg = 0.03;
  stick.stands = true;
  return stick;
}

GeneratedObject make_marker(Rng& rng) {
  const double r = rng.uniform(0.0075, 0.0105);
  const double length = rng.uniform(0.115, 0.145);
  const double cap = rng.uniform(0.32, 0.42) * length;
  GeneratedObject marker;
  add_solid(marker.mesh, Profile{{0.8 * r, 0.0}, {r, 0.004}, {r, 0.4 * length}, {r, length - cap}},
            kWallUv, kInnerUv);
  add_solid(
      marker.mesh,
      Profile{{1.12 * r, length - cap - 0.001}, {1.12 * r, length - 0.004}, {0.7 * r, length}},
      kPartUv, kPartUv);
  lay_down(marker.mesh);
  const RgbColour ink = vivid(rng);
  const RgbColour body = rng.uniform() < 0.55 ? kWhite : mix(ink, kBlack, 0.2);
  marker.texture = make_texture(body, ink, ink);
  const RgbColour print = body.sum() > 2.0 ? ink : kWhite;
  paint(marker.texture, part_of(kWall, 0.0, 0.78, 1.0, 0.86), print);
  paint(marker.texture, part_of(kWall, 0.42, 0.2, 0.58, 0.7), any_pattern(body, print, rng));
  marker.specular = 0.4;
  marker.mass_kg = 0.02;
  return marker;
}

GeneratedObject make_shampoo(Rng& rng) {
  const double h = rng.uniform(0.16, 0.21);
  const double r = rng.uniform(0.03, 0.038);
  const double flatness = rng.uniform(0.55, 0.75);
  const double waist = rng.uniform(0.82, 1.0);
  const Profile outer = smooth_curve<Vector2d>(Profile{{0.92 * r, 0.0},
                                                       {r, 0.01},
                                                       {waist * r, 0.45 * h},
                                                       {rng.uniform(0.85, 1.0) * r, 0.7 * h},
                                                       {0.55 * r, 0.82 * h}},
                                               3);
  const double cap_r = rng.uniform(0.5, 0.62) * r;
  GeneratedObject bottle;
  add_solid(bottle.mesh, outer, kWallUv, kInnerUv);
  add_solid(bottle.mesh, Profile{{cap_r, 0.81 * h}, {0.98 * cap_r, 0.985 * h}, {0.85 * cap_r, h}},
            kPartUv, kPartUv);
  scale(bottle.mesh, {1.0, flatness, 1.0});
  const RgbColour plastic = rng.uniform() < 0.4 ? pale(rng) : vivid(rng);
  const RgbColour accent = vivid(rng);
  bottle.texture = make_texture(plastic, plastic, rng.uniform() < 0.5 ? accent : kWhite);
  const RgbColour ink = plastic.sum() > 1.8 ? dark(rng) : kWhite;
  draw_text(bottle.texture, part_of(kWall, 0.58, 0.58, 0.92, 0.72), pick(kShampoos, rng), ink);
  draw_disc(bottle.texture, part_of(kWall, 0.66, 0.22, 0.84, 0.5), accent);
  draw_small_print(bottle.texture, part_of(kWall, 0.1, 0.25, 0.4, 0.65), ink, rng);
  bottle.specular = 0.6;
  bottle.mass_kg = rng.uniform(0.25, 0.4);
  bottle.stands = true;
  return bottle;
}

GeneratedObject make_toothpaste(Rng& rng) {  // lying, its cap at -x
  const double length = rng.uniform(0.13, 0.17);
  const double r = rng.uniform(0.016, 0.02);
  std::array<Vector3d, 8> path;
  std::array<Vector2d, 8> radii;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double along = static_cast<double>(i) / (path.size() - 1.0);
    radii[i] = r * Vector2d(1.0 + 0.5 * along, along < 0.12 ? 0.94 : 1.03 - 0.93 * along);
    path[i] = Vector3d(length * along, 0.0, radii[i].y());
  }
  GeneratedObject tube;
  append(tube.mesh, make_tube(path, radii, Vector3d::UnitY(), kAround, kWallUv));
  TriangleMesh cap;
  const double cap_r = rng.uniform(0.55, 0.85) * r;
  add_solid(cap, Profile{{0.85 * cap_r, 0.0}, {cap_r, 0.004}, {cap_r, 0.022}}, kPartUv, kPartUv);
  lay_down(cap);
  append(tube.mesh, cap, make_pose({-0.02, 0.0, radii[0].y()}, 0.0));
  const RgbColour ground = rng.uniform() < 0.6 ? kWhite : vivid(rng);
  const RgbColour accent = vivid(rng);
  tube.texture = make_texture(ground, ground, rng.uniform() < 0.5 ? kWhite : accent);
  const double edge = rng.uniform(0.3, 0.5);
  paint(tube.texture, part_of(kWall, 0.0, 0.0, 1.0, 0.14), accent);
  paint(tube.texture, part_of(kWall, 0.0, 1.0 - 0.6 * edge, 1.0, 0.95),
        any_pattern(ground, accent, rng));
  const std::string_view word = pick(kPastes, rng);
  for (std::size_t i = 0; i < word.size(); ++i) {  // read along the tube
    const double t = 0.2 + 0.1 * static_cast<double>(i);
    draw_text(tube.texture, part_of(kWall, 0.18, t, 0.32, t + 0.085), word.substr(i, 1), accent);
  }
  paint(tube.texture, part_of(kWall, 0.0, 0.95, 1.0, 1.0), kSteel);
  tube.specular = 0.5;
  tube.mass_kg = 0.12;
  return tube;
}

GeneratedObject make_instant_noodles(Rng& rng) {
  const double h = rng.uniform(0.085, 0.115);
  const double r = rng.uniform(0.042, 0.055);
  const double base = rng.uniform(0.68, 0.8);
  GeneratedObject cup;
  const Vector2d rim(1.04 * r, h - 0.002);
  add_solid(cup.mesh, Profile{{base * r, 0.0}, {0.5 * (1.0 + base) * r, 0.5 * h}, {r, h - 0.005}},
            kWallUv, kInnerUv);
  add_solid(cup.mesh, Profile{{1.02 * r, h - 0.006}, rim, {0.96 * r, h}}, kPartUv, kPartUv);
  const RgbColour ground = rng.uniform() < 0.35 ? kWhite : vivid(rng);
  cup.texture =
      make_texture(ground, kWhite, rng.uniform() < 0.5 ? mix(ground, kWhite, 0.5) : kSteel);
  draw_label(cup.texture, part_of(kWall, 0.0, 0.12, 1.0, 0.86),
             {pick(kNoodles, rng), ground, ground.sum() > 1.8 ? dark(rng) : kWhite}, rng);
  draw_disc(cup.texture, part_of(kWall, 0.6, 0.25, 0.9, 0.6),
            hsv(rng.uniform(0.05, 0.14), 0.7, 0.9));
  paint(cup.texture, part_of(kPart, 0.0, 0.0, 0.16, 1.0), vivid(rng));
  cup.mass_kg = 0.09;
  cup.top_radius_m = 0.9 * r;
  cup.stands = true;
  return cup;
}

GeneratedObject make_food_bag(Rng& rng) {  // stands on a gusset, its print on -y and +y
  const double w = rng.uniform(0.055, 0.078);
  const double h = rng.uniform(0.15, 0.21);
  const double t = rng.uniform(0.022, 0.032);
  constexpr std::array<double, 8> kGirth{0.75, 0.95, 1.0, 0.95, 0.8, 0.55, 0.12, 0.06};
  constexpr std::array<double, 8> kWidth{0.93, 0.97, 0.98, 0.98, 0.98, 0.99, 1.0, 1.0};
  constexpr std::array<double, 8> kHeight{0.0, 0.05, 0.25, 0.45, 0.65, 0.82, 0.94, 1.0};
  std::array<Vector3d, 8> path;
  std::array<Vector2d, 8> radii;
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i] = Vector3d(0.0, 0.0, h * kHeight[i]);
    radii[i] = Vector2d(w * kWidth[i], t * kGirth[i]);
  }
  GeneratedObject bag;
  append(bag.mesh, make_tube(path, radii, Vector3d::UnitX(), 36, kWallUv));
  const RgbColour ground = vivid(rng);
  const RgbColour accent = rng.uniform() < 0.5 ? kWhite : vivid(rng);
  bag.texture = make_texture(ground, ground, ground);
  paint(bag.texture, kWall, gradient(ground, mix(ground, accent, 0.35)));
  const std::string_view word = pick(kSnacks, rng);
  const RgbColour food = hsv(rng.uniform(0.07, 0.14), 0.75, 0.92);
  draw_text(bag.texture, part_of(kWall, 0.58, 0.6, 0.92, 0.8), word, accent);
  draw_text(bag.texture, part_of(kWall, 0.12, 0.68, 0.38, 0.8), word, accent);
  draw_disc(bag.texture, part_of(kWall, 0.6, 0.14, 0.9, 0.5), mix(ground, kWhite, 0.7));
  paint(bag.texture, part_of(kWall, 0.68, 0.22, 0.82, 0.42), dots(food, 0.7 * food, 3, 4, 0.4));
  draw_small_print(bag.texture, part_of(kWall, 0.12, 0.3, 0.38, 0.62), accent, rng);
  draw_barcode(bag.texture, part_of(kWall, 0.17, 0.1, 0.33, 0.24), rng);
  paint(bag.texture, part_of(kWall, 0.0, 0.93, 1.0, 1.0), stripes(ground, 0.8 * ground, 60));
  bag.specular = 0.6;
  bag.mass_kg = 0.1;
  bag.stands = true;
  return bag;
}

}  // namespace vantage::family
