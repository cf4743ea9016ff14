#include "vantage/perception/search/support_search.hpp"

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

/// Points between the lowest and the highest surface.
struct Band {
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();  ///< of the raster
  cv::Size cells;
};

Band band_of(const PointCloud& world, const SupportSearchOptions& options) {
  Band band;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3f& p : world.points) {
    if (!(p.z() >= options.min_height_m && p.z() <= options.max_height_m)) continue;
    band.points.emplace_back(p.cast<double>());
    box.extend(band.points.back().head<2>());
  }
  if (band.points.empty()) return band;
  constexpr int kBorder = 2;
  band.corner_m = box.min().array() - kBorder * options.cell_m;
  const Eigen::Array2i cells =
      (box.sizes().array() / options.cell_m).floor().cast<int>() + 1 + 2 * kBorder;
  band.cells = {cells.x(), cells.y()};
  return band;
}

cv::Point cell_of(const Band& band, const Eigen::Vector3d& p, double cell_m) {
  const Eigen::Array2d at = (p.head<2>() - band.corner_m).array() / cell_m;
  return {static_cast<int>(at.x()), static_cast<int>(at.y())};
}

/// Heights at which more points lie than up to 4 cm above and below, ascending.
std::vector<double> crowded_heights(const Band& band, const SupportSearchOptions& options) {
  constexpr double kBin_m = 0.01;
  constexpr int kApart = 4;
  const auto bins = static_cast<std::size_t>(
      std::ceil((options.max_height_m - options.min_height_m) / kBin_m) + 1.0);
  std::vector<int> count(bins, 0);
  for (const auto& p : band.points) {
    ++count[static_cast<std::size_t>((p.z() - options.min_height_m) / kBin_m)];
  }
  const auto at = [&](int bin) {
    return bin < 0 || bin >= static_cast<int>(bins) ? 0 : count[static_cast<std::size_t>(bin)];
  };
  std::vector<int> smooth;
  for (int bin = 0; bin < static_cast<int>(bins); ++bin) {
    smooth.push_back(at(bin - 2) + at(bin - 1) + at(bin) + at(bin + 1) + at(bin + 2));
  }
  constexpr int kFewest = 12;
  std::vector<double> heights;
  for (int bin = 0; bin < static_cast<int>(bins); ++bin) {
    const int here = smooth[static_cast<std::size_t>(bin)];
    bool peak = here >= kFewest;
    for (int other = std::max(0, bin - kApart);
         peak && other <= std::min(static_cast<int>(bins) - 1, bin + kApart); ++other) {
      const int there = smooth[static_cast<std::size_t>(other)];
      peak = other < bin ? there < here : there <= here;
    }
    if (peak) heights.push_back(options.min_height_m + (bin + 0.5) * kBin_m);
  }
  return heights;
}

struct Fit {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< dz/dx, dz/dy
  [[nodiscard]] double above(const Eigen::Vector3d& p) const {
    return p.z() - centroid.z() - slope.dot((p - centroid).head<2>());
  }
};

/// z = z0 + slope (x, y), least squares; steeper slopes than `steepest` are shortened to it, since
/// what is seen of a surface may be too narrow to tell.
Fit fit_plane(const std::vector<Eigen::Vector3d>& points, double steepest) {
  Fit fit;
  for (const auto& p : points) fit.centroid += p;
  fit.centroid /= static_cast<double>(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d lean = Eigen::Vector2d::Zero();
  for (const auto& p : points) {
    const Eigen::Vector3d d = p - fit.centroid;
    spread += d.head<2>() * d.head<2>().transpose();
    lean += d.z() * d.head<2>();
  }
  constexpr double kPrior_m = 0.02;  // leaves a patch level that is narrower than this
  spread += kPrior_m * kPrior_m * static_cast<double>(points.size()) * Eigen::Matrix2d::Identity();
  fit.slope = spread.ldlt().solve(lean);
  if (fit.slope.norm() > steepest) fit.slope *= steepest / fit.slope.norm();
  return fit;
}

TablePlane to_plane(const std::vector<Eigen::Vector3d>& points, const Fit& fit) {
  TablePlane plane;
  plane.centroid_m = fit.centroid;
  plane.height_m = fit.centroid.z();
  plane.normal = Eigen::Vector3d(-fit.slope.x(), -fit.slope.y(), 1.0).normalized();
  plane.inliers = points.size();
  std::vector<Eigen::Vector2d> outline;
  for (const auto& p : points) {
    const Eigen::Vector3d d = p - fit.centroid;
    plane.scatter_m2 += d * d.transpose();
    outline.emplace_back(p.head<2>());
  }
  plane.hull = convex_hull(std::move(outline));
  return plane;
}

double area_m2(const std::vector<Eigen::Vector2d>& hull) {
  double twice_m2 = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d& next = hull[(i + 1) % hull.size()];
    twice_m2 += hull[i].x() * next.y() - hull[i].y() * next.x();
  }
  return 0.5 * twice_m2;
}

