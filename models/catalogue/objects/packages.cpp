#include <numbers>

#include "vantage/models/catalogue/objects/family_kit.hpp"

namespace vantage::family {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr std::array<std::string_view, 6> kCereals{"OATS", "CRUNCH", "FLAKES",
                                                   "RICE", "HOOPS",  "MUESLI"};
constexpr std::array<std::string_view, 4> kCartons{"MILK", "JUICE", "SOYA", "CREAM"};
constexpr std::array<std::string_view, 6> kTitles{"ATLAS", "FABLES", "OPTICS",
                                                  "POEMS", "GARDEN", "ALGEBRA"};

void paint_all(Image& image, const BoxUv& uv, const RgbColour& colour) {
  for (const UvRect& rect : uv) paint(image, shrink(rect, -0.004), colour);
}

Pose lift_to(double z_m, double yaw_rad = 0.0) { return make_pose({0.0, 0.0, z_m}, yaw_rad); }

}  // namespace

GeneratedObject make_cereal_box(Rng& rng) {
  const Vector3d size{rng.uniform(0.13, 0.19), rng.uniform(0.045, 0.07), rng.uniform(0.19, 0.285)};
  const BoxUv uv = unfold_box(size);
  GeneratedObject box;
  append(box.mesh, make_rounded_box(size, 0.003, 2, uv));
  const RgbColour ground = vivid(rng);
  const RgbColour accent = rng.uniform() < 0.5 ? kWhite : vivid(rng);
  const std::string_view word = pick(kCereals, rng);
  box.texture = Image(kTexture_px, kTexture_px, ground);
  for (const UvRect& face : {uv[front], uv[back]}) {
    paint(box.texture, part_of(face, 0.0, 0.6, 1.0, 0.95), accent);
    draw_text(box.texture, part_of(face, 0.08, 0.66, 0.92, 0.89), word, dark(rng));
  }
  draw_disc(box.texture, part_of(uv[front], 0.14, 0.08, 0.86, 0.52), pale(rng));
  const RgbColour flakes = hsv(rng.uniform(0.05, 0.15), 0.8, 0.85);
  draw_disc(box.texture, part_of(uv[front], 0.24, 0.16, 0.76, 0.44), flakes);
  paint(box.texture, part_of(uv[front], 0.34, 0.2, 0.66, 0.4),
        dots(flakes, 0.7 * flakes, 4, 3, 0.35));
  draw_small_print(box.texture, part_of(uv[back], 0.1, 0.1, 0.9, 0.52), accent, rng);
  draw_small_print(box.texture, part_of(uv[right], 0.12, 0.3, 0.88, 0.9), kWhite, rng);
  draw_barcode(box.texture, part_of(uv[left], 0.12, 0.06, 0.88, 0.2), rng);
  paint(box.texture, part_of(uv[left], 0.15, 0.3, 0.85, 0.9), any_pattern(ground, accent, rng));
  box.mass_kg = rng.uniform(0.35, 0.6);
  box.top_radius_m = 0.5 * size.y();
  box.stands = true;
  return box;
}

GeneratedObject make_milk_carton(Rng& rng) {
  const double w = rng.uniform(0.06, 0.075);
  const double body = rng.uniform(0.13, 0.19);
  const double roof = 0.5 * w;
  const UvRect body_region{0.0, 0.25, 1.0, 1.0};
  const UvRect roof_region{0.0, 0.0, 0.6, 0.24};
  const UvRect cap_region{0.62, 0.0, 1.0, 0.24};
  const BoxUv uv = unfold_box({w, w, body}, body_region);
  GeneratedObject carton;
  append(carton.mesh, make_rounded_box({w, w, body}, 0.002, 2, uv), lift_to(0.5 * body));
  const double half = 0.5 * w - 0.001;
  const std::array<Vector2d, 6> gable{Vector2d(-half, 0),
                                      Vector2d(half, 0),
                                      Vector2d(0.0025, roof),
                                      Vector2d(0.0025, roof + 0.016),
                                      Vector2d(-0.0025, roof + 0.016),
                                      Vector2d(-0.0025, roof)};
  const UvRect plain = shrink(roof_region, 0.01);
  TriangleMesh prism = make_extrusion(gable, 2.0 * half, 0.0, {plain, plain, plain});
  const Eigen::AngleAxisd upright(0.5 * std::numbers::pi, Vector3d::UnitX());
  transform(prism, Eigen::Translation3d(0.0, half, body - 0.001) * Pose(upright));
  append(carton.mesh, prism);
  TriangleMesh cap;
  add_solid(cap, Profile{{0.012, 0.0}, {0.012, 0.012}}, shrink(cap_region, 0.01),
            shrink(cap_region, 0.01));
  append(carton.mesh, cap,
         Eigen::Translation3d(0.25 * w, 0.0, body + 0.45 * roof) *
             Pose(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vector3d::UnitY())));
  const RgbColour ground = rng.uniform() < 0.4 ? kWhite : pale(rng);
  const RgbColour accent = vivid(rng);
  carton.texture = Image(kTexture_px, kTexture_px, ground);
  paint(carton.texture, roof_region, accent);
  paint(carton.texture, cap_region, vivid(rng));
  const std::string_view word = pick(kCartons, rng);
  for (const Face face : {front, back, left, right}) {
    paint(carton.texture, part_of(uv[face], -0.1, 0.0, 1.1, 0.4), accent);
  }
  for (const Face face : {front, back}) {
    draw_text(carton.texture, part_of(uv[face], 0.1, 0.62, 0.9, 0.85), word, accent);
    draw_disc(carton.texture, part_of(uv[face], 0.25, 0.08, 0.75, 0.34), ground);
  }
  draw_small_print(carton.texture, part_of(uv[left], 0.12, 0.5, 0.88, 0.92),
                   mix(ground, kBlack, 0.6), rng);
  draw_barcode(carton.texture, part_of(uv[right], 0.15, 0.55, 0.85, 0.78), rng);
  carton.mass_kg = rng.uniform(0.5, 1.0);
  carton.stands = true;
  return carton;
}

