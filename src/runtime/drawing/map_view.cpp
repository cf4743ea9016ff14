#include "vantage/runtime/drawing/map_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kDistanceOverRadius = 3.2;  ///< of the camera: perspective without distortion
constexpr double kNearPlane_m = 1e-3;
constexpr float kRimStrength = 9.0F;

void blend(cv::Vec3b& pixel, const cv::Scalar& bgr, double opacity) {
  for (int c = 0; c < 3; ++c) {
    pixel[c] = cv::saturate_cast<std::uint8_t>(pixel[c] + opacity * (bgr[c] - pixel[c]));
  }
}

/// The pixels from `reach` before to `reach` behind the interval [u, v], of those from 0 to `last`.
std::pair<int, int> pixel_range(double u, double v, double reach, int last) {
  const auto clamped = [&](double at) { return std::clamp(at, -1.0, last + 1.0); };
  return {std::max(0, static_cast<int>(std::floor(clamped(std::min(u, v) - reach)))),
          std::min(last, static_cast<int>(std::ceil(clamped(std::max(u, v) + reach))))};
}

/// Fills a convex quad, corners in px in either turning sense, at one depth.
void fill_quad(MapCanvas& canvas, const std::array<Eigen::Vector2d, 4>& q, float inverse_depth,
               const cv::Vec3b& bgr) {
  Eigen::Vector2d low = q[0];
  Eigen::Vector2d high = q[0];
  double area = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& next = q[(i + 1) % 4];
    low = low.cwiseMin(q[i]);
    high = high.cwiseMax(q[i]);
    area += q[i].x() * next.y() - next.x() * q[i].y();
  }
  const double turn = area < 0.0 ? -1.0 : 1.0;
  const int x0 = std::max(0, static_cast<int>(std::floor(low.x())));
  const int y0 = std::max(0, static_cast<int>(std::floor(low.y())));
  const int x1 = std::min(canvas.bgr.cols - 1, static_cast<int>(std::ceil(high.x())));
  const int y1 = std::min(canvas.bgr.rows - 1, static_cast<int>(std::ceil(high.y())));
  for (int y = y0; y <= y1; ++y) {
    auto* depth_row = canvas.inverse_depth.ptr<float>(y);
    auto* colour_row = canvas.bgr.ptr<cv::Vec3b>(y);
    for (int x = x0; x <= x1; ++x) {
      if (depth_row[x] >= inverse_depth) continue;
      bool inside = true;
      for (std::size_t i = 0; i < 4 && inside; ++i) {
        const Eigen::Vector2d edge = q[(i + 1) % 4] - q[i];
        inside = turn * (edge.x() * (y - q[i].y()) - edge.y() * (x - q[i].x())) >= -0.5;
      }
      if (!inside) continue;
      depth_row[x] = inverse_depth;
      colour_row[x] = bgr;
    }
  }
}

/// +1 occupied, -1 free, 0 unobserved: what the renderer asks of each cell, many times.
std::vector<std::int8_t> cell_signs(const OccupancyGrid& grid) {
  const auto occupied = static_cast<float>(log_odds_of(kOccupiedAbove));
  const auto free = static_cast<float>(log_odds_of(kFreeBelow));
  std::vector<std::int8_t> signs(grid.size());
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const float log_odds = grid.log_odds[i];
    signs[i] = static_cast<std::int8_t>((log_odds > occupied ? 1 : 0) - (log_odds < free ? 1 : 0));
  }
  return signs;
}

struct Voxels {
  const GridFrame& frame;
  std::vector<std::int8_t> signs;
  [[nodiscard]] int sign(const Eigen::Array3i& cell) const {
    return frame.contains(cell) ? signs[frame.index(cell)] : 0;
  }
};

/// From occupied to free cells within two cells' distance; the less they agree the shorter.
Eigen::Vector3d smooth_normal(const Voxels& voxels, const Eigen::Array3i& cell) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (int dz = -2; dz <= 2; ++dz) {
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const Eigen::Array3i offset(dx, dy, dz);
        const int sign = voxels.sign(cell + offset);
        if (sign == 0) continue;
        const Eigen::Vector3d d =
            (offset.cast<double>() * voxels.frame.cell_size_m.array()).matrix();
        sum -= sign * d;
        weight += d.norm();
      }
    }
  }
  const double length = sum.norm();
  if (length <= 0.0) return sum;
  return sum / length * std::min(1.0, 4.0 * length / weight);
}

struct Lighting {
  Eigen::Vector3d p_camera;
  Eigen::Vector3d to_light;  ///< unit
};

