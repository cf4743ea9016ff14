#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const RgbColour kLeaf{0.25, 0.42, 0.14};

/// A factor on the distance from the z axis at a heading and a height.
using Bulge = std::function<double(double heading_rad, double z_m)>;

/// Normals of a closed smooth surface whose points were moved: of each point the mean over the
/// triangles round it, weighted by area.
void renew_normals(TriangleMesh& mesh) {
  const std::vector<int> point = weld(mesh);
  std::vector<Vector3d> sum(mesh.positions_m.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto p = [&](int i) { return mesh.positions_m[static_cast<std::size_t>(i)]; };
    const Vector3d normal = (p(b) - p(a)).cross(p(c) - p(a));
    for (const int corner : {a, b, c}) {
      sum[static_cast<std::size_t>(point[static_cast<std::size_t>(corner)])] += normal;
    }
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const Vector3d& normal = sum[static_cast<std::size_t>(point[i])];
    if (normal.norm() > 0.0) mesh.normals[i] = normal.normalized();
  }
}

TriangleMesh grow(const Profile& control_m, int steps, const Bulge& bulge) {
  Profile profile_m = smooth_curve<Vector2d>(control_m, steps);
  for (std::size_t i = 1; i + 1 < profile_m.size(); ++i) {
    profile_m[i].x() = std::max(profile_m[i].x(), 5e-4);
  }
  TriangleMesh mesh;
  add_lathe(mesh, profile_m, kAround, kWallUv);
  for (Vector3d& p : mesh.positions_m) p.head<2>() *= bulge(std::atan2(p.y(), p.x()), p.z());
  renew_normals(mesh);
  return mesh;
}

double round(double, double) { return 1.0; }

void add_stalk(TriangleMesh& mesh, double z_m, double length_m, double radius_m) {
  const std::array<Vector3d, 3> path{Vector3d(0, 0, z_m),
                                     Vector3d(0.1 * length_m, 0, z_m + 0.6 * length_m),
                                     Vector3d(0.35 * length_m, 0, z_m + length_m)};
  const std::array<Vector2d, 3> radii{Vector2d(radius_m, radius_m),
                                      0.75 * Vector2d(radius_m, radius_m),
                                      0.9 * Vector2d(radius_m, radius_m)};
  append(mesh, make_tube(path, radii, Vector3d::UnitY(), 8, kPartUv));
}

GeneratedObject finished(TriangleMesh mesh, Image texture, double specular, double mass_kg) {
  GeneratedObject object;
  object.mesh = std::move(mesh);
  object.texture = std::move(texture);
  object.specular = specular;
  object.mass_kg = mass_kg;
  return object;
}

}  // namespace

GeneratedObject make_tomato(Rng& rng) {
  const double r = rng.uniform(0.034, 0.043);
  const double h = rng.uniform(1.4, 1.7) * r;
  const double ribs = rng.uniform(0.0, 0.035);
  TriangleMesh mesh =
      grow({{0.0, 0.05 * h},
            {0.4 * r, 0.0},
            {0.92 * r, 0.28 * h},
            {r, 0.55 * h},
            {0.7 * r, 0.92 * h},
            {0.25 * r, 0.98 * h},
            {0.0, 0.88 * h}},
           3, [=](double heading, double) { return 1.0 + ribs * std::cos(5.0 * heading); });
  add_stalk(mesh, 0.87 * h, 0.012, 0.0022);
  const RgbColour skin = any_colour({{-0.01, 0.05}, {0.82, 0.95}, {0.7, 0.88}}, rng);
  Image texture = make_texture(skin, skin, kLeaf);
  paint(texture, kWall, mottled(skin, mix(skin, hsv(0.09, 0.8, 0.85), 0.35), 5, rng));
  paint(texture, part_of(kWall, 0.0, 0.86, 1.0, 1.0), [=](double s, double t) {
    return t > std::abs(std::sin(5.0 * std::numbers::pi * s)) ? kLeaf : skin;
  });
  return finished(std::move(mesh), std::move(texture), 0.6, 0.12);
}

