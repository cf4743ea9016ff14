#include "vantage/models/catalogue/objects/family_kit.hpp"

#include <algorithm>
#include <numbers>

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

RgbColour any_colour(const ColourRange& range, Rng& rng) {
  const auto draw = [&](const std::array<double, 2>& limits) {
    return rng.uniform(limits[0], limits[1]);
  };
  const double hue = draw(range.hue);
  const double saturation = draw(range.saturation);
  return hsv(hue, saturation, draw(range.brightness));
}

RgbColour vivid(Rng& rng) {
  constexpr std::array<ColourRange, 11> paints{{
      {{-0.02, 0.02}, {0.75, 0.92}, {0.65, 0.85}},  // red
      {{0.05, 0.08}, {0.75, 0.92}, {0.80, 0.95}},   // orange
      {{0.12, 0.15}, {0.70, 0.90}, {0.85, 0.96}},   // yellow
      {{0.22, 0.27}, {0.55, 0.75}, {0.60, 0.80}},   // leaf green
      {{0.36, 0.42}, {0.60, 0.85}, {0.35, 0.55}},   // dark green
      {{0.46, 0.51}, {0.60, 0.85}, {0.55, 0.75}},   // teal
      {{0.54, 0.57}, {0.50, 0.75}, {0.80, 0.92}},   // sky
      {{0.60, 0.65}, {0.70, 0.90}, {0.45, 0.70}},   // blue
      {{0.73, 0.79}, {0.45, 0.70}, {0.45, 0.65}},   // purple
      {{0.90, 0.95}, {0.45, 0.70}, {0.80, 0.92}},   // pink
      {{0.04, 0.07}, {0.55, 0.75}, {0.35, 0.50}},   // brown
  }};
  return any_colour(pick(paints, rng), rng);
}
RgbColour pale(Rng& rng) { return any_colour({{0.0, 1.0}, {0.04, 0.25}, {0.88, 0.98}}, rng); }
RgbColour dark(Rng& rng) { return any_colour({{0.0, 1.0}, {0.4, 0.9}, {0.15, 0.35}}, rng); }

Image make_texture(const RgbColour& wall, const RgbColour& inner, const RgbColour& part) {
  Image image(kTexture_px, kTexture_px, wall);
  paint(image, kInner, inner);
  paint(image, kPart, part);
  return image;
}

double radius_at(std::span<const Vector2d> profile_m, double z_m) {
  for (std::size_t i = 1; i < profile_m.size(); ++i) {
    const Vector2d& a = profile_m[i - 1];
    const Vector2d& b = profile_m[i];
    if (z_m > b.y()) continue;
    const double share = b.y() > a.y() ? (z_m - a.y()) / (b.y() - a.y()) : 1.0;
    return a.x() + std::clamp(share, 0.0, 1.0) * (b.x() - a.x());
  }
  return profile_m.back().x();
}

void add_vessel(TriangleMesh& mesh, std::span<const Vector2d> outer_m, double wall_m,
                double floor_m) {
  const Vector2d& rim = outer_m.back();
  add_lathe(mesh, Profile{{0.0, outer_m.front().y()}, outer_m.front()}, kAround, kInnerUv);
  add_lathe(mesh, outer_m, kAround, kWallUv);
  add_lathe(
      mesh,
      Profile{rim, {rim.x() - 0.5 * wall_m, rim.y() + 0.4 * wall_m}, {rim.x() - wall_m, rim.y()}},
      kAround, part_of(kInnerUv, 0.0, 0.9, 1.0, 1.0));
  Profile inner;
  for (std::size_t i = outer_m.size(); i-- > 0 && outer_m[i].y() > floor_m;) {
    inner.emplace_back(outer_m[i].x() - wall_m, outer_m[i].y());
  }
  inner.emplace_back(radius_at(outer_m, floor_m) - wall_m, floor_m);
  add_lathe(mesh, inner, kAround, part_of(kInnerUv, 0.0, 0.0, 1.0, 0.9));
  add_lathe(mesh, Profile{inner.back(), {0.0, floor_m}}, kAround,
            part_of(kInnerUv, 0.0, 0.0, 1.0, 0.1));
}

void add_solid(TriangleMesh& mesh, std::span<const Vector2d> outer_m, const UvRect& side,
               const UvRect& ends) {
  const Vector2d& low = outer_m.front();
  const Vector2d& high = outer_m.back();
  if (low.x() > 0.0) add_lathe(mesh, Profile{{0.0, low.y()}, low}, kAround, ends);
  add_lathe(mesh, outer_m, kAround, side);
  if (high.x() > 0.0) add_lathe(mesh, Profile{high, {0.0, high.y()}}, kAround, ends);
}

TriangleMesh make_handle(std::span<const Vector2d> outer_m, double z_low_m, double z_high_m,
                         double reach_m, double width_m) {
  const double high_r = radius_at(outer_m, z_high_m) - 0.002;
  const double low_r = radius_at(outer_m, z_low_m) - 0.002;
  const double z_span = z_high_m - z_low_m;
  const double out = std::max(high_r, low_r) + reach_m;
  const std::array<Vector3d, 5> control{
      Vector3d(high_r, 0, z_high_m), Vector3d(out - 0.35 * reach_m, 0, z_high_m + 0.02 * z_span),
      Vector3d(out, 0, z_low_m + 0.62 * z_span),
      Vector3d(out - 0.2 * reach_m, 0, z_low_m + 0.22 * z_span), Vector3d(low_r, 0, z_low_m)};
  const std::vector<Vector3d> path = smooth_curve<Vector3d>(control, 3);
  const std::vector<Vector2d> radii(path.size(), Vector2d(0.5 * width_m, 0.36 * width_m));
  return make_tube(path, radii, Vector3d::UnitY(), 8, kPartUv);
}

void lay_down(TriangleMesh& mesh) {
  transform(mesh, make_pose(Vector3d::Zero(), 0.0, 0.5 * std::numbers::pi));
}

void draw_label(Image& image, const UvRect& wall, const Label& label, Rng& rng) {
  const auto& [text, ground, ink] = label;
  paint(image, wall, ground);
  paint(image, part_of(wall, 0.0, 0.92, 1.0, 1.0), ink);
  paint(image, part_of(wall, 0.0, 0.0, 1.0, 0.08), ink);
  draw_text(image, part_of(wall, 0.11, 0.52, 0.49, 0.8), text, ink);
  const RgbColour ornament = vivid(rng);
  switch (rng.uniform_index(3)) {
    case 0: draw_disc(image, part_of(wall, 0.2, 0.12, 0.4, 0.46), ornament); break;
    case 1:
      paint(image, part_of(wall, 0.1, 0.18, 0.5, 0.42), zigzag(ornament, ground, 5, 2));
      break;
    default: paint(image, part_of(wall, 0.1, 0.14, 0.5, 0.44), dots(ground, ornament, 5, 2, 0.4));
  }
  draw_small_print(image, part_of(wall, 0.62, 0.42, 0.92, 0.86), mix(ground, ink, 0.7), rng);
  draw_barcode(image, part_of(wall, 0.66, 0.13, 0.88, 0.36), rng);
}

}  // namespace vantage::family
