#include <numbers>

#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const RgbColour kScreen{0.56, 0.64, 0.52};

RgbColour housing(Rng& rng) {
  const double kind = rng.uniform();
  if (kind < 0.35) return any_colour({{0.55, 0.7}, {0.0, 0.2}, {0.12, 0.25}}, rng);
  if (kind < 0.65) return any_colour({{0.08, 0.6}, {0.0, 0.08}, {0.7, 0.9}}, rng);
  return vivid(rng);
}

void add_box(TriangleMesh& mesh, const Vector3d& size_m, double edge_m, const BoxUv& uv,
             const Vector3d& centre_m) {
  append(mesh, make_rounded_box(size_m, edge_m, 2, uv), make_pose(centre_m, 0.0));
}

BoxUv plain(const UvRect& rect) {
  const UvRect inside = shrink(rect, 0.02);
  return {inside, inside, inside, inside, inside, inside};
}

/// Keys in rows and columns, `share` of the pitch wide.
void draw_keys(Image& image, const UvRect& rect, int columns, int rows, double share,
               const RgbColour& key, const RgbColour& ink) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double s = (column + 0.5) / columns;
      const double t = (row + 0.5) / rows;
      const double w = 0.5 * share / columns;
      const double h = 0.5 * share / rows;
      paint(image, part_of(rect, s - w, t - h, s + w, t + h), key);
      paint(image, part_of(rect, s - 0.35 * w, t - 0.3 * h, s + 0.35 * w, t + 0.3 * h), ink);
    }
  }
}

}  // namespace

GeneratedObject make_calculator(Rng& rng) {
  const Vector3d size{rng.uniform(0.072, 0.092), rng.uniform(0.12, 0.155),
                      rng.uniform(0.013, 0.02)};
  const BoxUv uv = unfold_box(size);
  GeneratedObject object;
  add_box(object.mesh, size, 0.004, uv, Vector3d::Zero());
  const RgbColour body = housing(rng);
  object.texture = Image(kTexture_px, kTexture_px, body);
  const double screen = rng.uniform(0.68, 0.75);
  paint(object.texture, part_of(uv[top], 0.08, screen, 0.92, 0.94), mix(body, kBlack, 0.6));
  paint(object.texture, part_of(uv[top], 0.13, screen + 0.04, 0.87, 0.9), kScreen);
  draw_text(object.texture, part_of(uv[top], 0.45, screen + 0.07, 0.85, 0.87), "1234", kBlack);
  const RgbColour key = body.sum() > 1.2 ? RgbColour(0.2, 0.2, 0.22) : pale(rng);
  const RgbColour ink = body.sum() > 1.2 ? kWhite : kBlack;
  const int rows = 4 + static_cast<int>(rng.uniform_index(3));
  draw_keys(object.texture, part_of(uv[top], 0.07, 0.06, 0.93, screen - 0.06), 4, rows, 0.76, key,
            ink);
  draw_keys(object.texture, part_of(uv[top], 0.715, 0.06, 0.93, screen - 0.06), 1, rows, 0.76,
            vivid(rng), kWhite);
  object.mass_kg = 0.12;
  object.stands = true;
  return object;
}

GeneratedObject make_cell_phone(Rng& rng) {
  const Vector3d size{rng.uniform(0.044, 0.054), rng.uniform(0.098, 0.118),
                      rng.uniform(0.013, 0.019)};
  const BoxUv uv = unfold_box(size);
  GeneratedObject object;
  add_box(object.mesh, size, 0.0055, uv, Vector3d::Zero());
  const RgbColour body = housing(rng);
  object.texture = Image(kTexture_px, kTexture_px, body);
  const bool touch = rng.uniform() < 0.4;
  const double screen = touch ? 0.18 : rng.uniform(0.46, 0.54);
  paint(object.texture, part_of(uv[top], 0.1, screen, 0.9, 0.9), kBlack);
  const RgbColour sky = vivid(rng);
  const UvRect picture = part_of(uv[top], 0.14, screen + 0.03, 0.86, 0.87);
  paint(object.texture, picture, gradient(mix(sky, kWhite, 0.6), sky));
  draw_text(object.texture, part_of(picture, 0.15, 0.7, 0.85, 0.9), "12 30", kWhite);
  if (touch) {
    draw_keys(object.texture, part_of(picture, 0.05, 0.05, 0.95, 0.6), 4, 4, 0.7, vivid(rng),
              kWhite);
    draw_disc(object.texture, part_of(uv[top], 0.4, 0.04, 0.6, 0.13), mix(body, kBlack, 0.5));
  } else {
    draw_keys(object.texture, part_of(uv[top], 0.1, 0.06, 0.9, screen - 0.04), 3, 5, 0.74,
              mix(body, kWhite, 0.6), kBlack);
  }
  paint(object.texture, part_of(uv[top], 0.35, 0.93, 0.65, 0.955), kSteel);
  object.specular = 0.6;
  object.mass_kg = 0.1;
  object.stands = true;
  return object;
}