GeneratedObject make_onion(Rng& rng) {
  const double r = rng.uniform(0.034, 0.044);
  const double h = rng.uniform(1.7, 2.0) * r;
  TriangleMesh mesh = grow({{0.0, 0.0},
                            {0.35 * r, 0.02 * h},
                            {0.9 * r, 0.25 * h},
                            {r, 0.48 * h},
                            {0.7 * r, 0.72 * h},
                            {0.22 * r, 0.86 * h},
                            {0.12 * r, 0.97 * h},
                            {0.0, h}},
                           3, round);
  const RgbColour skin = rng.uniform() < 0.35
                             ? any_colour({{0.9, 0.95}, {0.5, 0.7}, {0.4, 0.55}}, rng)
                             : any_colour({{0.07, 0.11}, {0.55, 0.8}, {0.65, 0.85}}, rng);
  Image texture = make_texture(skin, skin, skin);
  paint(texture, kWall, mottled(skin, mix(skin, kWhite, 0.25), 5, rng));
  for (int line = 0; line < 24; ++line) {
    const double s = rng.uniform(0.0, 0.98);
    const double low = rng.uniform(0.0, 0.2);
    const double high = rng.uniform(0.7, 0.95);
    const double shade = rng.uniform(0.15, 0.4);
    paint(texture, part_of(kWall, s, low, s + 0.008, high), mix(skin, kBlack, shade));
  }
  paint(texture, part_of(kWall, 0.0, 0.9, 1.0, 1.0), mix(skin, RgbColour(0.6, 0.5, 0.3), 0.7));
  return finished(std::move(mesh), std::move(texture), 0.35, 0.15);
}

GeneratedObject make_potato(Rng& rng) {
  const Vector3d radii{rng.uniform(0.045, 0.06), rng.uniform(0.03, 0.036),
                       rng.uniform(0.025, 0.031)};
  TriangleMesh mesh =
      make_superellipsoid(radii, rng.uniform(0.85, 1.05), 1.0, kAround, 16, kWallUv);
  const double tilt = rng.uniform(0.0, 6.0);
  const double depth = rng.uniform(0.05, 0.1);
  for (Vector3d& p : mesh.positions_m) {
    const Vector3d u = p.cwiseQuotient(radii);
    p *= 1.0 + depth * std::sin(3.0 * u.x() + tilt) * std::cos(2.0 * u.y() - tilt) +
         0.5 * depth * std::sin(5.0 * u.z() + 4.0 * u.x() + tilt);
  }
  renew_normals(mesh);
  const RgbColour skin = any_colour({{0.07, 0.12}, {0.35, 0.6}, {0.55, 0.8}}, rng);
  Image texture = make_texture(skin, skin, skin);
  paint(texture, kWall, mottled(skin, 0.75 * skin, 9, rng));
  for (int eye = 0; eye < 14; ++eye) {
    const double s = rng.uniform(0.0, 0.95);
    const double t = rng.uniform(0.15, 0.85);
    draw_disc(texture, part_of(kWall, s, t, s + 0.03, t + 0.02), 0.5 * skin);
  }
  return finished(std::move(mesh), std::move(texture), 0.05, 0.2);
}

GeneratedObject make_bell_pepper(Rng& rng) {
  const double r = rng.uniform(0.036, 0.044);
  const double h = rng.uniform(1.9, 2.5) * r;
  const double lobes = rng.uniform() < 0.5 ? 3.0 : 4.0;
  const double depth = rng.uniform(0.06, 0.1);
  TriangleMesh mesh =
      grow({{0.0, 0.07 * h},
            {0.35 * r, 0.0},
            {0.72 * r, 0.12 * h},
            {0.9 * r, 0.5 * h},
            {r, 0.8 * h},
            {0.7 * r, 0.97 * h},
            {0.3 * r, 0.96 * h},
            {0.0, 0.88 * h}},
           3, [=](double heading, double) { return 1.0 + depth * std::cos(lobes * heading); });
  add_stalk(mesh, 0.87 * h, 0.3 * h, 0.005);
  constexpr std::array<double, 4> hues{-0.005, 0.08, 0.14, 0.3};  // red, orange, yellow, green
  const double hue = pick(hues, rng) + rng.uniform(-0.01, 0.01);
  const RgbColour skin = hsv(hue, rng.uniform(0.8, 0.95), hue > 0.2 ? 0.5 : 0.82);
  Image texture = make_texture(skin, skin, mix(kLeaf, skin, 0.2));
  paint(texture, kWall, mottled(skin, 0.85 * skin, 5, rng));
  paint(texture, part_of(kWall, 0.0, 0.93, 1.0, 1.0), mix(kLeaf, skin, 0.4));
  return finished(std::move(mesh), std::move(texture), 0.7, 0.18);
}