GeneratedObject make_tissue_box(Rng& rng) {
  const bool cube = rng.uniform() < 0.4;
  const Vector3d size = cube ? Vector3d(0.112, 0.112, rng.uniform(0.11, 0.13))
                             : Vector3d{rng.uniform(0.2, 0.235), 0.115, rng.uniform(0.06, 0.09)};
  const BoxUv uv = unfold_box(size);
  GeneratedObject box;
  append(box.mesh, make_rounded_box(size, 0.003, 2, uv));
  const RgbColour ground = pale(rng);
  const RgbColour accent = vivid(rng);
  box.texture = Image(kTexture_px, kTexture_px, ground);
  const Pattern pattern = any_pattern(ground, accent, rng);
  for (const UvRect& face : uv) paint(box.texture, face, pattern);
  draw_disc(box.texture, part_of(uv[top], 0.2, 0.25, 0.8, 0.75), accent);
  draw_disc(box.texture, part_of(uv[top], 0.25, 0.32, 0.75, 0.68), kWhite);
  paint(box.texture, part_of(uv[front], 0.2, 0.3, 0.8, 0.7), accent);
  draw_text(box.texture, part_of(uv[front], 0.26, 0.38, 0.74, 0.62), "SOFT", kWhite);
  box.mass_kg = 0.2;
  box.top_radius_m = 0.5 * size.y() - 0.003;
  box.stands = true;
  return box;
}

GeneratedObject make_book(Rng& rng) {  // lying; the spine is on -x
  const Vector3d size{rng.uniform(0.125, 0.17), rng.uniform(0.18, 0.235),
                      rng.uniform(0.018, 0.045)};
  const double board = 0.003;
  const Vector3d pages_size = size - Vector3d(0.006, 0.008, 2.0 * board);
  const UvRect pages_region{0.0, 0.0, 1.0, 0.14};
  const UvRect cover_region{0.0, 0.15, 0.48, 1.0};
  const UvRect back_region{0.52, 0.15, 1.0, 1.0};
  const UvRect spine_region{0.485, 0.15, 0.515, 1.0};
  const UvRect leaf = shrink(pages_region, 0.01);
  const UvRect edge = shrink(spine_region, 0.006);
  GeneratedObject book;
  const BoxUv pages{leaf, leaf, leaf, leaf, leaf, leaf};
  append(book.mesh, make_rounded_box(pages_size, 0.0012, 1, pages), lift_to(0.5 * size.z()));
  const Vector3d board_size(size.x(), size.y(), board);
  const UvRect cover = shrink(cover_region, 0.006);
  const UvRect back_cover = shrink(back_region, 0.006);
  append(book.mesh, make_rounded_box(board_size, 0.0012, 2, {edge, edge, edge, edge, cover, edge}),
         lift_to(size.z() - 0.5 * board));
  append(book.mesh,
         make_rounded_box(board_size, 0.0012, 2, {edge, edge, edge, edge, edge, back_cover}),
         lift_to(0.5 * board));
  append(book.mesh,
         make_rounded_box({board, size.y(), size.z() - 0.001}, 0.0012, 1,
                          {edge, edge, edge, edge, edge, edge}),
         make_pose({-0.5 * size.x() + 0.5 * board, 0.0, 0.5 * size.z()}, 0.0));
  const RgbColour ground = vivid(rng);
  const RgbColour accent = rng.uniform() < 0.5 ? pale(rng) : dark(rng);
  book.texture = Image(kTexture_px, kTexture_px, ground);
  paint(book.texture, pages_region,
        bands(RgbColour(0.93, 0.90, 0.80), RgbColour(0.82, 0.78, 0.68), 8));
  draw_text(book.texture, part_of(cover_region, 0.1, 0.74, 0.9, 0.88), pick(kTitles, rng), accent);
  const UvRect art = part_of(cover_region, 0.15, 0.2, 0.85, 0.66);
  paint(book.texture, art, any_pattern(accent, vivid(rng), rng));
  if (rng.uniform() < 0.5) draw_disc(book.texture, part_of(art, 0.2, 0.15, 0.8, 0.85), vivid(rng));
  draw_small_print(book.texture, part_of(cover_region, 0.3, 0.08, 0.7, 0.16), accent, rng);
  draw_small_print(book.texture, part_of(back_region, 0.15, 0.45, 0.85, 0.85), accent, rng);
  draw_barcode(book.texture, part_of(back_region, 0.55, 0.08, 0.9, 0.2), rng);
  book.mass_kg = 900.0 * size.prod() * 0.8;
  book.top_radius_m = 0.5 * size.x() - 0.005;
  book.stands = true;
  return book;
}

