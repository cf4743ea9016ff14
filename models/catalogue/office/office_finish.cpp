#include "vantage/models/catalogue/office/office_finish.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "vantage/models/catalogue/shapes/mesh_builders.hpp"
#include "vantage/models/catalogue/shapes/patterns.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kCell_px = 64;
constexpr int kCells = 8;  // per edge of the image

/// Cells of the image, and how many metres the region covers; 0: it fills any face.
struct Region {
  int column, row, columns, rows;
  double scale_m;
};

Region region_of(Finish finish) {
  using enum Finish;
  switch (finish) {
    case oak: return {0, 0, 2, 2, 1.6};
    case walnut: return {2, 0, 2, 2, 1.6};
    case cardboard: return {4, 0, 2, 2, 0};
    case books: return {6, 0, 2, 2, 0};
    case binders: return {0, 2, 2, 2, 0};
    case spreadsheet: return {2, 2, 2, 2, 0};
    case editor: return {4, 2, 2, 2, 0};
    case view: return {6, 2, 2, 2, 0};
    case poster: return {0, 4, 2, 2, 0};
    case keyboard: return {2, 4, 2, 1, 0};
    case paper: return {2, 5, 1, 1, 0};
    case foliage: return {3, 5, 1, 1, 0};
    case clay: return {4, 4, 1, 1, 0.5};
    case white: return {5, 4, 1, 1, 0.8};
    case grey: return {6, 4, 1, 1, 0.8};
    case dark: return {7, 4, 1, 1, 0.8};
    case steel: return {4, 5, 1, 1, 0.8};
    case blue_fabric: return {0, 6, 2, 2, 0.6};
    case green_fabric: return {2, 6, 2, 2, 0.6};
    case red_fabric: return {4, 6, 2, 2, 0.6};
    case grey_fabric: return {6, 6, 2, 2, 0.6};
  }
  return {};
}

UvRect rect_of(Finish finish) {
  const Region r = region_of(finish);
  const double cell = 1.0 / kCells;
  return {r.column * cell, r.row * cell, (r.column + r.columns) * cell, (r.row + r.rows) * cell};
}

/// Upright spines in rows of colours, as books or binders stand on a board.
void paint_spines(Image& image, const UvRect& rect, int count, double label, Rng& rng) {
  paint(image, rect, RgbColour(0.08, 0.07, 0.06));
  for (int i = 0; i < count; ++i) {
    const double top = rng.uniform(0.75, 0.98);
    const UvRect spine = part_of(rect, (i + 0.06) / count, 0.0, (i + 0.94) / count, top);
    const double light = rng.uniform(0.25, 0.85);
    const double saturation = rng.uniform(0.15, 0.7);
    const RgbColour cover = hsv(rng.uniform(), saturation, light);
    paint(image, spine, cover);
    paint(image, part_of(spine, 0.2, 0.55, 0.8, 0.55 + label), mix(cover, RgbColour::Ones(), 0.75));
  }
}

void paint_screen(Image& image, const UvRect& rect, const RgbColour& ground, const RgbColour& bar,
                  const RgbColour& ink, Rng& rng) {
  paint(image, rect, ground);
  paint(image, part_of(rect, 0.0, 0.9, 1.0, 1.0), bar);
  paint(image, part_of(rect, 0.0, 0.0, 0.18, 0.9), mix(ground, bar, 0.35));
  for (int line = 0; line < 16; ++line) {
    const double t = 0.84 - 0.05 * line;
    const double indent = 0.22 + 0.04 * static_cast<double>(rng.uniform_index(4));
    paint(image, part_of(rect, indent, t, rng.uniform(indent + 0.1, 0.95), t + 0.022), ink);
  }
}

void paint_view(Image& image, const UvRect& rect, Rng& rng) {
  paint(image, rect, gradient(RgbColour(0.78, 0.87, 0.95), RgbColour(0.45, 0.66, 0.92)));
  for (int i = 0; i < 7; ++i) {
    const double s = i / 7.0;
    const double top = rng.uniform(0.2, 0.65);
    const double light = rng.uniform(0.45, 0.75);
    const RgbColour stone = hsv(0.08, rng.uniform(0.05, 0.25), light);
    paint(image, part_of(rect, s, 0.0, s + 1.0 / 7.0, top),
          checks(stone, 0.75 * stone, 6, static_cast<int>(30 * top)));
  }
  paint(image, part_of(rect, 0.0, 0.0, 1.0, 0.12), RgbColour(0.30, 0.45, 0.22));
}

void paint_fabric(Image& image, Finish finish, const RgbColour& colour, Rng& rng) {
  paint(image, rect_of(finish), mottled(0.88 * colour, 1.08 * colour, 24, rng));
}