GeneratedObject make_keyboard(Rng& rng) {  // without a number pad
  const Vector3d size{rng.uniform(0.26, 0.295), rng.uniform(0.1, 0.12), rng.uniform(0.012, 0.018)};
  const Vector3d keys(size.x() - 0.016, size.y() - 0.022, 0.01);
  const BoxUv uv = unfold_box(size, {0.0, 0.5, 1.0, 1.0});
  const BoxUv key_uv = unfold_box(keys, {0.0, 0.0, 1.0, 0.5});
  GeneratedObject object;
  add_box(object.mesh, size, 0.004, uv, Vector3d::Zero());
  add_box(object.mesh, keys, 0.002, key_uv, {0.0, -0.004, 0.5 * size.z() + 0.001});
  const RgbColour body = housing(rng);
  const bool dark_keys = rng.uniform() < 0.5;
  const RgbColour key = dark_keys ? RgbColour(0.17, 0.17, 0.19) : RgbColour(0.88, 0.87, 0.84);
  object.texture = Image(2 * kTexture_px, 2 * kTexture_px, body);
  for (const UvRect& face : key_uv)
    paint(object.texture, shrink(face, -0.004), mix(key, RgbColour::Zero(), 0.3));
  const UvRect field = part_of(key_uv[top], 0.01, 0.02, 0.99, 0.98);
  draw_keys(object.texture, field, 15, 5, 0.82, key, dark_keys ? kWhite : kBlack);
  const double width = rng.uniform(0.3, 0.45);
  paint(object.texture, part_of(field, 0.26, 0.0, 0.26 + width, 0.19), key);
  if (rng.uniform() < 0.6) {
    const RgbColour accent = vivid(rng);
    draw_keys(object.texture, part_of(field, 0.0, 0.8, 1.0 / 15.0, 1.0), 1, 1, 0.82, accent,
              kWhite);
    draw_keys(object.texture, part_of(field, 13.0 / 15.0, 0.4, 1.0, 0.6), 1, 1, 0.9, accent,
              kWhite);
  }
  object.mass_kg = 0.6;
  object.stands = true;
  return object;
}

GeneratedObject make_camera(Rng& rng) {  // looks along -y
  const Vector3d size{rng.uniform(0.09, 0.115), rng.uniform(0.03, 0.04), rng.uniform(0.056, 0.07)};
  const UvRect lens_region{0.0, 0.0, 0.5, 0.24};
  const UvRect metal_region{0.5, 0.0, 1.0, 0.24};
  const BoxUv uv = unfold_box(size, {0.0, 0.25, 1.0, 1.0});
  GeneratedObject object;
  add_box(object.mesh, size, 0.005, uv, {0.0, 0.0, 0.5 * size.z()});
  const double lens_r = rng.uniform(0.32, 0.4) * size.z();
  const double lens_m = rng.uniform(0.012, 0.04);
  TriangleMesh lens;  // along z here
  const Vector2d rim(0.92 * lens_r, lens_m);
  add_lathe(lens, Profile{{0.0, 0.0}, {lens_r, 0.0}}, kAround, shrink(metal_region, 0.02));
  add_lathe(lens, Profile{{lens_r, 0.0}, {lens_r, 0.6 * lens_m}, rim}, kAround,
            shrink(metal_region, 0.02));
  add_lathe(lens, Profile{rim, {0.7 * lens_r, lens_m - 0.004}, {0.0, lens_m - 0.004}}, kAround,
            shrink(lens_region, 0.02));
  const Eigen::AngleAxisd forward(0.5 * std::numbers::pi, Vector3d::UnitX());  // z to -y
  const double x = rng.uniform(-0.1, 0.15) * size.x();
  append(object.mesh, lens,
         Eigen::Translation3d(x, -0.5 * size.y() + 0.001, 0.46 * size.z()) * Pose(forward));
  TriangleMesh button;
  add_solid(button, Profile{{0.006, 0.0}, {0.006, 0.004}, {0.005, 0.005}},
            shrink(metal_region, 0.02), shrink(metal_region, 0.02));
  append(object.mesh, button, make_pose({-0.33 * size.x(), 0.0, size.z() - 0.001}, 0.0));
  const RgbColour body = housing(rng);
  object.texture = Image(kTexture_px, kTexture_px, body);
  paint(object.texture, metal_region, rng.uniform() < 0.5 ? kSteel : RgbColour(0.2, 0.2, 0.22));
  paint(object.texture, lens_region, gradient(RgbColour(0.1, 0.1, 0.2), kBlack));
  paint(object.texture, part_of(uv[front], 0.0, 0.0, 1.0, rng.uniform(0.2, 0.6)),
        mix(body, RgbColour::Zero(), 0.45));
  paint(object.texture, part_of(uv[front], 0.72, 0.74, 0.92, 0.9), RgbColour(0.95, 0.95, 0.85));
  draw_text(object.texture, part_of(uv[front], 0.06, 0.77, 0.36, 0.9), "FOTO", kWhite);
  paint(object.texture, part_of(uv[back], 0.28, 0.14, 0.92, 0.86), kBlack);
  paint(object.texture, part_of(uv[back], 0.32, 0.2, 0.88, 0.8), RgbColour(0.32, 0.38, 0.45));
  draw_keys(object.texture, part_of(uv[back], 0.06, 0.2, 0.24, 0.8), 1, 4, 0.6, kSteel, kBlack);
  object.specular = 0.5;
  object.mass_kg = 0.25;
  object.stands = true;
  return object;
}