GeneratedObject make_toy_blocks(Rng& rng) {
  const double edge = rng.uniform(0.05, 0.065);
  const std::array<UvRect, 3> region{UvRect{0.0, 0.45, 1.0, 1.0}, UvRect{0.0, 0.0, 0.5, 0.43},
                                     UvRect{0.5, 0.0, 1.0, 0.43}};
  const BoxUv cube_uv = unfold_box(Vector3d::Constant(edge), region[0]);
  GeneratedObject blocks;
  append(blocks.mesh, make_rounded_box(Vector3d::Constant(edge), 0.003, 2, cube_uv),
         lift_to(0.5 * edge));
  const UvRect middle = shrink(region[1], 0.01);
  const int corners = 5 + static_cast<int>(rng.uniform_index(4));
  std::vector<Vector2d> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    outline.emplace_back(0.5 * edge * Vector2d(std::cos(angle), std::sin(angle)));
  }
  const double z_middle = edge;
  const double z_upper = z_middle + 0.8 * edge;
  append(blocks.mesh, make_extrusion(outline, 0.8 * edge, 0.002, {middle, middle, middle}),
         lift_to(z_middle, rng.uniform(0.0, 1.5)));
  const UvRect upper = shrink(region[2], 0.01);
  const bool star = rng.uniform() < 0.5;
  std::vector<Vector2d> tip;
  if (star) {
    for (int i = 0; i < 10; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 10;
      tip.emplace_back((i % 2 == 0 ? 0.46 : 0.22) * edge *
                       Vector2d(std::cos(angle), std::sin(angle)));
    }
    append(blocks.mesh, make_extrusion(tip, 0.4 * edge, 0.002, {upper, upper, upper}),
           lift_to(z_upper, rng.uniform(0.0, 1.5)));
  } else {
    TriangleMesh cone;
    add_solid(cone, Profile{{0.4 * edge, 0.0}, {0.2 * edge, 0.4 * edge}, {0.0, 0.8 * edge}}, upper,
              upper);
    append(blocks.mesh, cone, lift_to(z_upper));
  }
  const RgbColour cube = vivid(rng);
  blocks.texture = Image(kTexture_px, kTexture_px, cube);
  paint_all(blocks.texture, cube_uv, cube);
  for (const UvRect& face : cube_uv) {
    paint(blocks.texture, part_of(face, 0.12, 0.12, 0.88, 0.88), kWhite);
    const char letter = static_cast<char>('A' + rng.uniform_index(26));
    draw_text(blocks.texture, part_of(face, 0.3, 0.22, 0.7, 0.78), std::string_view(&letter, 1),
              cube);
  }
  paint(blocks.texture, region[1],
        wood(RgbColour(0.86, 0.68, 0.45), RgbColour(0.6, 0.4, 0.2), 1, rng));
  if (rng.uniform() < 0.7) paint(blocks.texture, region[1], vivid(rng));
  paint(blocks.texture, region[2], vivid(rng));
  blocks.mass_kg = rng.uniform(0.15, 0.3);
  blocks.stands = true;
  return blocks;
}

}  // namespace vantage::family