/// The corners of one face of a cell, in order round it.
std::array<Eigen::Vector3d, 4> face_corners(const GridFrame& frame, const Eigen::Array3i& cell,
                                            int axis, int side) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const Eigen::Vector3d centre = frame.centre(cell);
  const Eigen::Vector3d half = 0.5 * frame.cell_size_m;
  std::array<Eigen::Vector3d, 4> corners;
  constexpr std::array<std::array<int, 2>, 4> kTurn{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = centre;
    corners[i][axis] += side * half[axis];
    corners[i][u] += kTurn[i][0] * half[u];
    corners[i][v] += kTurn[i][1] * half[v];
  }
  return corners;
}

void draw_face(MapCanvas& canvas, const MapCamera& camera,
               const std::array<Eigen::Vector3d, 4>& corners, const cv::Vec3b& bgr) {
  std::array<Eigen::Vector2d, 4> q;
  double inverse_depth = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = camera.project(corners[i]);
    if (p.z() <= 0.0) return;
    q[i] = p.head<2>();
    inverse_depth += 0.25 * p.z();
  }
  fill_quad(canvas, q, static_cast<float>(inverse_depth), bgr);
}

void draw_voxel(MapCanvas& canvas, const MapCamera& camera, const Voxels& voxels,
                const Lighting& light, const Eigen::Array3i& cell) {
  const GridFrame& frame = voxels.frame;
  const Eigen::Vector3d to_camera = light.p_camera - frame.centre(cell);
  const double share = (cell.z() + 0.5) / frame.cells.z();
  bool normal_known = false;
  Eigen::Vector3d normal;
  for (int axis = 0; axis < 3; ++axis) {
    const int side = to_camera[axis] > 0.0 ? 1 : -1;
    Eigen::Array3i neighbour = cell;
    neighbour[axis] += side;
    if (std::abs(to_camera[axis]) <= 0.5 * frame.cell_size_m[axis]) continue;
    if (voxels.sign(neighbour) > 0) continue;
    if (!normal_known) normal = smooth_normal(voxels, cell);
    normal_known = true;
    const Eigen::Vector3d face = side * Eigen::Vector3d::Unit(axis);
    Eigen::Vector3d mixed = 0.75 * normal + 0.25 * face;
    mixed.normalize();
    const double lit = 0.38 + 0.70 * std::max(0.0, mixed.dot(light.to_light));
    const cv::Vec3d colour = height_colour_bgr(share) * lit;
    draw_face(
        canvas, camera, face_corners(frame, cell, axis, side),
        {cv::saturate_cast<std::uint8_t>(colour[0]), cv::saturate_cast<std::uint8_t>(colour[1]),
         cv::saturate_cast<std::uint8_t>(colour[2])});
  }
}

/// Darkens pixels whose surroundings are nearer to the camera: objects stand off from what is
/// behind them.  [Boucheny2009, eye-dome lighting]
void shade_depth_rims(MapCanvas& canvas) {
  const cv::Mat depth = canvas.inverse_depth.clone();
  constexpr int kReach_px = 3;
  constexpr std::array<std::array<int, 2>, 8> kRing{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
  for (int y = kReach_px; y < depth.rows - kReach_px; ++y) {
    const auto* row = depth.ptr<float>(y);
    auto* colour_row = canvas.bgr.ptr<cv::Vec3b>(y);
    for (int x = kReach_px; x < depth.cols - kReach_px; ++x) {
      if (row[x] <= 0.0F) continue;
      float excess = 0.0F;
      for (const auto& [dx, dy] : kRing) {
        const float other = depth.ptr<float>(y + kReach_px * dy)[x + kReach_px * dx];
        excess += std::max(0.0F, other / row[x] - 1.0F - 0.004F);
      }
      if (excess > 0.0F)
        blend(colour_row[x], {}, 1.0 - std::exp(-kRimStrength * std::min(excess, 0.1F)));
    }
  }
}

}  // namespace

Eigen::Vector3d MapCamera::project(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p = T_camera_world * p_world;
  if (p.z() < kNearPlane_m) return {0.0, 0.0, -1.0};
  return {centre_px.x() + focal_px * p.x() / p.z(), centre_px.y() + focal_px * p.y() / p.z(),
          1.0 / p.z()};
}