/// The points of a patch, fitted again without what only leans against it: feet of objects would
/// tilt the plane.
std::optional<TablePlane> plane_of(std::vector<Eigen::Vector3d> points,
                                   const SupportSearchOptions& options) {
  constexpr std::size_t kFewest = 8;
  const double steepest = std::tan(options.max_tilt_rad);
  for (const double share : {1.0, 0.75, 0.5}) {
    if (points.size() < kFewest) return std::nullopt;
    const Fit fit = fit_plane(points, steepest);
    std::erase_if(points, [&](const Eigen::Vector3d& p) {
      return std::abs(fit.above(p)) > share * options.inlier_distance_m;
    });
  }
  if (points.size() < kFewest) return std::nullopt;
  return to_plane(points, fit_plane(points, steepest));
}

/// Cells that show something at a height, without those that show something well above it too: a
/// wall's, and those that objects cover.
cv::Mat1b level_cells(const Band& band, double height_m, const SupportSearchOptions& options) {
  constexpr double kTall_m = 0.08;
  const double half_m = 2.0 * options.inlier_distance_m;
  cv::Mat1b level(band.cells, static_cast<unsigned char>(0));
  cv::Mat1b tall(band.cells, static_cast<unsigned char>(0));
  for (const auto& p : band.points) {
    const cv::Point cell = cell_of(band, p, options.cell_m);
    if (std::abs(p.z() - height_m) <= half_m) level(cell) = 255;
    if (p.z() > height_m + kTall_m) tall(cell) = 255;
  }
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::morphologyEx(level, level, cv::MORPH_CLOSE, square);
  level.setTo(0, tall);
  cv::morphologyEx(level, level, cv::MORPH_OPEN, square);
  return level;
}

/// Level patches about one height: as thick as walls are not.
std::vector<TablePlane> patches_at(const Band& band, double height_m,
                                   const SupportSearchOptions& options) {
  const double half_m = 2.0 * options.inlier_distance_m;
  const cv::Mat1b raster = level_cells(band, height_m, options);
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(raster, labels, statistics, centres, 8);
  std::vector<std::vector<Eigen::Vector3d>> members(static_cast<std::size_t>(count));
  for (const auto& p : band.points) {
    if (std::abs(p.z() - height_m) > half_m) continue;
    const int label = labels.at<int>(cell_of(band, p, options.cell_m));
    if (label > 0) members[static_cast<std::size_t>(label)].push_back(p);
  }
  std::vector<TablePlane> planes;
  const double cell_area_m2 = options.cell_m * options.cell_m;
  for (int label = 1; label < count; ++label) {
    if (statistics.at<int>(label, cv::CC_STAT_AREA) * cell_area_m2 < options.min_area_m2) continue;
    auto plane = plane_of(std::move(members[static_cast<std::size_t>(label)]), options);
    const bool wide = plane && area_m2(plane->hull) >= options.min_area_m2;
    if (wide) planes.push_back(std::move(*plane));
  }
  return planes;
}

/// Of two above each other the lower, of two at about one height the one that more points speak
/// for.
void add_support(std::vector<TablePlane>& supports, TablePlane plane,
                 const SupportSearchOptions& options) {
  const double same_m = 3.0 * options.inlier_distance_m;
  for (TablePlane& lower : supports) {
    const bool over = inside_hull(lower.hull, plane.centroid_m.head<2>(), options.cell_m) ||
                      inside_hull(plane.hull, lower.centroid_m.head<2>(), options.cell_m);
    if (!over) continue;
    const bool same = std::abs(plane.height_m - lower.height_m) < same_m;
    if (same && plane.inliers > lower.inliers) lower = std::move(plane);
    return;
  }
  supports.push_back(std::move(plane));
}

}  // namespace

void SupportSearchOptions::check() const {
  if (min_height_m >= max_height_m) throw ConfigError("min_height_m must be below max_height_m");
}

std::vector<TablePlane> find_supports(const PointCloud& world,
                                      const SupportSearchOptions& options) {
  check_options(options, "support search");
  const Band band = band_of(world, options);
  std::vector<TablePlane> supports;
  for (const double height_m : crowded_heights(band, options)) {
    for (TablePlane& plane : patches_at(band, height_m, options)) {
      add_support(supports, std::move(plane), options);
    }
  }
  return supports;
}

}  // namespace vantage