GeneratedObject make_stapler(Rng& rng) {  // hinged at -x
  const double length = rng.uniform(0.12, 0.16);
  const double width = rng.uniform(0.03, 0.038);
  const double open_rad = rng.uniform(0.12, 0.2);
  const UvRect arm_region{0.0, 0.5, 1.0, 1.0};
  const UvRect foot_region{0.0, 0.0, 0.5, 0.48};
  const UvRect steel_region{0.5, 0.0, 1.0, 0.48};
  const double h = rng.uniform(0.022, 0.03);
  const std::array<Vector2d, 8> outline{Vector2d(0.0, 0.0),
                                        Vector2d(0.97 * length, 0.0),
                                        Vector2d(length, 0.3 * h),
                                        Vector2d(0.96 * length, 0.8 * h),
                                        Vector2d(0.6 * length, h),
                                        Vector2d(0.15 * length, 0.95 * h),
                                        Vector2d(-0.02 * length, 0.6 * h),
                                        Vector2d(-0.03 * length, 0.2 * h)};
  const UvRect side = shrink(arm_region, 0.02);
  TriangleMesh arm = make_extrusion(outline, 0.8 * width, 0.003, {side, side, side});
  const Eigen::AngleAxisd upright(0.5 * std::numbers::pi, Vector3d::UnitX());
  const Eigen::AngleAxisd raised(-open_rad, Vector3d::UnitY());
  transform(arm, Pose(raised) * Eigen::Translation3d(0.0, 0.4 * width, 0.0) * Pose(upright));
  GeneratedObject object;
  append(object.mesh, arm, make_pose({0.0, 0.0, 0.014}, 0.0));
  const Vector3d foot(1.02 * length, width, 0.01);
  add_box(object.mesh, foot, 0.004, plain(foot_region), {0.48 * length, 0.0, 0.005});
  TriangleMesh rail;  // what holds the staples
  append(rail,
         make_rounded_box({0.95 * length, 0.5 * width, 0.008}, 0.002, 2, plain(steel_region)));
  append(
      object.mesh, rail,
      make_pose({0.0, 0.0, 0.012}, 0.0) * Pose(raised) * Eigen::Translation3d(0.5 * length, 0, 0));
  append(object.mesh,
         make_rounded_box({0.1 * length, 0.85 * width, 0.024}, 0.003, 2, plain(steel_region)),
         make_pose({0.02 * length, 0.0, 0.014}, 0.0));
  const RgbColour body = housing(rng);
  object.texture = Image(kTexture_px, kTexture_px, body);
  paint(object.texture, foot_region, rng.uniform() < 0.5 ? body : RgbColour(0.15, 0.15, 0.16));
  paint(object.texture, steel_region, kSteel);
  draw_text(object.texture, part_of(arm_region, 0.3, 0.4, 0.7, 0.68), "OFFICE",
            body.sum() > 1.2 ? kBlack : kWhite);
  object.specular = 0.5;
  object.mass_kg = 0.25;
  return object;
}

}  // namespace vantage::family