GeneratedObject make_mushroom(Rng& rng) {
  const double r = rng.uniform(0.026, 0.038);
  const double stalk_r = rng.uniform(0.3, 0.42) * r;
  const double stalk_m = rng.uniform(0.55, 0.9) * r;
  const double dome_m = rng.uniform(0.65, 0.95) * r;
  GeneratedObject mushroom;
  add_solid(mushroom.mesh,
            smooth_curve<Vector2d>(Profile{{0.9 * stalk_r, 0.0},
                                           {stalk_r, 0.3 * stalk_m},
                                           {0.85 * stalk_r, stalk_m},
                                           {stalk_r, 1.2 * stalk_m}},
                                   2),
            kPartUv, kPartUv);
  const Vector2d edge(0.94 * r, stalk_m);
  add_lathe(mushroom.mesh, Profile{{0.0, stalk_m + 0.15 * r}, {0.6 * r, stalk_m + 0.04 * r}, edge},
            kAround, kInnerUv);
  const Profile dome = smooth_curve<Vector2d>(Profile{edge,
                                                      {r, stalk_m + 0.2 * dome_m},
                                                      {0.8 * r, stalk_m + 0.72 * dome_m},
                                                      {0.35 * r, stalk_m + 0.97 * dome_m},
                                                      {0.0, stalk_m + dome_m}},
                                              3);
  add_lathe(mushroom.mesh, dome, kAround, kWallUv);
  const bool brown = rng.uniform() < 0.5;
  const RgbColour cap = brown ? any_colour({{0.06, 0.09}, {0.45, 0.65}, {0.4, 0.6}}, rng)
                              : any_colour({{0.09, 0.12}, {0.08, 0.2}, {0.85, 0.95}}, rng);
  const RgbColour flesh(0.9, 0.86, 0.78);
  mushroom.texture = make_texture(cap, mix(flesh, RgbColour(0.45, 0.3, 0.2), 0.5), flesh);
  paint(mushroom.texture, kWall, mottled(cap, mix(cap, flesh, 0.3), 6, rng));
  speckle(mushroom.texture, kPart, 0.03, 3, rng);
  mushroom.mass_kg = 0.03;
  return mushroom;
}

GeneratedObject make_garlic(Rng& rng) {
  const double r = rng.uniform(0.026, 0.034);
  const double h = rng.uniform(1.7, 2.2) * r;
  const double cloves = 6.0 + static_cast<double>(rng.uniform_index(3));
  TriangleMesh mesh = grow({{0.0, 0.03 * h},
                            {0.4 * r, 0.0},
                            {0.95 * r, 0.18 * h},
                            {r, 0.32 * h},
                            {0.62 * r, 0.55 * h},
                            {0.2 * r, 0.75 * h},
                            {0.16 * r, 0.98 * h},
                            {0.0, h}},
                           3, [=](double heading, double z) {
                             const double bulb = std::clamp(1.4 - 2.0 * z / h, 0.0, 1.0);
                             return 1.0 + 0.07 * bulb * std::cos(cloves * heading);
                           });
  const RgbColour skin = any_colour({{0.05, 0.12}, {0.03, 0.1}, {0.88, 0.96}}, rng);
  const RgbColour veins = any_colour({{0.85, 0.95}, {0.25, 0.45}, {0.6, 0.75}}, rng);
  Image texture = make_texture(skin, skin, skin);
  paint(texture, kWall, mottled(skin, mix(skin, veins, rng.uniform(0.1, 0.6)), 6, rng));
  paint(texture, part_of(kWall, 0.0, 0.9, 1.0, 1.0), RgbColour(0.75, 0.66, 0.5));
  return finished(std::move(mesh), std::move(texture), 0.15, 0.05);
}

GeneratedObject make_peach(Rng& rng) {
  const double r = rng.uniform(0.033, 0.04);
  const double h = rng.uniform(1.75, 1.95) * r;
  TriangleMesh mesh = grow({{0.0, 0.02 * h},
                            {0.4 * r, 0.02 * h},
                            {0.9 * r, 0.28 * h},
                            {r, 0.52 * h},
                            {0.78 * r, 0.85 * h},
                            {0.25 * r, h},
                            {0.0, 0.92 * h}},
                           3, [](double heading, double) {
                             return 1.0 - 0.09 * std::exp(-std::pow(heading / 0.3, 2.0));
                           });
  const RgbColour skin = any_colour({{0.08, 0.11}, {0.45, 0.65}, {0.9, 0.98}}, rng);
  const RgbColour blush = any_colour({{-0.02, 0.02}, {0.6, 0.8}, {0.6, 0.8}}, rng);
  Image texture = make_texture(skin, skin, skin);
  const Pattern clouds = mottled(skin, blush, 4, rng);
  const double side = rng.uniform();
  paint(texture, kWall, [=](double s, double t) {
    const double share = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * (s - side));
    return mix(skin, clouds(s, t), share);
  });
  return finished(std::move(mesh), std::move(texture), 0.05, 0.15);
}

}  // namespace vantage::family