void paint_plain(Image& image, Finish finish, const RgbColour& colour, Rng& rng) {
  paint(image, rect_of(finish), mottled(0.96 * colour, 1.02 * colour, 4, rng));
}

void paint_cardboard(Image& image, Rng& rng) {
  const RgbColour board(0.72, 0.55, 0.36);
  const UvRect rect = rect_of(Finish::cardboard);
  paint(image, rect, mottled(0.93 * board, 1.05 * board, 8, rng));
  paint(image, part_of(rect, 0.0, 0.44, 1.0, 0.56), RgbColour(0.80, 0.68, 0.48));  // tape
  paint(image, part_of(rect, 0.62, 0.65, 0.92, 0.9), RgbColour(0.92, 0.91, 0.88));
  draw_small_print(image, part_of(rect, 0.64, 0.67, 0.90, 0.88), RgbColour(0.2, 0.2, 0.2), rng);
}

void paint_keyboard(Image& image) {
  const UvRect rect = rect_of(Finish::keyboard);
  paint(image, rect, RgbColour(0.12, 0.12, 0.13));
  for (int row = 0; row < 5; ++row) {
    for (int key = 0; key < 15; ++key) {
      paint(image,
            part_of(rect, (key + 0.35) / 16, (row + 0.3) / 5.4, (key + 1.15) / 16, (row + 1) / 5.4),
            RgbColour(0.30, 0.30, 0.32));
    }
  }
}

void paint_poster(Image& image, Rng& rng) {
  const UvRect rect = rect_of(Finish::poster);
  paint(image, rect, gradient(RgbColour(0.95, 0.85, 0.62), RgbColour(0.88, 0.45, 0.28)));
  paint(image, part_of(rect, 0.0, 0.0, 1.0, 0.3),
        zigzag(RgbColour(0.15, 0.30, 0.40), RgbColour(0.24, 0.44, 0.50), 5, 3));
  draw_disc(image, part_of(rect, 0.55, 0.5, 0.85, 0.8), RgbColour(0.98, 0.95, 0.80));
  draw_small_print(image, part_of(rect, 0.1, 0.84, 0.6, 0.96), RgbColour(0.3, 0.1, 0.1), rng);
}

}  // namespace

UvRect finish_uv(Finish finish, double width_m, double height_m) {
  const UvRect inner = shrink(rect_of(finish), 2.0 / (kCells * kCell_px));
  const double scale_m = region_of(finish).scale_m;
  if (scale_m == 0.0) return inner;
  return part_of(inner, 0.0, 0.0, std::min(1.0, width_m / scale_m),
                 std::min(1.0, height_m / scale_m));
}

Image paint_finishes() {
  using enum Finish;
  Rng rng = Rng::stream(0, "office finishes");
  Image image(kCells * kCell_px, kCells * kCell_px, RgbColour(0.5, 0.5, 0.5));
  paint(image, rect_of(oak),
        wood(RgbColour(0.85, 0.70, 0.50), RgbColour(0.66, 0.48, 0.30), 3, rng));
  paint(image, rect_of(walnut),
        wood(RgbColour(0.50, 0.33, 0.22), RgbColour(0.30, 0.18, 0.11), 3, rng));
  paint_cardboard(image, rng);
  paint_spines(image, rect_of(books), 22, 0.12, rng);
  paint_spines(image, rect_of(binders), 11, 0.25, rng);
  paint_screen(image, rect_of(spreadsheet), RgbColour(0.93, 0.95, 0.97),
               RgbColour(0.16, 0.42, 0.30), RgbColour(0.45, 0.50, 0.58), rng);
  paint_screen(image, rect_of(editor), RgbColour(0.11, 0.13, 0.18), RgbColour(0.25, 0.30, 0.40),
               RgbColour(0.55, 0.72, 0.62), rng);
  paint_view(image, rect_of(view), rng);
  paint_poster(image, rng);
  paint_keyboard(image);
  paint(image, rect_of(paper), RgbColour(0.95, 0.95, 0.93));
  draw_small_print(image, part_of(rect_of(paper), 0.1, 0.1, 0.9, 0.9), RgbColour(0.3, 0.3, 0.3),
                   rng);
  paint(image, rect_of(foliage),
        mottled(RgbColour(0.13, 0.34, 0.12), RgbColour(0.34, 0.60, 0.22), 5, rng));
  paint_plain(image, clay, RgbColour(0.72, 0.40, 0.28), rng);
  paint_plain(image, white, RgbColour(0.93, 0.93, 0.91), rng);
  paint_plain(image, grey, RgbColour(0.62, 0.64, 0.66), rng);
  paint_plain(image, dark, RgbColour(0.13, 0.13, 0.15), rng);
  paint_plain(image, steel, RgbColour(0.76, 0.78, 0.80), rng);
  paint_fabric(image, blue_fabric, RgbColour(0.20, 0.34, 0.55), rng);
  paint_fabric(image, green_fabric, RgbColour(0.30, 0.45, 0.33), rng);
  paint_fabric(image, red_fabric, RgbColour(0.58, 0.20, 0.18), rng);
  paint_fabric(image, grey_fabric, RgbColour(0.38, 0.39, 0.42), rng);
  return image;
}

