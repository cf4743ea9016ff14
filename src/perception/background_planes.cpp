#include "vantage/perception/background_planes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

constexpr int kSamples = 12000;  ///< pixels looked at, about
constexpr int kDraws = 300;
constexpr std::size_t kMaxPlanes = 4;
constexpr double kMinShare = 0.12;        ///< of all measured pixels
constexpr double kOwnBorderShare = 0.12;  ///< of what is on it, at the border
constexpr double kBorderShare = 0.08;     ///< of those at the border
constexpr double kBorder = 0.08;          ///< width of the border, of the picture's sides
constexpr double kMiddleDensity = 2.0;    ///< in the middle half, times that in the whole picture
constexpr double kStandsOut = 0.015;      ///< of the middle half, what is before the plane
constexpr double kMinUp = 0.25;           ///< of a support surface's normal, along the image's up
constexpr double kMaxRoll = 0.35;

struct Sample {
  Eigen::Vector3d p;
  bool border = false;
  bool middle = false;
};

std::vector<Sample> samples_of(const ObjectView& view) {
  const int pixels = view.width_px * view.height_px;
  const int stride = std::max(1, static_cast<int>(std::sqrt(pixels / kSamples)));
  std::vector<Sample> samples;
  for (int row = 0; row < view.height_px; row += stride) {
    for (int column = 0; column < view.width_px; column += stride) {
      const float z_m = view.depth_m[view.index(row, column)];
      if (!(z_m > 0.0F) || !std::isfinite(z_m)) continue;
      const double x = (column + 0.5) / view.width_px;
      const double y = (row + 0.5) / view.height_px;
      const double edge = std::min({x, y, 1.0 - x, 1.0 - y});
      samples.push_back({.p = view.point(row, column),
                         .border = edge < kBorder,
                         .middle = std::abs(x - 0.5) < 0.25 && std::abs(y - 0.5) < 0.25});
    }
  }
  return samples;
}

BackgroundPlane facing_camera(Eigen::Vector3d normal, const Eigen::Vector3d& point) {
  if (normal.dot(point) > 0.0) normal = -normal;
  return {.normal = normal, .offset_m = -normal.dot(point)};
}

bool on(const BackgroundPlane& plane, const Eigen::Vector3d& p) {
  return std::abs(plane.height_above(p)) <= plane_tolerance_m(p.z());
}

std::vector<std::size_t> inliers(const BackgroundPlane& plane, const std::vector<Sample>& samples,
                                 const std::vector<std::size_t>& left) {
  std::vector<std::size_t> found;
  for (const std::size_t i : left) {
    if (on(plane, samples[i].p)) found.push_back(i);
  }
  return found;
}

/// Through the inliers, by least squares.
BackgroundPlane refined(const std::vector<Sample>& samples,
                        const std::vector<std::size_t>& inliers) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::size_t i : inliers) mean += samples[i].p;
  mean /= static_cast<double>(inliers.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::size_t i : inliers) {
    const Eigen::Vector3d off = samples[i].p - mean;
    spread += off * off.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  return facing_camera(solver.eigenvectors().col(0), mean);
}

/// The plane with most inliers among those left.
BackgroundPlane largest_plane(const std::vector<Sample>& samples,
                              const std::vector<std::size_t>& left, Rng& rng) {
  BackgroundPlane best;
  std::size_t most = 0;
  const std::size_t step = std::max<std::size_t>(1, left.size() / 1500);
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto any = [&] { return samples[left[rng.uniform_index(left.size())]].p; };
    const Eigen::Vector3d a = any(), b = any(), c = any();
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (!(normal.norm() > 1e-6)) continue;
    const BackgroundPlane plane = facing_camera(normal.normalized(), a);
    std::size_t count = 0;
    for (std::size_t k = 0; k < left.size(); k += step) count += on(plane, samples[left[k]].p);
    if (count > most) {
      most = count;
      best = plane;
    }
  }
  return best;
}

/// Whether enough of what is on it is at the border and not too much of it in the middle, where
/// something is before it.
/// @param own what is on it and on no plane found before
bool is_background(const BackgroundPlane& plane, const std::vector<Sample>& samples,
                   const std::vector<std::size_t>& own) {
  double border = 0.0, middle = 0.0, middle_before = 0.0;
  for (const Sample& sample : samples) {
    border += sample.border ? 1.0 : 0.0;
    middle += sample.middle ? 1.0 : 0.0;
    const bool before = plane.height_above(sample.p) > plane_tolerance_m(sample.p.z());
    middle_before += sample.middle && before ? 1.0 : 0.0;
  }
  const auto own_border = static_cast<double>(
      std::ranges::count_if(own, [&](std::size_t i) { return samples[i].border; }));
  const auto own_middle = static_cast<double>(
      std::ranges::count_if(own, [&](std::size_t i) { return samples[i].middle; }));
  return own_border >= kBorderShare * border &&
         own_border >= kOwnBorderShare * static_cast<double>(own.size()) && own_border > 0.0 &&
         middle_before >= kStandsOut * middle &&
         own_middle * static_cast<double>(samples.size()) <=
             kMiddleDensity * static_cast<double>(own.size()) * middle;
}

}  // namespace

std::vector<BackgroundPlane> background_planes(const ObjectView& view) {
  const std::vector<Sample> samples = samples_of(view);
  std::vector<std::size_t> left(samples.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  const auto all = static_cast<double>(samples.size());
  std::vector<BackgroundPlane> planes;
  Rng rng = Rng::stream(1, "background planes");
  for (std::size_t search = 0; search < 2 * kMaxPlanes && planes.size() < kMaxPlanes; ++search) {
    if (static_cast<double>(left.size()) < kMinShare * all || left.size() < 30) break;
    BackgroundPlane plane = largest_plane(samples, left, rng);
    for (int pass = 0; pass < 2; ++pass) {
      const auto near = inliers(plane, samples, left);
      if (near.size() >= 3) plane = refined(samples, near);
    }
    const auto near = inliers(plane, samples, left);
    plane.share = static_cast<double>(near.size()) / all;
    if (plane.share < kMinShare) break;
    if (is_background(plane, samples, near)) planes.push_back(plane);
    std::erase_if(left, [&](std::size_t i) { return on(plane, samples[i].p); });
  }
  return planes;
}

double elevation_over(const std::vector<BackgroundPlane>& planes) {
  double best = kMinUp;
  double elevation_rad = -1.0;
  for (const BackgroundPlane& plane : planes) {
    const Eigen::Vector3d& up = plane.normal;
    // A wall's normal looks at the camera, or down if the camera looks down on it.
    const double upward = -up.y();
    if (upward <= best || std::abs(up.x()) > kMaxRoll || up.z() > 0.1) continue;
    best = upward;
    elevation_rad =
        std::clamp(std::asin(std::clamp(-up.z(), -1.0, 1.0)), 0.0, 0.5 * std::numbers::pi);
  }
  return elevation_rad;
}

}  // namespace vantage
