#include "vantage/planners/navigation/footprint_space.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "vantage/belief/map/floor_detail.hpp"

namespace vantage {
namespace {

constexpr double kTight_m = 0.005;

FloorOutline disc(double radius_m) {
  constexpr int kCorners = 32;
  FloorOutline outline;
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kCorners;
    outline.emplace_back(radius_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return outline;
}

/// What goes along its heading goes the same way back after half a turn.
FloorOutline both_ways(FloorOutline outline) {
  const std::size_t corners = outline.size();
  for (std::size_t i = 0; i < corners; ++i) outline.emplace_back(-outline[i]);
  return convex_outline(std::move(outline));
}

}  // namespace

double heading_along(const RobotOutline& robot, const Eigen::Vector2d& from_m,
                     const Eigen::Vector2d& to_m, double yaw_rad) {
  const Eigen::Vector2d way = to_m - from_m;
  if (robot.goes_sideways || way.norm() < 1e-6) return yaw_rad;
  return std::atan2(way.y(), way.x());
}

FootprintSpace::FootprintSpace(const FloorMap& detail, int parts, const RobotOutline& robot,
                               const PassageOptions& options)
    : parts_(parts),
      robot_(robot),
      options_(options),
      circumscribed_m_(circumscribed_radius_m(robot.outline)),
      first_centre_m_(detail.centre({0, 0})),
      cell_m_(detail.cell_m),
      nx_(detail.nx),
      ny_(detail.ny),
      words_((static_cast<std::size_t>(detail.nx) + 63) / 64),
      bits_(words_ * static_cast<std::size_t>(detail.ny), 0) {
  check_options(options, "passages");
  if (!robot_.goes_sideways) robot_.outline = both_ways(std::move(robot_.outline));
  for (std::size_t cell = 0; cell < detail.size(); ++cell) {
    if (is_free(detail, cell)) continue;
    const Eigen::Array2i at = detail.cell(cell);
    const auto x = static_cast<std::size_t>(at.x());
    bits_[static_cast<std::size_t>(at.y()) * words_ + x / 64] |= std::uint64_t{1} << (x % 64);
  }
  for (const Margin margin : {Margin::tight, Margin::least, Margin::preferred}) {
    const FloorOutline kept = grown(robot_.outline, margin_m(margin));
    HeadingMasks& masks = masks_[static_cast<std::size_t>(margin)];
    for (int heading = 0; heading < headings(); ++heading) {
      masks.at.push_back(mask_of(moved(kept, Pose2{0.0, 0.0, heading_rad(heading)})));
      masks.common.push_back(common_of(masks.at.back()));
      masks.turn.push_back(turn_mask_of(kept, heading));
    }
  }
  disc_ = mask_of(disc(inscribed_radius_m(robot_.outline)));
}

double FootprintSpace::heading_rad(int heading) const {
  return wrap_angle(2.0 * std::numbers::pi * heading / headings());
}

int FootprintSpace::nearest_heading(double yaw_rad) const {
  const int heading =
      static_cast<int>(std::lround(yaw_rad * headings() / (2.0 * std::numbers::pi)));
  return (heading % headings() + headings()) % headings();
}

Eigen::Vector2d FootprintSpace::centre(const Eigen::Array2i& cell) const {
  return first_centre_m_ + cell_m_ * cell.cast<double>().matrix();
}

FootprintSpace::Mask FootprintSpace::mask_of(const FloorOutline& outline) const {
  Mask mask;
  for_each_row_inside(outline, Eigen::Vector2d::Zero(), cell_m_, [&](int row, int first, int last) {
    mask.push_back({row, first, last});
  });
  return mask;
}

FootprintSpace::Mask FootprintSpace::turn_mask_of(const FloorOutline& outline, int heading) const {
  constexpr int kSteps = 8;  // between them 4 mm are left of such a corner
  const double step_rad = 2.0 * std::numbers::pi / headings() / kSteps;
  std::map<int, Row> rows;
  for (int step = 0; step <= kSteps; ++step) {
    const double yaw_rad = step < kSteps ? heading_rad(heading) + step * step_rad
                                         : heading_rad((heading + 1) % headings());
    for (const Row& row : mask_of(moved(outline, Pose2{0.0, 0.0, yaw_rad}))) {
      Row& all = rows.try_emplace(row.row, row).first->second;
      all.first = std::min(all.first, row.first);
      all.last = std::max(all.last, row.last);
    }
  }
  Mask mask;
  for (const auto& [index, row] : rows) mask.push_back(row);
  return mask;
}

FootprintSpace::Mask FootprintSpace::common_of(const Mask& mask) const {
  const int reach = parts_ / 2;
  Mask common;
  for (std::size_t i = static_cast<std::size_t>(reach);
       i + static_cast<std::size_t>(reach) < mask.size(); ++i) {
    Row row = mask[i];
    for (std::size_t k = i - static_cast<std::size_t>(reach);
         k <= i + static_cast<std::size_t>(reach); ++k) {
      row.first = std::max(row.first, mask[k].first);
      row.last = std::min(row.last, mask[k].last);
    }
    row.first += reach;
    row.last -= reach;
    if (row.first <= row.last) common.push_back(row);
  }
  return common;
}

bool FootprintSpace::is_clear(int row, int first, int last) const {
  if (row < 0 || row >= ny_ || first < 0 || last >= nx_) return false;
  const auto begin = static_cast<std::size_t>(first);
  const auto end = static_cast<std::size_t>(last);
  const std::uint64_t* words = &bits_[static_cast<std::size_t>(row) * words_];
  const std::uint64_t low = ~std::uint64_t{0} << (begin % 64);
  const std::uint64_t high = ~std::uint64_t{0} >> (63 - end % 64);
  if (begin / 64 == end / 64) return (words[begin / 64] & low & high) == 0;
  if ((words[begin / 64] & low) != 0 || (words[end / 64] & high) != 0) return false;
  for (std::size_t word = begin / 64 + 1; word < end / 64; ++word) {
    if (words[word] != 0) return false;
  }
  return true;
}

bool FootprintSpace::is_clear(const Mask& mask, const Eigen::Array2i& cell) const {
  return std::ranges::all_of(mask, [&](const Row& row) {
    return is_clear(cell.y() + row.row, cell.x() + row.first, cell.x() + row.last);
  });
}

bool FootprintSpace::fits(std::span<const Eigen::Vector2d> outline,
                          const Pose2& T_world_base) const {
  bool clear = true;
  for_each_row_inside(
      moved(outline, T_world_base), first_centre_m_, cell_m_,
      [&](int row, int first, int last) { clear = clear && is_clear(row, first, last); });
  return clear;
}

bool FootprintSpace::fits_along(std::span<const Eigen::Vector2d> outline,
                                const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
                                double yaw_rad) const {
  constexpr double kSample_m = 0.03;
  const int samples = 1 + static_cast<int>((to_m - from_m).norm() / kSample_m);
  for (int i = 0; i <= samples; ++i) {
    const Eigen::Vector2d p_m = from_m + static_cast<double>(i) / samples * (to_m - from_m);
    if (!fits(outline, Pose2{p_m.x(), p_m.y(), yaw_rad})) return false;
  }
  return true;
}

bool FootprintSpace::fits(const Eigen::Array2i& cell, int heading, Margin margin) const {
  const HeadingMasks& masks = masks_[static_cast<std::size_t>(margin)];
  return is_clear(masks.at[static_cast<std::size_t>(heading)], cell);
}

bool FootprintSpace::may_fit(const Eigen::Array2i& cell, int heading, Margin margin) const {
  const HeadingMasks& masks = masks_[static_cast<std::size_t>(margin)];
  return is_clear(masks.common[static_cast<std::size_t>(heading)], cell);
}

bool FootprintSpace::fits_turning(const Eigen::Array2i& cell, int heading, Margin margin) const {
  const HeadingMasks& masks = masks_[static_cast<std::size_t>(margin)];
  return is_clear(masks.turn[static_cast<std::size_t>(heading)], cell);
}

double FootprintSpace::margin_m(Margin margin) const {
  switch (margin) {
    case Margin::tight: return std::min(kTight_m, options_.margin_m);
    case Margin::preferred: return std::max(options_.preferred_margin_m, options_.margin_m);
    case Margin::least: break;
  }
  return options_.margin_m;
}

bool FootprintSpace::may_stand(const Eigen::Array2i& cell) const { return is_clear(disc_, cell); }

}  // namespace vantage