void add_block(TriangleMesh& mesh, const Vector3d& low_m, const Vector3d& high_m, Finish finish,
               Finish front) {
  const Vector3d size = high_m - low_m;
  const Vector3d centre = 0.5 * (low_m + high_m);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3d normal = sign * Vector3d::Unit(axis);
      const Vector3d up = axis == 2 ? Vector3d(sign * Vector3d::UnitX()) : Vector3d::UnitZ();
      const Vector3d right = up.cross(normal);
      const double width = right.cwiseAbs().dot(size);
      const double height = up.cwiseAbs().dot(size);
      const UvRect uv = finish_uv(axis == 0 && sign > 0 ? front : finish, width, height);
      std::array<int, 4> corner{};
      for (std::size_t i = 0; i < 4; ++i) {
        const double s = i == 1 || i == 2 ? 1.0 : 0.0;
        const double t = i >= 2 ? 1.0 : 0.0;
        const Vector3d p = centre + 0.5 * (normal.cwiseProduct(size) + (2 * s - 1) * width * right +
                                           (2 * t - 1) * height * up);
        corner[i] = mesh.add_vertex(p, normal, uv.at(s, t));
      }
      mesh.add_quad(corner[0], corner[1], corner[2], corner[3]);
    }
  }
}

void add_block(TriangleMesh& mesh, const Vector3d& low_m, const Vector3d& high_m, Finish finish) {
  add_block(mesh, low_m, high_m, finish, finish);
}

void add_cushion(TriangleMesh& mesh, const Vector3d& low_m, const Vector3d& high_m, Finish finish,
                 const Pose& T_mesh_cushion) {
  const Vector3d size = high_m - low_m;
  BoxUv uv;
  uv.fill(finish_uv(finish, size.y(), std::max(size.x(), size.z())));
  TriangleMesh cushion = make_rounded_box(size, 0.3 * size.minCoeff(), 1, uv);
  append(mesh, cushion, T_mesh_cushion * Eigen::Translation3d(0.5 * (low_m + high_m)));
}

void add_rod(TriangleMesh& mesh, const Vector3d& from_m, const Vector3d& to_m, double radius_m,
             Finish finish) {
  const std::array<Vector3d, 2> path{from_m, to_m};
  const std::array<Vector2d, 2> radii{Vector2d(radius_m, radius_m), Vector2d(radius_m, radius_m)};
  const Vector3d along = (to_m - from_m).normalized();
  const Vector3d side = std::abs(along.z()) > 0.9 ? Vector3d::UnitX() : Vector3d::UnitZ();
  append(mesh, make_tube(path, radii, side, 8, finish_uv(finish, 0.2, 0.4)));
}

void add_turned(TriangleMesh& mesh, std::span<const Vector2d> profile_m, const Vector2d& axis_m,
                Finish finish) {
  TriangleMesh turned;
  for (std::size_t i = 0; i + 1 < profile_m.size(); ++i) {
    add_lathe(turned, profile_m.subspan(i, 2), 14, finish_uv(finish, 0.4, 0.4));
  }
  append(mesh, turned, make_pose({axis_m.x(), axis_m.y(), 0.0}, 0.0));
}

void add_leaf(TriangleMesh& mesh, const Vector3d& root_m, double heading_rad, double length_m,
              double width_m) {
  constexpr int kNodes = 5;
  const Vector3d out(std::cos(heading_rad), std::sin(heading_rad), 0.0);
  std::vector<Vector3d> path;
  std::vector<Vector2d> radii;
  for (int i = 0; i < kNodes; ++i) {
    const double s = static_cast<double>(i) / (kNodes - 1);
    path.emplace_back(root_m +
                      length_m * (0.62 * s * out + (1.0 * s - 0.85 * s * s) * Vector3d::UnitZ()));
    const double breadth = 0.12 + 0.88 * std::sin(3.0 * std::min(s + 0.02, 1.0));
    radii.emplace_back(0.5 * width_m * std::max(0.08, breadth), 0.004);
  }
  append(mesh, make_tube(path, radii, Vector3d::UnitZ().cross(out), 4,
                         finish_uv(Finish::foliage, width_m, length_m)));
}

}  // namespace vantage
