#include <algorithm>
#include <cmath>

#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// A closed fruit from a profile between two points on the axis.
void add_fruit(TriangleMesh& mesh, const Profile& control, const UvRect& uv) {
  Profile profile = smooth_curve<Vector2d>(control, 4);
  for (std::size_t i = 1; i + 1 < profile.size(); ++i)
    profile[i].x() = std::max(profile[i].x(), 5e-4);
  add_lathe(mesh, profile, kAround, uv);
}

TriangleMesh make_stem(double z_m, double length_m) {
  const std::array<Vector3d, 3> path{Vector3d(0, 0, z_m), Vector3d(0.001, 0, z_m + 0.5 * length_m),
                                     Vector3d(0.004, 0, z_m + length_m)};
  const std::array<Vector2d, 3> radii{Vector2d(0.0018, 0.0018), Vector2d(0.0014, 0.0014),
                                      Vector2d(0.002, 0.002)};
  return make_tube(path, radii, Vector3d::UnitY(), 6, kPartUv);
}

const RgbColour kBark{0.35, 0.24, 0.12};

}  // namespace

GeneratedObject make_banana(Rng& rng) {
  const double bend_m = rng.uniform(0.085, 0.12);
  const double length_m = rng.uniform(0.16, 0.2);
  const double thick_m = rng.uniform(0.015, 0.019);
  constexpr std::array<double, 15> girth{0.30, 0.28, 0.34, 0.62, 0.82, 0.93, 1.0, 1.0,
                                         1.0,  0.97, 0.92, 0.82, 0.64, 0.36, 0.22};
  std::vector<Vector3d> path;
  std::vector<Vector2d> radii;
  for (std::size_t i = 0; i < girth.size(); ++i) {
    const double angle = length_m / bend_m * (static_cast<double>(i) / (girth.size() - 1.0) - 0.5);
    path.emplace_back(bend_m * std::cos(angle), bend_m * std::sin(angle), thick_m);
    radii.emplace_back(thick_m * girth[i] * Vector2d(1.0, 0.95));
  }
  GeneratedObject banana;
  append(banana.mesh, make_tube(path, radii, Vector3d::UnitZ(), 16, kWallUv));
  const double ripeness = rng.uniform();
  const RgbColour skin = mix(RgbColour(0.72, 0.78, 0.2), RgbColour(0.95, 0.78, 0.12), ripeness);
  banana.texture = make_texture(skin, skin, skin);
  paint(banana.texture, kWall, mottled(skin, mix(skin, kBark, 0.15 + 0.3 * ripeness), 10, rng));
  for (int side = 0; side < 5; ++side) {
    paint(banana.texture, part_of(kWall, 0.2 * side, 0.0, 0.2 * side + 0.012, 1.0),
          mix(skin, kBark, 0.35));
  }
  paint(banana.texture, part_of(kWall, 0.0, 0.0, 1.0, 0.1),
        mix(skin, RgbColour(0.45, 0.5, 0.15), 0.7));
  paint(banana.texture, part_of(kWall, 0.0, 0.95, 1.0, 1.0), kBark);
  banana.mass_kg = 0.15;
  return banana;
}

GeneratedObject make_apple(Rng& rng) {
  const double r = rng.uniform(0.034, 0.042);
  const double h = rng.uniform(1.7, 1.95) * r;
  GeneratedObject apple;
  add_fruit(apple.mesh,
            {{0.0, 0.08 * h},
             {0.42 * r, 0.0},
             {0.86 * r, 0.25 * h},
             {r, 0.58 * h},
             {0.6 * r, 0.95 * h},
             {0.25 * r, 0.97 * h},
             {0.0, 0.84 * h}},
            kWallUv);
  append(apple.mesh, make_stem(0.83 * h, 0.25 * h));
  const RgbColour skin =
      hsv(rng.uniform() < 0.7 ? rng.uniform(-0.03, 0.03) : rng.uniform(0.2, 0.28), 0.85, 0.75);
  const RgbColour blush = hsv(rng.uniform(0.1, 0.2), 0.7, 0.85);
  apple.texture = make_texture(skin, skin, kBark);
  paint(apple.texture, kWall, mottled(skin, mix(skin, blush, 0.7), 7, rng));
  paint(apple.texture, part_of(kWall, 0.0, 0.93, 1.0, 1.0), mix(skin, blush, 0.8));
  speckle(apple.texture, kWall, 0.04, 3, rng);
  apple.specular = 0.4;
  apple.mass_kg = 0.17;
  return apple;
}

GeneratedObject make_orange(Rng& rng) {
  const double r = rng.uniform(0.034, 0.043);
  GeneratedObject orange;
  append(orange.mesh,
         make_superellipsoid({r, r, rng.uniform(0.9, 0.98) * r}, 1.0, 1.0, kAround, 16, kWallUv));
  const RgbColour skin = any_colour({{0.06, 0.1}, {0.92, 0.92}, {0.85, 0.98}}, rng);
  orange.texture = make_texture(skin, skin, skin);
  speckle(orange.texture, kWall, 0.06, 2, rng);
  paint(orange.texture, part_of(kWall, 0.0, 0.985, 1.0, 1.0), RgbColour(0.3, 0.42, 0.15));
  orange.mass_kg = 0.18;
  return orange;
}

GeneratedObject make_lemon(Rng& rng) {
  const double r = rng.uniform(0.025, 0.031);
  const double length = rng.uniform(2.7, 3.1) * r;
  GeneratedObject lemon;
  add_fruit(lemon.mesh,
            {{0.0, 0.0},
             {0.22 * r, 0.03 * length},
             {0.5 * r, 0.14 * length},
             {r, 0.48 * length},
             {0.55 * r, 0.84 * length},
             {0.26 * r, 0.93 * length},
             {0.0, length}},
            kWallUv);
  lay_down(lemon.mesh);
  const bool lime = rng.uniform() < 0.3;
  const RgbColour skin =
      lime ? hsv(rng.uniform(0.22, 0.28), 0.8, 0.6) : hsv(rng.uniform(0.13, 0.155), 0.85, 0.95);
  lemon.texture = make_texture(skin, skin, skin);
  speckle(lemon.texture, kWall, 0.06, 2, rng);
  paint(lemon.texture, part_of(kWall, 0.0, 0.97, 1.0, 1.0), mix(skin, kBark, 0.6));
  lemon.mass_kg = 0.1;
  return lemon;
}

GeneratedObject make_pear(Rng& rng) {
  const double r = rng.uniform(0.032, 0.038);
  const double h = rng.uniform(2.5, 2.9) * r;
  GeneratedObject pear;
  add_fruit(pear.mesh,
            {{0.0, 0.04 * h},
             {0.4 * r, 0.0},
             {0.95 * r, 0.2 * h},
             {0.92 * r, 0.42 * h},
             {0.5 * r, 0.75 * h},
             {0.36 * r, 0.93 * h},
             {0.0, 0.97 * h}},
            kWallUv);
  append(pear.mesh, make_stem(0.95 * h, 0.22 * h));
  const RgbColour skin = any_colour({{0.14, 0.24}, {0.6, 0.8}, {0.65, 0.85}}, rng);
  pear.texture = make_texture(skin, skin, kBark);
  paint(pear.texture, kWall, mottled(skin, mix(skin, RgbColour(0.7, 0.3, 0.1), 0.5), 6, rng));
  speckle(pear.texture, kWall, 0.05, 2, rng);
  pear.mass_kg = 0.18;
  return pear;
}

}  // namespace vantage::family