MapCamera fit_camera(std::span<const Eigen::Vector3d> points_m, double azimuth_rad,
                     double elevation_rad, const cv::Rect& viewport) {
  expects(!points_m.empty(), "a camera is fitted to points");
  Eigen::AlignedBox3d box;
  for (const auto& p : points_m) box.extend(p);
  const double radius = std::max(1e-3, 0.5 * box.diagonal().norm());
  const double ce = std::cos(elevation_rad);
  const Eigen::Vector3d back(ce * std::cos(azimuth_rad), ce * std::sin(azimuth_rad),
                             std::sin(elevation_rad));
  const Eigen::Vector3d right(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
  MapCamera camera;
  Eigen::Matrix3d R;
  R.row(0) = right;
  R.row(1) = right.cross(back);
  R.row(2) = -back;
  camera.T_camera_world.linear() = R;
  camera.T_camera_world.translation() = -R * (box.center() + kDistanceOverRadius * radius * back);
  Eigen::AlignedBox2d image;
  for (const auto& p : points_m) image.extend(Eigen::Vector2d(camera.project(p).head<2>()));
  const Eigen::Vector2d size = image.sizes().cwiseMax(1e-6);
  camera.focal_px = std::min(viewport.width / size.x(), viewport.height / size.y());
  camera.centre_px =
      Eigen::Vector2d(viewport.x + 0.5 * viewport.width, viewport.y + 0.5 * viewport.height) -
      camera.focal_px * image.center();
  return camera;
}

MapCanvas make_canvas(cv::Size size) {
  return {cv::Mat(size, CV_8UC3, cv::Scalar()), cv::Mat(size, CV_32F, cv::Scalar())};
}

void draw_line(MapCanvas& canvas, const MapCamera& camera, const Eigen::Vector3d& p0_world,
               const Eigen::Vector3d& p1_world, const LineStyle& style) {
  const Eigen::Vector3d a = camera.project(p0_world);
  const Eigen::Vector3d b = camera.project(p1_world);
  if (a.z() <= 0.0 || b.z() <= 0.0) return;
  const Eigen::Vector2d along = (b - a).head<2>();
  const double length2 = std::max(along.squaredNorm(), 1e-18);
  const double reach = 0.5 * style.width_px + 0.5;
  // Along the steeper axis, and across it only as far as the stroke is wide.
  const int major = std::abs(along.x()) >= std::abs(along.y()) ? 0 : 1;
  const int minor = 1 - major;
  const double slope = std::abs(along[major]) > 1e-9 ? along[minor] / along[major] : 0.0;
  const double across = reach * std::sqrt(1.0 + slope * slope);
  const std::array<int, 2> last{canvas.bgr.cols - 1, canvas.bgr.rows - 1};
  const auto [low, high] = pixel_range(a[major], b[major], reach, last[major]);
  std::array<int, 2> at{};
  for (at[major] = low; at[major] <= high; ++at[major]) {
    const double middle = a[minor] + slope * (at[major] - a[major]);
    const auto [begin, end] = pixel_range(middle, middle, across, last[minor]);
    for (at[minor] = begin; at[minor] <= end; ++at[minor]) {
      const Eigen::Vector2d p(at[0] - a.x(), at[1] - a.y());
      const double t = std::clamp(p.dot(along) / length2, 0.0, 1.0);
      const double cover = std::clamp(reach - (p - t * along).norm(), 0.0, 1.0);
      if (cover <= 0.0) continue;
      const double inverse_depth = a.z() + t * (b.z() - a.z());
      const bool hidden = canvas.inverse_depth.at<float>(at[1], at[0]) > inverse_depth * 1.002;
      blend(canvas.bgr.at<cv::Vec3b>(at[1], at[0]), style.bgr,
            cover * (hidden ? style.hidden_opacity : style.opacity));
    }
  }
}

void draw_voxels(MapCanvas& canvas, const MapCamera& camera, const OccupancyGrid& grid) {
  const Voxels voxels{grid.frame, cell_signs(grid)};
  const Eigen::Matrix3d R_world_camera = camera.T_camera_world.linear().transpose();
  const Eigen::Vector3d to_light =
      (R_world_camera * Eigen::Vector3d(-0.45, -0.75, -0.6)).normalized();
  const Lighting light{camera.p_world_camera(), to_light};
  for (std::size_t i = 0; i < voxels.signs.size(); ++i) {
    if (voxels.signs[i] > 0) draw_voxel(canvas, camera, voxels, light, grid.frame.cell(i));
  }
  shade_depth_rims(canvas);
}

cv::Vec3d height_colour_bgr(double share) {
  static const std::array<cv::Vec3d, 6> kStops{{{184, 92, 58},
                                                {202, 165, 42},
                                                {150, 200, 70},
                                                {90, 215, 190},
                                                {70, 190, 250},
                                                {90, 110, 250}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kStops.size() - 2);
  return kStops[i] + (kStops[i + 1] - kStops[i]) * (at - static_cast<double>(i));
}

}  // namespace vantage
