#include "vantage/models/catalogue/database/sticker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kCells = 12;          // of the sheet, each way
constexpr double kLift_m = 0.0004;  // above the surface
constexpr double kMinFacing = 0.2;  // cosine between normal and heading
constexpr double kMaxSlope = 3.0;   // depth over width of a cell

struct Hit {
  double depth_m = std::numeric_limits<double>::infinity();  ///< along the line of sight
  Vector3d p_m = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();
};

/// Frame of the sticker: x across, y along z, lines of sight towards -out.
struct SightFrame {
  Vector3d out;
  Vector3d across;

  explicit SightFrame(double heading_rad)
      : out(std::cos(heading_rad), std::sin(heading_rad), 0.0), across(-out.y(), out.x(), 0.0) {}
  [[nodiscard]] Vector2d flat(const Vector3d& p) const { return {across.dot(p), p.z()}; }
};

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where a line of sight meets a triangle that faces it.
std::optional<Hit> meet(const TriangleMesh& mesh, const std::array<int, 3>& triangle,
                        const SightFrame& frame, const Vector2d& at) {
  std::array<Vector3d, 3> p;
  std::array<Vector2d, 3> flat;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = mesh.positions_m[static_cast<std::size_t>(triangle[k])];
    flat[k] = frame.flat(p[k]) - at;
  }
  const double area = cross(flat[1] - flat[0], flat[2] - flat[0]);
  if (area <= 1e-14) return std::nullopt;
  const Vector3d weights =
      Vector3d(cross(flat[1], flat[2]), cross(flat[2], flat[0]), cross(flat[0], flat[1])) / area;
  if (weights.minCoeff() < -1e-9) return std::nullopt;
  Hit hit;
  hit.p_m = weights.x() * p[0] + weights.y() * p[1] + weights.z() * p[2];
  for (int k = 0; k < 3; ++k) {
    hit.normal +=
        weights[k] * mesh.normals[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)])];
  }
  hit.normal.normalize();
  hit.depth_m = -frame.out.dot(hit.p_m);
  return hit;
}

std::optional<Hit> nearest(const TriangleMesh& mesh, const SightFrame& frame, const Vector2d& at) {
  Hit best;
  for (const auto& triangle : mesh.triangles) {
    const auto hit = meet(mesh, triangle, frame, at);
    if (hit && hit->depth_m < best.depth_m) best = *hit;
  }
  if (!std::isfinite(best.depth_m) || best.normal.dot(frame.out) < kMinFacing) {
    return std::nullopt;
  }
  return best;
}

/// A texture with the image in a strip below it. @return where the image is.
UvRect extend_texture(GeneratedObject& object, const Image& sticker_image) {
  Image& old = object.texture;
  Image taller(std::max(old.width_px, sticker_image.width_px),
               old.height_px + sticker_image.height_px, RgbColour::Ones());
  expects(old.width_px == taller.width_px, "a sticker's image is no wider than the texture");
  std::ranges::copy(old.rgb, taller.rgb.begin());
  for (int y = 0; y < sticker_image.height_px; ++y) {
    for (int x = 0; x < sticker_image.width_px; ++x) {
      taller.set(x, old.height_px + y, sticker_image.at(x, y));
    }
  }
  const double strip = static_cast<double>(sticker_image.height_px) / taller.height_px;
  for (Vector2d& uv : object.mesh.uvs) uv.y() = strip + (1.0 - strip) * uv.y();
  const double width = static_cast<double>(sticker_image.width_px) / taller.width_px;
  old = std::move(taller);
  return shrink({0.0, 0.0, width, strip}, 0.004);
}

bool is_smooth(const Hit& a, const Hit& b) {
  const double apart_m = std::abs(a.depth_m - b.depth_m);
  const Vector3d step = a.p_m - b.p_m;
  return apart_m <= kMaxSlope * std::sqrt(std::max(step.squaredNorm() - apart_m * apart_m, 0.0));
}

}  // namespace

double apply_sticker(GeneratedObject& object, const Sticker& sticker) {
  const SightFrame frame(sticker.heading_rad);
  constexpr std::size_t n = kCells + 1;
  const auto share_of = [](std::size_t i) -> Vector2d {
    const std::size_t row = i / n;
    return Vector2d(static_cast<double>(i % n), static_cast<double>(row)) / kCells;
  };
  std::array<std::optional<Hit>, n * n> hits;
  const double low_m = sticker.middle * object.height_m - 0.5 * sticker.height_m;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Vector2d share = share_of(i);
    hits[i] = nearest(object.mesh, frame,
                      {(share.x() - 0.5) * sticker.width_m, low_m + share.y() * sticker.height_m});
  }
  const UvRect uv = extend_texture(object, sticker.sticker_image);
  std::array<int, n * n> vertex{};
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i]) continue;
    const Vector2d share = share_of(i);
    vertex[i] = object.mesh.add_vertex(hits[i]->p_m + kLift_m * hits[i]->normal, hits[i]->normal,
                                       uv.at(share.x(), share.y()));
  }
  int laid = 0;
  for (std::size_t i = 0; i + n < hits.size(); ++i) {
    if (i % n == n - 1) continue;
    const std::array<std::size_t, 4> corner{i, i + 1, i + n + 1, i + n};
    bool good = std::ranges::all_of(corner, [&](std::size_t c) { return hits[c].has_value(); });
    for (std::size_t k = 0; good && k < 4; ++k) {
      good = is_smooth(*hits[corner[k]], *hits[corner[(k + 1) % 4]]);
    }
    if (!good) continue;
    object.mesh.add_quad(vertex[i], vertex[i + 1], vertex[i + n + 1], vertex[i + n]);
    ++laid;
  }
  return static_cast<double>(laid) / (kCells * kCells);
}

}  // namespace vantage
